"""The definition of how v2e's pixels fire and memorise, in NumPy float64."""

from __future__ import annotations

import numpy as np

from texvent.events import NOISE, SIGNAL
from texvent.simulate.crossing.ramp import Ramp, Rest
from texvent.simulate.crossing.ramp_reference import cross_ramp
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.v2e.kernels.emit_and_reset import LastEvents, Rules
from texvent.simulate.v2e.kernels.low_pass import Pixels, PixelState, Restless


def fire_and_memorise(
    restless: Restless,
    circuits: tuple[Pixels, PixelState],
    last: LastEvents,
    noise: UnsortedEvents,
    rules: Rules,
) -> UnsortedEvents:
    """Fire at every threshold that was crossed, and move the references by as many.

    Events to which leak and noise of the photoreceptor contributed at least half are noise.

    Args:
        restless: who has reached a threshold.
        circuits: thresholds and leak, and the state, of which the references move.
        last: events until now; brought up to date here.
        noise: further events of the interval.
        rules: where in time, and the refractory period: what it holds back may fire later.

    Returns:
        All events, `noise` among them.
    """
    (pixel, start, stop), (pixels, state), stop_us = restless, circuits, rules.interval.stop_us
    on, off = (
        thresholds[pixel].astype(np.float64)
        for thresholds in (pixels.threshold_on, pixels.threshold_off)
    )
    crossings = cross_ramp(
        Ramp(pixel, start, stop, on, off),
        last.fired_us,
        (rules.interval.start_us, stop_us),
        Rest(rules.refractory_us, is_level_lost=False),
    )
    steps, fired = crossings.steps, pixel[crossings.steps != 0]
    moved = steps * np.where(steps > 0, on, off)
    state.reference[pixel] += moved
    by_noise = np.zeros(len(pixel))
    if pixels.leak is not None:
        by_noise += pixels.leak[pixel].astype(np.float64) * (stop_us - last.interval_us[pixel])
    if state.voltage is not None and last.voltage is not None:
        by_noise += state.voltage[1][pixel] - last.voltage[pixel]
        last.voltage[fired] = state.voltage[1][fired]
    last.interval_us[fired] = stop_us
    is_noise = by_noise * np.sign(steps) >= 0.5 * np.abs(moved)
    # A step is an event here, and events come by pixel.
    label = np.repeat(np.where(is_noise, NOISE, SIGNAL).astype(np.uint8), np.abs(steps))
    fired = UnsortedEvents(crossings.pixel, crossings.t, crossings.p, label)
    return UnsortedEvents.concat((fired, noise))

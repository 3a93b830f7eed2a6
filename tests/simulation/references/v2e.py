"""The definition of v2e's pixels, in NumPy float64: low-pass, then emit and reset."""

import numpy as np
from tests.simulation.references.ramp import Ramp, cross_ramp

from texvent.events import NOISE, SIGNAL
from texvent.simulation.crossing.ramp import RefractoryPeriod
from texvent.simulation.packets import UnsortedEvents
from texvent.simulation.random.mismatch import PixelMismatch
from texvent.simulation.v2e.emit_and_reset import EmissionRules, LastEvents
from texvent.simulation.v2e.low_pass import SETTLED, CrossingPixels, LowPassInput, V2ePixelState
from texvent.simulation.v2e.pixels import lin_log, relative_intensity


def apply_low_pass(
    light: LowPassInput, mismatch: PixelMismatch, state: V2ePixelState
) -> CrossingPixels:
    """As `v2e.low_pass.apply_low_pass`."""
    if light.table is None:
        luma = light.now.astype(np.float64)
        now, relative = lin_log(luma), relative_intensity(luma)
    else:
        now, relative = light.table[0][light.now], light.table[1][light.now]
    light.before[:] = light.now
    before, weight = state.brightness.copy(), np.minimum(relative * light.angle, 1.0)
    lag = now - before
    lags = (weight < 1.0) & (np.abs(lag) >= SETTLED)
    state.brightness[:] = np.where(lags, before + weight * lag, now)
    start, stop = before - state.reference, state.brightness - state.reference
    if mismatch.leak.size:
        leak, elapsed_us = mismatch.leak.astype(np.float64), light.elapsed_us
        start, stop = start + leak * elapsed_us[0], stop + leak * elapsed_us[1]
    pixel = np.flatnonzero((stop >= mismatch.threshold_on) | (-stop >= mismatch.threshold_off))
    return CrossingPixels(pixel, start[pixel], stop[pixel])


def emit_and_reset(
    crossing: CrossingPixels,
    circuits: tuple[PixelMismatch, V2ePixelState],
    last: LastEvents,
    noise: UnsortedEvents,
    rules: EmissionRules,
) -> UnsortedEvents:
    """As `v2e.emit_and_reset.emit_and_reset`."""
    (pixel, start, stop), (mismatch, state), stop_us = crossing, circuits, rules.interval.stop_us
    on, off = (
        thresholds[pixel].astype(np.float64)
        for thresholds in (mismatch.threshold_on, mismatch.threshold_off)
    )
    crossings = cross_ramp(
        Ramp(pixel, start, stop, on, off),
        last.fired_us,
        (rules.interval.start_us, stop_us),
        RefractoryPeriod(rules.refractory_us, is_level_lost=False),
    )
    steps, fired = crossings.steps, pixel[crossings.steps != 0]
    moved = steps * np.where(steps > 0, on, off)
    state.reference[pixel] += moved
    leaked = np.zeros(len(pixel))
    if mismatch.leak.size:
        leaked = mismatch.leak[pixel].astype(np.float64) * (stop_us - last.interval_us[pixel])
    last.interval_us[fired] = stop_us
    is_noise = leaked * np.sign(steps) >= 0.5 * np.abs(moved)
    # Every step is an event here, and events come by pixel.
    label = np.repeat(np.where(is_noise, NOISE, SIGNAL).astype(np.uint8), np.abs(steps))
    fired = UnsortedEvents(crossings.pixel, crossings.t, crossings.p, label)
    return UnsortedEvents.concat((fired, noise))

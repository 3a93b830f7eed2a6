"""How v2e's pixels fire and memorise, compiled by Numba: the reference's bits."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE
from texvent.runtime.jit import jit
from texvent.runtime.scratch import take_scratch
from texvent.simulate.crossing.levels import Thresholds
from texvent.simulate.crossing.ramp import Rest
from texvent.simulate.crossing.ramp_cpu import Clock, Lines, clock_of, count_steps, list_events
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.sorting_cpu import merge_keys, sort_keyed_events
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.v2e.kernels import emit_and_reset_reference as memorise_reference
from texvent.simulate.v2e.kernels.emit_and_reset import LastEvents, Rules
from texvent.simulate.v2e.kernels.low_pass import (
    Float32Array,
    Float64Array,
    Pixels,
    PixelState,
    Restless,
)

Uint64Array = NDArray[np.uint64]
_1, _2 = np.uint64(1), np.uint64(2)
_NOISE = np.uint64(NOISE)


def fire_and_memorise(
    restless: Restless,
    circuits: tuple[Pixels, PixelState],
    last: LastEvents,
    noise: UnsortedEvents,
    rules: Rules,
) -> UnsortedEvents | SortedEvents:
    """See `memorise_reference.fire_and_memorise`."""
    interval = rules.interval
    span_us = interval.start_us, interval.stop_us
    clock = clock_of(span_us, rules.shape)
    if clock is None:
        return memorise_reference.fire_and_memorise(restless, circuits, last, noise, rules)
    (pixel, start, stop), (pixels, state) = restless, circuits
    on, off, threshold = (
        take_scratch(use, len(pixel), np.float64) for use in ("on", "off", "threshold")
    )
    _take(pixel, (pixels.threshold_on, pixels.threshold_off), on, off)
    lines = Lines(start, stop, threshold, take_scratch("steps", len(pixel), np.int64))
    count_steps(lines, Thresholds(on, off))
    keys = list_events(
        pixel, lines, last.fired_us, clock, Rest(rules.refractory_us, is_level_lost=False)
    )
    leak = np.empty(0, np.float32) if pixels.leak is None else pixels.leak
    voltage = np.empty(0), np.empty(0)
    if state.voltage is not None and last.voltage is not None:
        voltage = state.voltage[1], last.voltage
    times = last.interval_us, interval.stop_us
    _memorise(keys, (pixel, lines.threshold, lines.steps), state.reference, leak, voltage, times)
    if len(noise.t):
        keys = merge_keys(keys, _keys_of(noise, clock), clock.low)
    return sort_keyed_events(keys, span_us, rules.shape)


def warm_up() -> None:
    """Compile, or load what was compiled before."""
    one, pixel, threshold = np.ones(1), np.zeros(1, np.int64), np.ones(1, np.float32)
    circuits = Pixels(threshold, threshold, None), PixelState(one, one.copy(), None, one)
    noise = UnsortedEvents.noise(pixel, pixel, np.zeros(1, np.uint8))
    last = LastEvents(pixel.copy(), pixel.copy(), None)
    rules = Rules(FrameInterval(0, 1, np.uint64(0)), 0, (1, 1))
    fire_and_memorise(Restless(pixel, one, one), circuits, last, noise, rules)


@jit
def _take(
    pixel: NDArray[np.int64],
    thresholds: tuple[Float32Array, Float32Array],
    on: Float64Array,
    off: Float64Array,
) -> None:
    """Thresholds of some pixels."""
    all_on, all_off = thresholds
    for n in range(pixel.size):
        on[n], off[n] = all_on[pixel[n]], all_off[pixel[n]]


@jit
def _memorise(
    keys: Uint64Array,
    restless: tuple[NDArray[np.int64], Float64Array, NDArray[np.int64]],
    reference: Float64Array,
    leak: Float32Array,
    voltage: tuple[Float64Array, Float64Array],
    times: tuple[NDArray[np.int64], int],
) -> None:
    """Move the references by the steps of those that fired, and mark what is noise."""
    (pixel, thresholds, steps), (voltage_now, voltage_then) = restless, voltage
    interval_us, stop_us = times
    found = 0
    for n in range(pixel.size):
        count = abs(steps[n])
        if count == 0:
            continue
        i = pixel[n]
        moved, by_noise = steps[n] * thresholds[n], 0.0
        reference[i] += moved
        if leak.size > 0:
            by_noise += np.float64(leak[i]) * (stop_us - interval_us[i])
        if voltage_now.size > 0:
            by_noise += voltage_now[i] - voltage_then[i]
            voltage_then[i] = voltage_now[i]
        interval_us[i] = stop_us
        if (by_noise if steps[n] > 0 else -by_noise) >= 0.5 * abs(moved):
            for k in range(found, found + count):
                keys[k] |= _NOISE
        found += count


@jit
def _keys_of(noise: UnsortedEvents, clock: Clock) -> Uint64Array:
    pixel, t, p, _ = noise
    keys = np.empty(pixel.size, np.uint64)
    for i in range(pixel.size):
        place = np.uint64(pixel[i]) << _2 | np.uint64(p[i]) << _1 | _NOISE
        keys[i] = np.uint64(t[i] - clock.start_us) << np.uint64(clock.low) | place
    return keys

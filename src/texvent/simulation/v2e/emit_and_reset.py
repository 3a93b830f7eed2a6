"""Events of v2e's crossing pixels, and the reset of their references, compiled."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE
from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import take_scratch
from texvent.simulation.crossing.ramp import (
    KeyLayout,
    RampChanges,
    RefractoryPeriod,
    key_layout,
    list_crossing_keys,
)
from texvent.simulation.kernels.radix_sort import merge_keys, sort_keyed_events
from texvent.simulation.packets import FrameInterval, SortedEvents, UnsortedEvents
from texvent.simulation.random.mismatch import PixelMismatch, Thresholds
from texvent.simulation.v2e.low_pass import CrossingPixels, Float64Array, V2ePixelState


class LastEvents(NamedTuple):
    """The pixels' last events; [n] each."""

    fired_us: NDArray[np.int64]
    """Time of the last event that counts for the refractory period, µs."""
    interval_us: NDArray[np.int64]
    """End of the interval of the last event of any kind, µs."""


class EmissionRules(NamedTuple):
    """Interval and sensor of the events, and the refractory period."""

    interval: FrameInterval
    refractory_us: int
    shape: tuple[int, int]
    """(height, width) of the sensor."""


Uint64Array = NDArray[np.uint64]
_1, _2 = np.uint64(1), np.uint64(2)
_NOISE = np.uint64(NOISE)


def emit_and_reset(
    crossing: CrossingPixels,
    circuits: tuple[PixelMismatch, V2ePixelState],
    last: LastEvents,
    noise: UnsortedEvents,
    rules: EmissionRules,
) -> SortedEvents:
    """Fire at every threshold that was crossed, and move the references by as many.

    Events to which leak contributed at least half are noise.

    Args:
        crossing: the pixels that have reached a threshold.
        circuits: thresholds and leak, and the state, whose references are moved.
        last: the last events; brought up to date here.
        noise: further events of the interval.
        rules: where in time, and the refractory period. What it holds back may fire later.

    Returns:
        All events, `noise` among them, in the order of a packet.

    Raises:
        InputError: the interval is too long for a sensor of this size.
    """
    interval = rules.interval
    span_us = interval.start_us, interval.stop_us
    layout = key_layout(span_us, rules.shape)
    (pixel, start, stop), (mismatch, state) = crossing, circuits
    on, off, threshold = (
        take_scratch(use, len(pixel), np.float64) for use in ("on", "off", "threshold")
    )
    _take_thresholds(pixel, mismatch, on, off)
    changes = RampChanges(start, stop, threshold, take_scratch("steps", len(pixel), np.int64))
    refractory = RefractoryPeriod(rules.refractory_us, is_level_lost=False)
    keys = list_crossing_keys(
        pixel, changes, Thresholds(on, off), last.fired_us, layout, refractory
    )
    _reset(keys, (pixel, changes), mismatch.leak, state, last, interval.stop_us)
    if len(noise.t):
        keys = merge_keys(keys, _keys_of(noise, layout), layout.low)
    return sort_keyed_events(keys, span_us, rules.shape)


@jit
def _take_thresholds(
    pixel: NDArray[np.int64], mismatch: PixelMismatch, on: Float64Array, off: Float64Array
) -> None:
    """Thresholds of some pixels."""
    all_on, all_off, _ = mismatch
    for n in range(pixel.size):
        on[n], off[n] = all_on[pixel[n]], all_off[pixel[n]]


@jit
def _reset(
    keys: Uint64Array,
    moves: tuple[NDArray[np.int64], RampChanges],
    leak: NDArray[np.float32],
    state: V2ePixelState,
    last: LastEvents,
    stop_us: int,
) -> None:
    """Move the references of pixels that fired, and label what is noise."""
    pixel, (_, _, thresholds, steps) = moves
    _, reference, _ = state
    _, interval_us = last
    found = 0
    for n in range(pixel.size):
        count = abs(steps[n])
        if count == 0:
            continue
        i = pixel[n]
        moved, leaked = steps[n] * thresholds[n], 0.0
        reference[i] += moved
        if leak.size > 0:
            leaked = np.float64(leak[i]) * (stop_us - interval_us[i])
        interval_us[i] = stop_us
        if (leaked if steps[n] > 0 else -leaked) >= 0.5 * abs(moved):
            for k in range(found, found + count):
                keys[k] |= _NOISE
        found += count


@jit
def _keys_of(noise: UnsortedEvents, layout: KeyLayout) -> Uint64Array:
    pixel, t, p, _ = noise
    keys = np.empty(pixel.size, np.uint64)
    for i in range(pixel.size):
        place = np.uint64(pixel[i]) << _2 | np.uint64(p[i]) << _1 | _NOISE
        keys[i] = np.uint64(t[i] - layout.start_us) << np.uint64(layout.low) | place
    return keys

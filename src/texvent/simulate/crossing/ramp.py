"""Threshold crossings of brightness that changes in a straight line between two frames, compiled.

ESIM and v2e share them. Both compare the brightness of a pixel with its reference, fire at every
threshold that is crossed, and move the reference by one threshold per event. Crossings are counted
first, then listed, each as one 64-bit key of `kernels.radix_sort`.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import take_scratch
from texvent.simulate.kernels.radix_sort import KEY_USES, key_bits
from texvent.simulate.packets import check_event_number
from texvent.simulate.random.mismatch import Thresholds

Float64Array: TypeAlias = NDArray[np.float64]


class RefractoryPeriod(NamedTuple):
    """Refractory period, in which a pixel cannot fire."""

    period_us: int
    """µs; 0 is none."""
    is_level_lost: bool
    """Whether a crossing within the period is lost (ESIM: the reference moves past it) or may still
    fire in a later interval (v2e: the reference stays)."""


_1, _2 = np.uint64(1), np.uint64(2)
FEW = 2
"""Events that most pixels that fire have at most in an interval."""


class RampChanges(NamedTuple):
    """Change of each pixel, and how many thresholds it crosses; [n] each."""

    start: Float64Array
    """Change at the start of the interval, log units."""
    stop: Float64Array
    """Change at its end."""
    threshold: Float64Array
    """Of the polarity that it may fire."""
    steps: NDArray[np.int64]
    """Thresholds that it has passed at the end; OFF below 0."""


class KeyLayout(NamedTuple):
    """Place of the time of an event in its key."""

    start_us: int
    duration_us: int
    low: int
    """Bits of a key below its time."""


def key_layout(span_us: tuple[int, int], shape: tuple[int, int]) -> KeyLayout:
    """The layout for an interval and a sensor.

    Raises:
        InputError: the interval is too long for a sensor of this size.
    """
    start_us, stop_us = span_us
    return KeyLayout(start_us, stop_us - start_us, key_bits(stop_us - start_us, shape))


def list_crossing_keys(
    pixel: NDArray[np.int64],
    changes: RampChanges,
    fired_us: NDArray[np.int64],
    layout: KeyLayout,
    refractory: RefractoryPeriod,
) -> NDArray[np.uint64]:
    """Keys of all events, by pixel and then in time."""
    number = _add_up(changes.steps)
    check_event_number(number)
    keys = take_scratch(KEY_USES[0], number + FEW, np.uint64)
    return keys[: _list_crossings(pixel, changes, fired_us, layout, refractory, keys)]


@jit(error_model="numpy")
def count_crossings(changes: RampChanges, thresholds: Thresholds) -> None:
    """Fill in thresholds and steps."""
    _, stop, threshold, steps = changes
    on, off = thresholds
    # Loops over few arrays each, which become vector instructions.
    if on.size == 1:
        single_on, single_off = on[0], off[0]
        for n in range(stop.size):
            threshold[n] = single_on if stop[n] > 0 else single_off
    else:
        for n in range(stop.size):
            threshold[n] = on[n] if stop[n] > 0 else off[n]
    for n in range(stop.size):
        change, size = abs(stop[n]), threshold[n]
        # The quotient may be rounded across a whole number; what counts is the product.
        count = np.floor(change / size)
        count += 1.0 if change >= (count + 1.0) * size else 0.0
        count -= 1.0 if change < count * size else 0.0
        steps[n] = np.int64(count if stop[n] > 0 else -count)


@jit
def _add_up(steps: NDArray[np.int64]) -> int:
    """Number of all crossings."""
    total = 0
    for n in range(steps.size):
        total += abs(steps[n])
    return total


@jit(error_model="numpy")
def _list_crossings(
    pixel: NDArray[np.int64],
    changes: RampChanges,
    fired_us: NDArray[np.int64],
    layout: KeyLayout,
    refractory: RefractoryPeriod,
    keys: NDArray[np.uint64],
) -> int:
    """Fill in the keys of all events, by pixel and then in time; how many there are."""
    start, stop, thresholds, steps = changes
    low, found = np.uint64(layout.low), 0
    duration = np.float64(layout.duration_us)
    for i in range(pixel.size):
        is_on, count, threshold = steps[i] > 0, abs(steps[i]), thresholds[i]
        # By a product: a branch on ON or OFF would be mispredicted too.
        begin, end = math.copysign(1.0, stop[i]) * start[i], abs(stop[i])
        place = np.uint64(pixel[i]) << _2 | np.uint64(is_on) << _1
        # The first few always, also beyond the count: the end of a loop whose length differs
        # from pixel to pixel is mispredicted. The next pixel overwrites what is too many.
        for k in range(FEW):
            keys[found + k] = _key((k + 1) * threshold, (begin, end), duration, low) | place
        for k in range(FEW, count):
            keys[found + k] = _key((k + 1) * threshold, (begin, end), duration, low) | place
        if refractory.period_us > 0 and count > 0:
            # Far apart in memory, so not even looked at where it does not matter.
            last_us = fired_us[pixel[i]] - layout.start_us
            if not _none_refractory(keys[found : found + FEW], count, last_us, refractory, low):
                count = _drop_refractory(keys[found : found + count], last_us, refractory, low)
                if not refractory.is_level_lost:
                    steps[i] = count if is_on else -count
            if count > 0:
                fired_us[pixel[i]] = layout.start_us + np.int64(keys[found + count - 1] >> low)
        found += count
    return found


@jit(inline="always")
def _key(level: float, ends: tuple[float, float], duration: float, low: np.uint64) -> Any:
    """Time at which the line from begin to end reaches a level, in the bits of a key."""
    begin, end = ends
    fraction = (level - begin) / (end - begin) if begin < level else 0.0
    return np.uint64(np.int64(min(np.floor(fraction * duration), duration - 1.0))) << low


@jit(inline="always")
def _none_refractory(
    keys: NDArray[np.uint64], count: int, last_us: int, refractory: RefractoryPeriod, low: np.uint64
) -> bool:
    """Whether none of at most `FEW` events is in a refractory period; False for more."""
    is_allowed, before_us = bool(count <= FEW), last_us
    for k in range(FEW):
        offset_us = np.int64(keys[k] >> low)
        is_allowed &= bool((k >= count) | (offset_us - before_us >= refractory.period_us))
        before_us = int(offset_us)
    return is_allowed


@jit
def _drop_refractory(
    keys: NDArray[np.uint64], last_us: int, refractory: RefractoryPeriod, low: np.uint64
) -> int:
    """Drop a pixel's events within refractory periods; how many are left."""
    found = 0
    for key in keys:
        offset_us = np.int64(key >> low)
        if offset_us - last_us >= refractory.period_us:
            keys[found], last_us = key, int(offset_us)
            found += 1
    return found

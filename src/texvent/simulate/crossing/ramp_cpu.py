"""Threshold crossings on a straight line, compiled by Numba: the reference's bits.

Crossings are counted first, then listed, each as one 64-bit key of `packets.sorting_cpu`. The keys
are sorted into the packet without further columns.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.scratch import take_scratch
from texvent.simulate.crossing import ramp_reference
from texvent.simulate.crossing.levels import Thresholds
from texvent.simulate.crossing.ramp import (
    Candidates,
    Float64Array,
    Levels,
    Rest,
)
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.sorting_cpu import (
    KEY_USES,
    has_room_for_keys,
    key_bits,
    sort_keyed_events,
)

_1, _2 = np.uint64(1), np.uint64(2)
FEW = 2
"""Events that most pixels that fire have at most in an interval."""


class Lines(NamedTuple):
    """What becomes of each pixel; [n] each."""

    start: Float64Array
    """Change at the start of the interval, log units."""
    stop: Float64Array
    """Change at its end."""
    threshold: Float64Array
    """Of the polarity that it may fire."""
    steps: NDArray[np.int64]
    """Thresholds that it has passed at the end; OFF below 0."""


class Clock(NamedTuple):
    """The interval, and what an event's key is made of."""

    start_us: int
    duration_us: int
    low: int
    """Bits of a key below its time."""


def cross_levels(
    candidates: Candidates,
    levels: Levels,
    span_us: tuple[int, int],
    rest: Rest,
    shape: tuple[int, int],
) -> SortedEvents:
    """See `ramp_reference.cross_levels`."""
    clock = clock_of(span_us, shape)
    if clock is None:
        return ramp_reference.cross_levels(candidates, levels, span_us, rest, shape)
    # Numba leaves out branches for arguments that are None, but not for their fields.
    pixel, before, now, table, thresholds = candidates
    start, stop, threshold = (
        take_scratch(use, len(pixel), np.float64) for use in ("start", "stop", "threshold")
    )
    lines = Lines(start, stop, threshold, take_scratch("steps", len(pixel), np.int64))
    _compare((pixel, before, now), table, levels.reference, lines)
    count_steps(lines, thresholds)
    keys = list_events(pixel, lines, levels.fired_us, clock, rest)
    _step(pixel, lines, levels.reference)
    return sort_keyed_events(keys, span_us, shape)


def warm_up(dtype: str) -> None:
    """Compile for one type of frames, or load what was compiled before."""
    one, pixel = np.ones(1), np.zeros(1, np.int64)
    end = np.zeros(1, dtype)
    table = np.ones(256) if end.dtype == np.uint8 else None
    candidates = Candidates(pixel, end, end, table, Thresholds(one, one))
    cross_levels(candidates, Levels(one.copy(), pixel.copy()), (0, 1), Rest(0, False), (1, 1))


def clock_of(span_us: tuple[int, int], shape: tuple[int, int]) -> Clock | None:
    """None where time and pixel do not fit a key."""
    start_us, stop_us = span_us
    if not has_room_for_keys(stop_us - start_us, shape):
        return None
    return Clock(start_us, stop_us - start_us, key_bits(shape[0] * shape[1]))


def list_events(
    pixel: NDArray[np.int64],
    lines: Lines,
    fired_us: NDArray[np.int64],
    clock: Clock,
    rest: Rest,
) -> NDArray[np.uint64]:
    """Keys of all events, by pixel and then in time."""
    keys = take_scratch(KEY_USES[0], _add_up(lines.steps) + FEW, np.uint64)
    with np.errstate(all="ignore"):
        return keys[: _list_crossings(pixel, lines, fired_us, clock, rest, keys)]


@jit
def _compare(
    candidates: tuple[NDArray[np.int64], NDArray[Any], NDArray[Any]],
    table: Float64Array | None,
    reference: Float64Array,
    lines: Lines,
) -> None:
    """Fill in the changes against the references."""
    pixel, before, now = candidates
    start, stop, _, _ = lines
    for n in range(pixel.size):
        level = reference[pixel[n]]
        if table is not None:
            start[n], stop[n] = table[before[n]] - level, table[now[n]] - level
        else:
            start[n], stop[n] = before[n] - level, now[n] - level


@jit(error_model="numpy")
def count_steps(lines: Lines, thresholds: Thresholds) -> None:
    """Fill in thresholds and steps."""
    _, stop, threshold, steps = lines
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
    """How many thresholds have been passed in all."""
    total = 0
    for n in range(steps.size):
        total += abs(steps[n])
    return total


@jit(error_model="numpy")
def _list_crossings(
    pixel: NDArray[np.int64],
    lines: Lines,
    fired_us: NDArray[np.int64],
    clock: Clock,
    rest: Rest,
    keys: NDArray[np.uint64],
) -> int:
    """Fill in the keys of all events, by pixel and then in time; return how many fired."""
    start, stop, thresholds, steps = lines
    low, found = np.uint64(clock.low), 0
    duration = np.float64(clock.duration_us)
    for i in range(pixel.size):
        is_on, count, threshold = steps[i] > 0, abs(steps[i]), thresholds[i]
        # By a product: whether a pixel fires ON or OFF cannot be foreseen either.
        begin, end = math.copysign(1.0, stop[i]) * start[i], abs(stop[i])
        place = np.uint64(pixel[i]) << _2 | np.uint64(is_on) << _1
        # The first few always, also beyond the count: a loop that ends after each pixel's own
        # number of rounds is one that no processor foresees. The next pixel overwrites what is
        # too many.
        for k in range(FEW):
            keys[found + k] = _key((k + 1) * threshold, (begin, end), duration, low) | place
        for k in range(FEW, count):
            keys[found + k] = _key((k + 1) * threshold, (begin, end), duration, low) | place
        if rest.period_us > 0 and count > 0:
            # Far apart in memory, so not even looked at where it does not matter.
            last_us = fired_us[pixel[i]] - clock.start_us
            if not _is_rested(keys[found : found + FEW], count, last_us, rest, low):
                count = _leave_rested(keys[found : found + count], last_us, rest, low)
                if not rest.is_level_lost:
                    steps[i] = count if is_on else -count
            if count > 0:
                fired_us[pixel[i]] = clock.start_us + np.int64(keys[found + count - 1] >> low)
        found += count
    return found


@jit(inline="always")
def _key(level: float, ends: tuple[float, float], duration: float, low: np.uint64) -> Any:
    """When the line from begin to end reaches a level, where the time is in a key."""
    begin, end = ends
    fraction = (level - begin) / (end - begin) if begin < level else 0.0
    return np.uint64(np.int64(min(np.floor(fraction * duration), duration - 1.0))) << low


@jit(inline="always")
def _is_rested(
    keys: NDArray[np.uint64], count: int, last_us: int, rest: Rest, low: np.uint64
) -> bool:
    """Whether none of at most `FEW` events is too early; False says nothing of more."""
    is_rested, before_us = bool(count <= FEW), last_us
    for k in range(FEW):
        offset_us = np.int64(keys[k] >> low)
        is_rested &= bool((k >= count) | (offset_us - before_us >= rest.period_us))
        before_us = int(offset_us)
    return is_rested


@jit
def _leave_rested(keys: NDArray[np.uint64], last_us: int, rest: Rest, low: np.uint64) -> int:
    """Keep a pixel's events that are not too early; how many those are."""
    found = 0
    for key in keys:
        offset_us = np.int64(key >> low)
        if offset_us - last_us >= rest.period_us:
            keys[found], last_us = key, int(offset_us)
            found += 1
    return found


@jit
def _step(pixel: NDArray[np.int64], lines: Lines, reference: Float64Array) -> None:
    """Let the references make their steps."""
    _, _, threshold, steps = lines
    for n in range(pixel.size):
        reference[pixel[n]] += steps[n] * threshold[n]

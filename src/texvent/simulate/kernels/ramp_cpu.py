"""Threshold crossings on a straight line, compiled by Numba: the reference's bits."""

from __future__ import annotations

import math
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.ramp import (
    Candidates,
    Float64Array,
    Levels,
    Ramp,
    RampCrossings,
    Rest,
)


def cross_ramp(
    ramp: Ramp, fired_us: NDArray[np.int64], span_us: tuple[int, int], rest: Rest
) -> RampCrossings:
    """Every threshold that each pixel's change crosses; see `ramp_reference.cross_ramp`."""
    steps = np.empty(len(ramp.pixel), np.int64)
    total = _count_steps(ramp, steps)
    pixel = np.empty(total, np.int64)
    t = np.empty(total, np.int64)
    p = np.empty(total, np.uint8)
    found = _fill(ramp, fired_us, span_us, rest, (pixel, t, p, steps))
    return RampCrossings(pixel[:found], t[:found], p[:found], steps)


def cross_levels(
    candidates: Candidates, levels: Levels, span_us: tuple[int, int], rest: Rest
) -> RampCrossings:
    """See `ramp_reference.cross_levels`."""
    # Numba leaves out branches for arguments that are None, but not for their fields.
    pixel, before, now, table, on, off = candidates
    start, stop = np.empty(len(pixel)), np.empty(len(pixel))
    _compare((pixel, before, now), table, levels.reference, start, stop)
    on, off = (np.broadcast_to(one, pixel.shape) for one in (on, off))
    crossings = cross_ramp(Ramp(pixel, start, stop, on, off), levels.fired_us, span_us, rest)
    _step(pixel, crossings.steps, (on, off), levels.reference)
    return crossings


def warm_up(*dtypes: str) -> None:
    """Compile, for these types of frames, or load what was compiled before."""
    # Two pixels with one threshold, for Numba compiles for arrays that repeat one number apart.
    one, pixel = np.ones(2), np.zeros(2, np.int64)
    cross_ramp(Ramp(pixel, one, one, one, one), pixel.copy(), (0, 1), Rest(0, False))
    for dtype in dtypes:
        is_byte = dtype == "uint8"
        end, table = (np.zeros(2, dtype), np.ones(256)) if is_byte else (one, None)
        candidates = Candidates(pixel, end, end, table, one[:1], one[:1])
        cross_levels(candidates, Levels(one.copy(), pixel.copy()), (0, 1), Rest(0, False))


@numba.njit(cache=True, nogil=True)
def _compare(
    candidates: tuple[NDArray[np.int64], NDArray[Any], NDArray[Any]],
    table: Float64Array | None,
    reference: Float64Array,
    start: Float64Array,
    stop: Float64Array,
) -> None:
    """Fill in the changes against the references."""
    pixel, before, now = candidates
    for n in range(pixel.size):
        level = reference[pixel[n]]
        if table is not None:
            start[n], stop[n] = table[before[n]] - level, table[now[n]] - level
        else:
            start[n], stop[n] = before[n] - level, now[n] - level


@numba.njit(cache=True, nogil=True)
def _step(
    pixel: NDArray[np.int64],
    steps: NDArray[np.int64],
    thresholds: tuple[Float64Array, Float64Array],
    reference: Float64Array,
) -> None:
    """Let the references make their steps."""
    on, off = thresholds
    for n in range(pixel.size):
        reference[pixel[n]] += steps[n] * (on[n] if steps[n] > 0 else off[n])


@numba.njit(cache=True, nogil=True)
def _count_steps(ramp: Ramp, steps: NDArray[np.int64]) -> int:
    """Fill in the thresholds that each pixel has passed at the end; return how many in all."""
    total = 0
    stop, on, off = ramp.stop, ramp.threshold_on, ramp.threshold_off
    for i in range(steps.size):
        is_on = stop[i] > 0
        threshold = on[i] if is_on else off[i]
        last = abs(stop[i])
        count = 0
        while last >= (count + 1) * threshold:
            count += 1
        total += count
        steps[i] = count if is_on else -count
    return total


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _fill(
    ramp: Ramp,
    fired_us: NDArray[np.int64],
    span_us: tuple[int, int],
    rest: Rest,
    out: tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.uint8], NDArray[np.int64]],
) -> int:
    """Fill in the events of the pixels whose steps are not 0; return how many fired."""
    pixel, t, p, steps = out
    start_us, stop_us = span_us
    duration, rests = stop_us - start_us, rest.period_us > 0
    found = 0
    for i in range(steps.size):
        count = abs(steps[i])
        if count == 0:
            continue
        is_on = steps[i] > 0
        sign = 1 if is_on else -1
        threshold = ramp.threshold_on[i] if is_on else ramp.threshold_off[i]
        first, last = sign * ramp.start[i], sign * ramp.stop[i]
        # Far apart in memory, so not even looked at where it does not matter.
        fired, fired_at = 0, fired_us[ramp.pixel[i]] if rests else start_us
        for k in range(1, count + 1):
            level = k * threshold
            fraction = (level - first) / (last - first) if first < level else 0.0
            time = min(start_us + math.floor(fraction * duration), stop_us - 1)
            if rests and time - fired_at < rest.period_us:
                continue
            fired_at = time
            pixel[found], t[found], p[found] = ramp.pixel[i], time, is_on
            found += 1
            fired += 1
        if rests:
            fired_us[ramp.pixel[i]] = fired_at
        if not rest.is_level_lost:
            steps[i] = sign * fired
    return found

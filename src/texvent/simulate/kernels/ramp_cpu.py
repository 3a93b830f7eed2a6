"""Threshold crossings on a straight line, compiled by Numba: the reference's bits."""

from __future__ import annotations

import math

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.ramp import Ramp, RampCrossings, Rest


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


def warm_up() -> None:
    """Compile, or load what was compiled before."""
    one = np.ones(1)
    ramp = Ramp(np.zeros(1, np.int64), one, one, one, one)
    cross_ramp(ramp, np.zeros(1, np.int64), (0, 1), Rest(0, False))


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
    duration = stop_us - start_us
    found = 0
    for i in range(steps.size):
        count = abs(steps[i])
        if count == 0:
            continue
        is_on = steps[i] > 0
        sign = 1 if is_on else -1
        threshold = ramp.threshold_on[i] if is_on else ramp.threshold_off[i]
        first, last = sign * ramp.start[i], sign * ramp.stop[i]
        fired, fired_at = 0, fired_us[ramp.pixel[i]]
        for k in range(1, count + 1):
            level = k * threshold
            fraction = (level - first) / (last - first) if first < level else 0.0
            time = min(start_us + math.floor(fraction * duration), stop_us - 1)
            if time - fired_at < rest.period_us:
                continue
            fired_at = time
            pixel[found], t[found], p[found] = ramp.pixel[i], time, is_on
            found += 1
            fired += 1
        fired_us[ramp.pixel[i]] = fired_at
        if not rest.is_level_lost:
            steps[i] = sign * fired
    return found

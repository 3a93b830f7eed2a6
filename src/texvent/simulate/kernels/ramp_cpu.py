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
    steps = np.empty(ramp.start.shape, np.int64)
    total = _count_steps(ramp, steps)
    pixel = np.empty(total, np.int64)
    t = np.empty(total, np.int64)
    p = np.empty(total, np.uint8)
    found = _fill(ramp, fired_us, span_us, rest, (pixel, t, p, steps))
    return RampCrossings(pixel[:found], t[:found], p[:found], steps)


@numba.njit(cache=True, nogil=True)
def _count_steps(ramp: Ramp, steps: NDArray[np.int64]) -> int:
    """Fill in the thresholds that each pixel has passed at the end; return how many in all."""
    total = 0
    height, width = steps.shape
    for y in range(height):
        for x in range(width):
            stop = ramp.stop[y, x]
            threshold = ramp.threshold_on[y, x] if stop > 0 else ramp.threshold_off[y, x]
            last = abs(stop)
            count = 0
            while last >= (count + 1) * threshold:
                count += 1
            total += count
            steps[y, x] = count if stop > 0 else -count
    return total


@numba.njit(cache=True, nogil=True)
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
    height, width = steps.shape
    for y in range(height):
        for x in range(width):
            count = abs(steps[y, x])
            if count == 0:
                continue
            is_on = steps[y, x] > 0
            sign = 1 if is_on else -1
            threshold = ramp.threshold_on[y, x] if is_on else ramp.threshold_off[y, x]
            first, last = sign * ramp.start[y, x], sign * ramp.stop[y, x]
            fired = 0
            for k in range(1, count + 1):
                level = k * threshold
                fraction = (level - first) / (last - first) if first < level else 0.0
                time = start_us + math.floor(fraction * duration)
                if time >= stop_us:
                    time = stop_us - 1
                if time - fired_us[y, x] < rest.period_us:
                    continue
                fired_us[y, x] = time
                pixel[found], t[found], p[found] = y * width + x, time, is_on
                found += 1
                fired += 1
            if not rest.is_level_lost:
                steps[y, x] = sign * fired
    return found

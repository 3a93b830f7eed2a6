"""The scan for pixels outside their trigger levels, compiled by Numba."""

from __future__ import annotations

import math

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.elementary_cpu import exponential
from texvent.simulate.kernels.levels import MARGIN, Curve, Logs, Luma
from texvent.simulate.kernels.order import read_only

RUN = 128
"""Pixels that are passed over together."""


def find_outside(luma: Luma, low: Luma, high: Luma) -> NDArray[np.int64]:
    """See `levels_reference.find_outside`."""
    pixel: NDArray[np.int64] = _find_outside(read_only(luma), low, high)
    return pixel


def warm_up(dtype: str) -> None:
    """Compile for one type of frames, or load what was compiled before."""
    one, log = np.zeros(1, dtype), np.zeros(1)
    pixel = find_outside(one, one.copy(), one.copy())
    narrow(pixel, (log[:0], log[:0]), (1.0, 0.0), one.copy(), one.copy())


@numba.njit(cache=True, nogil=True)
def _find_outside(luma: Luma, low: Luma, high: Luma) -> NDArray[np.int64]:
    size = luma.size
    busy, runs = np.empty(-(-size // RUN), np.int64), 0
    for first in range(0, size, RUN):
        last = min(first + RUN, size)
        busy[runs] = first
        runs += _is_any_outside(luma[first:last], low[first:last], high[first:last])
    # One more, for the last index is written before it is known whether it counts.
    pixel = np.empty(runs * RUN + 1, np.int64)
    found = 0
    for first in busy[:runs]:
        for i in range(first, min(first + RUN, size)):
            pixel[found] = i
            found += (luma[i] < low[i]) | (luma[i] > high[i])
    return pixel[:found]


@numba.njit(cache=True, nogil=True)
def _is_any_outside(luma: Luma, low: Luma, high: Luma) -> bool:
    outside = 0
    for i in range(luma.size):
        outside |= (luma[i] < low[i]) | (luma[i] > high[i])
    return outside != 0


def narrow(pixel: NDArray[np.int64], logs: Logs, curve: Curve, low: Luma, high: Luma) -> None:
    """See `levels_reference.narrow`; levels may differ in their last bits, events may not."""
    (low_log, high_log), (scale, offset) = logs, curve
    with np.errstate(all="ignore"):
        _narrow(pixel, low_log, high_log, float(scale), float(offset), low, high)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _narrow(
    pixel: NDArray[np.int64],
    low_log: NDArray[np.float64],
    high_log: NDArray[np.float64],
    scale: float,
    offset: float,
    low: Luma,
    high: Luma,
) -> None:
    is_byte = low.itemsize == 1
    below, above = np.empty(RUN), np.empty(RUN)
    for first in range(0, pixel.size, RUN):
        size = min(RUN, pixel.size - first)
        for j in range(size):
            level = scale * exponential(low_log[first + j]) + offset
            below[j] = level + MARGIN * (1.0 + abs(level))
        for j in range(size):
            level = scale * exponential(high_log[first + j]) + offset
            above[j] = level - MARGIN * (1.0 + abs(level))
        for j in range(size):
            lowest, highest = below[j], above[j]
            if is_byte:
                lowest, highest = math.ceil(max(lowest, 0.0)), math.floor(min(highest, 255.0))
                if lowest > highest:
                    lowest, highest = 255, 0
            low[pixel[first + j]], high[pixel[first + j]] = lowest, highest

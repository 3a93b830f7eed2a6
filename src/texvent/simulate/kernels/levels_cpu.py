"""The scan for pixels outside their trigger levels, compiled by Numba."""

from __future__ import annotations

import math

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.elementary_cpu import exponential
from texvent.simulate.kernels.levels import MARGIN, Curve, Logs, Luma
from texvent.simulate.kernels.order import read_only

TILE, WORD = 4096, 8
"""Pixels that are compared together, and pixels that are passed over together."""
BLOCK = 128
"""Pixels whose levels are set together."""


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
    words = np.zeros(TILE // WORD, np.uint64)
    marks = words.view(np.uint8)
    pixel, found = np.empty(size // 16 + TILE + 1, np.int64), 0
    for first in range(0, size, TILE):
        last = min(first + TILE, size)
        if found + TILE >= pixel.size:
            pixel = _grown(pixel)
        _mark(luma[first:last], low[first:last], high[first:last], marks)
        for word in range(-(-(last - first) // WORD)):
            if words[word] == 0:
                continue
            for j in range(WORD * word, WORD * word + WORD):
                pixel[found] = first + j
                found += marks[j]
    return pixel[:found]


@numba.njit(cache=True, nogil=True)
def _mark(luma: Luma, low: Luma, high: Luma, marks: NDArray[np.uint8]) -> None:
    """1 where a pixel is outside, else 0, also beyond the last."""
    for i in range(luma.size):
        marks[i] = (luma[i] < low[i]) | (luma[i] > high[i])
    marks[luma.size :] = 0


@numba.njit(cache=True, nogil=True)
def _grown(pixel: NDArray[np.int64]) -> NDArray[np.int64]:
    """The same list with room for as many again."""
    larger = np.empty(2 * pixel.size, np.int64)
    larger[: pixel.size] = pixel
    return larger


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
    below, above = np.empty(BLOCK), np.empty(BLOCK)
    for first in range(0, pixel.size, BLOCK):
        size = min(BLOCK, pixel.size - first)
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

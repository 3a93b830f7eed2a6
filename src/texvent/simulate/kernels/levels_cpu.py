"""The scan for pixels outside their trigger levels, compiled by Numba."""

from __future__ import annotations

import math
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.cpu_draws import allow_wrap_around
from texvent.simulate.kernels.elementary_cpu import exponential
from texvent.simulate.kernels.levels import (
    MARGIN,
    SLACK,
    Curve,
    Float64Array,
    Luma,
    Outside,
    Thresholds,
)
from texvent.simulate.kernels.marks_cpu import (
    RUN,
    Marks,
    as_bits,
    list_marked,
    make_flags,
    number_of,
)
from texvent.simulate.kernels.order import read_only
from texvent.simulate.kernels.scratch import take_scratch

BLOCK = 128
"""Pixels whose levels are set together."""
_0, _1 = np.uint64(0), np.uint64(1)


def find_outside(luma: Luma, seen: Luma, low: Luma, high: Luma) -> Outside:
    """See `levels_reference.find_outside`."""
    # Room for all pixels; the system gives memory only to what is used.
    size, kind = luma.size + 1, luma.dtype.type
    found = Outside(
        take_scratch("candidates", size, np.int64),
        take_scratch(f"{luma.dtype} before", size, kind),
        take_scratch(f"{luma.dtype} now", size, kind),
    )
    with allow_wrap_around():
        count = _find_outside(read_only(luma), seen, low, high, found)
    pixel, before, now = found
    return Outside(pixel[:count], before[:count], now[:count])


def warm_up(dtype: str) -> None:
    """Compile for one type of frames, or load what was compiled before."""
    one, log = np.zeros(1, dtype), np.zeros(1)
    pixel, _, _ = find_outside(one, *(one.copy() for _ in range(3)))
    narrow(pixel, log, Thresholds(log, log), Curve(1.0, 0.0), one.copy(), one.copy())


@numba.njit(cache=True, nogil=True)
def _find_outside(luma: Luma, seen: Luma, low: Luma, high: Luma, found: Outside) -> int:
    pixel, before, now = found
    run, all_bits = _mark_outside(luma, low, high)
    count = 0
    for k in range(run.size):
        first, bits = run[k] * RUN, all_bits[k]
        while bits != _0:
            lowest = bits & (~bits + _1)
            i = first + np.int64(number_of(lowest))
            pixel[count], before[count], now[count] = i, seen[i], luma[i]
            count += 1
            bits ^= lowest
    for i in range(luma.size):
        seen[i] = luma[i]
    return count


@numba.njit(cache=True, nogil=True)
def _mark_outside(luma: Luma, low: Luma, high: Luma) -> Marks:
    """Mark pixels outside their levels; see `marks_cpu`."""
    is_marked = make_flags(luma.size)
    for number in range(luma.size // RUN):
        first, is_any = number * RUN, np.uint8(0)
        for i in range(first, first + RUN):
            is_any |= _is_outside(luma[i], low[i], high[i])
        is_marked[number] = is_any
    run = list_marked(is_marked)
    bits, word = np.empty(run.size, np.uint64), np.empty(RUN // 8, np.uint64)
    mark = word.view(np.uint8)
    for k in range(run.size):
        first, last = run[k] * RUN, min(run[k] * RUN + RUN, luma.size)
        _mark_run(luma, low, high, np.uint64(first), np.uint64(last), mark)
        bits[k] = as_bits(word)
    return Marks(run, bits)


@numba.njit(cache=True, nogil=True)
def _mark_run(
    luma: Luma,
    low: Luma,
    high: Luma,
    first: np.uint64,
    last: np.uint64,
    mark: NDArray[np.uint8],
) -> None:
    for i in range(last - first):
        mark[i] = _is_outside(luma[first + i], low[first + i], high[first + i])
    mark[last - first :] = 0


@numba.njit(cache=True, nogil=True, inline="always")
def _is_outside(luma: Any, low: Any, high: Any) -> Any:
    return np.uint8(luma < low) | np.uint8(luma > high)


def narrow(
    pixel: NDArray[np.int64],
    reference: Float64Array,
    thresholds: Thresholds,
    curve: Curve,
    low: Luma,
    high: Luma,
) -> None:
    """See `levels_reference.narrow`; levels may differ in their last bits, events may not."""
    with np.errstate(all="ignore"):
        _narrow(pixel, reference, thresholds, curve, low, high)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _narrow(
    pixel: NDArray[np.int64],
    reference: Float64Array,
    thresholds: Thresholds,
    curve: Curve,
    low: Luma,
    high: Luma,
) -> None:
    is_byte = low.itemsize == 1
    on, off = thresholds
    scale, offset, darkest = curve
    below, above = np.empty(BLOCK), np.empty(BLOCK)
    for first in range(0, pixel.size, BLOCK):
        size = min(BLOCK, pixel.size - first)
        _copy_rows(off, first, size, below)
        _copy_rows(on, first, size, above)
        for j in range(size):
            centre = reference[pixel[first + j]]
            below[j], above[j] = centre - below[j], centre + above[j]
        for j in range(size):
            level = scale * exponential(below[j]) + offset
            level += MARGIN * (1.0 + abs(level))
            below[j] = 0.0 if below[j] < darkest - SLACK else level
        for j in range(size):
            level = scale * exponential(above[j]) + offset
            above[j] = level - MARGIN * (1.0 + abs(level))
        for j in range(size):
            lowest, highest = below[j], above[j]
            if is_byte:
                lowest, highest = math.ceil(max(lowest, 0.0)), math.floor(min(highest, 255.0))
                if lowest > highest:
                    lowest, highest = 255, 0
            low[pixel[first + j]], high[pixel[first + j]] = lowest, highest


@numba.njit(cache=True, nogil=True)
def _copy_rows(values: Float64Array, first: int, size: int, rows: Float64Array) -> None:
    """Copy some rows; of [1] values, the only one into all."""
    if values.size == 1:
        rows[:size] = values[0]
    else:
        for j in range(size):
            rows[j] = values[first + j]

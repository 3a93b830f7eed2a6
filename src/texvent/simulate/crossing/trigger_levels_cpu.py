"""The scan for pixels outside their trigger levels, compiled by Numba."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.read_only import read_only
from texvent.runtime.scratch import take_scratch
from texvent.simulate.backend.elementary_cpu import exponential
from texvent.simulate.crossing.bitmask_cpu import (
    RUN,
    MarkedRuns,
    as_bits,
    list_marked_runs,
    make_flags,
    number_of,
)
from texvent.simulate.crossing.trigger_levels import (
    BRIGHTNESS_SLACK,
    MARGIN,
    BrightnessCurve,
    Float64Array,
    Luma,
    OutsidePixels,
)
from texvent.simulate.random.draws_cpu import allow_wrap_around
from texvent.simulate.random.mismatch import Thresholds

BLOCK = 128
"""Pixels whose levels are set together."""
_0, _1 = np.uint64(0), np.uint64(1)


def find_outside(luma: Luma, seen: Luma, low: Luma, high: Luma) -> OutsidePixels:
    """See `trigger_levels_reference.find_outside`."""
    # Room for all pixels; the system gives memory only to what is used.
    size, kind = luma.size + 1, luma.dtype
    found = OutsidePixels(
        take_scratch("candidates", size, np.int64),
        take_scratch("before " + kind.char, size, kind.type),
        take_scratch("now " + kind.char, size, kind.type),
    )
    with allow_wrap_around():
        count = _find_outside(read_only(luma), seen, low, high, found)
    pixel, before, now = found
    return OutsidePixels(pixel[:count], before[:count], now[:count])


def look_up(table: NDArray[Any], luma: NDArray[np.uint8]) -> NDArray[Any]:
    """See `trigger_levels_reference.look_up`; NumPy would make 64-bit numbers of the luma first."""
    found = np.empty(luma.size, table.dtype)
    _look_up(read_only(table), read_only(luma), found)
    return found


@jit
def _look_up(table: NDArray[Any], luma: NDArray[np.uint8], found: NDArray[Any]) -> None:
    for i in range(luma.size):
        found[i] = table[luma[i]]


@jit
def _find_outside(luma: Luma, seen: Luma, low: Luma, high: Luma, found: OutsidePixels) -> int:
    pixel, before, now = found
    run, all_bits = _mark_outside(luma, low, high)
    # Places are counted in uint64, which need no check for counting from the end.
    count = _0
    for k in range(run.size):
        first, bits = np.uint64(run[k] * RUN), all_bits[k]
        while bits != _0:
            lowest = bits & (~bits + _1)
            i = first + np.uint64(number_of(lowest))
            pixel[count], before[count], now[count] = i, seen[i], luma[i]
            count += _1
            bits ^= lowest
    for place in range(luma.size):
        seen[place] = luma[place]
    return int(count)


@jit
def _mark_outside(luma: Luma, low: Luma, high: Luma) -> MarkedRuns:
    """Mark pixels outside their levels; see `bitmask_cpu`."""
    is_marked = make_flags(luma.size)
    for number in range(luma.size // RUN):
        first, is_any = number * RUN, np.uint8(0)
        for i in range(first, first + RUN):
            is_any |= _is_outside(luma[i], low[i], high[i])
        is_marked[number] = is_any
    run = list_marked_runs(is_marked)
    bits, word = np.empty(run.size, np.uint64), np.empty(RUN // 8, np.uint64)
    mark = word.view(np.uint8)
    for k in range(run.size):
        first, last = run[k] * RUN, min(run[k] * RUN + RUN, luma.size)
        _mark_run(luma, low, high, np.uint64(first), np.uint64(last), mark)
        bits[k] = as_bits(word)
    return MarkedRuns(run, bits)


@jit
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


@jit(inline="always")
def _is_outside(luma: Any, low: Any, high: Any) -> Any:
    return np.uint8(luma < low) | np.uint8(luma > high)


def set_levels(
    pixel: NDArray[np.int64],
    reference: Float64Array,
    thresholds: Thresholds,
    curve: BrightnessCurve,
    low: Luma,
    high: Luma,
) -> None:
    """See `trigger_levels_reference.set_levels`; the last bits of a level may differ."""
    with np.errstate(all="ignore"):
        _set_levels(pixel, reference, thresholds, curve, low, high)


@jit(error_model="numpy")
def _set_levels(
    pixel: NDArray[np.int64],
    reference: Float64Array,
    thresholds: Thresholds,
    curve: BrightnessCurve,
    low: Luma,
    high: Luma,
) -> None:
    on, off = thresholds
    scale, offset, darkest = curve
    darkest_level = scale * exponential(darkest - BRIGHTNESS_SLACK) + offset
    centre, up, down = np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK)
    lowest, highest = np.empty(BLOCK, low.dtype), np.empty(BLOCK, low.dtype)
    for first in range(0, pixel.size, BLOCK):
        size = min(BLOCK, pixel.size - first)
        _take_exponentials(on, 1.0, first, size, up)
        _take_exponentials(off, -1.0, first, size, down)
        for j in range(size):
            centre[j] = reference[pixel[first + j]]
        for j in range(size):
            centre[j] = scale * exponential(centre[j])
        for j in range(size):
            below, above = centre[j] * down[j] + offset, centre[j] * up[j] + offset
            least = below + MARGIN * (1.0 + abs(below)) if below >= darkest_level else 0.0
            lowest[j], highest[j] = _as_luma(least, above - MARGIN * (1.0 + abs(above)), low)
        for j in range(size):
            low[pixel[first + j]], high[pixel[first + j]] = lowest[j], highest[j]


@jit(error_model="numpy")
def _take_exponentials(
    values: Float64Array, sign: float, first: int, size: int, rows: Float64Array
) -> None:
    """Exponentials of some rows; of [1] values, the only one into all."""
    if values.size == 1:
        rows[:size] = exponential(sign * values[0])
    else:
        for j in range(size):
            rows[j] = exponential(sign * values[first + j])


@jit(inline="always")
def _as_luma(lowest: float, highest: float, kind: Luma) -> Any:
    """Levels in the type of the frames: of bytes, those between both numbers."""
    if kind.itemsize > 1:
        return lowest, highest
    least, most = np.ceil(max(lowest, 0.0)), np.floor(min(highest, 255.0))
    is_empty = least > most
    # By way of 32 bits, from which bytes are made in vector registers.
    return np.int32(255.0 if is_empty else least), np.int32(0.0 if is_empty else most)

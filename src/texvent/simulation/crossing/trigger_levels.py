"""Trigger levels: the two intensities at which a pixel fires, so that a scan needs no logarithm.

Brightness is a logarithm of intensity, L = ln((I − offset) / scale). A pixel with the reference
brightness R fires where L reaches R + θ_on or R − θ_off. As L rises with I, that is

    I ≥ A · e^θ_on + offset   or   I ≤ A · e^−θ_off + offset ,   A = scale · e^R.

`trigger_factors` gives the two factors. Texvent has scale 1 and offset −α: A = α + R's intensity.

**Margin.** A scan rounds, and rounding must hide no event. So each level is moved towards the
reference by `MARGIN`, relative to the level and to the offset. No scan makes more than four float32
roundings, of 6·10⁻⁸ each, on the way to a level: the margin is four times as wide. A pixel
outside its levels *may* fire, and there the model decides with the logarithm in float64. A pixel
inside cannot.

`TriggerLevels` keeps the levels of every pixel for models whose references stay between frames.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import read_only, take_scratch
from texvent.simulation.kernels.active_pixels import (
    RUN,
    MarkedRuns,
    as_bits,
    list_marked_runs,
    make_flags,
    number_of_lowest,
)
from texvent.simulation.kernels.compiled_elementary import exponential
from texvent.simulation.random.mismatch import Thresholds, thresholds_at
from texvent.simulation.streaming import IntensityArray

Float64Array: TypeAlias = NDArray[np.float64]
Int64Array: TypeAlias = NDArray[np.int64]
Luma: TypeAlias = NDArray[Any]
"""[n] 0..255 scale, uint8 or float32."""

MARGIN = 1e-6
"""Shift of trigger levels towards the reference; relative, see above."""
PIXELS_AT_A_TIME = 1 << 14


class TriggerFactors(NamedTuple):
    """Factors of A that give the trigger levels."""

    up: float
    """e^θ_on."""
    down: float
    """e^−θ_off."""


def trigger_factors(threshold_on: float, threshold_off: float) -> TriggerFactors:
    """The factors of two thresholds, log units."""
    return TriggerFactors(math.exp(threshold_on), math.exp(-threshold_off))


class OutsidePixels(NamedTuple):
    """Pixels outside their trigger levels, which may fire; the next call overwrites the arrays."""

    pixel: Int64Array
    """[m] flat index, ascending."""
    before: Luma
    """[m] luma in the frame before."""
    now: Luma
    """[m] luma in this frame."""


class BrightnessCurve(NamedTuple):
    """Relation of brightness and intensity."""

    scale: float
    """A pixel of brightness v has the intensity `scale · e^v + offset`."""
    offset: float


class TriggerLevels:
    """The trigger levels of every pixel and its last luma, in the type of the frames."""

    def __init__(self, luma: IntensityArray, curve: BrightnessCurve) -> None:
        """Start from the first frame; every pixel may fire until its levels are set.

        Args:
            luma: 0..255 scale, [H, W], uint8 or float32; copied.
            curve: brightness and intensity.
        """
        self._curve = curve
        self._seen: Luma = luma.reshape(-1).copy()
        self._low = np.full(self._seen.size, 255, self._seen.dtype)
        self._high = np.zeros(self._seen.size, self._seen.dtype)

    def find_outside_levels(self, luma: IntensityArray) -> OutsidePixels:
        """Pixels that may fire at a frame, which becomes the last one seen.

        Args:
            luma: [H, W].
        """
        now: Luma = luma.reshape(-1)
        if now.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen, now = self._as_float(self._seen), self._as_float(now)
            self._low, self._high = self._as_float(self._low), self._as_float(self._high)
        # Room for all pixels; the system gives memory only to what is used.
        size, kind = now.size + 1, now.dtype
        found = OutsidePixels(
            take_scratch("candidates", size, np.int64),
            take_scratch("before " + kind.char, size, kind.type),
            take_scratch("now " + kind.char, size, kind.type),
        )
        count = _find_outside_levels(read_only(now), self._seen, self._low, self._high, found)
        return OutsidePixels(*(column[:count] for column in found))

    def set(self, pixel: Int64Array, reference: Float64Array, thresholds: Thresholds) -> None:
        """Set the levels of some pixels from their references.

        Args:
            pixel: flat index, [n].
            reference: of all pixels, [H · W] log units.
            thresholds: of the chosen pixels.
        """
        _set_levels(pixel, reference, thresholds, self._curve, self._low, self._high)

    def set_all(self, reference: Float64Array, thresholds: Thresholds) -> None:
        """Set the levels of all pixels.

        Args:
            reference: [H · W] log units.
            thresholds: of all pixels.
        """
        # Some at a time: one list of all is larger than most frames.
        for first in range(0, self._seen.size, PIXELS_AT_A_TIME):
            pixel = np.arange(first, min(first + PIXELS_AT_A_TIME, self._seen.size))
            self.set(pixel, reference, thresholds_at(pixel, thresholds))

    @staticmethod
    def _as_float(luma: NDArray[Any]) -> Luma:
        return luma.astype(np.float32, copy=False)


BLOCK = 512
"""Pixels whose levels are set together."""
_0, _1, _RUN = np.uint64(0), np.uint64(1), np.uint64(RUN)


@jit
def _find_outside_levels(
    luma: Luma, seen: Luma, low: Luma, high: Luma, found: OutsidePixels
) -> int:
    """List the pixels that are not between their two levels; `seen` becomes `luma`.

    Args:
        luma: [n].
        seen: luma of the frame before, [n], of the same type as `luma`.
        low: lowest luma at which each pixel cannot fire, [n], of the same type.
        high: highest such luma, [n]; below `low` where a pixel may fire at any luma.
        found: filled in.

    Returns:
        How many there are.
    """
    pixel, before, now = found
    run, all_bits = _mark_outside(luma, low, high)
    # Places are counted in uint64, which need no check for counting from the end.
    count = _0
    for k in range(run.size):
        first, bits = np.uint64(run[k]) * _RUN, all_bits[k]
        while bits != _0:
            i = first + number_of_lowest(bits)
            bits &= bits - _1
            pixel[count], before[count], now[count] = i, seen[i], luma[i]
            count += _1
    for place in range(luma.size):
        seen[place] = luma[place]
    return int(count)


@jit
def _mark_outside(luma: Luma, low: Luma, high: Luma) -> MarkedRuns:
    """Mark pixels outside their levels; see `active_pixels`."""
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


@jit(error_model="numpy")
def _set_levels(
    pixel: NDArray[np.int64],
    reference: Float64Array,
    thresholds: Thresholds,
    curve: BrightnessCurve,
    low: Luma,
    high: Luma,
) -> None:
    """Set the levels of some pixels, between which they cannot fire; `low`, `high` are of all."""
    on, off = thresholds
    scale, offset = curve
    centre, up, down = np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK)
    lowest, highest = np.empty(BLOCK, low.dtype), np.empty(BLOCK, low.dtype)
    for first in range(0, pixel.size, BLOCK):
        size = min(BLOCK, pixel.size - first)
        _take_exponentials(on, 1.0, first, size, up)
        _take_exponentials(off, -1.0, first, size, down)
        for j in range(size):
            centre[j] = reference[np.uint64(pixel[first + j])]
        for j in range(size):
            centre[j] = scale * exponential(centre[j])
        for j in range(size):
            below, above = centre[j] * down[j] + offset, centre[j] * up[j] + offset
            least = below + MARGIN * (1.0 + abs(below))
            lowest[j], highest[j] = _as_luma(least, above - MARGIN * (1.0 + abs(above)), low)
        for j in range(size):
            i = np.uint64(pixel[first + j])
            low[i], high[i] = lowest[j], highest[j]


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

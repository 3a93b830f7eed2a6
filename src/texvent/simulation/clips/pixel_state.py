"""Pixels of a clip on a CPU as they begin, and their noise, compiled."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulation.clips import pixels
from texvent.simulation.clips.pixels import Float64Array
from texvent.simulation.random.compiled_draws import draw_uniform_at, draw_word_at, place_of

_8, _48 = (np.uint64(bits) for bits in (8, 48))
_EVEN, _SUM = np.uint64(pixels.EVEN_BYTES), np.uint64(pixels.BYTE_SUM)
_8_32, _15, _16 = (np.uint32(bits) for bits in (8, 15, 16))
_EVEN_32, _LOW_16 = np.uint32(pixels.EVEN_BYTES & 0xFFFFFFFF), np.uint32(0xFFFF)
_SPREAD, _MIX_1, _MIX_2 = (np.uint32(one) for one in pixels.NOISE_WORDS)
_NOISE_MEAN = np.int32(pixels.NOISE_MEAN)
_MEAN, _UNIT = pixels.BYTES_MEAN, pixels.BYTES_UNIT
_ON, _OFF, _PHASE = pixels.ON_DRAW, pixels.OFF_DRAW, pixels.PHASE_DRAW
_CHOICE, _HOT = pixels.CHOICE_DRAW, pixels.HOT_DRAW
_LOWEST, _LONG_AGO = pixels.LOWEST, pixels.LONG_AGO_US


class PixelArrays(NamedTuple):
    """State and constants of pixels, [area] or [n] each."""

    reference: Float64Array
    on: Float64Array
    off: Float64Array
    hot: Float64Array
    fired_us: NDArray[np.int64]


@jit(inline="always")
def _normal(word: np.uint64) -> float:
    pairs = (word & _EVEN) + ((word >> _8) & _EVEN)
    return np.float64(np.int64((pairs * _SUM) >> _48) - _MEAN) * _UNIT


@jit
def begin_pixels(
    first: NDArray[np.uint8], width: int, numbers: Float64Array, key: np.uint64, table: Float64Array
) -> PixelArrays:
    """Pixels of a clip that have seen its first frame."""
    area = first.size
    reference, on, off, hot = np.empty(area), np.empty(area), np.empty(area), np.zeros(area)
    for i in range(area):
        at = place_of(i // width, i % width)
        on[i], off[i] = numbers[0], numbers[1]
        if numbers[2] > 0:
            spread = numbers[2] * _normal(draw_word_at(key, at, _ON))
            on[i] = max(numbers[0] + numbers[0] * spread, _LOWEST)
            spread = numbers[2] * _normal(draw_word_at(key, at, _OFF))
            off[i] = max(numbers[1] + numbers[1] * spread, _LOWEST)
        if draw_uniform_at(key, at, _CHOICE) < numbers[4]:
            hot[i] = numbers[5] * _normal(draw_word_at(key, at, _HOT))
        reference[i] = table[first[i]]
        if numbers[7] > 0:
            reference[i] += off[i] - draw_uniform_at(key, at, _PHASE) * (on[i] + off[i])
    return PixelArrays(reference, on, off, hot, np.full(area, _LONG_AGO))


@jit
def draw_noise(low: np.uint32, high: np.uint32, first: int, noise: NDArray[np.int16]) -> None:
    """Normal numbers of pixels at a frame; see `pixels.NOISE_WORDS`.

    Every step is cut to 32 bits, so that no processor makes them 64 bits wide.
    """
    for i in range(noise.size):
        word = np.uint32(np.uint32(np.uint32(first + i) * _SPREAD) + low)
        word = np.uint32(np.uint32(word ^ np.uint32(word >> _16)) * _MIX_1)
        word = np.uint32(np.uint32(np.uint32(word ^ np.uint32(word >> _15)) ^ high) * _MIX_2)
        word = np.uint32(word ^ np.uint32(word >> _16))
        pairs = np.uint32(
            np.uint32(word & _EVEN_32) + np.uint32(np.uint32(word >> _8_32) & _EVEN_32)
        )
        total = np.int32(np.uint32(pairs + np.uint32(pairs >> _16)) & _LOW_16)
        noise[i] = np.int16(total - _NOISE_MEAN)

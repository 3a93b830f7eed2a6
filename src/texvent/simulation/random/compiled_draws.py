"""Compiled form of `texvent.simulation.random.draws`, for use inside Numba kernels: equal bits."""

from __future__ import annotations

import numpy as np

from texvent.runtime.jit import jit
from texvent.simulation.random import draws

# Numba turns a sum of uint64 and int64 into a float, so every constant is uint64.
_GOLDEN = np.uint64(draws.GOLDEN)
_MULTIPLIER_1 = np.uint64(draws.MULTIPLIER_1)
_MULTIPLIER_2 = np.uint64(draws.MULTIPLIER_2)
_UNIT, _HALF_UNIT = draws.UNIT, draws.HALF_UNIT
_LOW_HALF = np.uint64(0xFFFF_FFFF)
_11, _16, _27, _30, _31, _32 = (np.uint64(bits) for bits in (11, 16, 27, 30, 31, 32))


@jit(inline="always")
def _mix(word: np.uint64) -> np.uint64:
    word = (word ^ (word >> _30)) * _MULTIPLIER_1
    word = (word ^ (word >> _27)) * _MULTIPLIER_2
    return word ^ (word >> _31)


@jit(inline="always")
def draw_word(key: np.uint64, y: int, x: int, draw: int) -> np.uint64:
    """64 random bits of one pixel; see `draws.draw_words`. `key` must be a uint64."""
    return draw_word_at(key, place_of(y, x), draw)


@jit(inline="always")
def place_of(y: int, x: int) -> np.uint64:
    """Row and column of a pixel in one number, for `draw_word_at`."""
    return (np.uint64(y) << _16) | np.uint64(x)


@jit(inline="always")
def draw_word_at(key: np.uint64, place: np.uint64, draw: int) -> np.uint64:
    """As `draw_word`, of a pixel given by `place_of`."""
    return _mix(_mix(((np.uint64(draw) << _32) | place) * _GOLDEN + key) ^ key)


@jit(inline="always")
def draw_uniform_at(key: np.uint64, place: np.uint64, draw: int) -> float:
    """As `draw_uniform`, of a pixel given by `place_of`."""
    return np.float64(draw_word_at(key, place, draw) >> _11) * _UNIT


@jit(inline="always")
def draw_halves_at(key: np.uint64, place: np.uint64, draw: int) -> tuple[float, float]:
    """Two uniform numbers in [0, 1), multiples of 2⁻³², of one word."""
    word = draw_word_at(key, place, draw)
    return np.float64(word >> _32) * _HALF_UNIT, np.float64(word & _LOW_HALF) * _HALF_UNIT


@jit(inline="always")
def draw_uniform(key: np.uint64, y: int, x: int, draw: int) -> float:
    """One uniform number in [0, 1); see `draws.draw_uniforms`. `key` must be a uint64."""
    return np.float64(draw_word(key, y, x, draw) >> _11) * _UNIT

"""The twin of `texvent.simulate.random.draws` for Triton kernels: same bits."""

from __future__ import annotations

import triton
import triton.language as tl

from texvent.simulate.random import draws

# Kernels may read module-level numbers only as constexpr.
_GOLDEN = tl.constexpr(draws.GOLDEN)
_MULTIPLIER_1 = tl.constexpr(draws.MULTIPLIER_1)
_MULTIPLIER_2 = tl.constexpr(draws.MULTIPLIER_2)
_UNIT = tl.constexpr(draws.UNIT)


@triton.jit
def _mix(word: tl.tensor) -> tl.tensor:
    word = (word ^ (word >> 30)) * _MULTIPLIER_1
    word = (word ^ (word >> 27)) * _MULTIPLIER_2
    return word ^ (word >> 31)


@triton.jit
def draw_word(key: tl.tensor, y: tl.tensor, x: tl.tensor, draw: tl.tensor) -> tl.tensor:
    """64 random bits, uint64; see `draws.draw_words`. `key` must be a uint64."""
    place = (y.to(tl.uint64) << 16) | x.to(tl.uint64)
    counter = (draw.to(tl.uint64) << 32) | place
    return _mix(_mix(counter * _GOLDEN + key) ^ key)


@triton.jit
def to_uniform(word: tl.tensor) -> tl.tensor:
    """The uniform number in [0, 1) that a word stands for, float64; see `draws.draw_uniforms`."""
    return (word >> 11).to(tl.float64) * _UNIT

"""Noise by blocks of pixels, compiled: time grows with the noise, not with the frame."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulate.packets.sorting_cpu import sort_almost_sorted, sort_keys
from texvent.simulate.random.draws import Purpose
from texvent.simulate.random.draws_cpu import allow_wrap_around, draw_uniform, draw_word
from texvent.simulate.texvent.kernels.noise_blocks import NoiseBlock, NoisePlaces
from texvent.simulate.texvent.kernels.noise_blocks_reference import TIME_UNIT
from texvent.simulate.texvent.kernels.scan import NOISE_BLOCK, NOISE_PLACE_SHIFT

_COUNT, _PLACE, _POLARITY = (
    int(purpose.draw())
    for purpose in (Purpose.NOISE_COUNT, Purpose.NOISE_PLACE, Purpose.NOISE_POLARITY)
)
_SHIFT, _TIME = np.uint64(NOISE_PLACE_SHIFT), np.uint64((1 << NOISE_PLACE_SHIFT) - 1)
_1, _INDEX_BITS = np.uint64(1), np.uint64(31)
_INDEX = np.uint64((1 << 31) - 1)
FEW_PIXELS = NOISE_BLOCK // 32
"""With an event for fewer pixels than these, 32 a block, sorting them by digits is faster."""


def place_noise(noise: NoiseBlock, pixels: int) -> NoisePlaces:
    """See `noise_blocks_reference.place_noise`."""
    with allow_wrap_around():
        places = _place_noise(noise.key, noise.cumulative, noise.on_fraction, pixels)
    return NoisePlaces(*places)


@jit
def _place_noise(
    key: np.uint64, cumulative: NDArray[np.float64], on_fraction: float, pixels: int
) -> Any:
    blocks = -(-pixels // NOISE_BLOCK)
    count = np.empty(blocks, np.int64)
    for b in range(blocks):
        count[b] = _count_up_to(draw_uniform(key, b >> 16, b & 0xFFFF, _COUNT), cumulative)
    total = count.sum()
    keys, fraction, found = np.empty(total, np.uint64), np.empty(total), 0
    for b in range(blocks):
        for k in range(count[b]):
            word = draw_word(key, b >> 16, b & 0xFFFF, _PLACE + k)
            pixel = b * NOISE_BLOCK + np.int64(word >> _SHIFT)
            if pixel < pixels:
                is_on = draw_uniform(key, b >> 16, b & 0xFFFF, _POLARITY + k) < on_fraction
                place = np.uint64(pixel) << _1 | np.uint64(is_on)
                keys[found] = place << _INDEX_BITS | np.uint64(found)
                fraction[found] = np.float64(word & _TIME) * TIME_UNIT
                found += 1
    return _by_place(keys[:found], fraction, pixels)


@jit
def _count_up_to(chance: float, cumulative: NDArray[np.float64]) -> int:
    """How many entries are at most `chance`: one by one, because most often it is none or few."""
    count = 0
    while count < cumulative.size and cumulative[count] <= chance:
        count += 1
    return count


@jit
def _by_place(keys: NDArray[np.uint64], fraction: NDArray[np.float64], pixels: int) -> Any:
    if keys.size * FEW_PIXELS < pixels:
        # Blocks follow each other already.
        sort_almost_sorted(keys)
    else:
        bits = 32
        while pixels >> (bits - 32):
            bits += 1
        keys = sort_keys(keys, np.empty_like(keys), 31, bits)
    pixel, p = np.empty(keys.size, np.int64), np.empty(keys.size, np.uint8)
    ordered = np.empty(keys.size)
    for i in range(keys.size):
        place = keys[i] >> _INDEX_BITS
        pixel[i], p[i] = place >> _1, place & _1
        ordered[i] = fraction[np.int64(keys[i] & _INDEX)]
    return pixel, ordered, p

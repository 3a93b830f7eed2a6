"""The definition of noise by blocks of pixels, in NumPy. Other backends must return equal bits."""

import numpy as np

from texvent.simulation.random.draws import Purpose, draw_uniforms, draw_words
from texvent.simulation.texvent.noise import (
    NOISE_BLOCK,
    NOISE_PLACE_SHIFT,
    TIME_UNIT,
    NoisePlaces,
    poisson_cumulative,
)


def place_noise(key: np.uint64, mean: float, on_fraction: float, pixels: int) -> NoisePlaces:
    """As `texvent.noise.place_noise`."""
    blocks = np.arange(-(-pixels // NOISE_BLOCK))
    y, x = blocks >> 16, blocks & 0xFFFF
    chance = draw_uniforms(key, y, x, Purpose.NOISE_COUNT.draw())
    count = np.searchsorted(poisson_cumulative(mean * NOISE_BLOCK), chance, side="right")
    order = np.arange(int(count.sum())) - np.repeat(np.cumsum(count) - count, count)
    block, y, x = (np.repeat(column, count) for column in (blocks, y, x))
    word = draw_words(key, y, x, Purpose.NOISE_PLACE.draw(order))
    pixel = block * NOISE_BLOCK + (word >> np.uint64(NOISE_PLACE_SHIFT)).astype(np.int64)
    fraction = (word & np.uint64((1 << NOISE_PLACE_SHIFT) - 1)).astype(np.float64) * TIME_UNIT
    is_on = draw_uniforms(key, y, x, Purpose.NOISE_POLARITY.draw(order)) < on_fraction
    inside = np.flatnonzero(pixel < pixels)
    by_pixel = inside[np.argsort(pixel[inside] * 2 + is_on[inside], kind="stable")]
    return NoisePlaces(pixel[by_pixel], fraction[by_pixel], is_on[by_pixel].astype(np.uint8))

"""Tiles cover the image, overlap, and join without seams."""

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from texvent.interpolate.networks.tiles import OVERLAP_PX, cut_tiles, tile_weights

SIZES = st.integers(1, 700)


def joined(image, side):
    """Every tile cut out and put back, weighted."""
    height, width = image.shape
    total, weight_sum = np.zeros((2, height, width))
    for tile in cut_tiles(height, width, side):
        weights = tile_weights(tile, height, width)
        assert weights.shape == (tile.height, tile.width)
        assert weights.min() > 0
        total[tile.rows, tile.columns] += weights * image[tile.rows, tile.columns]
        weight_sum[tile.rows, tile.columns] += weights
    return total / weight_sum


@given(SIZES, SIZES, st.integers(2 * OVERLAP_PX + 1, 400))
def test_an_image_survives_being_cut_and_joined(height, width, side):
    image = np.random.default_rng(height).uniform(0, 255, (height, width))
    assert np.abs(joined(image, side) - image).max() < 1e-9 * 255


@given(SIZES, st.integers(2 * OVERLAP_PX + 1, 400))
def test_neighbours_overlap_enough_and_no_tile_is_too_large(length, side):
    tiles = cut_tiles(1, length, side)
    assert tiles[0].left == 0
    assert tiles[-1].left + tiles[-1].width == length
    assert all(tile.width <= side for tile in tiles)
    for tile, following in pairwise(tiles):
        assert tile.left + tile.width - following.left >= OVERLAP_PX


def test_zero_means_one_tile():
    assert [(tile.height, tile.width) for tile in cut_tiles(4000, 5000, 0)] == [(4000, 5000)]

"""Samples between pixels: hand-computed cases, and what holds for every image.

`test_paths` holds the compiled warp to the same samples.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.pairs import reference

LEVELS = st.integers(0, 255)
SIXTEENTHS = st.integers(-48, 48)


def sample(image, x, y=0.0):
    """Samples of the whole image, displaced by (x, y) px."""
    shift = np.broadcast_to(np.array([x, y], image.dtype), (*image.shape, 2))
    return reference.sample_along(image, np.zeros_like(shift), shift)[0]


def images(least=1):
    shapes = st.tuples(st.integers(least, 6), st.integers(least, 8))
    return shapes.flatmap(lambda shape: arrays(np.float32, shape, elements=LEVELS))


@pytest.mark.parametrize("turned", [False, True])
def test_samples_by_hand(turned):
    # The slope changes by 0 at 10 and by (10 − 20) + (60 − 20) = 30 at 20, and by 0 at the border.
    # So the bend is 7.5 between 10 and 20, and between 20 and 60: a sample is 7.5 / 4 lower at a
    # half, 7.5 · 3/16 at a quarter.
    image = np.array([[0.0, 10.0, 20.0, 60.0]])

    def look(x):
        return sample(image.T, 0.0, x).T if turned else sample(image, x)

    np.testing.assert_allclose(look(0.5)[0], [5.0, 13.125, 38.125, 60.0])
    np.testing.assert_allclose(look(0.25)[0, 1], 11.09375)
    np.testing.assert_allclose(look(-0.75)[0, 2], 11.09375)


def test_a_sample_stays_in_the_range_of_the_pixels_around_it():
    # The parabolas through 0, 50, 50 and 50, 50, 0 reach 56.25 between both.
    np.testing.assert_array_equal(sample(np.array([[0.0, 50.0, 50.0, 0.0]]), 0.5)[0, 1], 50.0)


def test_parabolas_are_given_exactly_away_from_the_border():
    y, x = np.mgrid[:9, :9].astype(np.float64)
    image = x * x + 3 * y * y + 2 * x + 7 * y + 5
    wanted = (x + 0.3) ** 2 + 3 * (y + 0.6) ** 2 + 2 * (x + 0.3) + 7 * (y + 0.6) + 5
    np.testing.assert_allclose(sample(image, 0.3, 0.6)[1:-2, 1:-2], wanted[1:-2, 1:-2])


@given(image=images(), x=st.integers(-3, 3), y=st.integers(-3, 3))
def test_whole_pixels_give_the_pixels(image, x, y):
    rows = np.clip(np.arange(image.shape[0]) + y, 0, image.shape[0] - 1)
    columns = np.clip(np.arange(image.shape[1]) + x, 0, image.shape[1] - 1)
    np.testing.assert_array_equal(sample(image, x, y), image[rows][:, columns])


@given(along=st.integers(-9, 9), down=st.integers(-9, 9), x=SIXTEENTHS, y=SIXTEENTHS)
def test_ramps_are_given_exactly(along, down, x, y):
    row, column = np.mgrid[:5, :7].astype(np.float32)
    image = 128 + along * column + down * row
    column = np.clip(column + np.float32(x / 16), 0, 6)
    row = np.clip(row + np.float32(y / 16), 0, 4)
    np.testing.assert_array_equal(sample(image, x / 16, y / 16), 128 + along * column + down * row)

"""Filtered patterns equal the averages they stand for; lists of shapes miss no cell."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.scenes.raycast.acceleration import bin_rectangles
from texvent.scenes.raycast.shading.value_noise import (
    box_coverage,
    square_wave,
)

PLACES = st.floats(-20.0, 20.0)
FOOTPRINTS = st.floats(0.01, 5.0)


@given(x=PLACES, footprint=FOOTPRINTS)
@settings(max_examples=60)
def test_a_square_wave_is_the_average_over_the_footprint(x, footprint):
    points = x + footprint * ((np.arange(20_000) + 0.5) / 20_000 - 0.5)
    expected = np.mean(points - np.floor(points) < 0.5)
    assert square_wave(x, footprint) == pytest.approx(expected, abs=2e-3)


@given(x=PLACES, footprint=FOOTPRINTS, low=PLACES, width=st.floats(0.0, 10.0))
@settings(max_examples=60)
def test_a_band_is_the_share_of_the_footprint_inside(x, footprint, low, width):
    points = x + footprint * ((np.arange(20_000) + 0.5) / 20_000 - 0.5)
    expected = np.mean((points >= low) & (points <= low + width))
    assert box_coverage(x, low, low + width, footprint) == pytest.approx(expected, abs=2e-3)


@given(
    rectangles=st.lists(
        st.tuples(*[st.integers(-3, 9)] * 2, *[st.integers(-3, 7)] * 2), max_size=12
    )
)
@settings(max_examples=100)
def test_every_cell_lists_the_rectangles_that_touch_it_in_order(rectangles):
    table = np.array(
        [(min(a, b), max(a, b), min(c, d), max(c, d)) for a, b, c, d in rectangles], dtype=np.int64
    ).reshape(-1, 4)
    numbers = np.arange(100, 100 + len(table))
    bins = bin_rectangles(table, numbers, 7, 5)
    for row in range(5):
        for column in range(7):
            expected = [
                number
                for number, (left, right, top, bottom) in zip(numbers, table, strict=True)
                if left <= column <= right and top <= row <= bottom
            ]
            cell = row * 7 + column
            found = bins.items[bins.start[cell] : bins.start[cell + 1]]
            assert found.tolist() == expected

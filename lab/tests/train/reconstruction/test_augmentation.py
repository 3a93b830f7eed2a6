"""Pauses, noise and hot pixels, against slow references and their stated shares."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent_lab.train.reconstruction.losses import add_hot_pixels, add_noise, draw_pauses


def test_pauses_are_as_frequent_and_as_long_as_stated():
    chance = np.random.default_rng(0)
    drawn = draw_pauses(200_000, begin=0.05, stay=0.9, chance=chance)
    begins = np.flatnonzero(~drawn[:-1] & drawn[1:])
    # A share of 0.05 / (0.05 + 0.1), and 1 / (1 − 0.9) windows each.
    assert drawn.mean() == pytest.approx(1 / 3, abs=0.01)
    assert drawn.sum() / len(begins) == pytest.approx(10, rel=0.05)
    assert draw_pauses(3, begin=1.0, stay=0.0, chance=chance).tolist() == [False, True, False]


def test_noise_is_normal_and_spares_the_first_window():
    voxels = np.full((20, 5, 24, 24), 3, np.float32)
    noisy = add_noise(voxels, deviation=0.1, chance=np.random.default_rng(1))
    assert noisy.dtype == np.float32
    np.testing.assert_array_equal(noisy[0], voxels[0])
    noise = noisy[1:] - voxels[1:]
    assert noise.mean() == pytest.approx(0, abs=1e-3)
    assert noise.std() == pytest.approx(0.1, rel=0.01)
    assert voxels.max() == voxels.min() == 3


def slow_hot_pixels(voxels, deviation, max_fraction, seed):
    chance = np.random.default_rng(seed)
    windows, bins, height, width = voxels.shape
    count = int(chance.uniform(0, max_fraction) * height * width)
    rows = chance.integers(height, size=count)
    columns = chance.integers(width, size=count)
    values = chance.standard_normal(count, np.float32)
    out = voxels.copy()
    for row, column, value in zip(rows, columns, values, strict=True):
        for window in range(windows):
            for place in range(bins):
                out[window, place, row, column] += np.float32(deviation) * value
    return out


@given(st.floats(0, 1), st.integers(0, 99))
def test_hot_pixels_stay_the_same_in_all_bins_of_all_windows(max_fraction, seed):
    voxels = np.zeros((3, 2, 6, 7), np.float32)
    chance = np.random.default_rng(seed)
    found = add_hot_pixels(voxels, deviation=0.5, max_fraction=max_fraction, chance=chance)
    expected = slow_hot_pixels(voxels, 0.5, max_fraction, seed)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-6)
    assert not voxels.any()

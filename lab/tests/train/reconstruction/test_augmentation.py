"""Crops, mirrors, pauses, noise and hot pixels, against slow references and their stated shares."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent_lab.train.reconstruction.augmentation import (
    add_hot_pixels,
    add_noise,
    crop_randomly,
    draw_pauses,
    flip_randomly,
)


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


@given(st.integers(1, 9), st.integers(1, 9), st.data())
def test_a_crop_is_the_same_square_of_every_map(height, width, data):
    side = data.draw(st.integers(1, min(height, width)))
    seed = data.draw(st.integers(0, 100))
    whole = {"place": np.arange(height * width).reshape(1, height, width)}
    cut = crop_randomly(whole, side, np.random.default_rng(seed))
    top, left = divmod(int(cut["place"][0, 0, 0]), width)
    assert cut["place"].shape == (1, side, side)
    square = whole["place"][..., top : top + side, left : left + side]
    np.testing.assert_array_equal(cut["place"], square)


def test_a_mirror_turns_maps_and_displacements_round_in_all_four_ways():
    image = np.array([[[[1, 2, 3], [4, 5, 6]]]], np.float32)
    flow = np.concatenate([image, 10 * image], axis=1)
    expected = {
        (1, 1): ([[1, 2, 3], [4, 5, 6]], [1, 10]),
        (-1, 1): ([[3, 2, 1], [6, 5, 4]], [-3, 30]),
        (1, -1): ([[4, 5, 6], [1, 2, 3]], [4, -40]),
        (-1, -1): ([[6, 5, 4], [3, 2, 1]], [-6, -60]),
    }
    seen = set()
    for seed in range(20):
        turned = flip_randomly({"image": image, "flow": flow}, np.random.default_rng(seed))
        mirrored, corner = turned["image"][0, 0].tolist(), turned["flow"][0, :, 0, 0].tolist()
        (way,) = (way for way, one in expected.items() if one == (mirrored, corner))
        seen.add(way)
    assert seen == set(expected)

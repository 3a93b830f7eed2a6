"""Crops and mirror images of maps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.train.sequences.truth import crop_randomly, flip, flip_randomly

pytestmark = pytest.mark.torch


def maps(height: int, width: int) -> dict[str, np.ndarray]:
    """Each pixel tells its own place; the flow points to the pixel right below."""
    place = np.arange(height * width, dtype=np.float32).reshape(1, height, width)
    flow = np.zeros((1, 2, height, width), np.float32)
    flow[:, 1] = 1
    return {"place": place, "flow": flow}


@given(st.integers(1, 9), st.integers(1, 9), st.data())
def test_a_crop_is_the_same_square_of_every_map(height: int, width: int, data) -> None:
    side = data.draw(st.integers(1, min(height, width)))
    seed = data.draw(st.integers(0, 100))
    whole = maps(height, width)
    cut = crop_randomly(whole, side, np.random.default_rng(seed))
    top, left = divmod(int(cut["place"][0, 0, 0]), width)
    assert cut["place"].shape == (1, side, side)
    for name in whole:
        np.testing.assert_array_equal(
            cut[name], whole[name][..., top : top + side, left : left + side]
        )


def test_every_square_is_drawn() -> None:
    drawn = {
        float(crop_randomly(maps(3, 4), 2, np.random.default_rng(seed))["place"][0, 0, 0])
        for seed in range(200)
    }
    assert drawn == {0, 1, 2, 4, 5, 6}


def test_mirrored_flow_points_to_the_mirrored_pixel() -> None:
    chance = np.random.default_rng(0)
    image = chance.random((1, 4, 6)).astype(np.float32)
    flow = np.stack([np.full((4, 6), 2.0), np.full((4, 6), -1.0)])[None].astype(np.float32)
    for x in (False, True):
        for y in (False, True):
            turned = flip({"image": image, "flow": flow}, x=x, y=y)
            assert turned["flow"].dtype == np.float32
            for row in range(1, 4):
                for column in range(4):
                    # The pixel that (column, row) moves to, and the same in the mirror.
                    target = image[0, row - 1, column + 2]
                    r, c = (3 - row if y else row), (5 - column if x else column)
                    dx, dy = turned["flow"][0, :, r, c].astype(int)
                    assert turned["image"][0, r, c] == image[0, row, column]
                    assert turned["image"][0, r + dy, c + dx] == target


def test_each_axis_is_mirrored_half_of_the_time() -> None:
    image = np.array([[[0.0, 1.0], [2.0, 3.0]]])
    corners = [
        flip_randomly({"image": image}, np.random.default_rng(seed))["image"][0, 0, 0]
        for seed in range(400)
    ]
    assert set(corners) == {0.0, 1.0, 2.0, 3.0}
    assert all(60 < corners.count(corner) < 140 for corner in set(corners))

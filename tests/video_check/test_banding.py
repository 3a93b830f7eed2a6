"""Stairs of 8 bits are told from smooth gradients, grain and dither."""

from __future__ import annotations

import numpy as np
import pytest
from tests.video_check.made_clips import frames, pan

from texvent.video_check.banding import classify_tiles, code_values
from texvent.video_check.measurer import measure_video
from texvent.video_check.report import check_video


def gradient(height=64, width=256, low=40.0, high=100.0):
    """Levels that rise from left to right."""
    return np.repeat(np.linspace(low, high, width, dtype=np.float32)[None], height, axis=0)


def slow_tile(tile):
    """The definition of (smooth, banded), neighbour by neighbour."""
    across = [abs(row[i + 1] - row[i]) for row in tile for i in range(15)]
    down = [abs(column[i + 1] - column[i]) for column in tile.T for i in range(15)]
    path = sum(across) + sum(down)
    net = sum(abs(row[-1] - row[0]) for row in tile)
    net += sum(abs(column[-1] - column[0]) for column in tile.T)
    steps = across + down
    smooth = 2 <= tile.max() - tile.min() <= 24 and max(steps) <= 2.1 and path <= 1.25 * net
    equal = sum(step == 0 for step in steps) / len(steps)
    stairs = all(step == 0 or step >= 0.9 for step in steps)
    return bool(smooth), bool(smooth and equal >= 0.5 and stairs)


def test_tiles_are_those_of_the_definition():
    rng = np.random.default_rng(0)
    smooth = gradient() + np.linspace(0, 20, 64)[:, None]
    parts = [
        smooth,
        np.rint(smooth),
        np.rint(smooth + rng.normal(0, 0.6, smooth.shape)),
        smooth * 3,
    ]
    plane = np.concatenate(parts).astype(np.float32)
    found = classify_tiles(plane)
    for row in range(16):
        for column in range(16):
            tile = plane[16 * row : 16 * row + 16, 16 * column : 16 * column + 16].astype(float)
            assert (found[0][row, column], found[1][row, column]) == slow_tile(tile)


def test_a_gradient_is_banded_by_8_bits_alone():
    exact = gradient()
    cases = {
        "float": exact,
        "8 bits": np.rint(exact).astype(np.uint8),
        "10 bits": (np.rint(exact * 4) * 64).astype(np.uint16),
        "8 bits in 16": np.rint(exact).astype(np.uint16) * 257,
    }
    shares = {name: measure_video(frames([one] * 2)) for name, one in cases.items()}
    assert all(one["smooth_share"] == 1 for one in shares.values())
    banded = {name: one["banded_share"] for name, one in shares.items()}
    assert banded == {"float": 0, "8 bits": 1, "10 bits": 0, "8 bits in 16": 1}


def test_dither_and_grain_hide_the_stairs():
    rng = np.random.default_rng(0)
    dithered = np.floor(gradient() + rng.random((64, 256)))
    grainy = np.rint(gradient() + rng.normal(0, 1, (64, 256)))
    for image in (dithered, grainy):
        assert measure_video(frames([image.astype(np.uint8)] * 2))["banded_share"] == 0


def test_stairs_of_colour_are_seen_in_green():
    colour = np.stack([np.rint(gradient() * scale) for scale in (0.7, 1.0, 1.3)], axis=-1)
    (frame,) = frames([colour.astype(np.uint8)])
    assert np.array_equal(code_values(frame), np.rint(gradient()))
    assert "banding" in check_video(frames([colour.astype(np.uint8)] * 2)).remarks


@pytest.mark.parametrize("dtype", [np.uint8, np.float32])
def test_a_textured_image_has_no_bands(dtype):
    assert measure_video(frames(pan(4).astype(dtype)))["banded_share"] < 0.02

"""Small things that move too far for the search of patches."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.interpolate.dis_flow.estimator import DisFlow
from texvent.interpolate.dis_flow.fast_thing import surroundings
from texvent.interpolate.flow import FlowInterpolator
from texvent.video import Frame

WIDTH, HEIGHT = 192, 144


@pytest.fixture(scope="module")
def ground():
    rng = np.random.default_rng(4)
    image = np.kron(rng.uniform(20, 140, (24, 32)), np.ones((6, 6)))
    for axis in (0, 1, 0, 1):
        image = (image + np.roll(image, 2, axis)) / 2
    return image


def with_balls(ground, *centres, radius=4.0):
    """Bright balls of 8 px, their edges one pixel soft."""
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    image = ground
    for centre in centres:
        inside = np.clip(radius + 0.5 - np.hypot(x - centre[0], y - centre[1]), 0, 1)
        image = image + inside * (230 - image)
    return image.astype(np.float32)


def test_a_ball_of_8_px_that_moves_12_px_has_its_flow_and_the_ground_rests(ground):
    first, second = with_balls(ground, (80, 70)), with_balls(ground, (92, 66))
    forward, backward = DisFlow().both_ways(first, second)
    np.testing.assert_allclose(np.median(forward[68:73, 78:83], axis=(0, 1)), (12, -4), atol=0.7)
    np.testing.assert_allclose(np.median(backward[64:69, 90:95], axis=(0, 1)), (-12, 4), atol=0.7)
    # What it covers and uncovers rests, as the ground around.
    assert np.abs(np.median(forward[64:69, 90:95], axis=(0, 1))).max() < 0.5
    assert np.abs(np.median(backward[68:73, 78:83], axis=(0, 1))).max() < 0.5


@pytest.mark.parametrize("share", [0.25, 0.5, 0.75])
def test_the_ball_is_on_its_path_at_every_instant(ground, config, stream, psnr, share):
    first, second = (Frame(with_balls(ground, (80 + x, 70)), t) for x, t in ((0, 0), (12, 1000)))
    (frame,) = FlowInterpolator(config(), stream).between(first, second, [int(1000 * share)])
    near, truth = np.s_[60:80, 70:102], with_balls(ground, (80 + 12 * share, 70))
    blended = first.luma + share * (second.luma - first.luma)
    assert psnr(frame.pixels[near], truth[near]) > psnr(blended[near], truth[near]) + 5


def test_frames_in_which_nothing_moves_too_far_keep_their_flow(ground, monkeypatch):
    first, second = ground.astype(np.float32), np.roll(ground, 3, 1).astype(np.float32)
    flows = DisFlow().both_ways(first, second)
    monkeypatch.setattr(
        "texvent.interpolate.dis_flow.estimator.follow_fast_thing", lambda _, __, both, ___: both
    )
    np.testing.assert_array_equal(DisFlow().both_ways(first, second), flows)


def test_the_surroundings_of_a_small_thing_move_as_the_ground_does():
    flow = np.zeros((2, 72, 96), np.float32)
    flow[0], flow[1] = 2.0, -1.0
    flow[:, 30:42, 40:52] = 17.0
    around = surroundings(flow)
    assert (around[0] == 2.0).all()
    assert (around[1] == -1.0).all()

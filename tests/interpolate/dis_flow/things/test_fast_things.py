"""Small things that move too far for the search of patches."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.interpolate.dis_flow import flow_cpu
from texvent.interpolate.dis_flow.definitions import make_pyramid
from texvent.interpolate.dis_flow.estimator import DisFlow
from texvent.interpolate.dis_flow.things.fast_things import follow_fast_things
from texvent.interpolate.dis_flow.things.missed_shift import correlate_missed, wide_detail
from texvent.interpolate.dis_flow.things.ways import covered, surroundings
from texvent.interpolate.flow import FlowInterpolator
from texvent.sensor import SensorSize
from texvent.video import Frame
from texvent_lab.bench.oracle.camera import camera_level
from texvent_lab.bench.oracle.scenes import panning_texture
from texvent_lab.bench.oracle.smooth_texture import ValueNoise

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
        "texvent.interpolate.dis_flow.estimator.follow_fast_things", lambda *args, **_: args[2]
    )
    np.testing.assert_array_equal(DisFlow().both_ways(first, second), flows)


def test_the_surroundings_of_a_small_thing_move_as_the_ground_does():
    flow = np.zeros((2, 72, 96), np.float32)
    flow[0], flow[1] = 2.0, -1.0
    flow[:, 30:42, 40:52] = 17.0
    around = surroundings(flow)
    assert (around[0] == 2.0).all()
    assert (around[1] == -1.0).all()


def constant(flow):
    """The same flow at every pixel."""
    return np.broadcast_to(np.float32(flow)[:, np.newaxis, np.newaxis], (2, HEIGHT, WIDTH)).copy()


def test_three_balls_that_move_in_three_directions_have_their_flows(ground):
    places = np.array([(60, 40), (130, 70), (70, 110)])
    steps = np.array([(18, 4), (-16, 8), (24, -8)])
    first = second = ground
    for place, step, radius in zip(places, steps, (4.0, 5.0, 6.5), strict=True):
        first = with_balls(first, place, radius=radius)
        second = with_balls(second, place + step, radius=radius)
    forward, _ = DisFlow().both_ways(first, second)
    for (x, y), step in zip(places, steps, strict=True):
        found = np.median(forward[y - 2 : y + 3, x - 2 : x + 3], axis=(0, 1))
        np.testing.assert_allclose(found, step, atol=0.7)


def test_a_thing_that_explains_the_images_no_better_changes_no_flow(ground, monkeypatch):
    first, second = (make_pyramid(with_balls(ground, (x, 70)), 0, 0, flow_cpu)[0] for x in (80, 92))
    flows = constant((0, 0)), constant((0, 0))
    found = follow_fast_things(first, second, flows, flow_cpu)
    assert np.abs(found[0]).max() > 11
    monkeypatch.setattr(
        "texvent.interpolate.dis_flow.things.fast_things.correlate_missed",
        lambda *_: [np.float32([-20, 9])],
    )
    for one, other in zip(follow_fast_things(first, second, flows, flow_cpu), flows, strict=True):
        np.testing.assert_array_equal(one, other)


def test_a_thing_that_the_search_has_found_keeps_its_flow(ground):
    """As the wheels of a car, which turn and are missed, while the car is found."""
    first, second = with_balls(ground, (80, 70)), with_balls(ground, (92, 70))
    levels = [make_pyramid(one, 0, 0, flow_cpu)[0] for one in (first, second)]
    flows = constant((0, 0)), constant((0, 0))
    flows[0][0, 64:77, 74:87], flows[1][0, 64:77, 86:99] = 12, -12
    found = follow_fast_things(*levels, flows, flow_cpu)
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    for one, other, middle in zip(found, flows, (80, 92), strict=True):
        ball = np.hypot(x - middle, y - 70) < 4.5
        np.testing.assert_array_equal(one[:, ball], other[:, ball])
        # No other pixel gets a motion: of the square around the ball, ground may get its own back.
        assert ((one == other) | (one == 0)).all()


def test_ground_that_a_followed_disc_covers_is_no_thing(ground, config, stream, psnr):
    # The search finds the disc; what it covers and what it uncovers look alike.
    first, truth, second = (
        with_balls(ground, (76 + 8 * half, 80 - 3 * half), radius=10) for half in (0, 1, 2)
    )
    pair = Frame(first, 0), Frame(second, 1000)
    (frame,) = FlowInterpolator(config(), stream).between(*pair, [500])
    assert psnr(frame.pixels, truth) > 32.0


def test_the_shift_of_missed_details_is_found_and_one_that_repeats_has_a_rival():
    rng = np.random.default_rng(3)
    image = np.zeros((60, 90))
    image[20:32, 30:42] = rng.uniform(0, 200, (12, 12))
    image -= image.mean()
    missed = (np.ones(image.shape, bool),) * 2
    moved = np.roll(image, (5, -9), (0, 1))
    (shift,) = correlate_missed((image, moved), missed)
    np.testing.assert_allclose(shift, (-9, 5), atol=0.5)
    assert correlate_missed((image, image), missed) == []  # it rests
    assert correlate_missed((image, 0 * image), missed) == []
    stripes = np.tile(90 * np.sin(np.arange(300) * np.pi / 5), (60, 1))
    missed = (np.ones(stripes.shape, bool),) * 2
    assert len(correlate_missed((stripes, np.roll(stripes, 5, 1)), missed)) == 2


def test_what_is_covered_lies_where_the_other_image_shows_something_confirmed():
    flow = np.zeros((2, 1, 5), np.float32)
    flow[0, 0] = [2.0, 0.0, 0.0, 1.4, -9.0]
    is_open = np.array([[True, False, True, True, True]])
    there = np.array([[True, True, False, False, False]])
    # 0 leads to 2, which is confirmed; 1 is confirmed itself; 3 leads to 4; 4 leads outside.
    np.testing.assert_array_equal(covered(flow, is_open, there), [[True, False, True, True, False]])


def test_wide_detail_is_the_difference_from_the_mean_around():
    image = np.arange(8.0 * 12).reshape(8, 12) ** 2
    padded = np.pad(image, 1, mode="edge")  # 12 // 4 = 3 px wide
    around = np.lib.stride_tricks.sliding_window_view(padded, (3, 3)).mean(axis=(2, 3))
    np.testing.assert_allclose(wide_detail(image), image - around)


@pytest.mark.parametrize("seed", [0, 1, 4, 8])
def test_a_disc_of_one_colour_before_a_moving_texture_is_followed_both_ways(seed):
    """What it covers is unexplained in either direction: no reason to refuse its motion."""
    size = SensorSize(96, 72)
    y, x = np.mgrid[:72, :96]
    frames = []
    for seconds, centre in ((0.0, 40), (1 / 24, 57)):
        image = panning_texture(ValueNoise(seed), size, seconds, (60.0, 10.0))
        image[np.hypot(x - centre, y - 24) < 6] = 0.9
        frames.append(camera_level(image).astype(np.float32))
    forward, backward = DisFlow().both_ways(*frames)
    np.testing.assert_allclose(np.median(forward[22:27, 38:43], axis=(0, 1)), (17, 0), atol=0.5)
    np.testing.assert_allclose(np.median(backward[22:27, 55:60], axis=(0, 1)), (-17, 0), atol=0.5)

"""Motion of the whole frame that is fitted to what the search has found."""

import math

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.interpolate.dis_flow.definitions import PATCH, step_of
from texvent.interpolate.dis_flow.estimator import DisFlow, make_level, stretch
from texvent.interpolate.dis_flow.frame_motion import (
    find_motions,
    fit_motion,
    leads_outside,
    patch_vectors,
    pixel_vectors,
)

WIDTH, HEIGHT = 192, 144


def places(width=WIDTH, height=HEIGHT):
    """x and y of each pixel from the middle of the frame, px."""
    y, x = np.mgrid[:height, :width]
    return x + 0.5 - width / 2, y + 0.5 - height / 2


def move(motion):
    """The flow of a frame under a motion, [2, H, W]."""
    x, y = places()
    return np.float32([own[0] + own[1] * x + own[2] * y for own in motion])


def waves(x, y):
    """A texture without period."""
    image = np.zeros_like(x)
    for k, (across, down) in enumerate(np.random.default_rng(5).normal(0, 0.3, (40, 2))):
        image += np.cos(across * x + down * y + k)
    return (127 + 18 * image).astype(np.float32)


def similarity(zoom, degrees):
    """What a zoom and a turn about the middle of the frame move it by, [2, 3]."""
    cos, sin = (zoom * f(math.radians(degrees)) for f in (math.cos, math.sin))
    return np.array([[0, cos - 1, -sin], [0, sin, cos - 1]])


@examples(20)
@given(
    st.lists(st.floats(-20, 20), min_size=2, max_size=2),
    st.lists(st.floats(-0.3, 0.3), min_size=4, max_size=4),
    st.integers(0, 99),
)
def test_a_motion_is_fitted_although_a_few_vectors_are_wild(offset, growth, seed):
    rng = np.random.default_rng(seed)
    motion = np.column_stack([offset, np.reshape(growth, (2, 2))])
    flow = move(motion) + rng.normal(0, 0.05, (2, HEIGHT, WIDTH))
    wild = rng.random((HEIGHT, WIDTH)) < 0.05
    flow[:, wild] = rng.uniform(-40, 40, (2, int(wild.sum())))
    corners = np.abs(move(motion)[:, :: HEIGHT - 1, :: WIDTH - 1]).max()
    found = fit_motion(flow.astype(np.float32), np.ones((HEIGHT, WIDTH), bool))
    if corners > 1.5:
        np.testing.assert_allclose(found[:, 0], motion[:, 0], atol=0.02)
        np.testing.assert_allclose(found[:, 1:], motion[:, 1:], atol=3e-4)
    elif corners < 0.5:
        assert found is None


def test_a_zoom_about_a_corner_which_rests_is_a_motion_of_the_frame():
    zoom = [[0.05 * WIDTH / 2, 0.05, 0], [0.05 * HEIGHT / 2, 0, 0.05]]
    found = fit_motion(move(zoom), np.ones((HEIGHT, WIDTH), bool))
    np.testing.assert_allclose(found, zoom, atol=1e-3)


@pytest.mark.parametrize(
    ("what", "below", "above"),
    [
        ("share", 0.88, 0.92),
        ("confirmed", 0.08, 0.12),
        ("off", 1.1, 0.9),
        ("corner", 0.96, 1.04),
        ("right", 0.96, 1.04),
        ("below", 0.96, 1.04),
    ],
)
def test_a_motion_of_the_frame_needs_as_much_as_is_stated(what, below, above):
    rng, found = np.random.default_rng(2), []
    for much in (below, above):
        ends = {"corner": 1.0, "right": WIDTH / 2, "below": HEIGHT / 2}
        grows = [much / ends[what] * (what == name) for name in ends] if what in ends else [7, 0, 0]
        flow = move([grows, [0, 0, 0]])
        if what == "share":
            flow[0, rng.random(flow.shape[1:]) > much] = -20
        if what == "off":
            flow[1, rng.random(flow.shape[1:]) > 0.85] = much
        is_confirmed = rng.random(flow.shape[1:]) < (much if what == "confirmed" else 0.5)
        found.append(fit_motion(flow, is_confirmed))
    assert found[0] is None
    assert found[1] is not None


@pytest.mark.parametrize(("height", "width"), [(14, 20), (61, 90), (90, 61), (400, 37)])
def test_pixels_patches_and_the_fit_mean_the_same_motion(height, width):
    motion = np.float32([[1, 0.05, -0.02], [-2, 0.03, 0.25]])
    flow = pixel_vectors(motion, (height, width))
    x, y = places(width, height)
    wanted = [own[0] + own[1] * x + own[2] * y for own in motion]
    np.testing.assert_allclose(flow, wanted, atol=1e-4)
    found = fit_motion(flow, np.ones((height, width), bool))
    np.testing.assert_allclose(found, motion, atol=1e-4)
    level = make_level(np.zeros((height, width), np.float32))
    step = step_of(level)
    windows = np.lib.stride_tricks.sliding_window_view(flow, (PATCH, PATCH), (1, 2))
    means = windows[:, ::step, ::step].mean(axis=(-2, -1))
    np.testing.assert_allclose(patch_vectors(motion, level), np.moveaxis(means, 0, -1), atol=1e-4)


@pytest.mark.parametrize(("lost", "is_found"), [((1, 1), False), ((12, 1), True), ((1, 12), True)])
@pytest.mark.parametrize("reverse", [False, True])
def test_the_motion_of_the_frame_is_looked_for_where_either_flow_leaves_much_open(
    lost, is_found, reverse
):
    x, y = places()
    motion = np.array([[3.0, 0, 0], [-2.0, 0, 0]])
    levels = [make_level(waves(x - dx, y - dy)) for dx, dy in ((0, 0), motion[:, 0])]
    flows = [move(motion), move(-motion)]
    for flow, rows in zip(flows, lost, strict=True):
        flow[0, 60 : 60 + rows] = 20  # of 144 rows
    if reverse:
        levels, flows, motion = levels[::-1], flows[::-1], -motion
    found = find_motions(*levels, tuple(flows))
    assert (found is not None) == is_found
    if is_found:
        np.testing.assert_allclose(found, [motion, -motion], atol=0.05)


@pytest.mark.parametrize(("zoom", "degrees"), [(0.8, 0), (1.2, 10)])
def test_flow_of_a_zoom_and_a_turn_reaches_the_borders(zoom, degrees):
    x, y = places()
    cos, sin = (f(math.radians(degrees)) / zoom for f in (math.cos, math.sin))
    first, second = waves(x, y), waves(cos * x + sin * y, cos * y - sin * x)
    forward, _ = DisFlow().both_ways(first, second)
    wanted = move(similarity(zoom, degrees))
    forward = forward.repeat(2, axis=0).repeat(2, axis=1)  # a vector for each 2×2 px
    error = np.abs(np.moveaxis(forward, -1, 0) - wanted).max(axis=0)
    outside = leads_outside(wanted)
    assert np.mean(error[~outside] < 1) > 0.9
    if outside.any():  # what leaves the view goes on as the frame does
        assert np.mean(error[outside] < 1) > 0.9


def test_flow_is_the_same_with_one_and_two_threads(moving_texture, monkeypatch):
    first, second = (moving_texture(dx, width=320, height=240) for dx in (0, 5))
    flows = []
    for threads in (1, 2):
        monkeypatch.setattr(numba, "get_num_threads", lambda count=threads: count)
        flows.append(DisFlow().both_ways(first, second))
    np.testing.assert_array_equal(*flows)


@pytest.mark.parametrize(("shape", "vectors"), [((300, 8), (300, 8)), ((101, 133), (51, 67))])
def test_flow_is_finite_and_half_as_large_but_for_strips(shape, vectors):
    first = np.random.default_rng(3).uniform(0, 255, shape).astype(np.float32)
    for flow in DisFlow().both_ways(first, np.roll(first, 1, axis=1)):
        assert flow.shape == (*vectors, 2)
        assert flow.dtype == np.float32
        assert np.isfinite(flow).all()


@pytest.mark.parametrize("scale", [1, 2, 4])
def test_a_pan_is_found_on_frames_of_every_size(moving_texture, scale):
    size = {"width": 160 * scale, "height": 120 * scale}
    flows = DisFlow().both_ways(*(moving_texture(dx * scale, **size) for dx in (0, 4)))
    for flow, x in zip(flows, (4 * scale, -4 * scale), strict=True):
        np.testing.assert_allclose(np.median(flow[8:-8, 8:-8], axis=(0, 1)), (x, 0), atol=0.1)


def test_stretching_uses_one_scale_for_both_frames():
    first, second = np.float32([[2, 12]]), np.float32([[22, 7]])
    earlier, later = stretch(first, second)
    # 2..22 becomes 0..255: 12.75 per level.
    assert earlier.tolist() == [[0, 127.5]]
    assert later.tolist() == [[255, 63.75]]


def test_stretching_leaves_flat_frames_nearly_flat():
    earlier, later = stretch(np.float32([[100, 101]]), np.float32([[100, 101]]))
    # One level is 255/16 at most, not the whole scale.
    assert earlier.tolist() == later.tolist() == [[0, 255 / 16]]

"""Motion of the whole frame that is fitted to what the search has found."""

import math

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.interpolate.dis_flow.estimator import DisFlow, make_level, stretch
from texvent.interpolate.dis_flow.frame_motion import fit_motion, leads_outside, patch_vectors

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


def test_two_layers_a_frame_at_rest_and_few_vectors_tell_no_motion_of_the_frame():
    everywhere = np.ones((HEIGHT, WIDTH), bool)
    flow = move([[8, 0, 0], [0, 0, 0]])
    assert fit_motion(flow, everywhere) is not None
    flow[:, :, :60] = 0
    assert fit_motion(flow, everywhere) is None
    assert fit_motion(0 * flow, everywhere) is None
    # A zoom about a corner, which rests, is one.
    zoom = [[0.05 * WIDTH / 2, 0.05, 0], [0.05 * HEIGHT / 2, 0, 0.05]]
    np.testing.assert_allclose(fit_motion(move(zoom), everywhere), zoom, atol=1e-3)
    few = np.zeros_like(everywhere)
    few[:10] = True
    assert fit_motion(move([[8, 0, 0], [0, 0, 0]]), few) is None


def test_patches_move_as_their_middles_do():
    level = make_level(np.zeros((14, 20), np.float32))
    vectors = patch_vectors(np.float32([[1, 0.5, 0], [0, 0, 0.25]]), level)
    assert vectors.shape == (3, 5, 2)
    # The first patch covers 0..8 px: its middle is 6 px left of the middle, and 3 px above.
    np.testing.assert_allclose(vectors[0, 0], (1 - 3, -0.75))
    np.testing.assert_allclose(vectors[2, 4], (1 + 3, 0.75))


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

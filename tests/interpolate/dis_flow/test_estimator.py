"""Optical flow of frames of any size."""

import numba
import numpy as np
import pytest

from texvent.interpolate.dis_flow.estimator import DisFlow, stretch


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

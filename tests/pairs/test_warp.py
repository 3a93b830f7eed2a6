"""The warping kernel: hand-computed cases, and the compiled one against its definition."""

import numpy as np
import pytest
from tests.pairs import reference

from texvent.pairs import warping


def warp_between(*arrays):
    """One intermediate frame at the last argument, compiled."""
    return warping.warp_pair(warping.prepare_pair(*arrays[:-1], arrays[-1:]), 0, 1)[0]


KERNELS = [reference.warp_between, warp_between]
kernels = pytest.mark.parametrize("warp", KERNELS, ids=["reference", "cpu"])


def constant_flow(shape, x, y=0.0):
    return np.broadcast_to(np.float32([x, y]), (*shape, 2)).copy()


@kernels
def test_a_ramp_moves_with_its_flow(warp):
    # I(x) = 10 x moves right by 2 px: at τ = 1/4 it has moved 0.5 px, so I = 10 (x − 0.5).
    first = np.tile(np.arange(12, dtype=np.float32) * 10, (3, 1))
    second = first - 20
    forward, backward = constant_flow((3, 12), 2.0), constant_flow((3, 12), -2.0)
    got = warp(first, second, forward, backward, 0.25)
    np.testing.assert_allclose(got[:, 2:-2], first[:, 2:-2] - 5.0, atol=1e-5)


@kernels
def test_flows_that_contradict_each_other_give_a_blend_in_place(warp):
    # Both directions claim 50 px to the right: the errors are 100 px on a path of 0 px.
    rng = np.random.default_rng(0)
    first, second = (rng.uniform(0, 255, (6, 200)).astype(np.float32) for _ in range(2))
    wrong = constant_flow((6, 200), 50.0)
    got = warp(first, second, wrong, wrong, 0.5)
    np.testing.assert_allclose(got, (first + second) / 2, atol=0.01)


@kernels
def test_what_enters_the_image_is_taken_from_the_frame_that_shows_it(warp):
    # Everything moves right by 8 px. At τ = 1/2, column 0 shows what is at column 4 of the later
    # frame and was outside the earlier one, which therefore does not count.
    first, second = np.zeros((1, 20), np.float32), np.full((1, 20), 70.0, np.float32)
    got = warp(first, second, constant_flow((1, 20), 8.0), constant_flow((1, 20), -8.0), 0.5)
    assert got[0, 0] == pytest.approx(70.0)
    assert got[0, 10] == pytest.approx(35.0)
    assert got[0, 19] == pytest.approx(0.0)


def test_places_outside_are_looked_at_at_the_edge():
    image = np.array([[0.0, 10.0], [20.0, 30.0]])
    flow = np.stack([image, -image], axis=-1)
    way = np.zeros((2, 2, 2))
    way[0, 0], way[0, 1], way[1, 0], way[1, 1] = (0.5, 0.4), (-0.75, 0.0), (-3.0, -0.5), (0.3, 9.0)
    seen, vectors, is_inside = reference.sample_along(image, flow, way)
    np.testing.assert_allclose(seen, [[13.0, 2.5], [10.0, 30.0]])
    np.testing.assert_array_equal(vectors[..., 0], [[10.0, 0.0], [20.0, 30.0]])
    np.testing.assert_array_equal(is_inside, [[True, True], [False, False]])
    assert reference.sample_along(image, flow, way + np.array([0.2, -8.5]))[2][1, 1]


def test_some_points_of_an_image_are_those_of_the_whole_image():
    rng = np.random.default_rng(7)
    first, second = (rng.uniform(0, 255, (30, 21)).astype(np.float32) for _ in range(2))
    forward = rng.normal(0, 3, (30, 21, 2)).astype(np.float32)
    pair = warping.prepare_pair(first, second, forward, -forward, [0.2, 0.7])
    pixel = np.sort(rng.choice(630, 100, replace=False))
    room, shown = warping.make_room(pixel.size), np.empty(pixel.size, np.float32)
    warping.take_points(pair, pixel, room.points)
    warping.warp_points(pair, room, pixel.size, 1, shown)
    whole = warping.warp_pair(pair, 0, 2)
    np.testing.assert_array_equal(shown, whole[1].reshape(-1)[pixel])


def test_a_flow_that_is_no_number_does_no_harm():
    frame, flow = np.full((4, 5), 7, np.float32), constant_flow((4, 5), np.nan)
    assert warp_between(frame, frame, flow, flow, 0.5).shape == (4, 5)
    flow = constant_flow((4, 5), 1e30)
    np.testing.assert_array_equal(warp_between(frame, frame, flow, flow, 0.5), frame)

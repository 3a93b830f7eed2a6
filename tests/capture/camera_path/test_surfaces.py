"""Parallax: nearer surfaces move more, and hide farther ones."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.capture.camera_path.layers_cpu import draw_pieces
from texvent.capture.camera_path.motion import Place, Pose
from texvent.capture.camera_path.surfaces import Surfaces
from texvent.capture.camera_path.view import View
from texvent.sensor import SensorSize

BAND = slice(4, 7)
"""Columns of a near band, at 1 m; the wall behind it is at 2 m."""


def two_planes(width=12, height=3):
    levels = np.tile(np.arange(10, 10 + 10 * width, 10, dtype=np.float32), (height, 1))
    depth = np.full((height, width), 2.0)
    levels[:, BAND], depth[:, BAND] = 200.0, 1.0
    return levels, depth


def surfaces_of(levels, depth, scale=1.0, sensor=None, focal_px=None, margin=2, hidden=4):
    size = SensorSize(levels.shape[1], levels.shape[0])
    seen = depth[np.isfinite(depth)]
    reference = float(np.median(seen)) if seen.size else 1.0
    view = View(size, sensor or size, scale, focal_px, reference)
    return Surfaces(view, levels, depth, margin, hidden)


def draw(surfaces, place):
    shape = surfaces.view.sensor.shape
    out, depth = np.empty(shape, np.float32), np.empty(shape, np.float32)
    covered = np.empty(shape)
    draw_pieces(surfaces.pieces(place), out, depth, covered)
    return out, depth, covered


def test_a_still_camera_sees_the_image_exactly():
    levels, depth = two_planes()
    out, seen, covered = draw(surfaces_of(levels, depth), Place())
    np.testing.assert_array_equal(out, levels)
    np.testing.assert_array_equal(seen, depth)
    assert (covered == 1).all()


def test_the_nearer_plane_moves_twice_as_far_and_hides_the_wall():
    levels, depth = two_planes()
    out, seen, covered = draw(surfaces_of(levels, depth), Place(x=1.0))
    # The wall, at the median depth, moves by 1 px to the left, the band by 2: it covers 2 to 4.
    # Behind it appears column 5's place, which was hidden: there the wall's edge, 80, is held.
    expected = [20, 30, 200, 200, 200, 80, 80, 90, 100, 110, 120, 120]
    np.testing.assert_allclose(out[1], expected, atol=1e-4)
    assert seen[1].tolist() == [2, 2, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2]
    np.testing.assert_allclose(covered, 1, atol=1e-9)


def test_an_edge_covers_part_of_a_pixel():
    levels, depth = two_planes()
    out, _, covered = draw(surfaces_of(levels, depth), Place(x=0.25))
    # The band covers 3.5 to 6.5; the wall is shifted by a quarter, its columns 2 and 3 to 40 lie
    # at 2.75 to 3.75, and column 7 begins at 6.75.
    assert out[1, 3] == pytest.approx(0.5 * 200 + 0.5 * 40)
    assert out[1, 6] == pytest.approx(0.5 * 200 + 0.5 * 80)
    assert out[1, 1] == pytest.approx(0.75 * 20 + 0.25 * 30)
    np.testing.assert_allclose(covered, 1, atol=1e-9)


def test_poses_move_by_focal_length_over_depth():
    levels, depth = two_planes()
    pose = Pose(np.eye(3), np.array([0.2, 0.0, 0.0]))
    moved, _, _ = draw(surfaces_of(levels, depth, focal_px=10.0), pose)
    same, _, _ = draw(surfaces_of(levels, depth), Place(x=1.0))  # 10 px · 0.2 m / 2 m
    np.testing.assert_allclose(moved, same, atol=1e-3)


def test_coming_nearer_makes_things_larger_by_the_ratio_of_depths():
    levels = np.full((9, 9), 50, np.float32)
    levels[3:6, 3:6] = 150
    depth = np.full((9, 9), 3.0)
    pose = Pose(np.eye(3), np.array([0.0, 0.0, 1.0]))
    out, seen, _ = draw(surfaces_of(levels, depth, focal_px=8.0), pose)
    # A square of 3 px at 3 m, from 2 m: 4.5 px, from 2.25 to 6.75.
    edges = [0, 0, 0.75, 1, 1, 1, 0.75, 0, 0]
    np.testing.assert_allclose(out, 50 + 100 * np.outer(edges, edges), atol=1e-3)
    np.testing.assert_allclose(seen, 2.0)


def test_without_depth_nothing_parts_and_far_things_stand_still():
    levels, _ = two_planes()
    still, _, _ = draw(surfaces_of(levels, np.full(levels.shape, np.inf)), Place(x=3.0))
    np.testing.assert_allclose(still, levels)


@given(
    st.floats(-2, 2),
    st.floats(-2, 2),
    st.floats(-0.3, 0.3),
    st.floats(0.8, 1.3),
    st.floats(0.5, 9),
    st.booleans(),
)
def test_projection_and_its_inverse_agree(x, y, turn, zoom, metres, is_pose):
    levels, depth = two_planes()
    surfaces = surfaces_of(levels, depth, scale=1.5, sensor=SensorSize(8, 2), focal_px=11.0)
    place = Place(x, y, turn, zoom)
    if is_pose:
        cos, sin = math.cos(turn), math.sin(turn)
        rotation = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
        place = Pose(rotation, np.array([x, y, zoom - 1]) / 10)
    points = np.array([[3.0, 1.0], [7.5, 2.5]])
    seen, ahead = surfaces.project(points, np.full(2, metres), place)
    back, first = surfaces.unproject(seen, ahead, place)
    np.testing.assert_allclose(back, points, atol=1e-9)
    np.testing.assert_allclose(first, metres)
    flat = surfaces.view.matrix(place, surfaces.view.reference_m / metres)
    if not is_pose:  # a turned camera sees an upright plane at several depths
        u, v, w = flat @ np.append(seen[0], 1.0)
        np.testing.assert_allclose([u / w, v / w], points[0], atol=1e-9)


@given(st.floats(-3, 3), st.floats(-2, 2), st.floats(0.9, 1.1))
def test_one_surface_has_no_gaps(x, y, zoom):
    levels = np.random.default_rng(1).random((10, 12)).astype(np.float32) * 255
    depth = 2 + 0.02 * np.arange(12)[None] + 0.01 * np.arange(10)[:, None]
    surfaces = surfaces_of(levels, depth, margin=6)
    out, _, covered = draw(surfaces, Place(x, y, 0.0, zoom))
    np.testing.assert_allclose(covered, 1, atol=0.05)
    assert levels.min() - 1e-3 <= out.min() <= out.max() <= levels.max() + 1e-3


def test_behind_a_near_thing_goes_on_what_is_beside_it_not_what_is_farthest():
    levels, depth = two_planes(height=6)
    levels[0], depth[0] = 250.0, np.inf  # a sky above the wall
    out, _, _ = draw(surfaces_of(levels, depth), Place(x=1.0))
    np.testing.assert_allclose(out[2, 5], 80, atol=1e-4)
    np.testing.assert_allclose(out[0], 250, atol=1e-4)

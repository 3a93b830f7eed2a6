"""Parallax: nearer surfaces move more, and hide farther ones."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.capture.camera_path.motion import CameraPose2D
from texvent.capture.camera_path.view import MOST, View, split_planes
from texvent.sensor import SensorSize

BAND = slice(4, 7)
"""Columns of a near band, at 1 m; the wall behind it is at 2 m."""


def two_planes(width=12, height=3):
    levels = np.tile(np.arange(10, 10 + 10 * width, 10, dtype=np.float32), (height, 1))
    depth = np.full((height, width), 2.0, np.float32)
    levels[:, BAND], depth[:, BAND] = 200.0, 1.0
    return levels, depth


def planes_of(levels, depth, place):
    size = SensorSize(levels.shape[1], levels.shape[0])
    seen = depth[np.isfinite(depth)]
    reference = float(np.median(seen)) if seen.size else 1.0
    return split_planes(View(size, size, 1.0, reference), levels, depth, [place])


def draw(levels, depth, place):
    planes = planes_of(levels, depth, place)
    out, seen = planes.render(place)
    return out, planes.depth(seen)


def test_a_still_camera_sees_the_image_exactly():
    levels, depth = two_planes()
    planes = planes_of(levels, depth, CameraPose2D(2.0))
    out, seen = planes.render(CameraPose2D())
    np.testing.assert_array_equal(out, levels)
    np.testing.assert_array_equal(planes.depth(seen), depth)


def test_the_nearer_plane_moves_twice_as_far_and_hides_the_wall():
    levels, depth = two_planes()
    out, seen = draw(levels, depth, CameraPose2D(x=1.0))
    # The wall, at the median depth, moves by 1 px to the left, the band by 2: it covers 2 to 4.
    # Behind it appears column 5's place, which was hidden: there the wall's edge, 80, is held.
    expected = [20, 30, 200, 200, 200, 80, 80, 90, 100, 110, 120, 120]
    np.testing.assert_allclose(out[1], expected, atol=1e-3)
    assert seen[1].tolist() == [2, 2, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2]


def test_an_edge_covers_part_of_a_pixel():
    levels, depth = two_planes()
    out, _ = planes_of(levels, depth, CameraPose2D(x=2.0)).render(CameraPose2D(x=0.25))
    # The band covers 3.5 to 6.5.
    assert out[1, 3] == pytest.approx(0.5 * 200 + 0.5 * 40, abs=2)
    assert out[1, 6] == pytest.approx(0.5 * 200 + 0.5 * 80, abs=2)
    assert out[1, 1] == pytest.approx(0.75 * 20 + 0.25 * 30)


def test_far_things_stand_still():
    levels, _ = two_planes()
    still, _ = draw(levels, np.full(levels.shape, np.inf, np.float32), CameraPose2D(x=3.0))
    np.testing.assert_allclose(still, levels)


@given(st.floats(-2, 2), st.floats(-2, 2), st.floats(-0.3, 0.3), st.floats(0.8, 1.3))
def test_vectors_there_and_back_cancel(x, y, turn, zoom):
    levels, depth = two_planes()
    place = CameraPose2D(x, y, turn, zoom)
    first = CameraPose2D()
    planes = planes_of(levels, depth, place)
    _, seen = planes.render(first)
    there = planes.vectors(first, place, seen)
    view, near = planes.view, planes.nearness
    for row, column in ((1, 5), (0, 0)):
        moved = np.append(np.array([column + 0.5, row + 0.5]) + there[row, column], 1.0)
        u, v, w = view.matrix(place, near[seen[row, column]]) @ moved
        np.testing.assert_allclose([u / w, v / w], [column + 0.5, row + 0.5], atol=1e-5)


@given(st.floats(-3, 3), st.floats(-2, 2), st.floats(0.9, 1.1))
def test_one_slanted_surface_has_no_gaps(x, y, zoom):
    levels = np.full((10, 12), 100, np.float32)
    depth = (2 + 0.2 * np.arange(12)[None] + 0.1 * np.arange(10)[:, None]).astype(np.float32)
    place = CameraPose2D(x, y, 0.0, zoom)
    planes = planes_of(levels, depth, place)
    assert len(planes.nearness) <= MOST
    np.testing.assert_allclose(planes.render(place)[0], 100, atol=1e-3)


def test_behind_a_near_thing_goes_on_what_is_beside_it_not_what_is_farthest():
    levels, depth = two_planes(height=6)
    levels[0], depth[0] = 250.0, np.inf  # a sky above the wall
    out, _ = draw(levels, depth, CameraPose2D(x=1.0))
    np.testing.assert_allclose(out[2, 5], 80, atol=1e-3)
    np.testing.assert_allclose(out[0], 250, atol=1e-3)

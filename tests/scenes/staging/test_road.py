"""Roads: their centre lines and who is on them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.scenes.description import (
    ObjectMotion,
    SceneDescription,
    SceneObject,
    Surroundings,
)
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.sensor import SensorSize


def stage(*objects: SceneObject, place: str = "road") -> ComposedScene:
    description = SceneDescription("", objects, surroundings=Surroundings(place))
    return compose_scene(description, seed=0, size=SensorSize(64, 48), duration_s=2.0)


def road_of(scene: ComposedScene) -> tuple[RoadLine, float]:
    """The road of a scene, and half its width."""
    found = scene.environment(0.0)
    x, y = found.road_offset
    return RoadLine(found.road_angle, (float(x), float(y))), found.road_half_width


@given(st.floats(-4.0, 4.0), st.sampled_from([0.0, 0.02, -0.03]), st.floats(-40.0, 40.0))
def test_points_at_an_arc_length_lie_on_the_line(angle, curvature, along):
    road = RoadLine(angle, (3.0, -2.0), curvature)
    x, y, heading = road.at(along)
    assert road.distance(np.array([[x, y]]))[0] == pytest.approx(0.0, abs=1e-9)
    further = road.at(along + 1e-6)
    assert math.hypot(further[0] - x, further[1] - y) == pytest.approx(1e-6, rel=1e-3)
    assert math.cos(heading) == pytest.approx((further[0] - x) / 1e-6, abs=1e-3)
    left = np.array([[x - 0.5 * math.sin(heading), y + 0.5 * math.cos(heading)]])
    assert road.across(left)[0] == pytest.approx(0.5)


def test_distance_is_to_the_nearest_road():
    road = RoadLine(crossings=((5.0, 0.0, math.pi / 2),))
    np.testing.assert_allclose(road.distance(np.array([[4.0, 3.0], [0.0, 2.0]])), [1.0, 2.0])


@pytest.mark.parametrize(("direction", "is_on"), [("right", False), ("across", True)])
def test_who_walks_in_a_city_is_on_the_pavement_unless_they_cross(direction, *, is_on):
    scene = stage(SceneObject("man", motion=ObjectMotion("walk", direction)), place="city")
    road, half = road_of(scene)
    distances = road.distance(np.array([scene.actors[0].middle(t)[:2] for t in (0.0, 1.0, 2.0)]))
    assert bool(distances.min() < half) == is_on
    assert np.ptp(distances) > 0.5 if is_on else np.ptp(distances) < 0.1


@pytest.mark.parametrize(
    ("nouns", "place", "is_on"),
    [
        (("fire hydrant", "sign"), "road", False),
        (("cow",), "city", False),
        (("barrier", "fire hydrant"), "road", True),
        (("car",), "road", True),
    ],
)
def test_what_rests_is_beside_the_road_unless_it_belongs_there(nouns, place, *, is_on):
    scene = stage(*(SceneObject(one, motion=ObjectMotion("stand")) for one in nouns), place=place)
    road, half = road_of(scene)
    spots = np.array([one.middle(0.0)[:2] for one in scene.actors])
    assert bool(road.distance(spots).min() < half) == is_on

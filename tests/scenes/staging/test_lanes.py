"""Traffic queues in lanes."""

from __future__ import annotations

import itertools

from texvent.scenes.description import (
    CREEPING_M_S,
    ObjectMotion,
    SceneDescription,
    SceneObject,
    Surroundings,
)
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.scenes.staging.surroundings.road import find_lanes
from texvent.sensor import SensorSize


def stage(*objects: SceneObject) -> ComposedScene:
    description = SceneDescription("", objects, surroundings=Surroundings("road"))
    return compose_scene(description, seed=0, size=SensorSize(64, 48), duration_s=2.0)


def drivers(noun: str, direction: str, count: int = 1, *, speed: float | None = None):
    motion = ObjectMotion("drive", direction, speed_m_s=speed)
    return SceneObject(noun, count, motion=motion)


def test_traffic_drives_both_ways_in_two_lanes_without_touching():
    lanes = find_lanes(stage(drivers("car", "right", 3), drivers("bus", "left", 3)).actors)
    assert [len(lane) for lane in lanes] == [3, 3]
    for time_s in (0.0, 1.0, 2.0):
        for lane in lanes:
            assert len({one.middle(time_s)[1] for one in lane}) == 1
            for one, other in itertools.combinations(lane, 2):
                gap = abs(one.middle(time_s)[0] - other.middle(time_s)[0])
                assert gap > 0.5 * (one.model.length + other.model.length)
    right, left = (lane[0].middle(0.0)[1] for lane in lanes)
    assert right < left


def test_two_cars_stay_where_they_are_placed():
    scene = stage(drivers("car", "left"), drivers("bus", "right"))
    assert all(len(lane) == 1 for lane in find_lanes(scene.actors))


def test_a_jam_has_its_subject_amid_it():
    slow = CREEPING_M_S
    scene = stage(
        drivers("bus", "right", speed=slow), drivers("car", "right", 3, speed=slow),
        drivers("van", "left", 3, speed=slow),
    )  # fmt: skip
    right, _ = find_lanes(scene.actors)
    bus = next(one for one in right if one.noun.name == "bus")
    along = sorted(one.middle(0.0)[0] for one in right)
    assert along[0] < bus.middle(0.0)[0] < along[-1]
    assert abs(bus.middle(2.0)[0] - bus.middle(0.0)[0]) < 0.2

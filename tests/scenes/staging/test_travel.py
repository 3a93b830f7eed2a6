"""A camera that travels: route, road, what stands along it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from texvent.scenes.description import (
    CameraMove,
    ObjectMotion,
    SceneDescription,
    SceneObject,
    Shot,
    Surroundings,
)
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)
DURATION_S = 2.0
PLACES = ("road", "city", "dirt road", "forest", "grass", "desert", "snow", "sea", "underwater",
          "mountain", "sky", "indoor")  # fmt: skip


def travel(
    place: str, *moves: CameraMove, view: str | None = None, objects: tuple[SceneObject, ...] = ()
) -> ComposedScene:
    description = SceneDescription(
        "", objects, shot=Shot(moves, view), surroundings=Surroundings(place)
    )
    return compose_scene(description, seed=0, size=SIZE, duration_s=DURATION_S)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("direction", ["forward", "backward", "left"])
def test_the_camera_moves_on_above_the_ground_and_through_nothing(place, direction):
    scene = travel(place, CameraMove("travel", direction))
    times = np.linspace(0.0, DURATION_S, 21)
    cameras = [scene.camera(float(time)) for time in times]
    positions = np.array([camera.position for camera in cameras])
    way = np.hypot(*np.diff(positions[:, :2], axis=0).T).sum()
    assert way > 1.5
    assert positions[:, 2].min() > 0.25
    sign = -1.0 if direction == "backward" else 1.0
    steps = np.diff(positions, axis=0)
    ahead = [float(step @ camera.rotation[2]) for step, camera in zip(steps, cameras, strict=False)]
    assert min(sign * step for step in ahead) > 0.0
    boxes = scene.still.to_world
    middles, reach = boxes[:, :, 3], np.linalg.norm(boxes[:, :, :3], axis=(1, 2)) / math.sqrt(3.0)
    for position in positions:
        assert np.all(np.linalg.norm(middles - position, axis=1) > 0.3 * reach)


def test_the_road_bends_with_the_route():
    scene = travel("road", CameraMove("travel", "left"))
    environment = scene.environment(0.0)
    centre = (
        environment.road_offset
        + np.array([-math.sin(environment.road_angle), math.cos(environment.road_angle)])
        / environment.road_curvature
    )
    lanes = [
        np.hypot(*(scene.camera(t).position[:2] - centre)) - 1.0 / environment.road_curvature
        for t in (0.0, 1.0, 2.0)
    ]
    np.testing.assert_allclose(lanes, lanes[0], atol=1e-6)
    assert 0.5 < lanes[0] < environment.road_half_width


def test_a_vehicle_ahead_keeps_its_distance_and_oncoming_ones_pass():
    ahead = SceneObject("truck", motion=ObjectMotion("drive"))
    oncoming = SceneObject("car", motion=ObjectMotion("drive", "towards"))
    scene = travel("road", CameraMove("travel", "forward"), objects=(ahead, oncoming))
    depths = []
    for time in (0.0, 1.0, 2.0):
        camera = scene.camera(time)
        middles = np.array([actor.middle(time) for actor in scene.actors])
        depths.append(((middles - camera.position) @ camera.rotation.T)[:, 2])
    gaps = np.array(depths)
    np.testing.assert_allclose(gaps[:, 0], gaps[0, 0], atol=0.05)
    assert gaps[0, 1] - gaps[2, 1] > 20.0


@pytest.mark.parametrize("road", ["curved", "crossing"])
def test_the_camera_travels_on_the_road_as_it_is(road):
    description = SceneDescription(
        "", shot=Shot((CameraMove("travel", "forward"),)),
        surroundings=Surroundings("city", road=road),
    )  # fmt: skip
    environment = compose_scene(description, seed=0, size=SIZE, duration_s=DURATION_S).environment(
        0.0
    )
    assert (environment.road_curvature != 0.0) == (road == "curved")
    assert (len(environment.road_crossings) == 1) == (road == "crossing")

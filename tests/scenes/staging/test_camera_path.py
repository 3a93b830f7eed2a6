"""Camera moves: smooth, in phases, with the subject in view and of the right size."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.scenes.description import (
    CameraMove,
    ObjectMotion,
    SceneDescription,
    SceneObject,
    Shot,
    Surroundings,
)
from texvent.scenes.staging.camera.framing import image_of
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)
DURATION_S = 2.0
KINDS = ("pan", "tilt", "roll", "zoom", "dolly", "truck", "pedestal", "orbit", "crane",
         "dolly zoom", "handheld", "follow")  # fmt: skip
DIRECTIONS = ("left", "right", "up", "down", "in", "out", "clockwise", "behind", "side")
moves = st.lists(
    st.builds(
        CameraMove, st.sampled_from(KINDS), st.sampled_from(DIRECTIONS),
        st.sampled_from([0.5, 1.0, 2.0]), st.integers(0, 2),
        start_s=st.sampled_from([None, None, 0.0, 0.7]), stop_s=st.sampled_from([None, 1.4]),
    ),
    min_size=1, max_size=3,
)  # fmt: skip


def film(
    *shot: CameraMove, noun: str = "dog", motion: ObjectMotion | None = None, place: str = "grass"
) -> ComposedScene:
    subject = SceneObject(noun, motion=motion or ObjectMotion("stand"))
    description = SceneDescription(
        "", (subject,), shot=Shot(shot), surroundings=Surroundings(place)
    )
    return compose_scene(description, seed=0, size=SIZE, duration_s=DURATION_S)


@settings(max_examples=30)
@given(moves, st.sampled_from(["stand", "walk"]))
def test_every_combination_is_smooth_and_keeps_its_subject(shot, kind):
    scene = film(*shot, motion=ObjectMotion(kind))
    inside = []
    for time in np.linspace(0.0, DURATION_S, 13):
        before, after = scene.camera(float(time)), scene.camera(float(time) + 1e-3)
        distance = float(np.linalg.norm(before.position - scene.actors[0].middle(float(time))))
        assert np.abs(before.position - after.position).max() < 0.005 * distance
        assert np.abs(before.rotation - after.rotation).max() < 0.02
        assert abs(math.log(after.focal / before.focal)) < 0.02
        assert before.position[2] >= 0.25
        x, y, depth = image_of(before, scene.actors[0].middle(float(time)))
        inside.append(abs(x) < 0.5 and abs(y) < 0.5 * SIZE.height / SIZE.width and depth > 0.0)
    assert np.mean(inside) > 0.85


@pytest.mark.parametrize("direction", ["behind", "front", "side", "above"])
@pytest.mark.parametrize("motion", [("run", None), ("walk", "away"), ("walk", "circle")])
def test_a_followed_subject_keeps_its_place_and_size(direction, motion):
    scene = film(CameraMove("follow", direction), motion=ObjectMotion(*motion))
    dog = scene.actors[0]
    times = np.linspace(0.0, DURATION_S, 9)
    depths = []
    for time in times:
        camera = scene.camera(float(time))
        depths.append(float(camera.rotation[2] @ (dog.middle(float(time)) - camera.position)))
    assert max(depths) / min(depths) < 1.1
    way = np.diff([scene.camera(float(t)).position[:2] for t in times], axis=0)
    assert np.hypot(*way.T).sum() > 1.0


@pytest.mark.parametrize("direction", ["in", "out"])
def test_a_dolly_zoom_keeps_the_subject_and_changes_the_background(direction):
    scene = film(CameraMove("dolly zoom", direction), noun="man")
    man = scene.actors[0]
    views = [image_of(scene.camera(t), man.corners(t)) for t in (0.0, 0.5, 1.0, 1.5, 2.0)]
    sizes = [np.ptp(view[:, :2], axis=0).max() for view in views]
    assert max(sizes) / min(sizes) < 1.02
    behind = man.middle(0.0) + np.array([[-4.0, 30.0, 0.0], [4.0, 30.0, 0.0]])
    spans = [np.ptp(image_of(scene.camera(t), behind)[:, 0]) for t in (0.0, DURATION_S)]
    assert max(spans) / min(spans) > 1.4
    ways = [np.linalg.norm(scene.camera(t).position - man.middle(0.0)) for t in (0.0, 2.0)]
    assert (ways[1] < ways[0]) == (direction == "in")


def test_a_timed_move_starts_and_stops_when_it_says():
    pan = CameraMove("pan", "right", start_s=0.5, stop_s=1.0)
    scene = film(pan, CameraMove("tilt", "up", start_s=1.5), noun="house")
    axes = [scene.camera(t).rotation[2] for t in (0.0, 0.5, 0.75, 1.0, 1.5, 2.0)]
    bearings = [math.atan2(axis[0], axis[1]) for axis in axes]
    assert bearings[1] == pytest.approx(bearings[0])
    assert bearings[1] + 0.05 < bearings[2] < bearings[3] - 0.05
    assert bearings[4] == pytest.approx(bearings[3])
    assert axes[4][2] == pytest.approx(axes[0][2])
    assert axes[5][2] > axes[4][2] + 0.05

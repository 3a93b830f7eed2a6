"""Motions of laboratories: flat patterns, rates, rotation, acceleration."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.scenes.description import ObjectMotion, SceneDescription, SceneObject
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

DURATION_S = 1.0
TIMES = (0.0, 0.3, 0.7, 1.0)
FRONT = [0.0, -1.0, 0.0]


def stage(noun: str, *motions: ObjectMotion, count: int = 1) -> ComposedScene:
    thing = SceneObject(noun, count=count, motion=motions[0], then=motions[1:])
    description = SceneDescription("hand-built", (thing,))
    return compose_scene(description, seed=0, size=SensorSize(64, 48), duration_s=DURATION_S)


def actor(noun: str, *motions: ObjectMotion) -> Actor:
    return stage(noun, *motions).actors[0]


@pytest.mark.parametrize(
    ("noun", "motions"),
    [
        ("disc", (ObjectMotion("move", "left"), ObjectMotion("move", "right"))),
        ("grating", (ObjectMotion("move", "circle"),)),
        ("barcode", (ObjectMotion("spin"),)),
        ("checkerboard", (ObjectMotion("slide", "to and fro"),)),
        ("qr code", (ObjectMotion("move", "diagonal"),)),
        ("disc", (ObjectMotion("rise"),)),
    ],
)
def test_a_flat_pattern_faces_the_camera_all_along(noun, motions):
    path = actor(noun, *motions).trajectory
    fronts = [path.at(time).to_world()[:, 0] for time in TIMES]
    np.testing.assert_allclose(fronts, [FRONT] * len(TIMES), atol=1e-9)


def test_a_flat_pattern_turns_clockwise_for_the_viewer():
    path = actor("grating", ObjectMotion("spin", "clockwise")).trajectory
    up = path.at(0.2).to_world()[:, 2] - path.at(0.0).to_world()[:, 2]
    assert up[0] > 0.1  # its upper edge goes to the right


def test_what_moves_up_and_down_at_a_rate_stays_above_the_ground():
    ball = actor("ball", ObjectMotion("move", "up and down", rate_hz=2.0))
    heights = [ball.trajectory.at(time).position[2] for time in np.linspace(0.0, 1.0, 41)]
    assert min(heights) >= -1e-9
    turns = np.count_nonzero(np.diff(np.sign(np.diff(heights))))
    assert turns == 4

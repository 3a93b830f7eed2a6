"""Things named alone stand side by side; long ones lie across the view."""

from __future__ import annotations

import math

import pytest

from texvent.scenes.description import ObjectMotion, SceneDescription, SceneObject, Surroundings
from texvent.scenes.staging.compose import compose_scene
from texvent.scenes.staging.still_life import is_still_life
from texvent.sensor import SensorSize


def describe(*nouns: str, kind: str = "stand") -> SceneDescription:
    objects = tuple(SceneObject(noun, motion=ObjectMotion(kind)) for noun in nouns)
    return SceneDescription("", objects, surroundings=Surroundings("plain"))


@pytest.mark.parametrize(
    ("nouns", "kind", "is_still"),
    [
        (("bus", "bench"), "stand", True),
        (("bus", "bench"), "drive", False),
        (("man", "bench"), "stand", False),
        (("bus",), "stand", False),
    ],
)
def test_a_few_things_at_rest_are_a_still_life(
    nouns: tuple[str, ...], kind: str, *, is_still: bool
) -> None:
    assert is_still_life(describe(*nouns, kind=kind)) is is_still


def test_sticks_lie_across_the_view() -> None:
    scene = compose_scene(
        describe("baseball bat", "ball"), seed=0, size=SensorSize(96, 72), duration_s=1.0
    )
    assert abs(math.cos(scene.actors[0].trajectory.at(0.0).yaw)) > 0.9

"""The camera comes near for small things at a person who stays, unless others would be lost."""

from __future__ import annotations

import numpy as np
from tests.scenes.sentences import parse_prompt

from texvent.scenes.projection import project
from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize


def distance(prompt: str) -> float:
    scene = compose_scene(parse_prompt(prompt), seed=0, size=SensorSize(173, 130), duration_s=1.0)
    return scene.camera_path.framing.distance_m


def test_small_things_are_seen_from_nearer_where_nothing_else_is_named() -> None:
    alone = distance("a man shows a thumbs up and holds a cup")
    assert alone < 0.9 * distance("a man shows a thumbs up")
    assert alone < distance("a man shows a thumbs up and holds a cup beside a sofa")


def test_a_kite_is_whole_in_the_image_with_who_flies_it() -> None:
    size = SensorSize(173, 130)
    scene = compose_scene(parse_prompt("a girl flies a kite"), seed=0, size=size, duration_s=1.0)
    for actor in scene.actors:
        spots = project(scene.camera(0.5), size, actor.corners(0.5))[:, :2]
        assert np.all(spots > -2.0)
        assert np.all(spots < np.array([size.width, size.height]) + 2.0)

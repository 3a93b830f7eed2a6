"""Furniture of rooms stands at the wall: in one row, its front to the room, the wall behind it."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.scenes.staging.placement.at_wall import list_at_wall
from texvent.sensor import SensorSize

SIZE = SensorSize(128, 96)


def staged(prompt: str) -> ComposedScene:
    return compose_scene(parse_prompt(prompt), seed=1, size=SIZE, duration_s=1.0)


def test_what_is_fitted_has_the_wall_at_its_back() -> None:
    scene = staged("a kitchen with an oven and a refrigerator")
    wall = scene.environment(0.0).room_half_size
    for actor in scene.actors:
        corners = actor.corners(0.0)
        assert wall - 0.1 < corners[:, 1].max() <= wall
        assert actor.trajectory.at(0.0).yaw == pytest.approx(-0.5 * math.pi)
    eye = scene.camera(0.0).position
    assert np.all(np.abs(eye[:2]) < wall)
    assert abs(scene.camera(0.0).rotation[2, 0]) < 0.2


def test_a_row_at_the_wall_does_not_overlap() -> None:
    scene = staged("a bathroom with a sink, a toilet and a bathtub")
    spans = sorted(
        (corners[:, 0].min(), corners[:, 0].max())
        for corners in (actor.corners(0.0) for actor in scene.actors)
    )
    assert all(one[1] < two[0] for one, two in itertools.pairwise(spans))


def test_a_curtain_hangs_before_its_window() -> None:
    window, curtain = staged("a window with a red curtain").actors[:2]
    assert abs(window.middle(0.0)[0] - curtain.middle(0.0)[0]) < 0.1
    assert curtain.middle(0.0)[1] < window.middle(0.0)[1]


@pytest.mark.parametrize(
    "prompt",
    [
        "a toilet stands on the grass in a park",
        "a cat sits on a refrigerator in a garden",
        "a red car drives past a house",
    ],
)
def test_outdoors_nothing_stands_at_a_wall(prompt: str) -> None:
    said = parse_prompt(prompt)
    assert not list_at_wall(said, said.surroundings.place or "grass")


def test_who_is_on_or_in_it_goes_with_it() -> None:
    tub, cat = staged("a cat sits in a bathtub").actors[:2]
    if tub.noun.name == "cat":
        tub, cat = cat, tub
    assert np.all(np.abs((tub.middle(0.0) - cat.middle(0.0))[:2]) < [0.9, 0.5])


def test_cabinets_of_a_kitchen_are_one_row_of_cabinets() -> None:
    assert parse_prompt("a kitchen with white cabinets").objects[0].count == 1

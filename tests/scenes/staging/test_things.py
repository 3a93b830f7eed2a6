"""Things stand, lie and are held as strangers expect them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.objects.toys import KITE_TURN_RAD
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.shapes import bounds
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.scenes.staging.placement.fitting import enlarge_small
from texvent.scenes.staging.placement.tables.tabletop import set_on_table
from texvent.scenes.staging.preparation import prepare
from texvent.sensor import SensorSize

SIZE = SensorSize(128, 96)


def stage(prompt: str) -> ComposedScene:
    return compose_scene(parse_prompt(prompt), seed=0, size=SIZE, duration_s=1.0)


def find(scene: ComposedScene, noun: str) -> list[Actor]:
    return [actor for actor in scene.actors if actor.noun.name == noun]


@pytest.mark.parametrize("prompt", ["a fire hydrant and a mailbox", "a man stands beside a sign"])
def test_what_belongs_at_the_kerb_is_not_on_the_road(prompt: str) -> None:
    scene = stage(f"{prompt} in a city")
    ground = scene.environment(0.5)
    for actor in scene.actors:
        assert ground.road_half_width is not None
        away = abs(actor.middle(0.5)[1] - ground.road_offset[1])
        assert away > ground.road_half_width


def test_one_has_one_pair_of_skis() -> None:
    assert [
        one.count for one in parse_prompt("skis lie in the snow").objects if one.noun == "ski"
    ] == [1]


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [("a girl holds an umbrella on a beach", "umbrella"), ("two umbrellas on a beach", "parasol"),
     ("a man sits under an umbrella", "parasol"), ("an umbrella and a bench", "umbrella")],
)  # fmt: skip
def test_umbrellas_are_for_the_hand_but_over_people_and_on_beaches(prompt: str, noun: str) -> None:
    description, _ = prepare(parse_prompt(prompt), NOUNS, 1.0)
    assert noun in {one.noun for one in description.objects}


def test_an_open_umbrella_lies_on_its_rim_and_stands_upright_in_a_hand() -> None:
    model = NOUNS["umbrella"].build(colour=None, scale=1.0, seed=0)
    low, high = bounds(model.parts(Pose(0.0, 0.0, 0.0, "stand")))
    assert -0.06 < low[2] < 0.03
    held_low, held_high = bounds(model.parts(Pose(0.0, 0.0, 0.0, "move")))
    assert held_high[2] - held_low[2] > 0.8
    assert abs(held_high[0] + held_low[0]) < 0.1 < abs(high[0] + low[0])


def test_a_kite_shows_its_face_and_sways() -> None:
    (kite,) = find(stage("a person flies a kite"), "kite")
    start, later = kite.trajectory.at(0.0), kite.trajectory.at(0.6)
    assert math.sin(start.yaw + KITE_TURN_RAD) < -0.8
    assert np.hypot(*np.subtract(start.position, later.position)[:2]) > 0.1


def test_what_one_drinks_from_does_not_hide_the_face() -> None:
    drinks = enlarge_small(parse_prompt("a man drinks from a glass"), NOUNS)
    holds = enlarge_small(parse_prompt("a man holds a glass"), NOUNS)
    assert drinks.objects[1].scale < holds.objects[1].scale


def test_sticks_lie_across_the_view_in_a_still_life() -> None:
    (bat,) = find(stage("a baseball bat and a sports ball"), "baseball bat")
    assert abs(math.cos(bat.trajectory.at(0.0).yaw)) > 0.9


def test_several_computers_stand_on_a_desk_in_a_row() -> None:
    said = set_on_table(parse_prompt("a laptop and two monitors in an office"), NOUNS)
    assert [one.noun for one in said.objects].count("desk") == 1
    scene = stage("a laptop and two monitors in an office")
    (desk,) = find(scene, "desk")
    screens = [*find(scene, "laptop"), *find(scene, "monitor")]
    spots = sorted(float(one.middle(0.0)[0] - desk.middle(0.0)[0]) for one in screens)
    assert np.all(np.diff(spots) > 0.3)
    assert abs(spots[0] + spots[-1]) < 0.2


def test_a_glove_is_on_the_left_hand() -> None:
    scene = stage("a man holds a baseball glove")
    (man,), (glove,) = find(scene, "man"), find(scene, "baseball glove")
    hand = man.anchor("left hand", 0.5)[:, 3]
    assert np.linalg.norm(glove.middle(0.5) - hand) < 0.25

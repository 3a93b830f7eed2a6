"""Gates and doors that one goes through, cages that one stays in, boards that show their front."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.shapes import bounds
from texvent.scenes.models.wrapped.opened import OpenedModel
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.body_boxes import part_boxes
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

STILL = Pose(0.0, 0.0, 0.0, "stand")
TIMES = np.linspace(0.0, 1.0, 9)


def stage(prompt: str) -> ComposedScene:
    return compose_scene(parse_prompt(prompt), seed=0, size=SensorSize(173, 130), duration_s=1.0)


def named(scene: ComposedScene, noun: str) -> list[Actor]:
    return [one for one in scene.actors if one.noun.name == noun]


def test_the_leaf_of_an_open_gate_is_swung_away_from_the_way_through() -> None:
    gate = NOUNS["gate"].build(colour=None, scale=1.0, seed=0)
    opened = OpenedModel(gate, "gate")
    assert len(opened.parts(STILL)) == len(gate.parts(STILL))
    blocking = [one for one in opened.parts(STILL) if abs(one.to_body[1, 3]) < 0.8]
    assert not blocking
    assert bounds(opened.parts(STILL))[0][0] < -2.0


@pytest.mark.parametrize(
    ("prompt", "passage"),
    [("a dog runs through a gate", "gate"), ("a woman walks through a door", "door")],
)
def test_what_goes_through_is_on_one_side_first_and_then_on_the_other(prompt, passage) -> None:
    scene = stage(prompt)
    (gate,) = named(scene, passage)
    (mover,) = [one for one in scene.actors if one is not gate]
    ahead = [float((mover.middle(t) - gate.middle(t))[1]) for t in (0.0, 1.0)]
    assert ahead[0] > 0.0 > ahead[1]
    assert not scene.not_shown


def test_several_share_out_the_gates_of_a_row() -> None:
    scene = stage("people walk through three gates")
    gates, people = named(scene, "gate"), named(scene, "person")
    lanes = sorted(round(float(one.middle(0.0)[0]), 2) for one in gates)
    assert len(set(lanes)) == len(gates) > 1
    for one in people:
        assert min(abs(float(one.middle(0.5)[0]) - lane) for lane in lanes) < 0.3


@pytest.mark.parametrize("does", ["hops", "flies", "sits", "walks"])
def test_an_animal_stays_in_its_cage(does) -> None:
    scene = stage(f"a parrot {does} in a cage")
    (cage,), (bird,) = named(scene, "cage"), named(scene, "parrot")
    low, high = part_boxes(cage, 0.0).hull
    middles = np.array([bird.middle(float(t)) for t in TIMES])
    assert np.all(middles > low)
    assert np.all(middles < high)
    assert not [one for one in scene.not_shown if "in the cage" in one]


def test_a_board_that_moves_shows_its_front() -> None:
    (board,) = named(stage("a checkerboard moving left to right"), "checkerboard")
    states = [board.trajectory.at(float(t)) for t in TIMES]
    assert [one.yaw for one in states] == pytest.approx([-0.5 * math.pi] * len(TIMES))
    assert states[-1].position[0] > states[0].position[0] + 0.2


def test_things_that_one_works_on_lie_side_by_side_on_the_table() -> None:
    scene = stage("a man slices three tomatoes")
    tomatoes = named(scene, "tomato")
    heights = [float(one.middle(0.0)[2]) for one in tomatoes]
    assert len(tomatoes) == 3
    assert min(heights) > 0.6
    apart = np.linalg.norm(tomatoes[0].middle(0.0) - tomatoes[1].middle(0.0))
    assert apart > 0.8 * tomatoes[0].model.width


def test_who_climbs_has_no_table_in_the_way() -> None:
    man = named(stage("a man is climbing a ladder to pick apples from a tree"), "man")[0]
    assert not any(prop.furniture for prop in man.props)


def test_what_passes_behind_a_bush_is_not_under_it() -> None:
    scene = stage("a rabbit hops across a garden and under a bush")
    (rabbit,), (bush,) = named(scene, "rabbit"), named(scene, "bush")
    low, high = bush.corners(0.0).min(axis=0)[:2], bush.corners(0.0).max(axis=0)[:2]
    places = np.array([rabbit.middle(float(t))[:2] for t in np.linspace(0.0, 1.0, 25)])
    is_inside = bool(np.any(np.all((low < places) & (places < high), axis=1)))
    assert is_inside == ("under the bush" not in scene.not_shown)

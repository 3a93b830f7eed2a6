"""Things that touch or hide each other: on, in, behind, between, on a seat; both in the picture."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.models.people.daily import SEAT
from texvent.scenes.raycast.ground_truth import ground_truth
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)
CLIP_S = 1.0


def stage(prompt: str, seed: int = 0) -> ComposedScene:
    return compose_scene(parse_prompt(prompt), seed=seed, size=SIZE, duration_s=CLIP_S)


def named(scene: ComposedScene, noun: str) -> Actor:
    return next(actor for actor in scene.actors if actor.noun.name == noun)


def span(actor: Actor, time_s: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    corners = actor.corners(time_s)
    return corners.min(axis=0), corners.max(axis=0)


@pytest.mark.parametrize("seed", [0, 1, 2])
@pytest.mark.parametrize(
    ("prompt", "noun"),
    [("a cat behind a sofa", "cat"), ("a boy behind a truck", "child"),
     ("a dog behind a fence", "dog"), ("a fox behind a bush", "fox"),
     ("a man behind a table", "man"), ("a pig behind a barn", "pig")],
)  # fmt: skip
def test_what_is_behind_something_is_seen_past_its_edge(prompt: str, noun: str, seed: int) -> None:
    scene = stage(prompt, seed)
    behind, before = scene.actors
    assert behind.middle(0.5)[1] > before.middle(0.5)[1]
    shares = []
    for time_s in (0.0, 0.5, 1.0):
        boxes = {box.instance: box for box in ground_truth(scene, time_s, time_s, SIZE).boxes}
        shares.append(boxes[behind.instance].visibility if behind.instance in boxes else 0.0)
        assert before.instance in boxes
    assert behind.noun.name == noun
    assert sorted(shares)[1] >= 0.3


def test_what_is_behind_them_is_said_of_the_thing_before() -> None:
    description = parse_prompt("three zebras with a giraffe behind them")
    found = {(one.kind, one.subject, one.targets) for one in description.relations}
    assert ("behind", 1, (0,)) in found
    scene = stage("three zebras with a giraffe behind them")
    zebras = [actor for actor in scene.actors if actor.noun.name == "zebra"]
    assert all(named(scene, "giraffe").middle(0.5)[1] > one.middle(0.5)[1] for one in zebras)


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [("a lamp between two armchairs", "lamp"), ("a rooster between two hay bales", "rooster")],
)
def test_between_two_of_a_kind_is_in_their_midst(prompt: str, noun: str) -> None:
    scene = stage(prompt)
    middle, (left, right) = named(scene, noun), scene.actors[1:]
    assert span(left)[1][0] < span(middle)[0][0]
    assert span(middle)[1][0] < span(right)[0][0]
    low, high = (min(one.middle(0.5)[1] for one in (left, right)),
                 max(one.middle(0.5)[1] for one in (left, right)))  # fmt: skip
    assert low - 0.1 <= middle.middle(0.5)[1] <= high + 0.1


def test_a_child_on_a_swing_sits_on_the_board_and_goes_with_it() -> None:
    scene = stage("kid on a swing")
    child, swing = scene.actors
    scale = child.model.height / 1.75
    places = []
    for time_s in np.linspace(0.0, 1.0, 9):
        parts = swing.place(float(time_s)).parts
        board = swing.trajectory.at(0.0).to_world() @ np.vstack(
            [parts[-1].to_body, [0.0, 0.0, 0.0, 1.0]]
        )
        seat = child.trajectory.at(float(time_s)).to_world() @ [0.0, 0.0, SEAT * scale, 1.0]
        places.append(board[:, 3])
        assert np.linalg.norm(seat - board[:, 3]) < 0.12
    assert np.linalg.norm(np.ptp(places, axis=0)) > 0.5


@pytest.mark.parametrize("doing", ["reading a book", "drinking", "", "watching TV"])
def test_people_on_a_sofa_sit_whatever_they_do(doing: str) -> None:
    scene = stage(f"a woman on a sofa {doing}".strip())
    woman = named(scene, "woman")
    assert woman.trajectory.at(0.5).activity.startswith("sit")
    hips = woman.anchor("torso", 0.5)[2, 3]
    top = span(woman, 0.5)[1][2]
    assert top < 1.5
    assert 0.3 < hips < 0.7


def test_who_stands_on_a_chair_as_the_prompt_says_stands() -> None:
    woman = named(stage("a woman stands on a chair"), "woman")
    assert span(woman)[1][2] > 1.75


@pytest.mark.parametrize(
    "prompt", ["an elephant beside a baby", "a moth flying around a lamp", "a cat under a truck"]
)
def test_both_things_of_a_relation_are_in_the_picture(prompt: str) -> None:
    scene = stage(prompt)
    seen = [
        {box.instance for box in ground_truth(scene, time_s, time_s, SIZE).boxes}
        for time_s in np.linspace(0.0, CLIP_S, 5)
    ]
    for actor in scene.actors:
        assert sum(actor.instance in one for one in seen) >= 4


def test_what_only_has_a_place_stays_there() -> None:
    scene = stage("a dog beside a tree")
    start, end = (named(scene, "dog").middle(time_s) for time_s in (0.0, CLIP_S))
    assert math.dist(start, end) == pytest.approx(0.0)


def test_nothing_but_the_hand_stands_in_the_picture() -> None:
    scene = stage("hand waving left to right")
    assert [actor.noun.name for actor in scene.actors] == ["hand"]
    assert len(scene.still.to_world) == 0


@pytest.mark.parametrize("prompt", ["a goldfish in a bowl", "a dog in a basket"])
def test_an_animal_fits_into_what_it_is_in(prompt: str) -> None:
    inside, around = stage(prompt).actors
    length = max(inside.model.length, inside.model.width)
    assert length <= 0.801 * max(around.model.length, around.model.width)
    assert np.allclose(inside.middle(0.5)[:2], around.middle(0.5)[:2], atol=0.45 * length)

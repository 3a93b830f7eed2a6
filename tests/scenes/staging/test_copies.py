"""Copies stand at each other's side, and things are in what is open and has no second dish."""

from __future__ import annotations

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.shapes import bounds
from texvent.scenes.models.wrapped.hollow import HollowModel
from texvent.scenes.models.wrapped.served import OWN_DISH, ServedModel
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.body_boxes import gap, part_boxes
from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(128, 96)
REST = Pose(0.0, 0.0, 0.0, "stand")


def staged(prompt: str, noun: str) -> list[Actor]:
    scene = compose_scene(parse_prompt(prompt), seed=1, size=SIZE, duration_s=2.0)
    return [actor for actor in scene.actors if actor.noun.name == noun]


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("three women standing together", "woman"),
        ("two cows standing next to each other", "cow"),
        ("two boys walk side by side", "child"),
    ],
)
def test_copies_that_are_together_are_near_each_other(prompt: str, noun: str) -> None:
    boxes = [part_boxes(one, 1.0) for one in staged(prompt, noun)]
    for own in boxes:
        low, high = own.hull
        nearest = min(gap(own, other) for other in boxes if other is not own)
        assert nearest < 0.5 * float(np.max((high - low)[:2]))


def test_two_who_stand_around_someone_leave_the_view_of_him_free() -> None:
    prompt = "two women stand around a man"
    (man,) = staged(prompt, "man")
    for woman in staged(prompt, "woman"):
        aside, nearer = (woman.middle(0.0) - man.middle(0.0))[:2]
        assert abs(aside) > abs(nearer)


@pytest.mark.parametrize("noun", sorted(OWN_DISH))
def test_food_alone_stands_on_its_foot_and_is_smaller_than_with_its_dish(noun: str) -> None:
    whole = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    low, high = bounds(ServedModel(whole, noun).parts(REST))
    assert low[2] == pytest.approx(0.0, abs=1e-6)
    assert high[2] < whole.height
    assert len(ServedModel(whole, noun).parts(REST)) == len(whole.parts(REST)) - OWN_DISH[noun]


def test_food_on_a_plate_brings_no_dish_and_food_alone_does() -> None:
    assert isinstance(staged("a plate of spaghetti", "noodles")[0].model, ServedModel)
    assert not isinstance(staged("spaghetti on a table", "noodles")[0].model, ServedModel)


def test_what_is_in_a_box_is_between_its_walls_and_what_is_on_it_stands_on_its_lid() -> None:
    prompt = "a rabbit in a box"
    (box,), (rabbit,) = staged(prompt, "box"), staged(prompt, "rabbit")
    assert isinstance(box.model, HollowModel)
    assert part_boxes(rabbit, 0.0).hull[0][2] < part_boxes(box, 0.0).hull[1][2] - 0.05
    assert not isinstance(staged("a rabbit on a box", "box")[0].model, HollowModel)

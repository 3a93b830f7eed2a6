"""Food lies on its dish: inside the rim, side by side, as large as there is room for."""

from __future__ import annotations

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.compose import compose_scene
from texvent.scenes.staging.placement.tables.plating import dish_up
from texvent.sensor import SensorSize

SIZE = SensorSize(128, 96)


def staged(prompt: str) -> dict[str, list[Actor]]:
    scene = compose_scene(parse_prompt(prompt), seed=1, size=SIZE, duration_s=1.0)
    found: dict[str, list[Actor]] = {}
    for actor in scene.actors:
        found.setdefault(actor.noun.name, []).append(actor)
    return found


@pytest.mark.parametrize(
    ("prompt", "dish"),
    [
        ("a plate with a waffle, some strawberries and a fried egg", "plate"),
        ("a bowl of apples", "bowl"),
        ("two hot dogs on a tray", "tray"),
        ("a pizza on a frying pan", "frying pan"),
        ("a plate of meat and vegetables and rice", "plate"),
    ],
)
def test_food_lies_within_the_rim_of_its_dish(prompt: str, dish: str) -> None:
    found = staged(prompt)
    (plate,) = found.pop(dish)
    middle = plate.middle(0.0)
    radius = 0.5 * min(plate.model.length, plate.model.width)
    for actor in (one for group in found.values() for one in group):
        spot = actor.middle(0.0)
        assert np.hypot(*(spot - middle)[:2]) < radius
        assert spot[2] > middle[2] - 0.5 * plate.model.height
        assert max(actor.model.length, actor.model.width) > 0.35 * radius


def test_all_food_of_a_dish_lies_on_it() -> None:
    said = dish_up(parse_prompt("a dish with meat and vegetables"), NOUNS)
    on = {one.subject for one in said.relations if one.kind == "on"}
    assert on == {i for i, one in enumerate(said.objects) if one.noun != "plate"}


def test_candles_stand_on_the_cake() -> None:
    found = staged("a cake with candles")
    (cake,) = found["cake"]
    top = cake.corners(0.0)[:, 2].max()
    for candle in found["candle"]:
        assert np.hypot(*(candle.middle(0.0) - cake.middle(0.0))[:2]) < 0.5 * cake.model.width
        assert candle.corners(0.0)[:, 2].min() > 0.3 * top
        assert candle.model.height < cake.model.height


def test_a_mass_of_food_is_one_heap() -> None:
    for words in ("rice", "vegetables", "some fruit", "food"):
        (heap,) = parse_prompt(f"a plate with {words}").objects[1:]
        assert heap.count == 1


def test_two_things_that_are_side_by_side_stay_so() -> None:
    said = parse_prompt("an apple to the left of a bowl")
    assert dish_up(said, NOUNS).relations == said.relations

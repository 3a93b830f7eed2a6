"""Places of a prompt are known by what must come into view: trees, water, a road, furniture."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.generate.landmarks import ROAD, SKY, WATER, is_marked, list_landmarks
from texvent.scenes.description import SceneDescription, Surroundings
from texvent.scenes.report import Substitution
from texvent.scenes.staging.surroundings.environment import build_environment
from texvent.scenes.staging.surroundings.road import RoadLine


def landmarks(place: str, *shown: str, **said) -> dict[str, frozenset[str]]:
    description = SceneDescription("", surroundings=Surroundings(place, **said), shown=shown)
    return dict(list_landmarks(description))


def test_a_place_that_is_said_has_landmarks():
    assert landmarks("river", "dog", "river") == {"river": {WATER}}
    assert landmarks("dirt road", "trails") == {"trails": {ROAD}}
    assert "pine" in landmarks("forest", "pine forest")["pine forest"]
    assert "oven" in landmarks("kitchen", "kitchen")["kitchen"]
    assert landmarks("road", "forest", backdrops=("forest",)).keys() == {"forest"}
    assert landmarks("mountain", "valley", "slopes").keys() == {"valley", "slopes"}


def test_a_place_that_is_not_said_or_has_nothing_of_its_own_has_none():
    assert landmarks("river", "dog") == {}
    assert landmarks("grass", "lawn") == {}
    assert landmarks("city", "street") == {}
    assert landmarks("kitchen", "kitchen", is_empty=True) == {}


def test_a_place_that_is_shown_as_another_one_is_named_as_it_was_said():
    description = SceneDescription(
        "", surroundings=Surroundings("kitchen"),
        substituted=(Substitution("bakery", "kitchen"), Substitution("wok", "frying pan")),
    )  # fmt: skip
    assert [one.word for one in list_landmarks(description)] == ["bakery"]


def test_words_of_the_sky_need_the_sky():
    assert landmarks("grass", "stars") == {"stars": {SKY}}
    assert landmarks("grass", clouds=0.8) == {"sky": {SKY}}
    assert landmarks("grass", "clouds") == {}  # "no clouds" shows the word too


@pytest.mark.parametrize(
    ("place", "mark", "expected"),
    [
        # Along x through (0, 10); a river reaches 4.5 m to each side, a lake lies on the left.
        ("river", WATER, [False, True, True, False]),
        ("lake", WATER, [False, False, True, True]),
        ("road", ROAD, [False, True, True, False]),
        ("sea", WATER, [True, True, True, True]),
        ("grass", "", [False, False, False, False]),
    ],
)
def test_points_of_the_ground_are_water_or_road(place, mark, expected):
    environment = build_environment(
        SceneDescription(""), place=place, road=RoadLine(0.0, (0.0, 10.0)),
        distance_m=10.0, room_m=9.0,
    ).at(0.0)  # fmt: skip
    spots = np.array([[3.0, 0.0], [3.0, 8.0], [3.0, 12.0], [3.0, 20.0]])
    found, where = is_marked(environment, spots)
    assert found == mark
    assert where.tolist() == expected

"""Who stands with whom, what a phrase belongs to, and how many of a thing are there."""

from __future__ import annotations

import pytest

from texvent.scenes.description import TOGETHER, SceneDescription
from texvent.scenes.language.parser import parse_prompt


def relations_of(description: SceneDescription) -> set[tuple[str, str, str]]:
    nouns = [one.noun for one in description.objects]
    return {(nouns[one.subject], one.kind, nouns[one.targets[0]]) for one in description.relations}


@pytest.mark.parametrize(
    "prompt",
    [
        "three girls sing together",
        "two goats standing next to each other",
        "four vans parked side by side",
    ],
)
def test_copies_that_are_together_stand_so(prompt: str) -> None:
    assert parse_prompt(prompt).objects[0].side == TOGETHER


def test_two_things_that_are_together_are_beside_each_other() -> None:
    found = parse_prompt("a goat and a horse eat together")
    assert ("horse", "beside", "goat") in relations_of(found)


def test_one_alone_is_not_together() -> None:
    assert "together" in parse_prompt("a man runs together").not_understood


@pytest.mark.parametrize(
    ("prompt", "relation"),
    [
        ("a cow surrounded by children", ("child", "around", "cow")),
        ("a nurse in a group of children", ("child", "around", "nurse")),
        ("children surrounding a cow", ("child", "around", "cow")),
        ("a cake on a table surrounded by chairs", ("chair", "around", "table")),
        ("a red van in a row of vans", ("van", "beside", "van")),
        ("one goat follows another", ("goat", "follow", "goat")),
        ("a woman gazing past a vase on top of a shelf", ("vase", "on", "shelf")),
        ("a girl with a donut on a plate", ("donut", "on", "plate")),
        ("two girls stand around a boy with an umbrella", ("child", "hold", "umbrella")),
        ("a gull on the back of a cow", ("gull", "on", "cow")),
        ("a cat on the roof of a car", ("cat", "on", "car")),
        ("a desk filled with laptops", ("laptop", "on", "desk")),
        ("a man with a cup on a table", ("cup", "on", "table")),
    ],
)
def test_who_is_where(prompt: str, relation: tuple[str, str, str]) -> None:
    assert relation in relations_of(parse_prompt(prompt))


@pytest.mark.parametrize(
    ("prompt", "noun", "count"),
    [
        ("a boy holds skis", "ski", 1),
        ("a cows tail beside a gate", "cow", 1),
        ("one goat follows another", "goat", 1),
        ("a bottle of champagne", "bottle", 1),
        ("a plate with broccoli", "broccoli", 1),
        ("a crate filled with lemons", "lemon", 4),
    ],
)
def test_how_many_there_are(prompt: str, noun: str, count: int) -> None:
    found = [one.count for one in parse_prompt(prompt).objects if one.noun == noun]
    assert set(found) == {count}


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("a shelf set up as a bar table", "table"),
        ("a girl dressed as a queen", "queen"),
        ("a cart used as a bench", "bench"),
    ],
)
def test_what_something_is_like_is_no_second_thing(prompt: str, noun: str) -> None:
    found = parse_prompt(prompt)
    assert noun not in {one.noun for one in found.objects}
    assert any(noun in one for one in found.not_understood)


def test_who_has_a_telephone_at_the_ear_talks_on_it() -> None:
    (man,) = parse_prompt("a man holding a phone up to his ear").objects
    assert man.motion is not None
    assert man.motion.kind == "phone"


def test_a_crowd_of_birds_holds_no_people() -> None:
    found = parse_prompt("a goose of people")
    assert not found.relations
    assert "of" in found.not_understood


@pytest.mark.parametrize(
    ("prompt", "word"),
    [
        ("a woman stands on a railroad track", "on"),
        ("a clock on top of a church", "top"),
        ("a dog in the fruit", "in"),
    ],
)
def test_where_something_is_not_is_reported(prompt: str, word: str) -> None:
    assert word in parse_prompt(prompt).not_understood


def test_who_stands_with_another_does_so_too() -> None:
    one, other = parse_prompt("a woman stands with another woman").objects
    assert one.motion == other.motion


def test_what_lies_on_a_table_is_not_held() -> None:
    kinds = {one.kind for one in parse_prompt("a man with a cup on a table").relations}
    assert "hold" not in kinds

"""Prompts in the style of a telegram: no verb, no article, no one who does it."""

from __future__ import annotations

import pytest

from texvent.errors import InputError
from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "noun", "kind"),
    [
        ("dog jump", "dog", "jump"),
        ("rocket launch", "rocket", "rise"),
        ("drone flip", "drone", "flip"),
        ("coin flip", "coin", "flip"),
        ("drone takeoff", "drone", "rise"),
        ("lane change", "car", "change lane"),
        ("a truck lane change", "truck", "change lane"),
        ("u-turn", "car", "turn"),
        ("parking", "car", "park"),
        ("motorcycle wheelie", "motorcycle", "wheelie"),
        ("guitar playing", "person", "play guitar"),
        ("carpet cleaning", "person", "clean"),
        ("hand waving", "hand", "wave"),
        ("fencing", "person", "fence"),
        ("archery", "person", "archery"),
        ("apple fall", "apple", "fall"),
        ("dice roll, close up", "dice", "roll"),
        ("head nodding", "person", "nod"),
        ("chopping onions", "person", "chop"),
        ("kneading dough", "person", "knead"),
        ("spinning tops", "spinning top", None),
        ("glass shattering", "glass", None),
    ],
)
def test_who_does_what_in_a_telegram(prompt: str, noun: str, kind: str | None) -> None:
    first = parse_prompt(prompt).objects[0]
    assert first.noun == noun
    if kind is not None:
        assert first.motion is not None
        assert first.motion.kind == kind


@pytest.mark.parametrize("prompt", ["car crash", "overtaking", "rear-end collision", "tug of war"])
def test_what_one_alone_cannot_do_is_done_by_two(prompt: str) -> None:
    description = parse_prompt(prompt)
    assert sum(one.count for one in description.objects) == 2
    assert not description.not_understood


@pytest.mark.parametrize(
    ("prompt", "kind"),
    [
        ("a car makes a quick u-turn", "turn"),
        ("a car performs a lane change", "change lane"),
        ("a car parks", "park"),
        ("a parked car", "stand"),
    ],
)
def test_a_noun_after_does_or_makes_says_what_is_done(prompt: str, kind: str) -> None:
    motion = parse_prompt(prompt).objects[0].motion
    assert motion is not None
    assert motion.kind == kind


@pytest.mark.parametrize("prompt", ["javelin throw", "throwing javelin", "throwing a javelin"])
def test_what_is_done_to_a_thing_needs_someone_who_does_it(prompt: str) -> None:
    description = parse_prompt(prompt)
    assert [one.noun for one in description.objects] == ["person", "spear"]
    assert [one.kind for one in description.relations] == ["throw"]
    assert any("no one is named" in note for note in description.notes)


def test_a_part_of_the_body_that_acts_is_a_person() -> None:
    description = parse_prompt("head nodding")
    assert [str(one) for one in description.substituted] == ["head → person"]


@pytest.mark.parametrize("prompt", ["trampoline jump", "tunnel move"])
def test_what_is_fixed_and_what_is_vague_is_no_act(prompt: str) -> None:
    with pytest.raises(InputError, match="nothing in the prompt was understood"):
        parse_prompt(prompt)


def test_sentences_are_read_as_before() -> None:
    assert parse_prompt("a dog makes a big jump").objects[0].noun == "dog"
    assert "jump" in parse_prompt("a dog makes a jump").not_understood


@pytest.mark.parametrize(
    ("prompt", "kind"),
    [
        ("table tennis rally", "swing racket"),
        ("a golf swing", "swing club"),
        ("badminton", "swing racket"),
    ],
)
def test_a_game_that_is_named_is_shown_by_one_person_and_reported_so(
    prompt: str, kind: str
) -> None:
    description = parse_prompt(prompt)
    assert [one.motion.kind for one in description.objects if one.motion is not None] == [kind]
    assert all(one.shown == f"one person, {kind}" for one in description.substituted)
    assert " ".join(one.said for one in description.substituted) == prompt.removeprefix("a ")


def test_an_activity_alone_is_a_person_who_does_it() -> None:
    assert parse_prompt("squat").objects[0].noun == "person"

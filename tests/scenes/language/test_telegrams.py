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
        ("horse slow walk", "horse", "walk"),
        ("figure skater fast spin", "ice skater", "spin"),
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
        ("a dog makes a jump", "jump"),
        ("an ice skater does a fast spin", "spin"),
        ("a car takes a sharp turn", "turn"),
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
    assert "fuss" in parse_prompt("a dog makes a fuss").not_understood


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


@pytest.mark.parametrize(
    ("prompt", "place", "means"),
    [
        ("night driving", "road", "drive"),
        ("highway driving in rain", "motorway", "drive"),
        ("forest walking", "forest", "walk"),
        ("tunnel driving at night", "road tunnel", "drive"),
    ],
)
def test_who_goes_through_a_place_is_the_camera(prompt: str, place: str, means: str) -> None:
    description = parse_prompt(prompt)
    (move,) = description.shot.moves
    assert (move.kind, move.means) == ("travel", means)
    assert (description.surroundings.place, description.objects) == (place, ())


def test_a_place_drifts_before_a_camera_that_pans() -> None:
    description = parse_prompt("star field drifting slowly")
    (move,) = description.shot.moves
    assert (move.kind, move.pace < 1.0) == ("pan", True)
    assert not description.not_understood


def test_a_rate_at_the_end_is_that_of_the_thing_before_it() -> None:
    (led,) = parse_prompt("blinking LED 200 Hz").objects
    assert led.blink_hz == 200.0
    assert parse_prompt("an LED blinks at 5 kHz").objects[0].blink_hz == 5000.0


def test_headlights_are_those_of_a_car() -> None:
    description = parse_prompt("oncoming headlights at night")
    (car,) = description.objects
    assert car.motion is not None
    assert (car.noun, car.motion.direction) == ("car", "towards")
    assert [str(one) for one in description.substituted] == ["headlights → car"]
    assert [one.noun for one in parse_prompt("the headlights of a truck").objects] == ["truck"]


def test_a_time_lapse_is_of_what_stands_before_it() -> None:
    description = parse_prompt("city skyline timelapse")
    assert (description.surroundings.place, description.is_timelapse) == ("city", True)


@pytest.mark.parametrize(
    ("prompt", "noun", "kind"),
    [("falling dominoes", "domino row", "collapse"), ("rolling dice", "dice", "roll"),
     ("3D printer printing", "filament printer", "work"), ("jet flyover", "airplane", "fly")],
)  # fmt: skip
def test_a_participle_first_or_last_is_what_the_thing_does(prompt, noun, kind) -> None:
    (only,) = parse_prompt(prompt).objects
    assert only.motion is not None
    assert (only.noun, only.motion.kind) == (noun, kind)

"""Parts are shown with the things that they are parts of."""

from __future__ import annotations

import pytest

from texvent.errors import InputError
from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "noun", "motion", "part", "lost"),
    [
        ("fan blades spinning", "fan", "work", "blades", ()),
        ("the hands of a clock turn", "clock", "work", "hands", ()),
        ("the door of a fridge opens", "refrigerator", "open", "door", ()),
        ("washing machine drum spins", "washing machine", "work", "drum", ()),
        ("helicopter blades spinning", "helicopter", "stand", "blades", ()),
        ("a cat's tail twitches", "cat", "walk", "tail", ("twitches",)),
        ("a woman's hair blows", "woman", "walk", "hair", ("blows",)),
        ("a printer head moves", "printer", "stand", "head", ("moves",)),
    ],
)
def test_a_part_is_shown_with_the_whole_that_moves_only_by_it(
    prompt: str, noun: str, motion: str, part: str, lost: tuple[str, ...]
) -> None:
    description = parse_prompt(prompt)
    (only,) = description.objects
    assert (only.noun, only.count) == (noun, 1)
    assert only.motion is not None
    assert only.motion.kind == motion
    assert [(one.said, one.shown) for one in description.report().substituted] == [(part, noun)]
    assert description.not_understood == lost


def test_what_is_done_to_a_part_is_done_to_the_whole() -> None:
    description = parse_prompt("a dog bumps into a chair leg")
    assert [one.noun for one in description.objects] == ["dog", "chair"]


@pytest.mark.parametrize(
    ("prompt", "noun"), [("a car wheel rolls", "wheel"), ("a man's cap", "cap")]
)
def test_what_is_a_thing_by_itself_is_shown_so(prompt: str, noun: str) -> None:
    assert noun in {one.noun for one in parse_prompt(prompt).objects}


def test_a_noun_of_what_happens_leaves_the_thing_before_it() -> None:
    description = parse_prompt("fireworks finale")
    assert [one.noun for one in description.objects] == ["firework"]
    assert description.not_understood == ("finale",)
    assert parse_prompt("office corridor walkthrough").surroundings.place == "corridor"
    with pytest.raises(InputError, match="nothing in the prompt"):
        parse_prompt("snail mail")


@pytest.mark.parametrize(
    ("prompt", "noun", "kind"),
    [
        ("a woman's hands knead dough", "woman", "knead"),
        ("a man's hand waves", "man", "wave"),
        ("a man's head nods", "man", "nod"),
    ],
)
def test_who_has_the_hands_does_it(prompt: str, noun: str, kind: str) -> None:
    first = parse_prompt(prompt).objects[0]
    assert first.motion is not None
    assert (first.noun, first.motion.kind) == (noun, kind)


@pytest.mark.parametrize("prompt", ["a car's wheel spins", "the propeller of a ship spins"])
def test_a_part_that_is_a_thing_moves_alone_and_its_owner_is_reported(prompt: str) -> None:
    description = parse_prompt(prompt)
    (only,) = description.objects
    assert only.noun in ("wheel", "propeller")
    assert only.motion is not None
    assert only.motion.kind in ("spin", "work")
    assert set(description.not_understood) & {"car", "ship"}


def test_blades_have_the_rate_of_the_fan_and_a_dot_is_on_its_disc() -> None:
    (fan,) = parse_prompt("a fan with four blades spinning at 10 Hz").objects
    assert fan.motion is not None
    assert (fan.noun, fan.motion.kind) == ("fan", "work")
    assert fan.motion.pace == pytest.approx(10.0 / 3.37, rel=0.01)
    assert [one.noun for one in parse_prompt("a disc with a black dot rotates").objects] == [
        "dotted disc"
    ]


def test_weights_are_one_barbell() -> None:
    assert [(one.noun, one.count) for one in parse_prompt("a man lifts weights").objects] == [
        ("man", 1), ("barbell", 1)
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("prompt", "first"),
    [
        ("A man with a sack walking on a beach", "1 man, walks, holding 1 sack"),
        (
            "a woman in a coat sitting on a bench",
            "1 woman, sits, wearing 1 coat, on 1 bench",
        ),
        ("A boat with dolphins jumping", "1 boat, sails, with 3 dolphins"),
        ("A woman in a costume who is clapping", "1 woman, claps, wearing 1 dress"),
    ],
)
def test_who_has_a_thing_does_what_the_thing_cannot(prompt: str, first: str) -> None:
    assert parse_prompt(prompt).summary()[0] == first


@pytest.mark.parametrize(
    ("prompt", "line"),
    [
        ("a man looks through a book on a table", "1 book, stands still, on 1 table"),
        ("a girl holds a cup with rice in bowls", "1 rice, stands still, in 3 bowls"),
        ("a bowl with rice and carrots on a table", "1 bowl, stands still, on 1 table"),
        ("a laptop with a keyboard and a mouse on a table", "1 keyboard, stands still, on 1 table"),
        ("a kitchen with a sink and a table in it", "1 table, stands still"),
    ],
)
def test_things_are_where_things_go(prompt: str, line: str) -> None:
    assert line in parse_prompt(prompt).summary()


def test_what_is_near_a_place_that_is_all_around_is_reported() -> None:
    assert "near" in parse_prompt("two men walk near a garden").not_understood
    assert parse_prompt("a house by a lake").not_understood == ()


@pytest.mark.parametrize(
    ("prompt", "line"),
    [
        ("a plate with a fork and a knife next to it", "1 fork, stands still, beside 1 plate"),
        (
            "a girl in a jacket and boots with an umbrella",
            "1 girl, stands still, wearing 1 jacket and 2 boots, holding 1 umbrella",
        ),
        ("a man in a hat with a feather", "1 man, stands still, wearing 1 hat"),
        ("people waiting and flying kites", "3 people, stand still, holding 3 kites"),
        (
            "a dog runs after a car",
            "1 dog, runs at 1.2 times its usual speed, following 1 car",
        ),
    ],
)
def test_with_and_after_belong_to_who_has_and_who_chases(prompt: str, line: str) -> None:
    assert line in parse_prompt(prompt).summary()


def test_what_has_been_is_reported() -> None:
    found = parse_prompt("two men after a football game")
    assert found.not_understood == ("after", "football", "game")
    assert len(found.objects) == 1
    assert parse_prompt("a dog runs and stops after two seconds").not_understood == ()

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

"""What a prompt leaves out: where drops come from, and what people known by their work do."""

from __future__ import annotations

import pytest

from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "noun", "effect"),
    [
        ("water dripping", "faucet", "drip"),
        ("welding sparks", "angle grinder", "sparks"),
        ("popping popcorn", "frying pan", "popcorn"),
    ],
)
def test_drops_and_sparks_come_from_something_that_is_noted(prompt, noun, effect) -> None:
    description = parse_prompt(prompt)
    assert [one.noun for one in description.objects] == [noun]
    assert [(one.kind, one.source) for one in description.effects] == [(effect, 0)]
    assert f"no source of the {effect} is said: the {noun} is chosen" in description.notes
    assert not description.not_understood


def test_a_source_or_a_place_that_is_said_stays() -> None:
    assert [one.noun for one in parse_prompt("water drips from a pipe").objects] == ["pipe"]
    assert not parse_prompt("water drops falling into a pond").objects


@pytest.mark.parametrize(
    ("prompt", "kind", "place"),
    [
        ("a boxer", "box", "boxing hall"),
        ("a tennis player", "swing racket", "tennis court"),
        ("a blacksmith", "forge", "workshop"),
        ("a conductor", "conduct", "stage"),
        ("a gymnast", "cartwheel", "gym"),
        ("a pianist", "play piano", "indoor"),
        ("a surfer on a wave", "surf", "sea"),
    ],
)
def test_who_is_known_by_what_they_do_does_it_where_it_is_done(prompt, kind, place) -> None:
    description = parse_prompt(prompt)
    (only,) = description.objects
    assert only.motion is not None
    assert (only.motion.kind, description.surroundings.place) == (kind, place)


@pytest.mark.parametrize("prompt", ["a boxer walks left", "a dog runs past a boxer"])
def test_they_do_what_is_said_and_nothing_beside_what_moves(prompt) -> None:
    description = parse_prompt(prompt)
    boxer = next(one for one in description.objects if one.noun == "boxer")
    assert boxer.motion is not None
    assert boxer.motion.kind in ("walk", "stand")


@pytest.mark.parametrize(
    ("prompt", "ball"),
    [
        ("a tennis player hits a ball", "tennis ball"),
        ("a basketball player throws the ball", "basketball"),
        ("a boy kicks a ball", "ball"),
    ],
)
def test_a_ball_is_that_of_the_game(prompt, ball) -> None:
    assert parse_prompt(prompt).objects[1].noun == ball

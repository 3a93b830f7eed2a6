"""Acts that are told in full, or reported: "walks off", "about to fall", "is poured into"."""

from __future__ import annotations

import pytest

from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "first", "lost"),
    [
        ("a man walks off", "1 man, walks away", ()),
        ("a ball rolls off a table", "1 ball, rolls, from 1 table", ()),
        ("a vase is about to fall", "1 vase, stands still", ("fall",)),
        ("a waiter walks from one table to another", "1 waiter, walks, from 1 table", ("another",)),
        ("a cyclist falls", "1 bicycle, stands still, then falls", ()),
        ("a seagull takes off from the beach", "1 gull, rises", ()),
        ("a bus slows to a stop", "1 bus, drives at 1.8 times its usual speed", ()),
        ("a dog races", "1 dog, runs at 1.6 times its usual speed", ()),
        ("a girl bounces on a bed", "1 girl, jumps, on 1 bed", ()),
        ("dough kneaded by a baker", "1 baker, kneads, working on 1 dough", ()),
        ("milk is poured into a cup", "1 person, pours, working on 1 cup", ()),
        ("a forklift lifts a pallet", "1 forklift, does 'lift load', with 1 pallet", ()),
        ("a man moves a chair", "1 man, walks, pushing 1 chair", ()),
        ("a crane moves a chair", "1 crane, moves in place, far away", ("moves",)),
        ("two friends play rock paper scissors", "2 people, do 'show fists'", ()),
        ("a woman cuts a man's hair", "1 woman, stands still", ("cuts", "hair")),
        ("a boy climbs over a wall", "1 child, climbs, working on 1 wall", ("over",)),
    ],
)  # fmt: skip
def test_an_act_is_told_or_reported(prompt: str, first: str, lost: tuple[str, ...]) -> None:
    description = parse_prompt(prompt)
    assert first in description.summary()
    assert description.not_understood == lost

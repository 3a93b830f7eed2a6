"""Rates that a prompt states in words."""

from __future__ import annotations

from dataclasses import replace

import pytest

from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "plain"),
    [
        ("a lamp blinks 10 times per second", "a lamp blinks at 10 Hz"),
        ("a lamp blinks twice a second", "a lamp blinks at 2 Hz"),
        ("a lamp blinks 30 times a minute", "a lamp blinks at 0.5 Hz"),
        ("an LED blinking every 100 ms", "an LED blinking at 10 Hz"),
        ("an LED blinks every two seconds", "an LED blinks at 0.5 Hz"),
        ("a lamp flickers with a period of 20 ms", "a lamp flickers at 50 Hz"),
        ("a fan spins 20 times per second", "a fan spins at 20 Hz"),
        ("a fan spins at exactly 20 Hz", "a fan spins at 20 Hz"),
        ("a fan spinning at a rate of 20 Hz", "a fan spinning at 20 Hz"),
        ("a strobe light at a frequency of 30 Hz", "a strobe light at 30 Hz"),
        ("a checkerboard moves up and down 3 times every second",
         "a checkerboard moves up and down at 3 Hz"),
        ("a car drives at a constant 50 km/h", "a car drives at 50 km/h"),
    ],
)  # fmt: skip
def test_rates_in_words_are_those_in_hertz(prompt: str, plain: str) -> None:
    description = parse_prompt(prompt)
    assert description.not_understood == ()
    named = {"prompt": "", "shown": (), "substituted": (), "claims": ()}
    assert replace(description, **named) == replace(parse_prompt(plain), **named)


def test_a_rate_is_reported_as_the_prompt_has_it() -> None:
    assert "10 times per second" in parse_prompt("a lamp blinks 10 times per second").shown
    assert parse_prompt("a man claps twice a second").not_understood == ("twice a second",)


@pytest.mark.parametrize(
    ("prompt", "lost"),
    [
        ("every second car is red", "second"),
        ("a man jumps three times", "times"),
        ("a lamp blinks at 5 solid Hz", "solid"),
        ("a lamp blinks at 10 flashes per second", "10"),
        ("a lamp blinks 0 times per second", "0"),
        ("a lamp blinks every 0 seconds", "0"),
        ("a red panda rotates about its vertical axis at 1000000 kHz", "1000000"),
    ],
)
def test_what_is_no_rate_is_reported(prompt: str, lost: str) -> None:
    assert lost in parse_prompt(prompt).not_understood

"""Waves on water, and people who wave."""

from __future__ import annotations

import pytest

from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "place"),
    [
        ("ocean waves", "sea"),
        ("waves crash on a beach", "beach"),
        ("a rough sea", "sea"),
        ("rough sea", "sea"),
        ("a boat in the waves", "sea"),
        ("a seagull flies over the waves", "sea"),
        ("big waves roll onto the shore", "beach"),
    ],
)
def test_waves_are_on_the_water(prompt, place) -> None:
    description = parse_prompt(prompt)
    assert description.surroundings.place == place
    assert description.surroundings.wave_height > 1.0
    assert not description.not_understood
    assert "waves" in " ".join(description.summary())


@pytest.mark.parametrize("prompt", ["a man waves on a beach", "two hands wave", "a flag waves"])
def test_who_waves_is_no_water(prompt) -> None:
    description = parse_prompt(prompt)
    assert description.surroundings.wave_height == 1.0
    assert description.objects[0].motion is not None
    assert description.objects[0].motion.kind in ("wave", "work")


def test_other_things_that_are_rough_are_reported() -> None:
    assert "rough" in parse_prompt("a rough road").not_understood
    assert parse_prompt("a calm sea").surroundings.wave_height == 1.0

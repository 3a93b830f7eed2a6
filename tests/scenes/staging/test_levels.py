"""Heights above the ground at which things float, swim and fly."""

from __future__ import annotations

import pytest

from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.staging.levels import choose_levels


@pytest.mark.parametrize(
    ("prompt", "noun", "is_lifted"),
    [
        ("A diver swims beside a shark.", "scuba diver", True),
        ("A man swims underwater.", "man", True),
        ("A diver stands underwater.", "scuba diver", False),
        ("A man swims in the sea.", "man", False),
    ],
)
def test_who_swims_under_water_is_above_the_sea_bed(prompt, noun, is_lifted) -> None:
    description = parse_prompt(prompt)
    levels = choose_levels(description.surroundings.place or "", description, NOUNS)
    assert (levels.get(noun, 0.0) > 0.0) is is_lifted

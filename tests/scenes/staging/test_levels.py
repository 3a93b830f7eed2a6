"""Heights above the ground at which things float, swim and fly."""

from __future__ import annotations

import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.staging.body_boxes import part_boxes
from texvent.scenes.staging.compose import compose_scene
from texvent.scenes.staging.levels import choose_levels
from texvent.sensor import SensorSize


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


@pytest.mark.parametrize("prompt", ["three crows standing on grass", "pigeons pecking"])
def test_birds_that_rest_are_all_on_the_ground(prompt: str) -> None:
    scene = compose_scene(parse_prompt(prompt), seed=0, size=SensorSize(96, 72), duration_s=1.0)
    for actor in scene.actors:
        low = float(part_boxes(actor, 0.5).hull[0][2])
        assert abs(low) < 0.1 * actor.size_m

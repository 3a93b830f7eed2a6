"""A colour by which one of several is told apart, which the others do not have."""

from __future__ import annotations

import pytest
from tests.scenes.staged import SIZE

from texvent_scenes.colours import SURFACES
from texvent_scenes.models.materials import has_colour
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import Pose
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.staging.placement.told_apart import unlike

TOLD = " is not told apart by it"


@pytest.mark.parametrize("noun", ["runner", "person", "child", "car", "horse"])
@pytest.mark.parametrize("colour", ["yellow", "red", "white"])
def test_others_of_a_group_have_a_body_of_another_colour(noun, colour):
    rgb = SURFACES[colour]
    for seed in range(8):
        own = NOUNS[noun].build(colour=None, scale=1.0, seed=unlike(NOUNS[noun], seed, [rgb]))
        assert not has_colour(own.parts(Pose(0.0, 0.0, 0.0, "stand")), rgb, 0.1)


@pytest.mark.parametrize(
    ("prompt", "is_told"),
    [
        ("Five runners race around a track. The one in yellow starts last.", False),
        ("Six people walk on a street, only one in red", False),
        ("Four police officers stand on a street, one of them in blue", True),
        ("Five swans swim on a lake. One of them is white.", True),
        ("Five swans swim on a lake. One of them is black.", False),
    ],
)
def test_a_group_that_has_the_colour_all_the_same_is_told(prompt, is_told):
    report = ProceduralGenerator(ProceduralConfig(duration=1.0), size=SIZE).report(prompt)
    assert any(TOLD in one for one in report.notes) == is_told

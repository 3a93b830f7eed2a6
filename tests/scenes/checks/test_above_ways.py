"""Prepositions of what flies at a road or at water: it is above it, along it, or leaves it."""

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.staged import SIZE
from tests.scenes.test_short_prompts import report, staged

from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.checks.surroundings.water import is_above_way, wet_share
from texvent_scenes.description import Claim
from texvent_scenes.scene_input import list_nouns, understand


@pytest.mark.parametrize("noun", ["bird", "drone", "pigeon"])
@pytest.mark.parametrize("place", ["lake", "river"])
def test_what_takes_off_from_water_begins_above_it(noun, place):
    scene, said, _ = staged(f"a {noun} takes off from a {place}")
    assert wet_share(scene, scene.actors[0].middle(0.0)[None, :2]) == 1.0
    assert "from" in said.shown


@pytest.mark.parametrize("place", ["road", "highway", "river", "lake", "gravel road"])
def test_what_flies_over_a_way_is_above_it(place):
    for noun in ("drone", "eagle"):
        assert "over" in report(f"a {noun} flies over a {place}").shown


@pytest.mark.parametrize("place", ["river", "road", "gravel road"])
@pytest.mark.parametrize(("turn", "is_so"), [(0.0, True), (0.5 * np.pi, False), (np.pi, True)])
def test_along_is_the_way_that_has_the_direction_of_the_road_or_shore(place, turn, is_so):
    text = f"a drone flies along a {place}"
    scene, said = staged(text)[0], understand(text, list_nouns())
    plan = scene.animated_environment
    base = replace(plan.base, road_angle=plan.base.road_angle + turn)
    turned = replace(scene, animated_environment=replace(plan, base=base))
    clip = StagedClip(turned, said, SIZE, 2.0)
    assert is_above_way(clip, Claim("along", "above way", "along", 0)) == is_so

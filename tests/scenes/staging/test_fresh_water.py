"""Ponds, lakes and rivers: their beds have no corals, and animals in them swim."""

import pytest
from tests.scenes.staged import stage_text


@pytest.mark.parametrize(
    ("text", "place"),
    [("fish in a pond", "lake bed"), ("a turtle swims in a river", "lake bed"),
     ("koi swim in a lake", "lake bed"), ("a fish swims in the sea", "underwater"),
     ("a turtle swims", "underwater"), ("a fish jumps out of a lake", "lake")],
)  # fmt: skip
def test_who_dives_in_fresh_water_is_over_its_bed(text, place):
    said, scene = stage_text(text)
    assert said.place.name == place
    corals = [one for one in scene.scenery if one.rule.noun == "coral branch"]
    assert bool(corals) == (place == "underwater")


@pytest.mark.parametrize(
    ("text", "kind"),
    [("a crocodile in a river", "swim"), ("a dog and a cat in a pond", "swim"),
     ("three horses in a lake", "swim"), ("a bear stands in a river", "stand"),
     ("a frog in a pond jumps", "jump")],
)  # fmt: skip
def test_animals_in_water_that_do_nothing_else_swim(text, kind):
    assert {one.motion.kind for one in stage_text(text)[0].objects} == {kind}

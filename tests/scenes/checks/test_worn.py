"""Clothes that the picture shows, and those that it cuts off, hides or shows as a few pixels."""

from dataclasses import replace

import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, SIZE

from texvent_scenes.checks.worn import find_unworn
from texvent_scenes.description import IndexedRelation, SceneDescription
from texvent_scenes.models.people.outfit import CLOTHES
from texvent_scenes.spec.scene import Camera, Place, SceneObject
from texvent_scenes.staging.compose import compose_scene

LOW = {"shoes", "boots", "trousers"}


def unworn(clothes, **fields):
    said = SceneDescription(
        objects=(SceneObject("man"), SceneObject(clothes)),
        relations=(IndexedRelation("wear", 0, (1,)),),
        place=Place("grass", is_empty=True), **fields,
    )  # fmt: skip
    scene = compose_scene(said, seed=0, size=SIZE, duration_s=DURATION_S)
    return said, scene, [*find_unworn(scene, said, [0.2, 1.0, 1.8])]


@for_every(CLOTHES)
def test_who_stands_shows_what_he_wears(clothes):
    assert unworn(clothes)[2] == []


@for_every([name for name, row in CLOTHES.items() if {*row["painted"]} <= LOW])
def test_a_close_shot_of_a_person_cuts_off_what_is_on_the_legs(clothes):
    assert unworn(clothes, camera=Camera(framing="close"))[2] == [1]


@pytest.mark.parametrize("clothes", ["glove", "boot", "coat"])
def test_who_is_far_away_or_wears_nothing_shows_no_clothes(clothes):
    said, scene, _ = unworn(clothes)
    framing = replace(scene.camera_path.framing, distance_m=150.0)
    far = replace(scene, camera_path=replace(scene.camera_path, framing=framing))
    assert [*find_unworn(far, said, [0.5])] == [1]


@pytest.mark.parametrize(("clothes", "is_shown"), [("jacket", True), ("glove", False),
                                                   ("boot", False)])  # fmt: skip
def test_a_rider_who_is_part_of_what_he_rides_shows_a_shirt(clothes, is_shown):
    said, scene, _ = unworn(clothes)
    found = [*find_unworn(replace(scene, actors=()), said, [0.5])]
    assert found == ([] if is_shown else [1])

"""Looks, patterns and clothes of bodies: shown where the picture shows them."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, SIZE

from texvent_scenes.checks.bodies.worn import find_unworn
from texvent_scenes.description import IndexedRelation, SceneDescription
from texvent_scenes.models.materials import MATERIALS
from texvent_scenes.models.people.outfit import CLOTHES, list_props
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.shapes import bounds
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.spec.scene import Camera, CameraMove, Place, SceneObject
from texvent_scenes.staged_prompt import stage
from texvent_scenes.staging.compose import compose_scene


@cache
def report(text):
    return ProceduralGenerator(ProceduralConfig(duration=1.0), size=SIZE).report(text)


@for_every(("striped", "checkered", "spotted"))
def test_a_pattern_has_two_colours_far_apart_in_any_colour(name):
    for colour in ("white", "black", "yellow"):
        nouns, text = list_nouns(), f"a {colour} {name} sphere"
        scene = understand(text, nouns)
        staged, said, *_ = stage(scene, scene.words, nouns, seed=0, size=SIZE, duration_s=1.0)
        part, *_ = staged.actors[0].model.parts(Pose(0.0, 0.0, 0.0, "stand"))
        assert part.texture is MATERIALS[name].texture
        assert name in " ".join(said.shown)
        assert abs(sum(part.colour) - sum(part.second_colour)) / 3.0 > 0.25


@for_every(CLOTHES)
def test_clothes_show_on_who_wears_them_in_their_colour(name):
    said = report(f"a man in a green {name} walks")
    assert {"green", "man", "walks"} <= {*said.shown}
    assert not [*said.not_understood, *said.not_shown, *said.substituted]


@pytest.mark.parametrize("act", ["chop", "slice", "knead", "wipe table"])
@pytest.mark.parametrize("size", [0.7, 1.0])
def test_a_counter_is_closed_below_the_top_on_which_an_act_is_done(act, size):
    prop = list_props(act, size)[0]
    bench, counter = (prop.as_said(1, None, noun).draw(0.0) for noun in ("", "kitchen counter"))
    (low, high), (first, last) = map(bounds, (bench, counter))
    assert np.allclose([low, high], [first, last], atol=0.05)
    below = [0.64 * size, 0.2 * size, 0.4 * size]
    held = [[(bounds([one])[0] < below).all() and (bounds([one])[1] > below).all()
             for one in parts] for parts in (bench, counter)]  # fmt: skip
    assert [any(each) for each in held] == [False, True]


@pytest.mark.parametrize("count", [1, 3, 8])
def test_props_come_in_the_number_and_colour_that_is_said(count):
    (prop,) = list_props("juggle")
    drawn = prop.as_said(count, (0.0, 1.0, 0.0)).draw(0.3)
    assert [one.colour for one in drawn] == count * [(0.0, 1.0, 0.0)]
    assert len({tuple(one.to_body[:, 3]) for one in drawn}) == count


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


@pytest.mark.parametrize("clothes", ["jacket", "sweater", "hoodie"])
@pytest.mark.parametrize("way", ["in", "out"])
def test_clothes_are_seen_that_are_near_for_a_part_of_the_clip(clothes, way):
    start_m, end_m = (-23.0, -6.0)[:: 1 if way == "in" else -1]
    move = CameraMove("dolly", way, speed_m_s=8.5)
    camera = Camera(position_m=(0.0, start_m, 1.4), look_at_m=(0.0, 30.0, 1.4), moves=(move,))
    said, scene, found = unworn(clothes, camera=camera)
    assert scene.camera(DURATION_S).position[1] == pytest.approx(end_m, abs=0.3)
    assert found == []
    assert [*find_unworn(scene, said, [0.0 if way == "in" else DURATION_S])] == [1]


@pytest.mark.parametrize(("clothes", "is_shown"), [("jacket", True), ("glove", False),
                                                   ("boot", False)])  # fmt: skip
def test_a_rider_who_is_part_of_what_he_rides_shows_a_shirt(clothes, is_shown):
    said, scene, _ = unworn(clothes)
    found = [*find_unworn(replace(scene, actors=()), said, [0.5])]
    assert found == ([] if is_shown else [1])

"""What a clip shows of several acts and of a place: each check in unrelated sentences."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.checks.test_pictures import SMALL
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, SIZE, in_image, stage, stage_text, thing
from tests.scenes.test_short_prompts import report

from texvent_scenes.checks.bodies.limbs import find_tiny
from texvent_scenes.checks.bodies.phases import find_unhurried, find_unlifted
from texvent_scenes.defaults import complete
from texvent_scenes.description import SceneDescription, to_description
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES
from texvent_scenes.spec.scene import Motion, Relation, Scene, SceneObject
from texvent_scenes.staging.compose import compose_scene


def test_a_cyclist_has_one_bicycle():
    assert sum("bicycle" in line for line in report("a cyclist pushes his bicycle").scene) == 0
    said = report("a cyclist falls off his bike")
    assert "bike" in (*said.shown, *said.uncertain)


def test_what_flashes_is_hidden_by_nothing():
    text = "a square flashes at 2 Hz"
    assert "flashes" in report(text).shown
    assert not any("hidden" in note for note in report(text).notes)


def test_an_act_whose_limbs_hardly_move_in_the_image_is_said_if_none_is_near():
    said, scene = stage_text("a woman waves in the street")
    times, (near,) = [0.0, 0.5, 1.0], scene.actors
    far = replace(near, track=replace(near.track, start=(0.0, 400.0, 0.0)))
    for share, lost in ((1.0, []), (0.01, ["wave"])):
        cameras = [replace(each, focal=share * each.focal) for each in map(scene.camera, times)]
        for own in ((near,), (far, near), (near, far)):
            found = find_tiny(said, own, cameras, times, SIZE)
            assert [one.value for one in found] == lost


@pytest.mark.parametrize(("noun", "kind"), [("car", "drive"), ("dog", "run"), ("bird", "fly")])
@pytest.mark.parametrize("pace", [1.0, 1.7, 3.0])
def test_haste_is_shown_of_who_has_it(noun, kind, pace):
    actors = stage(SceneObject(noun, motions=(Motion(kind, pace=pace),)), place="plain").actors
    for said in (1.7, 3.0, 9.0):
        words = SceneDescription(objects=(SceneObject(noun, motions=(Motion(kind, pace=said),)),))
        is_slower = bool([*find_unhurried(words, actors, np.linspace(0.0, 2.0, 9))])
        assert is_slower == (pace < 0.75 * said)


@pytest.mark.parametrize(
    ("noun", "target"), [("dog", "tree"), ("child", "van"), ("ball", "box"), ("cat", "sofa")]
)
def test_who_comes_from_behind_a_thing_is_hidden_first_and_then_clear_of_it(noun, target):
    scene = stage(
        thing(noun, ("move",)), thing(target, ("stand",)), relations=(("from behind", 0, 1),)
    )
    one, other = scene.actors
    first, last = (in_image(scene, one, at) for at in (0.0, 2.0))
    cover = in_image(scene, other, 0.0)
    low, high = cover[:, 0].min(), cover[:, 0].max()
    assert low <= first[:, 0].mean() <= high
    gone = last[:, 0].mean() - first[:, 0].mean()
    assert abs(gone) > 0.5 * np.ptp(first[:, 0])


@pytest.mark.parametrize(
    ("text", "means"),
    [
        ("first person view of a drone flying through a forest", "fly"),
        ("first-person view of a man walking through a market", "walk"),
        ("pov of a car driving through a city", "drive"),
    ],
)
def test_a_first_person_view_goes_with_the_camera(text, means):
    said = report(text)
    assert any(f'means = "{means}"' in one for one in said.scene)
    assert "objects" not in " ".join(said.scene)


ROOMS = [name for name, one in PLACES.items() if one.is_room and name not in ("indoor", *SMALL)]


@for_every(zip(ROOMS, itertools.cycle(("walking", "flying"))))
def test_a_camera_that_goes_through_a_room_sees_its_furniture(row):
    name, how = row
    assert not report(f"{how} through a {name}").not_shown


@pytest.mark.parametrize(
    ("text", "is_told"),
    [("a toy train goes round and round a christmas tree", True),
     ("a car drives around a fountain", True), ("an elephant walks around a house", True),
     ("a dog runs around a tree", False), ("a bird flies in circles", False),
     ("a car drives past a fountain", False)],
)  # fmt: skip
def test_who_does_not_come_once_round_is_told(text, is_told):
    assert any("of the way round" in one for one in report(text).notes) == is_told


@pytest.mark.parametrize("start_s", [0.0, 0.5, 1.0, 1.8])
@pytest.mark.parametrize("noun", ["robot arm", "forklift"])
@pytest.mark.parametrize("target", ["box", "bottle", "pallet"])
def test_what_is_lifted_too_late_is_told(noun, target, start_s):
    lifter = SceneObject(noun, motions=(Motion("work", start_s=start_s),),
                         relations=(Relation("lift", (target,)),))  # fmt: skip
    said = to_description(Scene(objects=(lifter, SceneObject(target))))
    scene = compose_scene(complete(said, NOUNS), seed=0, size=SIZE, duration_s=DURATION_S)
    lifted = next(one for one in scene.actors if one.noun.name == target)
    rise_m = lifted.middle(DURATION_S)[2] - lifted.middle(0.0)[2]
    told = [*find_unlifted(said, scene.actors, DURATION_S)]
    assert bool(told) == (rise_m < 0.1 * lifted.size_m)

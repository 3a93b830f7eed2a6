"""Things named alone stand close together and fill the image; tables are seen from near."""

from __future__ import annotations

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.projection import project
from texvent.scenes.staging.camera.camera_path import share_followed
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.scenes.staging.still_life import enlarge_beside, is_still_life
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)


def stage(prompt: str) -> ComposedScene:
    return compose_scene(parse_prompt(prompt), seed=0, size=SIZE, duration_s=2.0)


def extents(scene: ComposedScene, time_s: float = 1.0) -> dict[str, float]:
    """Noun → the largest extent of its boxes in the image: share of the width or height."""
    found: dict[str, float] = {}
    for actor in scene.actors:
        image = project(scene.camera(time_s), SIZE, actor.corners(time_s))[:, :2]
        extent = float((np.ptp(image, axis=0) / [SIZE.width, SIZE.height]).max())
        found[actor.noun.name] = max(extent, found.get(actor.noun.name, 0.0))
    return found


def test_several_small_things_lie_close_together() -> None:
    assert extents(stage("three carrots"))["carrot"] > 0.2


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [("a spoon and a lamp", "spoon"), ("a kettle on the left of a wardrobe", "kettle"),
     ("a mailbox and a bus", "mailbox"), ("a duck and a cow", "duck")],
)  # fmt: skip
def test_the_smaller_of_two_things_is_large_enough_to_tell(prompt: str, noun: str) -> None:
    assert extents(stage(prompt))[noun] > 0.12


def test_things_named_alone_stay_where_they_are() -> None:
    for prompt in ("a bus and a bench", "a bear and a goat", "an airplane and a car"):
        description = parse_prompt(prompt)
        assert {one.motion.kind for one in description.objects if one.motion} == {"stand"}
        assert is_still_life(description)
    assert not is_still_life(parse_prompt("a bus passes a bench"))
    assert not is_still_life(parse_prompt("a man and a bench"))


def test_a_person_beside_furniture_does_not_walk_off() -> None:
    man, _ = parse_prompt("a man and a wardrobe").objects
    assert man.motion is not None
    assert man.motion.kind == "stand"


def test_half_of_a_ratio_is_left() -> None:
    assert enlarge_beside(0.2, 1.6) == pytest.approx(2.0)
    assert enlarge_beside(0.5, 0.6) == 1.0
    assert enlarge_beside(0.01, 100.0) == 3.5


def test_things_on_a_table_are_seen_from_near_and_above() -> None:
    for prompt in ("a table with a teapot", "a cup and a spoon on a table"):
        scene = stage(prompt)
        assert scene.camera_path.framing.elevation > 0.4
        named = extents(scene)
        assert named["table"] > 1.0
        assert max(extent for noun, extent in named.items() if noun != "table") > 0.3


def test_who_is_small_on_something_large_that_goes_is_seen_from_near() -> None:
    scene = stage("a cat sits on the roof of a truck that drives")
    assert extents(scene)["cat"] > 0.1
    resting = stage("a cat sits on a truck")
    assert extents(resting)["cat"] > 0.1


def test_the_camera_goes_along_with_what_would_be_small_and_lets_it_cross_the_image() -> None:
    scene = stage("a red car drives left")
    assert 0.0 < share_followed(scene.camera_path.moves) < 1.0
    (car,) = scene.actors
    places = [project(scene.camera(t), SIZE, car.middle(t)[None])[0, 0] for t in (0.0, 2.0)]
    assert places[1] < places[0] - 0.15 * SIZE.width
    assert extents(scene)["car"] > 0.35


def test_a_train_is_seen_from_nearer_its_front() -> None:
    scene = stage("a train")
    (train,) = scene.actors
    state = train.trajectory.at(1.0)
    ahead = np.array([np.cos(state.yaw), np.sin(state.yaw), 0.0])
    assert (scene.camera(1.0).position - train.middle(1.0)) @ ahead > 0.0


def test_an_animal_before_a_table_that_is_named_leaves_the_usual_view() -> None:
    assert stage("a dog walks past a table").camera_path.framing.elevation < 0.4


def test_a_clock_of_a_building_is_high_on_its_front_and_as_large_as_one_sees_it() -> None:
    scene = stage("a tower with a clock")
    tower, clock = scene.actors
    assert 0.5 * tower.model.height < clock.middle(0.0)[2] < tower.model.height
    assert clock.model.height > 0.3 * tower.model.width


def test_who_holds_something_stands_and_is_seen_from_near() -> None:
    scene = stage("a man holds a banana")
    man, banana = scene.actors
    assert np.ptp([man.middle(t)[0] for t in (0.0, 2.0)]) < 0.3
    assert extents(scene)[banana.noun.name] > 0.15


def test_of_two_who_hold_things_both_are_in_the_image() -> None:
    scene = stage("two women hold cups")
    for actor in scene.actors[:2]:
        x, y = project(scene.camera(1.0), SIZE, actor.middle(1.0)[None])[0, :2]
        assert 0.0 < x < SIZE.width
        assert 0.0 < y < 1.2 * SIZE.height


@pytest.mark.parametrize("move", ["pans left", "tilts up", "zooms out"])
def test_a_camera_that_turns_goes_along_too(move: str) -> None:
    scene = stage(f"a dog runs across a meadow, the camera {move}")
    assert 0.0 < share_followed(scene.camera_path.moves) < 1.0
    assert extents(scene)["dog"] > 0.2
    assert share_followed(stage("a dog runs across a meadow, static camera").camera_path.moves) == 1

"""Who sits where, what things are in, and what goes along with them."""

from __future__ import annotations

import numpy as np
import pytest
from texvent.scenes.staging.claims.contact import is_in, rides, touches

from tests.scenes.sentences import parse_prompt
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)


def stage(prompt: str) -> ComposedScene:
    return compose_scene(parse_prompt(prompt), seed=0, size=SIZE, duration_s=1.0)


def named(scene: ComposedScene, noun: str) -> list[Actor]:
    return [actor for actor in scene.actors if actor.noun.name == noun]


@pytest.mark.parametrize(
    ("prompt", "mount", "rider", "count"),
    [
        ("a motorcycle with a passenger drives by", "motorcycle", "person", 1),
        ("a man rides a motorcycle with a woman behind him", "motorcycle", "woman", 1),
        ("two people ride a horse", "horse", "person", 2),
        ("a couple is paddling a canoe", "canoe", "person", 2),
        ("two children on a sled", "sled", "child", 2),
        ("four people in a raft", "raft", "person", 4),
        ("two boys on a bicycle", "bicycle", "child", 1),
        ("a worker drives a tractor", "tractor", "worker", 1),
        ("a man pulls a sled with a child on it", "sled", "child", 1),
        ("a woman pushes a stroller with a baby in it", "stroller", "baby", 1),
    ],
)
def test_all_of_a_crew_are_aboard(prompt: str, mount: str, rider: str, count: int) -> None:
    scene = stage(prompt)
    riders = named(scene, rider)
    assert len(riders) == count
    for time_s in (0.0, 0.5, 1.0):
        assert all(rides(one, named(scene, mount)[0], time_s) for one in riders)
    places = [one.middle(0.5) for one in riders]
    apart = [np.linalg.norm(a - b) for n, a in enumerate(places) for b in places[:n]]
    assert not apart or min(apart) > 0.3
    assert not scene.not_shown


def test_who_is_said_to_ride_two_things_sits_on_one() -> None:
    scene = stage("a performer rides a unicycle around a square, then pedals off")
    assert named(scene, "bicycle")
    assert not named(scene, "performer")


def test_more_riders_than_seats_are_reported() -> None:
    assert "people riding the motorcycle" in stage("five people ride a motorcycle").not_shown


@pytest.mark.parametrize(
    ("prompt", "content", "vessel"),
    [
        ("a vase of tulips", "tulip", "vase"),
        ("a bowl of apples", "apple", "bowl"),
        ("a glass of flowers", "flower", "glass"),
        ("a cup with two pencils", "pencil", "cup"),
        ("a woman rides a bicycle with her basket full of flowers", "flower", "basket"),
    ],
)
def test_what_is_in_a_vessel_stays_in_it(prompt: str, content: str, vessel: str) -> None:
    scene = stage(prompt)
    assert not scene.not_shown
    for time_s in (0.0, 1.0):
        around = named(scene, vessel)[0]
        assert all(is_in(one, around, time_s) for one in named(scene, content))


def test_a_fish_in_a_bowl_swims_in_it_all_the_time() -> None:
    scene = stage("a fish swims in a bowl")
    fish, bowl = named(scene, "fish")[0], named(scene, "bowl")[0]
    reach = 0.5 * bowl.model.length
    for time_s in np.linspace(0.0, 1.0, 9):
        apart = fish.middle(float(time_s)) - bowl.middle(0.0)
        assert np.linalg.norm(apart[:2]) + 0.4 * fish.model.length < reach
        assert apart[2] < 0.5 * bowl.model.height + 0.5 * fish.model.height


def test_each_person_has_a_mat() -> None:
    scene = stage("three people sit on mats")
    people, mats = named(scene, "person"), named(scene, "rug")
    taken = {
        min(range(3), key=lambda n: np.linalg.norm((mats[n].middle(0.0) - one.middle(0.0))[:2]))
        for one in people
    }
    assert taken == {0, 1, 2}
    assert not scene.not_shown


def test_who_is_in_a_window_stands_behind_its_open_frame() -> None:
    scene = stage("a woman waves from a window")
    woman, window = named(scene, "woman")[0], named(scene, "window")[0]
    low, high = (window.corners(0.0)[:, :2].min(axis=0), window.corners(0.0)[:, :2].max(axis=0))
    assert np.all(woman.middle(0.0)[:2] > low - 0.4)
    assert np.all(woman.middle(0.0)[:2] < high + 0.4)
    assert woman.middle(0.0)[1] > window.middle(0.0)[1]
    pose = window.pose(0.0)
    assert len(window.model.parts(pose)) < len(
        NOUNS["window"].build(colour=None, scale=1.0, seed=0).parts(pose)
    )


def test_bottles_go_along_on_a_belt_without_its_own_boxes() -> None:
    scene = stage("bottles on a conveyor belt")
    belt = named(scene, "conveyor belt")[0]
    for bottle in named(scene, "bottle"):
        way = bottle.middle(1.0) - bottle.middle(0.0)
        assert 0.1 < np.linalg.norm(way) < 0.5
        assert abs(way[2]) < 1e-6
    tops = [part.to_body[2, 3] for part in belt.model.parts(belt.pose(0.3))]
    assert max(tops) < 0.72


@pytest.mark.parametrize(
    ("prompt", "thing"),
    [
        ("a woman with a basket on her head walks", "basket"),
        ("a man with a parrot on his shoulder", "parrot"),
        ("a girl carries a cat on her back", "cat"),
        ("a boy with a stick walks", "branch"),
        ("a dog with a stick in its mouth runs", "branch"),
    ],
)
def test_what_somebody_has_on_the_body_goes_along(prompt: str, thing: str) -> None:
    scene = stage(prompt)
    owner = next(actor for actor in scene.actors if actor.noun.name != thing)
    held = named(scene, thing)[0]
    assert touches(owner, held, 0.0)
    assert touches(owner, held, 1.0)
    assert not scene.not_shown


def test_what_stands_in_the_lane_is_on_the_road_of_a_camera_that_drives() -> None:
    scene = stage("a deer stands in the lane ahead as we drive along a road")
    assert not scene.not_shown
    deer = named(scene, "deer")[0].middle(0.0)
    ahead = deer - scene.camera(0.0).position
    assert abs(ahead[0]) < 2.0
    assert ahead[1] > 3.0


def test_who_stands_in_a_doorway_stands_on_the_ground() -> None:
    scene = stage("a man stands in a doorway")
    man, door = named(scene, "man")[0], named(scene, "door")[0]
    assert man.corners(0.0)[:, 2].min() < 0.05
    assert np.linalg.norm((man.middle(0.0) - door.middle(0.0))[:2]) < 0.6

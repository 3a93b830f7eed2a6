"""Who works on a thing stands at it, with hands that reach it; what is too low is reported."""

import math

import numpy as np
import pytest
from texvent.scenes.staging.claims.contact import touches

from texvent.scenes.description import ObjectMotion, Relation, SceneDescription, SceneObject
from tests.scenes.sentences import parse_prompt
from texvent.scenes.staging.acts.hand_work.working import work_at
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize


def compose(description: SceneDescription) -> ComposedScene:
    return compose_scene(description, seed=0, size=SensorSize(96, 72), duration_s=2.0)


def stage(activity: str, target: str) -> ComposedScene:
    worker = SceneObject("woman", motion=ObjectMotion(activity))
    relation = Relation("work on", 0, (1,))
    return compose(SceneDescription("hand-built", (worker, SceneObject(target)), (relation,)))


@pytest.mark.parametrize(
    ("activity", "target"),
    [("wash", "horse"), ("wash", "car"), ("paint", "fence"), ("saw", "table"), ("wash", "desk")],
)
def test_a_worker_faces_the_thing_and_its_hands_reach_it(activity, target):
    scene = stage(activity, target)
    worker, thing = scene.actors
    state = worker.trajectory.at(0.0)
    towards = np.array(thing.trajectory.at(0.0).position) - state.position
    heading = np.array([math.cos(state.yaw), math.sin(state.yaw)])
    assert heading @ towards[:2] > 0.8 * np.linalg.norm(towards[:2])
    assert any(touches(worker, thing, float(t)) for t in np.linspace(0.0, 1.0, 9))
    assert scene.not_shown == ()


@pytest.mark.parametrize("activity", ["pet", "wash", "brush", "feed"])
@pytest.mark.parametrize("target", ["rabbit", "cat", "dog", "cow"])
def test_who_works_on_an_animal_touches_it(activity, target):
    assert stage(activity, target).not_shown == ()


def test_who_does_something_else_stays():
    worker, thing = stage("wave", "horse").actors
    assert work_at(worker, thing) == (worker, thing)


@pytest.mark.parametrize(
    "prompt", ["a woman washes a horse", "a woman brushes a horse", "a man paints a fence"]
)
def test_what_is_worked_on_is_read(prompt):
    relations = parse_prompt(prompt).relations
    assert [(one.kind, one.subject, one.targets) for one in relations] == [("work on", 0, (1,))]


def test_an_activity_that_names_its_object_works_on_nothing():
    assert parse_prompt("a man plays the piano").relations == ()


@pytest.mark.parametrize(
    "prompt", ["two men wash a car", "a man and a woman wash a car", "two women wash a table"]
)
def test_workers_share_the_room_along_a_thing(prompt):
    scene = compose(parse_prompt(prompt))
    *workers, thing = scene.actors
    places = [np.array(one.trajectory.at(0.0).position) for one in workers]
    assert np.linalg.norm(places[0] - places[1]) > 0.4
    for worker in workers:
        assert any(touches(worker, thing, float(t)) for t in np.linspace(0.0, 1.0, 9))
    assert scene.not_shown == ()


def test_a_crew_that_finds_no_room_is_reported():
    scene = compose(parse_prompt("nine men paint a door"))
    assert "men working on the door" in scene.not_shown


@pytest.mark.parametrize(
    "prompt",
    [
        "a woman slices a cucumber", "a man tightens a pipe with a wrench",
        "a boy knocks on a door", "a woman irons a shirt",
        "a man stirs soup in a pot", "a man pours coffee into a cup",
        "a potter shapes a vase", "a worker welds a pipe", "a man lifts a box",
    ],
)  # fmt: skip
def test_hands_or_tools_touch_what_the_verb_acts_on(prompt):
    assert not any("working on" in text for text in compose(parse_prompt(prompt)).not_shown)


def test_a_small_thing_is_put_on_a_table_that_comes_with_the_worker():
    worker, cucumber = compose(parse_prompt("a woman slices a cucumber")).actors
    assert cucumber.trajectory.at(0.0).position[2] > 0.6
    assert any(prop.anchor == "ground" for prop in worker.props)


@pytest.mark.parametrize(("subject", "thing"), [("rabbit", "carrot"), ("dog", "bowl")])
def test_an_animal_eats_with_its_mouth_at_the_thing(subject, thing):
    scene = compose(parse_prompt(f"a {subject} eats from a {thing}"))
    animal, food = scene.actors
    assert any(touches(animal, food, float(t)) for t in np.linspace(0.0, 1.0, 9))
    assert scene.not_shown == ()


def test_who_climbs_a_ladder_holds_it_and_goes_up():
    scene = compose(parse_prompt("a man climbs a ladder"))
    man, _ = scene.actors
    assert man.trajectory.at(1.5).position[2] > man.trajectory.at(0.0).position[2] + 0.4
    assert scene.not_shown == ()

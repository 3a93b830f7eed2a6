"""Two who do something together, what goes from hand to hand, and what opens."""

from itertools import pairwise

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.people.acts.pairs import GIVEN_S, PAIR_GAPS
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.wrapped.opening import OPENING, OpeningModel
from texvent.scenes.scene import Scene
from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize


def stage(prompt: str) -> Scene:
    return compose_scene(parse_prompt(prompt), seed=0, size=SensorSize(173, 130), duration_s=2.0)


@pytest.mark.parametrize(
    ("prompt", "activity"),
    [
        ("two friends hug", "hug"),
        ("a man shakes hands with a woman", "shake hands"),
        ("a man argues with his boss", "argue"),
        ("two boxers sparring", "box"),
    ],
)
def test_two_who_do_it_together_face_each_other(prompt: str, activity: str) -> None:
    one, other = (actor.trajectory.at(0.0) for actor in stage(prompt).actors[:2])
    assert {one.activity, other.activity} == {activity}
    apart = np.array(other.position) - np.array(one.position)
    size = PAIR_GAPS[activity]
    assert 0.7 * size < np.hypot(apart[0], apart[1]) < 1.1 * size
    for state, sign in ((one, 1.0), (other, -1.0)):
        heading = np.array([np.cos(state.yaw), np.sin(state.yaw)])
        assert sign * float(apart[:2] @ heading) > 0.9 * np.hypot(apart[0], apart[1])


@pytest.mark.parametrize(
    "prompt", ["a man hands a flower to a woman", "a woman gives a child an apple"]
)
def test_what_is_handed_over_goes_from_the_one_hand_to_the_other(prompt: str) -> None:
    actors = {actor.noun.name: actor for actor in stage(prompt).actors}
    names = [name for name in actors if name not in ("flower", "apple")]
    thing = next(actor for name, actor in actors.items() if name not in names)
    giver, taker = (actors[name] for name in names)
    places = [np.array(thing.trajectory.at(t).position) for t in np.arange(0.0, 2.0, 0.001)]
    assert max(np.linalg.norm(b - a) for a, b in pairwise(places)) < 0.02
    first, last = (who.anchor("right hand", t)[:, 3] for who, t in ((giver, 0.0), (taker, 2.0)))
    assert np.linalg.norm(places[0] - first) < 0.3
    assert np.linalg.norm(places[-1] - last) < 0.3
    assert 0.0 < GIVEN_S < 2.0


@pytest.mark.parametrize("noun", sorted(OPENING))
def test_what_opens_keeps_its_parts_and_closes_as_it_opens(noun: str) -> None:
    model = OpeningModel(NOUNS[noun].build(colour=None, scale=1.0, seed=0), noun)

    def parts(activity: str, time_s: float) -> list[np.ndarray]:
        return [one.to_body for one in model.parts(Pose(time_s, 0.0, 0.0, activity))]

    opened, closed = parts("open", 2.0), parts("open", 0.0)
    assert len(opened) == len(closed)
    assert any(np.abs(a - b).max() > 0.1 for a, b in zip(opened, closed, strict=True))
    for a, b in zip(opened, parts("close", 0.0), strict=True):
        np.testing.assert_allclose(a, b)


def test_a_person_at_a_door_opens_it_and_the_report_says_so() -> None:
    described = parse_prompt("a man opens a door")
    motions = {one.noun: one.motion.kind for one in described.objects if one.motion}
    assert motions == {"man": "open", "door": "open"}
    assert not described.substituted


@pytest.mark.parametrize(
    ("prompt", "rises"),
    [("a woman puts a cup on the table", False), ("a child picks up a ball", True)],
)
def test_hands_put_things_down_and_pick_them_up(prompt: str, rises: bool) -> None:
    scene = stage(prompt)
    thing = next(one for one in scene.actors if one.noun.name in ("cup", "ball"))
    first, last = (thing.trajectory.at(t).position[2] for t in (0.0, 2.0))
    assert (last - first > 0.15) if rises else (first - last > 0.15)


@pytest.mark.parametrize("prompt", ["a cat climbs a tree", "a bear climbing a tree"])
def test_an_animal_climbs_up_the_trunk(prompt: str) -> None:
    scene = stage(prompt)
    animal, tree = sorted(scene.actors, key=lambda one: one.noun.name == "tree")
    first, last = (animal.trajectory.at(t) for t in (0.0, 2.0))
    assert last.position[2] - first.position[2] > 0.3
    assert first.pitch == pytest.approx(-0.5 * np.pi)
    assert np.hypot(*(animal.middle(1.0) - tree.middle(0.0))[:2]) < 1.5


@pytest.mark.parametrize(
    "prompt", ["a woman is talking to a man", "a man chats with a girl", "a man waves at a dog"]
)
def test_who_talks_to_somebody_stands_before_them(prompt: str) -> None:
    scene = stage(prompt)
    one, other = (actor.trajectory.at(1.0) for actor in scene.actors[:2])
    apart = (np.array(other.position) - np.array(one.position))[:2]
    for state, sign in ((one, 1.0), (other, -1.0)):
        heading = np.array([np.cos(state.yaw), np.sin(state.yaw)])
        assert sign * float(apart @ heading) > 0.9 * np.hypot(*apart)
    assert not scene.not_shown


def test_a_parked_car_is_overtaken_too() -> None:
    assert not stage("a cyclist overtakes a parked car").not_shown


def test_who_walks_up_and_down_stays_on_the_ground_and_turns_round() -> None:
    (woman,) = stage("a woman walks up and down a beach").actors
    states = [woman.trajectory.at(float(t)) for t in np.linspace(0.0, 2.0, 9)]
    assert {one.position[2] for one in states} == {0.0}
    way = np.diff([one.position[:2] for one in states], axis=0)
    headings = [(np.cos(one.yaw), np.sin(one.yaw)) for one in states]
    going = [step @ np.array(heading) for step, heading in zip(way, headings, strict=False)]
    assert sum(one > 0.0 for one in going) >= 6


def test_a_chased_ball_rolls_and_an_overtaken_truck_drives() -> None:
    moves = {one.noun: one.motion for one in parse_prompt("a dog chases a ball").objects}
    assert moves["ball"] is not None
    assert moves["ball"].kind == "roll"
    described = parse_prompt("a motorcycle overtakes a truck")
    assert described.objects[1].motion is not None
    assert described.objects[1].motion.kind == "drive"


def test_who_runs_on_a_treadmill_runs_in_place() -> None:
    scene = stage("a man running on a treadmill")
    (man,) = [one for one in scene.actors if one.noun.name == "man"]
    states = [man.trajectory.at(t) for t in (0.0, 1.0, 2.0)]
    assert {one.activity for one in states} == {"run in place"}
    assert np.ptp([one.position for one in states], axis=0).max() < 0.05


def test_two_dogs_pull_at_one_rope() -> None:
    scene = stage("two dogs play tug of war")
    assert sum(one.tether is not None for one in scene.actors) == 1


def test_what_is_not_there_is_not_put_down() -> None:
    assert "puts" in parse_prompt("a woman puts effort into it").not_understood

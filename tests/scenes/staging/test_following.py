"""Who follows goes along the way of its leader, as far behind as it begins."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import SIZE

from texvent.errors import ConfigError
from texvent_scenes.description import report_of
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.scene_input import check_words, describe_scene
from texvent_scenes.spec.scene import Motion, Place, Relation, Scene, SceneObject
from texvent_scenes.staged_prompt import stage
from texvent_scenes.staging.compose import compose_scene

PAIRS = [("mobile robot", "mobile robot", "drive", 1.2), ("man", "dog", "walk", 1.3),
         ("dog", "man", "run", 2.5), ("car", "car", "drive", 4.0), ("drone", "drone", "fly", 2.0),
         ("ball", "ball", "roll", 1.0)]  # fmt: skip
LEGS = {
    "corner": [("right", 0.0), ("away", 1.0)], "late": [("away", 0.5), ("left", 1.5)],
    "two": [("right", 0.0), ("away", 0.8), ("left", 2.0)],
    "rest": [("right", 0.0), ("stand", 1.0), ("towards", 1.6)],
}  # fmt: skip
BEHIND = {"right": (-1.0, 0.0), "away": (0.0, -1.0)}
SPAN_S = 3.0


def legs(kind, speed, names):
    return tuple(
        replace(Motion(kind, way, speed_m_s=speed), start_s=at)
        if way != "stand"
        else Motion("stand", start_s=at)
        for way, at in LEGS[names]
    )


def follow(pair, names, far_m, *, motions=(), is_stated=True, prompt=""):
    first, second, kind, speed = pair
    way = np.array(BEHIND[LEGS[names][0][0]])
    place = {"position_m": tuple(far_m * way)} if is_stated else {}
    relation = Relation("follow", ("a",), None if is_stated else far_m)
    objects = (
        SceneObject(first, id="a", motions=legs(kind, speed, names), position_m=(0.0, 0.0)),
        SceneObject(second, id="b", motions=motions, relations=(relation,), **place),
    )
    scene = Scene(prompt=prompt, objects=objects, place=Place("plain", is_empty=True))
    said = describe_scene(scene, NOUNS)
    staged = compose_scene(said, seed=2, size=SIZE, duration_s=SPAN_S)
    return [one.track for one in staged.actors]


@for_every(itertools.product(PAIRS, LEGS, (1.5, 6.0), (True, False), ("", "a drives")))
def test_a_follower_is_where_its_leader_was_as_far_back_on_its_way(row):
    pair, names, far_m, is_stated, prompt = row
    leader, follower = follow(pair, names, far_m, is_stated=is_stated, prompt=prompt)
    start = far_m * np.array(BEHIND[LEGS[names][0][0]])
    np.testing.assert_allclose(follower.at(0.0).position[:2], start, atol=1e-6)
    times = np.linspace(0.0, SPAN_S, 241)
    places = np.array([leader.at(float(at)).position[:2] for at in times])
    arcs = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(places, axis=0), axis=1))])
    for at in (0.7, 1.3, 2.1, 2.9):
        behind = np.interp(at, times, arcs) - far_m
        want = (np.array([np.interp(behind, arcs, axis) for axis in places.T]) if behind > 0.0
                else start * -behind / far_m)  # fmt: skip
        np.testing.assert_allclose(follower.at(at).position[:2], want, atol=0.03)


@for_every(itertools.product(PAIRS, LEGS, (1.5, 6.0)))
def test_a_follower_that_only_goes_and_one_without_motions_do_the_same(row):
    pair, names, far_m = row
    kind = NOUNS[pair[1]].motion
    tracks = [follow(pair, names, far_m, motions=motions)[1]
              for motions in ((), (Motion(kind),))]  # fmt: skip
    for at in (0.0, 1.2, 2.4):
        ends = [one.at(at).position for one in tracks]
        np.testing.assert_allclose(*ends, atol=1e-9)


@for_every(itertools.product((PAIRS[2], ("ball", "apple", "roll", 1.0)), LEGS, (1.5,)))
def test_a_follower_covers_the_way_that_is_seen_and_rolls_by_it(row):
    pair, names, far_m = row
    _, one = follow(pair, names, far_m, motions=(Motion(pair[2]),))
    steps = np.linspace(0.0, 2.1, 841)
    places = np.array([one.at(float(at)).position[:2] for at in steps])
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(places, axis=0).T))])
    assert (one.radius_m > 0.0) == (pair[1] == "apple")
    for at in (0.7, 2.1):
        gone = float(np.interp(at, steps, way))
        assert one.at(at).distance_m == pytest.approx(gone, abs=0.02)
        assert one.at(at).pitch == pytest.approx(gone / (one.radius_m or np.inf), rel=0.02)


@pytest.mark.parametrize("count", [2, 4])
def test_a_queue_keeps_its_distances_round_a_corner(count):
    objects = [SceneObject("mobile robot", id="0", position_m=(0.0, 0.0),
                           motions=legs("drive", 1.5, "two"))]  # fmt: skip
    objects += [SceneObject("mobile robot", id=str(n),
                            relations=(Relation("follow", (str(n - 1),), 1.0),))
                for n in range(1, count)]  # fmt: skip
    said = describe_scene(Scene(objects=tuple(objects), place=Place("plain")), NOUNS)
    actors = compose_scene(said, seed=0, size=SIZE, duration_s=SPAN_S).actors
    for at in np.linspace(0.0, SPAN_S, 13):
        places = [np.array(one.track.at(float(at)).position[:2]) for one in actors]
        apart = [math.dist(*pair) for pair in itertools.pairwise(places)]
        assert 0.68 < min(apart) <= max(apart) < 1.001
    slower = [one.track.at(2.5).position[:2] for one in actors]
    assert len({tuple(np.round(one, 3)) for one in slower}) == count


def test_a_line_about_followers_names_them_by_their_ids():
    a = SceneObject("car", id="a", motions=(Motion("drive", "right"),), position_m=(0.0, 0.0))
    b = SceneObject("car", id="b", motions=(Motion("drive", "left"),), position_m=(0.0, 9.0),
                    relations=(Relation("follow", ("a",)),))  # fmt: skip
    said = describe_scene(Scene(objects=(a, b), place=Place("plain", is_empty=True)), NOUNS)
    _, report, _ = stage(said, report_of(said), NOUNS, seed=0, size=SIZE, duration_s=2.0)
    assert 'the car "b" following the car "a"' in report.not_shown


def test_a_distance_beside_a_position_of_who_follows_is_refused():
    a = SceneObject("car", id="a", motions=(Motion("drive", "right"),))
    b = SceneObject(
        "car", id="b", position_m=(1.0, 1.0), relations=(Relation("follow", ("a",), 2.0),)
    )
    with pytest.raises(ConfigError, match="distance_m is given beside position_m"):
        check_words(Scene(objects=(a, b)))

"""Ways to, into, out of, off, up and down things, as the geometry of staged scenes has them."""

import itertools
import math

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, stage, thing

from texvent_scenes.checks.clip.body_boxes import body_of
from texvent_scenes.checks.clip.relations import find_violations
from texvent_scenes.description import IndexedRelation, SceneDescription
from texvent_scenes.models.activities import ACTIVITIES, PERSON_NOUNS
from texvent_scenes.models.anchors import find_support
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.postures import find_track
from texvent_scenes.models.tables import nouns_with, trait_values
from texvent_scenes.spec.scene import Motion, SceneObject

TIMES = np.linspace(0.0, DURATION_S, 21)
OPEN = sorted({*trait_values("opening"), "car", "bus", "airplane"})
CLIMBED = sorted(trait_values("climbed"))
SLOPES = sorted(trait_values("slope"))


def way(kind, who, what, motion="walk", seed=0):
    """The places [t, 3] of who goes a way, and both bodies."""
    scene = stage(
        thing(who, (motion,)), thing(what, ("stand",)), relations=((kind, 0, 1),), seed=seed
    )
    one, other = scene.actors[:2]
    return np.array([one.track.at(t).position for t in TIMES]), one, other


def inside(place, other):
    """A place in the body coordinates of what stays."""
    to_world = other.track.at(0.0).to_world()
    return np.linalg.solve(to_world[:, :3], place - to_world[:, 3])


def holds(kind, one, other, motion="walk"):
    """Whether the check of relations finds nothing to say."""
    objects = (SceneObject(one.noun.name, motions=(Motion(motion),)), SceneObject(other.noun.name))
    said = SceneDescription(objects=objects, relations=(IndexedRelation(kind, 0, (1,)),))
    scene = stage(*objects, relations=((kind, 0, 1),))
    times = [float(t) for t in TIMES[::3]]
    cameras = [scene.camera(t) for t in times]
    copies = [[body_of(each, cameras, times)] for each in (one, other)]
    return not [each for each in find_violations(said, copies) if each.kind == "relation"]


@pytest.mark.parametrize("what", OPEN)
@pytest.mark.parametrize("kind", ["into", "out of"])
def test_a_way_in_or_out_has_one_end_inside_and_the_other_before_the_opening(kind, what):
    places, one, other = way(kind, "man", what)
    half = 0.5 * np.array([other.model.length, other.model.width])
    within, before = (inside(place, other)[:2] for place in (places[0], places[-1]))
    if kind == "into":
        within, before = before, within
    assert (np.abs(within) < half).all()
    passage = kind == "into" and what in nouns_with("passage")
    assert np.linalg.norm(before) > np.linalg.norm(within) + (0.0 if passage else 0.5)
    assert holds(kind, one, other)


@pytest.mark.parametrize("who", ["man", "dog", "car", "cyclist", "robot"])
@pytest.mark.parametrize("what", ["table", "tree", "house", "traffic light"])
def test_who_goes_to_something_rests_before_it_at_the_end(who, what):
    places, one, other = way("to", who, what, NOUNS[who].motion)
    half = 0.5 * np.array([other.model.length, other.model.width])
    gaps = []
    for t in (0.0, DURATION_S):
        beyond = np.maximum(np.abs(inside(one.middle(t), other)[:2]) - half, 0.0)
        gaps.append(np.linalg.norm(beyond) - 0.5 * one.model.length)
    assert -0.5 < gaps[1] < min(gaps[0], 1.6)
    assert np.allclose(places[-1], places[-2], atol=1e-6)
    fastest = np.linalg.norm(np.diff(places, axis=0), axis=1).max() / (TIMES[1] - TIMES[0])
    assert fastest <= 1.01 * NOUNS[who].speed_m_s
    assert holds("to", one, other, NOUNS[who].motion)


@pytest.mark.parametrize("what", ["table", "wall", "platform"])
def test_who_leaves_a_top_starts_on_it(what):
    for who, motion in (("cat", "jump"), ("cup", "fall"), ("drone", "rise")):
        _, one, other = way("off", who, what, motion)
        top = find_support(other.model).height
        assert one.lowest_m(0.0) == pytest.approx(top, abs=0.05), who
        if motion != "rise":
            assert one.lowest_m(DURATION_S) == pytest.approx(0.0, abs=0.06), who
            assert one.track.at(DURATION_S).speed_m_s == 0.0, who
        assert holds("off", one, other, motion), who


@pytest.mark.parametrize("kind", ["up", "down"])
@pytest.mark.parametrize("who", ["woman", "squirrel"])
@pytest.mark.parametrize("what", CLIMBED)
def test_a_climber_goes_up_or_down_at_the_speed_of_climbing(kind, who, what):
    places, one, other = way(kind, who, what, "climb")
    rates = np.diff(places[:, 2]) / np.diff(TIMES) * (1.0 if kind == "up" else -1.0)
    assert places[:, 2].min() >= 0.0
    assert np.ptp(places[:, 2]) >= 0.29
    assert rates.min() >= -1e-9
    assert rates.max() <= 0.41
    covered = [one.track.at(t).distance_m for t in TIMES]  # its limbs move by it
    assert np.diff(covered) == pytest.approx(np.linalg.norm(np.diff(places, axis=0), axis=1))
    assert one.corners(DURATION_S)[:, 2].max() < other.model.height + 1.0
    assert holds(kind, one, other, "climb")


@pytest.mark.parametrize("what", SLOPES)
def test_a_walker_goes_up_a_slope_upright_at_the_usual_speed(what):
    places, one, other = way("up", "man", what)
    length, height, _ = trait_values("slope")[what]
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1) / np.diff(TIMES)
    assert steps.max() == pytest.approx(NOUNS["man"].speed_m_s, rel=0.05)
    assert 0.1 < np.ptp(places[:, 2]) <= height + 0.01
    assert all(one.track.at(t).pitch == 0.0 for t in TIMES)
    grades = np.diff(places[:, 2]) / np.maximum(
        np.linalg.norm(np.diff(places[:, :2], axis=0), axis=1), 1e-9
    )
    assert grades.max() == pytest.approx(height / length, rel=0.05)
    assert holds("up", one, other)


def test_nothing_goes_where_there_is_no_way():
    for kind, what in (("into", "tree"), ("up", "cup"), ("out of", "bench")):
        _, one, other = way(kind, "man", what)
        assert not holds(kind, one, other)


def test_an_open_door_is_dark_only_where_one_goes_through():
    darks = []
    for kind in ("into", "beside"):
        scene = stage(
            thing("man", ("walk",)), thing("house", ("stand",)), relations=((kind, 0, 1),)
        )
        house = scene.actors[1]
        darks.append(sum(max(part.colour) < 0.02 for part in house.place(0.0).parts))
    assert darks[0] == darks[1] + 1


@pytest.mark.parametrize(("kind", "level"), [("throw", 1.08), ("kick", 0.0), ("roll", 0.0)])
@pytest.mark.parametrize("who", ["woman", "dog"])
def test_what_is_sent_to_somebody_ends_there(kind, level, who):
    scene = stage(
        thing("man"), thing("ball"), thing(who),
        relations=((kind, 0, 1), ("towards", 0, 2)),
    )  # fmt: skip
    _, ball, goal = scene.actors
    ends = [ball.middle(t) for t in (DURATION_S - 0.05, DURATION_S)]
    landed = goal.middle(DURATION_S) - goal.middle(DURATION_S - 0.05)  # of who leapt for it
    assert np.linalg.norm(ends[1] - ends[0] - landed) < 0.05
    reach = 0.5 * (goal.model.length + ball.model.length) + 0.3
    assert np.linalg.norm((ends[1] - goal.middle(DURATION_S))[:2]) < reach
    if kind == "throw" and who == "woman":
        assert ends[1][2] == pytest.approx(level * goal.model.height / 1.82, abs=0.15)
    elif kind != "throw":
        assert ball.lowest_m(DURATION_S) == pytest.approx(0.0, abs=0.03)


@for_every([*zip(sorted(PERSON_NOUNS & set(NOUNS)), itertools.cycle(("ball", "apple")))])
def test_what_is_thrown_to_anybody_ends_between_the_hands(row):
    who, what = row
    relations = (("throw", 0, 1), ("towards", 0, 2))
    _, thrown, goal = stage(thing("man"), thing(what), thing(who), relations=relations).actors
    hands = [goal.anchor(f"{side} hand", DURATION_S)[:, 3] for side in ("left", "right")]
    gaps = [np.linalg.norm(one - thrown.middle(DURATION_S)) for one in hands]
    assert gaps == pytest.approx([0.5 * thrown.model.width] * 2, abs=0.02)


@pytest.mark.parametrize("what", ["ball", "box", "cup", "suitcase"])
@pytest.mark.parametrize(("kind", "rises"), [("lift", True), ("set down", False), ("drop", False)])
def test_what_is_lifted_or_let_go_moves_without_a_leap(kind, rises, what):
    scene = stage(thing("man"), thing(what), relations=((kind, 0, 1),))
    _, carried = scene.actors
    fine = np.linspace(0.0, DURATION_S, 401)
    places = np.array([carried.middle(float(t)) for t in fine])
    ends = [carried.lowest_m(t) for t in (0.0, DURATION_S)]
    low, high = ends if rises else ends[::-1]
    assert low == pytest.approx(0.0, abs=0.05)
    assert high > 0.4
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).max() < 0.06


@pytest.mark.parametrize("name", [name for name, one in ACTIVITIES.items() if one.repeats_hz])
def test_what_is_counted_repeats_at_its_rate(name):
    track, period_s = find_track("activities", name), 1.0 / ACTIVITIES[name].repeats_hz
    found = [track.at(t) for t in (0.31, 0.31 + 2.0 * period_s, 0.31 + 0.4 * period_s)]
    arms = [{k: v for k, v in one.items() if k != "look" or name == "shake head"} for one in found]
    same, other = (
        max(abs(a - b) for k in arms[0] for a, b in zip(arms[0][k], each[k], strict=True))
        for each in arms[1:]
    )
    assert same < 1e-6 < 0.01 < other


@pytest.mark.parametrize(("kind", "sign"), [("grow", 1.0), ("shrink", -1.0)])
@pytest.mark.parametrize("noun", ["disc", "balloon", "tree"])
def test_what_grows_gets_larger_all_along(kind, sign, noun):
    (one,) = stage(thing(noun, (kind,))).actors
    sizes = [np.ptp(one.corners(float(t)), axis=0).max() for t in TIMES]
    assert (sign * np.diff(sizes) > 0.0).all()
    assert max(sizes) / min(sizes) > 2.0


@pytest.mark.parametrize(("is_lit", "levels"), [(True, (0.0, 1.0)), (False, (1.0, 0.0))])
def test_a_lamp_is_switched_once(is_lit, levels):
    lamp = SceneObject("lamp", motions=(Motion("stand"),), is_lit=is_lit, switch_s=0.7)
    scene = stage(lamp)
    bright = [scene.environment(t).lamps["light"].max() for t in (0.6, 0.8)]
    assert [bool(one > 0.1) for one in bright] == [bool(one) for one in levels]


@pytest.mark.parametrize(
    ("kind", "what"), [("into", "house"), ("out of", "garage"), ("up", "tree")]
)
def test_several_go_one_after_the_other(kind, what):
    motion = "climb" if kind == "up" else "walk"
    scene = stage(
        thing("man", (motion,), count=2), thing(what, ("stand",)), relations=((kind, 0, 1),)
    )
    first, second, _ = scene.actors
    apart = np.subtract(first.track.at(1.0).position, second.track.at(1.0).position)
    ahead = [math.cos(first.track.at(1.0).yaw), math.sin(first.track.at(1.0).yaw)]
    aside = abs(apart[0] * ahead[1] - apart[1] * ahead[0])
    assert aside < 1e-6
    assert np.linalg.norm(apart) > 0.5

"""Acts: what is held stays in the hand, bodies meet when they should, nothing jumps."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, middle, stage, thing
from tests.scenes.test_short_prompts import report, staged

from texvent_scenes.description import IndexedRelation, SceneDescription
from texvent_scenes.models.anchors import top_heights
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.shapes import bounds, moved
from texvent_scenes.models.tables import nouns_with, trait_values
from texvent_scenes.spec.scene import Motion, SceneObject
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.interactions.settling import settle_motions
from texvent_scenes.staging.interactions.striking import contact_time

CONTACT_M = 0.02


def act(kind, *nouns, motion=None, seed=0):
    objects = [
        SceneObject(nouns[0], motions=(motion,) if motion else ()),
        *(SceneObject(noun) for noun in nouns[1:]),
    ]
    relation = (kind, 0, *range(1, len(nouns)))
    return stage(*objects, relations=(relation,), place=None, seed=seed)


WALK_RIGHT = Motion("walk", "right")
SCENES = {
    "kick": ("kick", "man", "football"),
    "throw": ("throw", "woman", "ball"),
    "hold": ("hold", "man", "bottle"),
    "hold in both arms": ("hold", "worker", "box"),
    "ride a horse": ("ride", "man", "horse"),
    "push": ("push", "man", "box"),
}
BY_SCENE = pytest.mark.parametrize("name", sorted(SCENES))


@BY_SCENE
def test_nothing_jumps_between_two_milliseconds(name):
    scene = act(*SCENES[name])
    instants = list(np.arange(0.0, DURATION_S, 0.0873))
    instants += [contact_time(DURATION_S, share) for share in (0.35, 0.45, 0.5, 0.55)]
    for time_s in instants:
        start = float(time_s) - 5e-4
        before, after = scene.primitives(start), scene.primitives(start + 1e-3)
        moved = np.abs(after.to_world[:, :, 3] - before.to_world[:, :, 3]).max(initial=0.0)
        assert moved < 0.03, time_s


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(("who", "what"), [("man", "football"), ("child", "ball")])
def test_the_foot_touches_the_ball_when_it_leaves(who, what, seed):
    scene = act("kick", who, what, seed=seed)
    kicker, ball = scene.actors
    contact_s = contact_time(DURATION_S, 0.45)
    tip = kicker.anchor("right foot", contact_s)[:, 3]
    gap = math.dist(tip, middle(ball, contact_s)) - 0.5 * ball.model.length
    assert abs(gap) < CONTACT_M
    assert middle(ball, contact_s - 0.1) == pytest.approx(middle(ball, contact_s))
    ahead = kicker.track.at(contact_s).to_world()[:, 0]
    assert (middle(ball, contact_s + 0.3) - middle(ball, contact_s)) @ ahead > 0.4


def test_what_is_thrown_leaves_the_hand_when_it_is_let_go():
    woman, ball = act("throw", "woman", "ball").actors
    release_s = contact_time(DURATION_S, 0.35)
    gaps = [np.linalg.norm(middle(ball, t) - woman.anchor("right hand", t)[:, 3])
            for t in (0.0, release_s - 1e-3, release_s + 0.5)]  # fmt: skip
    assert gaps[0] == pytest.approx(gaps[1], abs=0.01)
    assert gaps[2] > gaps[0] + 0.4


@pytest.mark.parametrize(
    "text",
    ["a boy kicks a ball to a girl", "a boy throws a box to a dog", "a girl rolls a ball to a dog",
     "a man throws a ball to a woman"],
)  # fmt: skip
def test_what_is_sent_to_somebody_turns_from_its_start_until_it_is_there(text):
    track = next(one.track for one in staged(text)[0].actors if one.noun.name in ("ball", "box"))
    *before, flown_s, _ = (key.duration_s for key in track.keys)
    sent_s = sum(before)

    def turned(*times):
        states = [track.at(sent_s + share * flown_s) for share in times]
        return np.diff([[one.roll, one.pitch, one.yaw] for one in states], axis=0)

    steps = turned(0.0, 0.02, 0.3, 0.32, 0.6, 0.62, 0.97, 0.99)[::2]
    assert np.linalg.norm(steps[0]) > 0.05
    np.testing.assert_allclose(steps, np.broadcast_to(steps[0], steps.shape), atol=1e-9)
    np.testing.assert_allclose(turned(1.001, 1.05, 1.1), 0.0, atol=1e-9)


@pytest.mark.parametrize("what", ["bottle", "umbrella", "box"])
@pytest.mark.parametrize("motion", [None, WALK_RIGHT])
def test_any_noun_can_be_held_and_stays_at_the_hands(what, motion):
    scene = act("hold", "man", what, motion=motion)
    man, thing = scene.actors
    for time_s in (0.0, 0.7, 1.6):
        reach = 0.5 * max(thing.model.length, thing.model.width, thing.model.height)
        hands = [man.anchor(f"{side} hand", time_s)[:, 3] for side in ("left", "right")]
        gap = min(np.linalg.norm(middle(thing, time_s) - hand) for hand in hands)
        assert gap < reach + 0.35


@pytest.mark.parametrize("what", ["horse", "elephant"])
def test_a_rider_sits_on_the_back_with_a_leg_on_each_side(what):
    rider, mount = act("ride", "man", what).actors
    back = top_heights(mount.model.parts(Pose(0.0, 0.0, 0.0, "stand")), np.zeros(1), np.zeros(1))
    for time_s in (0.0, 1.3):
        to_mount = np.linalg.inv(np.vstack([mount.track.at(time_s).to_world(), [0, 0, 0, 1]]))
        seat = to_mount @ [*rider.anchor("seat", time_s)[:, 3], 1.0]
        assert seat[2] == pytest.approx(back[0], abs=CONTACT_M)
        assert abs(seat[1]) < CONTACT_M
        feet = [
            (to_mount @ [*rider.anchor(f"{side} foot", time_s)[:, 3], 1.0])[1]
            for side in ("left", "right")
        ]
        assert feet[0] > 0.15 > -0.15 > feet[1]


def test_hands_stay_at_the_back_of_what_is_pushed():
    pusher, box = act("push", "man", "box").actors
    gaps = []
    for time_s in (0.0, 0.8, 1.9):
        ahead = pusher.track.at(time_s).to_world()[:, 0]
        hand = pusher.anchor("right hand", time_s)[:, 3]
        back = box.track.at(time_s).to_world()[:, 3] - 0.5 * box.model.length * ahead
        gaps.append(float((back - hand) @ ahead))
    np.testing.assert_allclose(gaps, gaps[0], atol=CONTACT_M)
    assert 0.0 <= gaps[0] < 0.05
    assert box.track.at(2.0).distance_m > 0.8


@pytest.mark.parametrize(
    ("what", "place"), [("hat", "crown"), ("glasses", "face"), ("tie", "torso")]
)
def test_what_is_worn_goes_with_the_body(what, place):
    man, worn = act("wear", "man", what, motion=WALK_RIGHT).actors
    gaps = [np.linalg.norm(middle(worn, t) - man.anchor(place, t)[:, 3]) for t in (0.0, 0.6, 1.5)]
    assert max(gaps) < 0.45
    np.testing.assert_allclose(gaps, gaps[0], atol=1e-9)


def test_who_rides_in_a_closed_vehicle_is_not_seen():
    scene = act("ride", "man", "bus")
    assert [actor.noun.name for actor in scene.actors] == ["bus"]


def gap(one: Actor, other: Actor, time_s: float) -> float:
    """Least distance between boxes of their parts, m."""
    (low, high), (floor, top) = (
        np.transpose([bounds([part]) for part in moved(placed.parts, placed.to_world)], (1, 0, 2))
        for placed in (one.place(time_s), other.place(time_s))
    )
    apart = np.maximum(low[:, None] - top[None], floor[None] - high[:, None])
    return float(np.linalg.norm(np.maximum(apart, 0.0), axis=2).min())


@pytest.mark.parametrize(
    ("nouns", "moves"),
    [(("car", "car"), (True, True)), (("ball", "box"), (True, False)),
     (("tree", "car"), (False, True))],
)  # fmt: skip
def test_bodies_that_collide_touch_at_one_instant(nouns, moves):
    actors = act("collide", *nouns).actors
    contact_s = contact_time(DURATION_S, 0.5)
    mover = actors[moves.index(True)]
    assert gap(*actors, 0.0) > 0.5 * min(actor.model.length for actor in actors)
    assert gap(*actors, contact_s) == pytest.approx(0.0, abs=0.15 * mover.model.length)
    assert gap(*actors, contact_s - 0.2) > 0.0
    ways = [np.linalg.norm(middle(one, contact_s) - middle(one, 0.0)) for one in actors]
    assert tuple(way > 0.1 for way in ways) == moves


@pytest.mark.parametrize("nouns", [("car", "car"), ("ball", "ball"), ("dog", "man")])
def test_what_collides_at_a_pace_is_so_much_faster(nouns):
    ways = []
    for pace in (1.0, 2.0):
        said = (SceneObject(one, motions=(Motion("move", pace=pace),)) for one in nouns)
        actors = stage(*said, relations=(("collide", 0, 1),)).actors
        ways.append([np.linalg.norm(middle(one, 0.4) - middle(one, 0.2)) for one in actors])
    assert ways[1] == pytest.approx(2.0 * np.array(ways[0]), rel=1e-6)


def test_what_collides_on_a_table_stays_on_it():
    cups = thing("cup", ("stand",)), thing("cup", ("stand",))
    relations = (("collide", 0, 1), ("on", 0, 2), ("on", 1, 2))
    scene = stage(*cups, thing("table", ("stand",)), relations=relations)
    *bodies, table = scene.actors
    low, high = table.corners(0.0).min(axis=0), table.corners(0.0).max(axis=0)
    for time_s in np.linspace(0.0, 2.0, 9):
        for one in bodies:
            at = one.corners(time_s).mean(axis=0)
            assert np.all((low[:2] <= at[:2]) & (at[:2] <= high[:2]))
            assert at[2] > high[2]


@pytest.mark.parametrize(
    ("text", "turned"),
    [("a robot vacuum bumps into a chair leg and turns around", math.pi),
     ("a wheeled robot bumps into a wall and turns left", 0.5 * math.pi),
     ("a toy car crashes into a pot and turns right", -0.5 * math.pi)],
)  # fmt: skip
def test_who_runs_against_something_and_turns_goes_another_way(text, turned):
    actor = staged(text)[0].actors[0]
    first, last = (actor.track.at(at).yaw for at in (0.0, 2.9))
    assert math.remainder(last - first - turned, math.tau) == pytest.approx(0.0, abs=1e-6)
    assert "turns" in " ".join(report(text).shown)


RIDDEN = sorted(NOUNS.keys() & trait_values("ridden").keys() - nouns_with("ridden in place"))
GOING = [(Motion("run", "left"),), (Motion("jump"), Motion("walk", start_s=1.0)),
         (Motion("walk", pace=2.0), Motion("stand", start_s=1.2))]  # fmt: skip


@for_every(itertools.product(RIDDEN, GOING))
def test_it_is_the_same_whether_a_rider_or_what_is_ridden_is_said_to_go(row):
    noun, motions = row
    said = []
    for own in ((motions, ()), ((), motions)):
        objects = tuple(map(SceneObject, ("man", noun)))
        objects = tuple(replace(one, motions=each) for one, each in zip(objects, own, strict=True))
        scene = SceneDescription(objects=objects, relations=(IndexedRelation("ride", 0, (1,)),))
        said.append(settle_motions(scene, NOUNS, 0).objects)
    assert said[0] == said[1]
    assert len(said[0][1].motions) == len(motions)

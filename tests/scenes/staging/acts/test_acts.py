"""Acts: what is held stays in the hand, bodies meet when they should, nothing jumps."""

import math
from functools import cache
from itertools import pairwise
from typing import get_args

import numpy as np
import pytest

from texvent.scenes.colours import COLOURS
from texvent.scenes.description import (
    ObjectMotion,
    Relation,
    SceneDescription,
    SceneObject,
    Surroundings,
)
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.support_surface import find_support, top_heights
from texvent.scenes.spec.scene import RelationKind
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import ACTS, SINGLE
from texvent.scenes.staging.acts.attached import Performed
from texvent.scenes.staging.acts.striking import contact_time
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.scenes.staging.trajectories.trajectory import Riding, Trajectory
from texvent.sensor import SensorSize

DURATION_S = 2.0
CONTACT_M = 0.02


@cache
def stage(
    *objects: SceneObject, acts: tuple[Relation, ...], place: str | None = None, seed: int = 0
) -> ComposedScene:
    description = SceneDescription("hand-built", objects, acts, surroundings=Surroundings(place))
    return compose_scene(description, seed=seed, size=SensorSize(96, 72), duration_s=DURATION_S)


def act(kind: str, *nouns: str, motion: ObjectMotion | None = None, seed: int = 0) -> ComposedScene:
    objects = [SceneObject(nouns[0], motion=motion), *(SceneObject(noun) for noun in nouns[1:])]
    targets = tuple(range(1, len(nouns)))
    return stage(*objects, acts=(Relation(kind, 0, targets),), seed=seed)


def middle(actor: Actor, time_s: float) -> np.ndarray:
    lift = 0.0 if actor.is_centred else 0.5 * actor.model.height
    return actor.trajectory.at(time_s).to_world() @ np.array([0.0, 0.0, lift, 1.0])


WALK_RIGHT = ObjectMotion("walk", "right")
SCENES = {
    "kick": ("kick", "man", "football"),
    "kick by a child": ("kick", "child", "ball"),
    "throw": ("throw", "woman", "ball"),
    "throw to a dog": ("throw", "child", "ball", "dog"),
    "throw to a man": ("throw", "woman", "tennis ball", "man"),
    "catch": ("catch", "man", "ball"),
    "dog catches": ("catch", "dog", "tennis ball"),
    "hit with a racket": ("hit", "man", "tennis ball"),
    "hit with a bat": ("hit", "woman", "ball"),
    "hold": ("hold", "man", "bottle"),
    "umbrella": ("hold", "woman", "umbrella"),
    "balloon": ("hold", "child", "balloon"),
    "kite": ("hold", "child", "kite"),
    "carry": ("carry", "worker", "box"),
    "dog carries": ("carry", "dog", "tennis ball"),
    "ride a horse": ("ride", "man", "horse"),
    "ride an elephant": ("ride", "woman", "elephant"),
    "push": ("push", "man", "box"),
    "pull": ("pull", "man", "box"),
}
BY_SCENE = pytest.mark.parametrize("name", sorted(SCENES))


@BY_SCENE
def test_nothing_jumps_between_two_milliseconds(name: str) -> None:
    scene = act(*SCENES[name])
    instants = list(np.arange(0.0, DURATION_S, 0.0437))
    instants += [contact_time(DURATION_S, share) for share in (0.35, 0.45, 0.5, 0.55)]
    for time_s in instants:
        start = float(time_s) - 5e-4
        before, after = scene.primitives(start), scene.primitives(start + 1e-3)
        moved = np.abs(after.to_world[:, :, 3] - before.to_world[:, :, 3]).max(initial=0.0)
        assert moved < 0.03, time_s


@BY_SCENE
def test_shapes_keep_their_number(name: str) -> None:
    scene = act(*SCENES[name])
    counts = {scene.primitives(t).shape.size for t in (0.0, 0.6, 1.1, 2.0)}
    assert len(counts) == 1
    assert set(scene.primitives(0.0).instance.tolist()) - {0} == set(scene.class_names)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("who", "what"), [("man", "football"), ("child", "ball")])
def test_the_foot_touches_the_ball_when_it_leaves(who: str, what: str, seed: int) -> None:
    scene = act("kick", who, what, seed=seed)
    kicker, ball = scene.actors
    contact_s = contact_time(DURATION_S)
    tip = kicker.anchor("right foot", contact_s)[:, 3]
    gap = math.dist(tip, middle(ball, contact_s)) - 0.5 * ball.model.length
    assert abs(gap) < CONTACT_M
    assert middle(ball, contact_s - 0.1) == pytest.approx(middle(ball, contact_s))
    ahead = kicker.trajectory.at(contact_s).to_world()[:, 0]
    assert (middle(ball, contact_s + 0.3) - middle(ball, contact_s)) @ ahead > 0.4


def test_a_kicked_ball_falls_by_gravity() -> None:
    ball = act("kick", "man", "football").actors[1]
    start = contact_time(DURATION_S)
    heights = [middle(ball, start + step * 0.05)[2] for step in range(4)]
    np.testing.assert_allclose(np.diff(heights, 2), -9.81 * 0.05**2, atol=1e-9)


def test_the_standing_foot_of_a_kicker_does_not_slide() -> None:
    kicker = act("kick", "man", "football").actors[0]
    contact_s = contact_time(DURATION_S)
    times = np.arange(contact_s - 0.15, DURATION_S, 0.05)
    tips = np.array([kicker.anchor("left foot", float(t))[:2, 3] for t in times])
    assert np.ptp(tips, axis=0).max() < 5e-3


@pytest.mark.parametrize(
    ("names", "catcher", "place"),
    [(("throw", "woman", "ball", "man"), 2, "hands"), (("catch", "man", "ball"), 0, "hands"),
     (("throw", "child", "ball", "dog"), 2, "mouth"),
     (("catch", "dog", "tennis ball"), 0, "mouth")],
)  # fmt: skip
def test_what_is_caught_stays_with_who_caught_it(
    names: tuple[str, ...], catcher: int, place: str
) -> None:
    scene = act(*names)
    ball, who = scene.actors[1], scene.actors[catcher]
    gaps = []
    for time_s in (1.7, 1.8, 2.0):
        gaps.append(middle(ball, time_s) - who.anchor(place, time_s)[:, 3])
        assert np.linalg.norm(gaps[-1]) < 0.5 * ball.model.length + 0.05
    assert np.linalg.norm(middle(ball, 0.3) - who.anchor(place, 0.3)[:, 3]) > 0.8


def test_a_racket_meets_the_ball_at_the_contact() -> None:
    scene = act("hit", "man", "tennis ball")
    player, ball = scene.actors
    contact_s = contact_time(DURATION_S, 0.5)
    axes = player.anchor("right hand", contact_s)
    gap = np.linalg.norm(middle(ball, contact_s) - axes[:, 3] - 0.48 * axes[:, 2])
    assert gap < 0.5 * ball.model.length + 2.0 * CONTACT_M
    speed = [np.linalg.norm(middle(ball, t + 0.01) - middle(ball, t)) for t in (0.8, 1.05)]
    assert min(speed) > 0.01


@pytest.mark.parametrize("what", ["bottle", "umbrella", "tennis ball", "box", "cup", "rock"])
@pytest.mark.parametrize("motion", [None, WALK_RIGHT])
def test_any_noun_can_be_held_and_stays_at_the_hands(
    what: str, motion: ObjectMotion | None
) -> None:
    scene = act("carry", "man", what, motion=motion)
    man, thing = scene.actors
    for time_s in (0.0, 0.7, 1.6):
        reach = 0.5 * max(thing.model.length, thing.model.width, thing.model.height)
        hands = [man.anchor(f"{side} hand", time_s)[:, 3] for side in ("left", "right")]
        gap = min(np.linalg.norm(middle(thing, time_s) - hand) for hand in hands)
        assert gap < reach + 0.35


@pytest.mark.parametrize("what", ["plate", "book", "cat"])
def test_who_sits_holds_things_below_the_head(what: str) -> None:
    scene = act("hold", "man", what, motion=ObjectMotion("sit"))
    man, thing = scene.actors
    head = man.anchor("head", 0.0)[2, 3]
    assert middle(thing, 0.0)[2] < head - 0.1
    hands = [man.anchor(f"{side} hand", 0.0)[2, 3] for side in ("left", "right")]
    assert max(hands) < head - 0.1


def test_a_dog_carries_a_ball_in_its_mouth() -> None:
    dog, ball = act("carry", "dog", "tennis ball", motion=ObjectMotion("run", "left")).actors
    for time_s in (0.0, 0.9, 1.8):
        gap = np.linalg.norm(middle(ball, time_s) - dog.anchor("mouth", time_s)[:, 3])
        assert gap < ball.model.length


@pytest.mark.parametrize("what", ["horse", "elephant", "cow"])
def test_a_rider_sits_on_the_back_with_a_leg_on_each_side(what: str) -> None:
    rider, mount = act("ride", "man", what).actors
    back = top_heights(mount.model.parts(Pose(0.0, 0.0, 0.0, "stand")), np.zeros(1), np.zeros(1))
    for time_s in (0.0, 1.3):
        to_mount = np.linalg.inv(np.vstack([mount.trajectory.at(time_s).to_world(), [0, 0, 0, 1]]))
        seat = to_mount @ [*rider.anchor("seat", time_s)[:, 3], 1.0]
        assert seat[2] == pytest.approx(back[0], abs=CONTACT_M)
        assert abs(seat[1]) < CONTACT_M
        feet = [
            (to_mount @ [*rider.anchor(f"{side} foot", time_s)[:, 3], 1.0])[1]
            for side in ("left", "right")
        ]
        assert feet[0] > 0.15 > -0.15 > feet[1]


def test_the_rider_of_a_bicycle_is_the_one_that_its_model_brings() -> None:
    scene = act("ride", "man", "bicycle")
    assert [actor.noun.name for actor in scene.actors] == ["bicycle"]
    assert set(scene.class_names) >= {1}


def test_hands_stay_at_the_back_of_what_is_pushed() -> None:
    pusher, box = act("push", "man", "box").actors
    gaps = []
    for time_s in (0.0, 0.8, 1.9):
        ahead = pusher.trajectory.at(time_s).to_world()[:, 0]
        hand = pusher.anchor("right hand", time_s)[:, 3]
        back = box.trajectory.at(time_s).to_world()[:, 3] - 0.5 * box.model.length * ahead
        gaps.append(float((back - hand) @ ahead))
    np.testing.assert_allclose(gaps, gaps[0], atol=CONTACT_M)
    assert 0.0 <= gaps[0] < 0.05
    assert box.trajectory.at(2.0).distance_m > 0.8


def test_what_is_pulled_follows_at_the_end_of_its_rope() -> None:
    puller, box = act("pull", "man", "box").actors
    assert box.tether is not None
    for time_s in (0.0, 1.7):
        to_world = box.trajectory.at(time_s).to_world()
        rope = box.tether.draw(to_world, time_s).to_body
        ends = [rope @ [0.0, 0.0, end, 1.0] for end in (-1.0, 1.0)]
        hand = puller.anchor("right hand", time_s)[:, 3]
        assert to_world @ [*ends[0], 1.0] == pytest.approx(hand, abs=1e-6)


def test_a_kite_hangs_on_the_string_of_who_flies_it() -> None:
    child, kite = act("hold", "child", "kite", motion=ObjectMotion("run", "left")).actors
    assert kite.tether is not None
    assert middle(kite, 1.0)[2] > 1.8
    assert child.anchor("right hand", 1.0)[2, 3] > 0.8


@pytest.mark.parametrize("noun", ["table", "sofa", "chair", "bed", "bench"])
def test_things_rest_on_the_surface_of_furniture(noun: str) -> None:
    scene = stage(
        SceneObject("cup", count=2),
        SceneObject(noun),
        acts=(Relation("on", 0, (1,)),),
        place="indoor",
    )
    furniture = next(actor for actor in scene.actors if actor.noun.name == noun)
    height = find_support(furniture.model).height
    for actor in scene.actors[:2]:
        assert actor.trajectory.at(0.0).position[2] == pytest.approx(height)


def test_the_surface_of_a_table_is_its_top_and_of_a_sofa_its_seat() -> None:
    table = NOUNS["table"].build(colour=None, scale=1.0, seed=0)
    sofa = NOUNS["sofa"].build(colour=None, scale=1.0, seed=0)
    assert find_support(table).height == pytest.approx(table.height, rel=0.02)
    assert 0.4 * sofa.height < find_support(sofa).height < 0.7 * sofa.height


@pytest.mark.parametrize("noun", ["chair", "sofa", "bench"])
def test_who_sits_has_the_seat_under_the_hips(noun: str) -> None:
    sitter = SceneObject("man", motion=ObjectMotion("sit"))
    scene = stage(sitter, SceneObject(noun), acts=(Relation("on", 0, (1,)),))
    man, seat = scene.actors
    assert man.trajectory.at(0.0).activity == "sit"
    hips = man.anchor("torso", 0.0)[2, 3]
    assert 0.02 < hips - find_support(seat.model).height < 0.15
    assert man.anchor("right foot", 0.0)[2, 3] > 0.0


def test_what_is_in_a_box_looks_out_of_it() -> None:
    scene = stage(SceneObject("ball"), SceneObject("box", scale=1.5),
                  acts=(Relation("in", 0, (1,)),))  # fmt: skip
    ball, box = scene.actors
    top = box.model.height
    low = ball.trajectory.at(0.0).position[2]
    assert low < top < low + ball.model.height


def test_a_person_on_a_horse_rides_it() -> None:
    scene = stage(SceneObject("man"), SceneObject("horse", motion=ObjectMotion("run", "right")),
                  acts=(Relation("on", 0, (1,)),))  # fmt: skip
    man, horse = scene.actors
    travelled = man.anchor("seat", 2.0)[:, 3] - man.anchor("seat", 0.0)[:, 3]
    assert travelled[0] > 1.0
    assert horse.is_mover


def test_who_plays_with_a_ball_that_the_prompt_names_kicks_it() -> None:
    player = SceneObject("child", motion=ObjectMotion("kick"))
    _, ball = stage(player, SceneObject("football"), acts=()).actors
    assert np.linalg.norm(middle(ball, 1.9) - middle(ball, 0.0)) > 1.0


@pytest.mark.parametrize(
    ("what", "place"), [("hat", "crown"), ("glasses", "face"), ("tie", "torso")]
)
def test_what_is_worn_goes_with_the_body(what: str, place: str) -> None:
    man, worn = act("wear", "man", what, motion=WALK_RIGHT).actors
    gaps = [np.linalg.norm(middle(worn, t) - man.anchor(place, t)[:, 3]) for t in (0.0, 0.6, 1.5)]
    assert max(gaps) < 0.45
    np.testing.assert_allclose(gaps, gaps[0], atol=1e-9)


def test_a_worn_shirt_is_the_colour_of_the_body_s_own() -> None:
    scene = stage(SceneObject("man"), SceneObject("shirt", colour="red"),
                  acts=(Relation("wear", 0, (1,)),))  # fmt: skip
    (man,) = scene.actors
    colours = {part.colour for part in man.place(0.0).parts}
    assert COLOURS["red"] in colours


def test_who_plays_a_guitar_that_the_prompt_names_holds_that_one() -> None:
    player = SceneObject("man", motion=ObjectMotion("play guitar"))
    alone = stage(player, acts=())
    named = stage(player, SceneObject("guitar"), acts=())
    assert len(alone.actors[0].props) == 1
    assert named.actors[0].props == ()
    guitar = named.actors[1]
    assert np.linalg.norm(middle(guitar, 0.5) - named.actors[0].anchor("neck", 0.5)[:, 3]) < 0.6


def test_a_piano_is_shown_once() -> None:
    player = SceneObject("man", motion=ObjectMotion("play piano"))
    scene = stage(player, SceneObject("piano"), acts=())
    assert [actor.noun.name for actor in scene.actors] == ["man"]


@pytest.mark.parametrize("board", ["skateboard", "snowboard", "surfboard"])
def test_who_rides_a_board_stands_on_it(board: str) -> None:
    rider, ridden = act("ride", "man", board).actors
    top = find_support(ridden.model).height
    for time_s in (0.0, 1.4):
        to_board = np.linalg.inv(np.vstack([ridden.trajectory.at(time_s).to_world(), [0, 0, 0, 1]]))
        for side in ("left", "right"):
            foot = to_board @ [*rider.anchor(f"{side} foot", time_s)[:, 3], 1.0]
            assert -0.01 < foot[2] - top < 0.09


@pytest.mark.parametrize("then", ["wave", "sit", "kneel", "lie", "clap", "run"])
def test_a_body_goes_over_smoothly_from_one_activity_to_the_next(then: str) -> None:
    walker = SceneObject("man", motion=ObjectMotion("walk", "right"), then=(ObjectMotion(then),))
    scene = stage(walker, acts=())
    assert scene.actors[0].pose(2.0).activity.startswith(then)
    for time_s in np.arange(0.7, 1.6, 0.011):
        before, after = (scene.primitives(float(time_s) + step) for step in (0.0, 1e-3))
        moved = np.abs(after.to_world[:, :, 3] - before.to_world[:, :, 3]).max()
        assert moved < 0.02, time_s


def test_a_ball_is_hit_with_the_racket_that_is_held() -> None:
    objects = [SceneObject(noun) for noun in ("man", "tennis ball", "tennis racket")]
    acts = (Relation("hit", 0, (1,)), Relation("hold", 0, (2,)))
    player, ball, racket = stage(*objects, acts=acts).actors
    contact_s = contact_time(DURATION_S, 0.5)
    assert player.props == ()
    assert np.linalg.norm(middle(racket, contact_s) - middle(ball, contact_s)) < 0.35


def test_what_is_thrown_towards_somebody_is_caught() -> None:
    objects = [SceneObject(noun) for noun in ("woman", "frisbee", "dog")]
    acts = (Relation("throw", 0, (1,)), Relation("towards", 0, (2,)))
    _, frisbee, dog = stage(*objects, acts=acts).actors
    gap = np.linalg.norm(middle(frisbee, 1.9) - dog.anchor("mouth", 1.9)[:, 3])
    assert gap < frisbee.model.length


def test_a_kite_that_nobody_holds_has_a_string_too() -> None:
    (kite,) = stage(SceneObject("kite", motion=ObjectMotion("fly")), acts=()).actors
    assert kite.tether is not None
    for time_s in (0.0, 1.5):
        to_world = kite.trajectory.at(time_s).to_world()
        rope = kite.tether.draw(to_world, time_s).to_body
        start = to_world @ [*(rope @ [0.0, 0.0, -1.0, 1.0]), 1.0]
        assert start == pytest.approx(kite.tether.holder, abs=1e-6)


def test_more_riders_than_bicycles() -> None:
    scene = stage(SceneObject("man", count=3), SceneObject("bicycle", count=2),
                  acts=(Relation("ride", 0, (1,)),))  # fmt: skip
    names = [actor.noun.name for actor in scene.actors]
    assert (names.count("man"), names.count("bicycle")) == (1, 2)
    assert [actor.instance for actor in scene.actors] == [1, 2, 3]
    one = stage(SceneObject("man"), SceneObject("bicycle", count=2),
                acts=(Relation("ride", 0, (1,)),))  # fmt: skip
    assert [actor.noun.name for actor in one.actors] == ["bicycle", "bicycle"]


def test_every_act_is_a_relation_and_some_happen_at_an_instant() -> None:
    kinds = set(get_args(RelationKind))
    assert SINGLE < ACTS <= kinds


@pytest.mark.parametrize("mount", ["boat", "canoe", "tractor", "wheelchair", "horse", "motorcycle"])
def test_riders_sit_apart_and_go_along(mount: str) -> None:
    scene = stage(SceneObject("man", count=2), SceneObject(mount, motion=ObjectMotion("move")),
                  acts=(Relation("ride", 0, (1,)),))  # fmt: skip
    carrier = next(one for one in scene.actors if one.noun.name == mount)
    seated = [one for one in scene.actors if isinstance(base(one), Riding)]
    assert seated
    inverse = [np.linalg.inv(np.vstack([carrier.trajectory.at(t).to_world(), [0, 0, 0, 1]]))
               for t in (0.0, 1.5)]  # fmt: skip
    for one in seated:
        places = [turn @ [*one.trajectory.at(t).position, 1.0]
                  for t, turn in zip((0.0, 1.5), inverse, strict=True)]  # fmt: skip
        np.testing.assert_allclose(places[0], places[1], atol=1e-9)
    apart = [np.linalg.norm(a.middle(0.0) - b.middle(0.0)) for a, b in pairwise(seated)]
    assert not apart or min(apart) > 0.3


def base(actor: Actor) -> Trajectory:
    """The trajectory under what the hands do meanwhile."""
    path = actor.trajectory
    return path.path if isinstance(path, Performed) else path


def test_who_rides_in_a_closed_vehicle_is_not_seen() -> None:
    scene = act("ride", "man", "bus")
    assert [actor.noun.name for actor in scene.actors] == ["bus"]


def test_what_the_rider_of_a_bicycle_has_goes_along_on_it() -> None:
    objects = [SceneObject(noun) for noun in ("man", "bicycle", "basket", "helmet")]
    acts = (Relation("ride", 0, (1,)), Relation("carry", 0, (2,)), Relation("wear", 0, (3,)))
    bicycle, basket, helmet = stage(*objects, acts=acts).actors
    for thing, low, high in ((basket, 0.7, 1.3), (helmet, 1.5, 1.9)):
        way = middle(thing, 2.0) - middle(thing, 0.0)
        np.testing.assert_allclose(way, middle(bicycle, 2.0) - middle(bicycle, 0.0), atol=1e-6)
        assert low < middle(thing, 1.0)[2] < high


def test_what_is_in_a_pushed_cart_goes_along() -> None:
    objects = [SceneObject(noun) for noun in ("man", "shopping cart", "ball")]
    acts = (Relation("push", 0, (1,)), Relation("in", 2, (1,)))
    _, cart, ball = stage(*objects, acts=acts).actors
    apart = [middle(ball, t) - middle(cart, t) for t in (0.0, 2.0)]
    np.testing.assert_allclose(apart[0], apart[1], atol=1e-9)
    assert np.linalg.norm(apart[0][:2]) < 0.5


def test_who_walks_a_dog_has_it_on_a_leash() -> None:
    walking = ObjectMotion("walk", "left")
    man, dog = stage(SceneObject("man", motion=walking), SceneObject("dog", motion=walking),
                     acts=(Relation("with", 0, (1,), way="lead"),)).actors  # fmt: skip
    assert dog.tether is not None
    gaps = [np.linalg.norm(middle(man, t) - middle(dog, t)) for t in (0.0, 1.0, 2.0)]
    np.testing.assert_allclose(gaps, gaps[0], atol=0.05)


@pytest.mark.parametrize("activity", ["hug", "shake hands", "high five"])
def test_two_who_do_it_together_face_each_other_at_arm_s_length(activity: str) -> None:
    motion = ObjectMotion(activity)
    scene = stage(SceneObject("man", motion=motion), SceneObject("woman", motion=motion), acts=())
    one, other = (actor.trajectory.at(0.0) for actor in scene.actors)
    way = np.subtract(other.position, one.position)
    assert 0.3 < np.linalg.norm(way) < 1.1
    for state, sign in ((one, 1.0), (other, -1.0)):
        heading = state.to_world()[:, 0]
        assert sign * float(way @ heading) > 0.9 * np.linalg.norm(way)


def test_who_looks_at_something_has_the_front_to_it() -> None:
    man, dog = act("look at", "man", "dog").actors
    way = middle(dog, 1.0) - middle(man, 1.0)
    heading = man.trajectory.at(1.0).to_world()[:, 0]
    assert float(way[:2] @ heading[:2]) > 0.95 * np.linalg.norm(way[:2])


@pytest.mark.parametrize("what", ["ladder", "tree"])
def test_who_climbs_goes_up_the_side_of_it(what: str) -> None:
    climber = SceneObject("man", motion=ObjectMotion("climb"))
    scene = stage(climber, SceneObject(what), acts=(Relation("on", 0, (1,)),))
    man, thing = scene.actors
    states = [man.trajectory.at(t) for t in (0.0, 1.0, 2.0)]
    assert {state.activity for state in states} == {"climb"}
    assert states[2].position[2] - states[0].position[2] > 0.4
    assert abs(states[1].pitch) < 1e-6
    assert np.hypot(*(middle(man, 1.0) - middle(thing, 1.0))[:2]) < 1.5


def test_a_child_on_a_swing_goes_with_its_board() -> None:
    sitting = SceneObject("child", motion=ObjectMotion("sit"))
    child, swing = stage(sitting, SceneObject("swing"), acts=(Relation("on", 0, (1,)),)).actors
    places = [child.middle(float(t)) for t in np.linspace(0.0, 2.0, 9)]
    assert np.linalg.norm(np.ptp(places, axis=0)) > 0.5
    assert np.hypot(*(child.middle(0.0) - swing.middle(0.0))[:2]) < 2.0

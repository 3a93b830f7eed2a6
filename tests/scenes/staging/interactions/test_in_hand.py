"""What is held tilts, sways and turns in the hand; a motion that no hand holds is refused."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import SIZE, stage
from tests.scenes.test_short_prompts import is_right, report, staged

from texvent.errors import ConfigError
from texvent_scenes.description import IndexedRelation, SceneDescription
from texvent_scenes.models.anchors import gripper_of
from texvent_scenes.models.materials import Material
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.shapes import ArticulatedModel, ball
from texvent_scenes.models.tables import trait_values
from texvent_scenes.scene_input import describe_scene
from texvent_scenes.spec.scene import Motion, Place, Relation, Scene, SceneObject
from texvent_scenes.staging.compose import compose_scene
from texvent_scenes.staging.interactions.by_hand import BY_HAND

HELD = ("checkerboard", "mug", "sign", "box")
TURNS = ("tilt", "sway", "spin", "rotate")
BONDS = [("man", "hold"), ("hand", "hold"), ("hand", "with"), ("dog", "hold")]
ROWS = [(who, kind, noun, turn) for who, kind in BONDS for noun in HELD for turn in TURNS]


def hold(who, kind, noun, *motions):
    objects = (SceneObject(who), SceneObject(noun, motions=motions))
    relation = (kind, 1, 0) if kind == "with" else (kind, 0, 1)
    scene = stage(*objects, relations=(relation,))
    found = {one.object_index: one for one in scene.actors}
    return found[0], found[1]


def turned_deg(actor, others=(0.0,)):
    """Greatest turn from time 0, degrees."""
    first = actor.track.at(0.0).to_world()[:, :3]
    turns = [actor.track.at(float(t)).to_world()[:, :3] for t in np.linspace(0.0, 1.9, 20)]
    cosines = [0.5 * (np.trace(one @ first.T) - 1.0) for one in turns]
    return math.degrees(math.acos(max(-1.0, min(1.0, *cosines))))


@for_every(ROWS)
def test_what_is_held_turns_in_the_hand_as_it_does_alone(row):
    who, kind, noun, turn = row
    motion = Motion(turn, rate_hz=0.7)
    holder, thing = hold(who, kind, noun, motion)
    (alone,) = stage(SceneObject(noun, motions=(motion,))).actors
    assert turned_deg(thing) > 3.0
    assert turned_deg(thing) == pytest.approx(turned_deg(alone), rel=0.5)
    gaps = [np.linalg.norm(thing.middle(t) - holder.middle(t)) for t in np.linspace(0.0, 1.9, 8)]
    assert max(gaps) < holder.size_m + thing.size_m


@for_every([("checkerboard", "tilt"), ("box", "tilt"), ("sign", "sway"), ("box", "sway")])
def test_hands_go_with_what_they_hold(row):
    noun, turn = row
    for who, kind in BONDS[:3]:
        holder, thing = hold(who, kind, noun, Motion(turn, rate_hz=0.7))
        places = ("palm",) if who == "hand" else ("right hand",)
        for place in places:
            own = []
            for t in np.linspace(0.0, 1.9, 8):
                axes = np.vstack([thing.track.at(t).to_world(), [0.0, 0.0, 0.0, 1.0]])
                own.append(np.linalg.solve(axes, [*holder.anchor(place, t)[:, 3], 1.0])[:3])
            assert np.ptp(own, axis=0).max() < 0.06, (who, kind)


@for_every([(who, kind, noun, gone) for who, kind in BONDS for noun in HELD
            for gone in ("fall", "bounce", "slide", "rise")])  # fmt: skip
def test_a_motion_that_no_hand_holds_is_refused_with_what_to_do(row):
    who, kind, noun, gone = row
    relations = (Relation(kind, (noun if kind == "hold" else who,)),)
    held = SceneObject(noun, motions=(Motion(gone),))
    objects = (SceneObject(who, relations=relations), held)
    if kind == "with":
        objects = (
            SceneObject(who),
            SceneObject(noun, motions=(Motion(gone),), relations=relations),
        )
    with pytest.raises(ConfigError, match=r"^objects\[1\].motions\[0\]\.kind .* leave out the"):
        describe_scene(Scene(objects=objects), NOUNS)


@pytest.mark.parametrize("field", [{"position_m": (1.0, 2.0)}, {"height_m": 1.2},
                                   {"heading_deg": 30.0}, {"placement": "left"}])  # fmt: skip
@pytest.mark.parametrize("noun", HELD[:3])
def test_the_place_of_what_is_held_is_that_of_its_holder(field, noun):
    man = SceneObject("man", relations=(Relation("hold", (noun,)),))
    with pytest.raises(ConfigError, match=r"^objects\[1\]\.\w+ has no effect: it is held: "):
        describe_scene(Scene(objects=(man, SceneObject(noun, **field))), NOUNS)


RIGHT = ["robot arm picks up a red cube", "a robotic arm lifts a bottle",
         "an industrial robot picks a box off a conveyor belt",
         "a robot arm picks up a cup from a table", "a gripper closes on an egg",
         "a robot arm is stacking blue blocks", "a manipulator places a ball on a table",
         "a robotic gripper picks up a cube and drops it in a bin", "a forklift lifts a pallet",
         "a forklift carries a box"]  # fmt: skip


@pytest.mark.parametrize("text", RIGHT)
def test_the_hand_has_the_thing_and_nothing_jumps(text):
    assert is_right(text), report(text)
    scene = staged(text)[0]
    machine = next(one for one in scene.actors if one.noun.name in trait_values("gripper"))
    thing = next(one for one in scene.actors if one.track.anchor is not None)
    instants = np.arange(0.0, 2.0, 0.02)
    hand = np.array([machine.anchor("hands", at)[:, 3] for at in instants])
    middle = np.array([thing.middle(at) for at in instants])
    assert np.abs(np.diff(middle, axis=0)).max() < 0.12
    room = 0.1 + 0.5 * thing.model.height * (not gripper_of(machine.noun.name).is_below)
    gaps = np.linalg.norm(hand - middle, axis=1)
    assert gaps.min() < room + 0.5 * thing.model.length * gripper_of(machine.noun.name).is_below
    assert machine.anchor("hands", 0.0).shape == (3, 4)


def test_what_is_stacked_rests_on_the_others():
    _, *blocks = staged("a robot arm is stacking blue blocks")[0].actors
    low = sorted(one.lowest_m(1.99) for one in blocks)
    np.testing.assert_allclose(low, np.arange(3) * blocks[0].model.height, atol=0.01)
    assert max(one.lowest_m(0.0) for one in blocks) < 1.1 * blocks[0].model.height


@pytest.mark.parametrize(("way", "share"), [("on", 1.0), ("in", 0.0)])
def test_what_is_put_on_a_box_is_on_top_and_in_it_at_its_bottom(way, share):
    scene = staged(f"a robot arm picks up a blue cube and places it {way} a green box")[0]
    (cube,) = (one for one in scene.actors if one.noun.name == "cube")
    (box,) = (one for one in scene.actors if one.noun.name.endswith("box"))
    low_m = box.lowest_m(1.99) + share * box.model.height
    assert cube.lowest_m(1.99) == pytest.approx(low_m, abs=0.06 * box.model.height)


def middles_of(who, kind, thing, habitat):
    """[times, 2, 3] where a body and a thing are, whose origin its habitat decides."""
    size = SIZES_M[thing]

    def build(*, colour, scale, seed):
        foot = 0.0 if habitat == "water" else 0.5 * size[2]
        shape = ball(Material((0.5, 0.5, 0.5)), (0.0, 0.0, foot), size)
        return ArticulatedModel([shape], is_centred=habitat == "water").scaled(scale)

    nouns = {**NOUNS, thing: replace(NOUNS[thing], build=build, habitat=habitat)}
    said = SceneDescription(
        objects=(SceneObject(who), SceneObject(thing)),
        relations=(IndexedRelation(*((kind, 0, (1,)) if who != "horse" else (kind, 1, (0,)))),),
        place=Place("grass", is_empty=True),
    )
    scene = compose_scene(said, seed=0, size=SIZE, duration_s=3.0, nouns=nouns)
    actors = sorted(scene.actors, key=lambda one: one.object_index)
    found = np.array([[one.middle(t) for one in actors] for t in np.linspace(0.0, 2.9, 9)])
    comes = kind == "ride" or (who == "hand" and kind in (*BY_HAND, "move over"))
    return found - found[:1, 1:] * comes  # to what stands where it lives


SIZES_M = {"box": (0.2, 0.25, 0.3), "hammer": (0.05, 0.04, 0.3), "mug": (0.1, 0.1, 0.12)}
BONDS_OF_ALL = ("hold", "wear", "push", "kick", "throw", "roll", "lift", "drop", "catch", "pull",
                "set down", "move over", "ride")  # fmt: skip
HOLDERS = ("man", "dog", "hand", "robot arm", "forklift")


@for_every(
    [("horse", "ride", "box"), ("hand", "hold", "mug"), ("hand", "hold", "hammer")]
    + [(who, kind, thing) for who in HOLDERS for kind in BONDS_OF_ALL for thing in SIZES_M]
)
def test_a_thing_is_where_its_holder_has_it_wherever_its_origin_is(row):
    np.testing.assert_allclose(middles_of(*row, "ground"), middles_of(*row, "water"), atol=1e-9)

"""Machines that handle things: the hand is where the thing is; the report tells what is shown."""

import numpy as np
import pytest
from tests.scenes.test_short_prompts import is_right, report, staged

from texvent_scenes.models.anchors import gripper_of
from texvent_scenes.models.tables import trait_values

RIGHT = [
    "robot arm picks up a red cube",
    "a robotic arm lifts a bottle",
    "an industrial robot picks a box off a conveyor belt",
    "a robot arm picks up a cup from a table",
    "a gripper closes on an egg",
    "a robot arm is stacking blue blocks",
    "a manipulator places a ball on a table",
    "a robotic gripper picks up a cube and drops it in a bin",
    "a forklift lifts a pallet",
    "a forklift carries a box",
]


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

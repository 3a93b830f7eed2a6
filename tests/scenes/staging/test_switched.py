"""What switches from one state to another at a stated time is in the other one from then on."""

import itertools

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import place

from texvent_scenes.models.activities import ANIMAL_ACTIVITIES
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.scene_input import describe_scene
from texvent_scenes.spec.scene import Motion, Scene, SceneObject

SWITCHED = [(noun.name, kind) for noun in NOUNS.values() for kind in sorted(noun.acts)
            if ANIMAL_ACTIVITIES[kind].to_state]  # fmt: skip


def show(noun, *motions, duration_s=2.0):
    one = SceneObject(noun, motions=motions)
    describe_scene(Scene(objects=(one,)), NOUNS)
    return place(one, duration_s=duration_s)[0]


def light(actor, time_s):
    return np.array([one.emission for one in actor.place(time_s).parts])


def test_lights_switch():
    assert {kind for _, kind in SWITCHED} >= {"turn green", "turn amber", "turn red"}


@for_every(itertools.product(SWITCHED, (False, True), (0.4, 1.0, 1.7), (2.0, 3.0)))
def test_a_state_changes_at_the_time_that_is_stated(row):
    (noun, kind), is_said, start_s, duration_s = row
    act = ANIMAL_ACTIVITIES[kind]
    motions = (Motion(act.from_state),) * is_said + (Motion(kind, start_s=start_s),)
    actor = show(noun, *motions, duration_s=duration_s)
    before, after = (
        light(show(noun, Motion(state), duration_s=duration_s), 0.5)
        for state in (act.from_state, act.to_state)
    )
    assert not np.allclose(before, after)
    for time_s in (0.0, 0.5 * start_s, start_s - 1e-6):
        np.testing.assert_array_equal(light(actor, time_s), before)
    for time_s in (start_s, start_s + 0.05, duration_s - 1e-6):
        np.testing.assert_array_equal(light(actor, time_s), after)


@for_every(itertools.product(SWITCHED, (0.6, 1.1)))
def test_a_state_lasts_up_to_the_next(row):
    (noun, kind), start_s = row
    others = [one for name, one in SWITCHED if name == noun and one != kind]
    for other in others:
        motions = (Motion(kind, start_s=start_s), Motion(other, start_s=start_s + 0.5))
        actor = show(noun, *motions)
        states = [light(actor, t) for t in (start_s, start_s + 0.499, start_s + 0.5, 1.99)]
        np.testing.assert_array_equal(states[0], states[1])
        np.testing.assert_array_equal(states[2], states[3])
        assert not np.allclose(states[1], states[2])


def test_without_a_time_a_light_is_seen_before_and_after_it_turns():
    (noun, kind), *_ = SWITCHED
    actor = show(noun, Motion(kind))
    assert not np.allclose(light(actor, 0.0), light(actor, 1.9))
    assert pytest.approx(light(actor, 0.0)) == light(actor, 0.3)

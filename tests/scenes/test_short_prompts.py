"""Short prompts as people write them: each mechanism in three unrelated sentences at least."""

from functools import cache

import numpy as np
import pytest

from texvent.sensor import SensorSize
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.staged_prompt import stage

SIZE = SensorSize(173, 130)


@cache
def staged(text):
    """The staged scene of a sentence, and its report."""
    nouns = list_nouns()
    scene = understand(text, nouns)
    return stage(scene, scene.words, nouns, seed=0, size=SIZE, duration_s=2.0)


@cache
def report(text):
    return ProceduralGenerator(ProceduralConfig(duration=2.0), size=SIZE).report(text)


def is_right(text):
    """Whether the report has no fault."""
    said = report(text)
    return not (said.not_understood or said.not_shown or said.out_of_view or said.substituted)


def parts(actor, time_s):
    return np.array([part.to_body for part in actor.own_parts(actor.pose(time_s))])


@pytest.mark.parametrize(
    "text",
    ["a door opens slowly", "a drawer slides open", "the fridge opens", "a laptop closes",
     "a box opens after 0.5 s", "a woman opens a window", "a boy shuts the oven"],
)  # fmt: skip
def test_what_opens_or_closes_turns_or_slides_its_own_parts(text):
    actor = staged(text)[0].actors[-1]
    first, last = parts(actor, 0.0), parts(actor, 2.0)
    assert np.abs(last - first).max() > 0.1 * actor.size_m
    assert is_right(text)


@pytest.mark.parametrize(
    ("text", "other"),
    [("an open door", "a closed door"), ("the laptop is open", "the laptop is closed"),
     ("a cat beside an open box", "a cat beside a closed box")],
)  # fmt: skip
def test_open_and_closed_of_what_opens_are_two_states_that_last(text, other):
    one, two = (staged(each)[0].actors[-1] for each in (text, other))
    np.testing.assert_array_equal(parts(one, 0.0), parts(one, 2.0))
    assert np.abs(parts(one, 0.0) - parts(two, 0.0)).max() > 0.1 * one.size_m
    assert is_right(text)
    assert is_right(other)


@pytest.mark.parametrize("text", ["an open hammer", "a closed dog", "a chair opens"])
def test_nothing_else_opens(text):
    assert {"open", "closed", "opens"} & {*report(text).not_understood}


def test_an_act_begins_when_it_is_said_and_takes_longer_slowly():
    usual, late, slow = (
        staged(text)[0].actors[0]
        for text in ("a door opens", "a door opens after 1 s", "a door opens slowly")
    )
    np.testing.assert_allclose(parts(usual, 0.5), parts(late, 1.5))
    np.testing.assert_allclose(parts(usual, 0.5), parts(slow, 1.0))
    np.testing.assert_array_equal(parts(late, 0.0), parts(late, 1.0))


@pytest.mark.parametrize(
    "text",
    ["a man walks through a door", "a dog runs through a doorway", "a cat walks through the door"],
)
def test_who_goes_through_a_door_finds_it_open(text):
    assert is_right(text)

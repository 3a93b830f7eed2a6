"""Small things that the prompt puts nowhere are in a hand or on a table, and large enough."""

from __future__ import annotations

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.description import SceneObject
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.projection import project
from texvent.scenes.staging.compose import compose_scene
from texvent.scenes.staging.placement.fitting import enlarge_small, extent
from texvent.scenes.staging.placement.tables.tabletop import set_on_table
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)


def placed(prompt: str) -> set[tuple[str, str, str]]:
    """Relations of a prompt's objects after small things have found their place, by noun."""
    found = set_on_table(parse_prompt(prompt), NOUNS)
    names = [one.noun for one in found.objects]
    return {(names[r.subject], r.kind, names[t]) for r in found.relations for t in r.targets}


def test_several_small_things_are_put_on_a_table_before_the_people() -> None:
    assert placed("A woman stands in a kitchen, three tomatoes, two plates.") == {
        ("tomato", "on", "table"), ("plate", "on", "table"), ("table", "front", "woman"),
    }  # fmt: skip


def test_a_table_that_is_named_takes_them() -> None:
    found = set_on_table(parse_prompt("A man stands. A desk. Two cups."), NOUNS)
    assert [one.noun for one in found.objects] == ["man", "desk", "cup"]
    assert ("cup", "on", "desk") in placed("A man stands. A desk. Two cups.")


def test_a_single_thing_is_held_by_who_is_named_before_it() -> None:
    assert placed("A woman stands. A cup.") == {("woman", "hold", "cup")}


@pytest.mark.parametrize("prompt", ["Two cups.", "A cat and two cups.", "A dog chases a ball."])
def test_without_people_nothing_is_added(prompt) -> None:
    description = parse_prompt(prompt)
    assert set_on_table(description, NOUNS) == description


def test_what_the_prompt_places_stays_there() -> None:
    assert ("cup", "on", "chair") in placed("A cup on a chair beside a woman.")


def test_small_things_beside_large_ones_are_up_to_1_8_times_as_large() -> None:
    description = parse_prompt("A man holds an apple.")
    apple = next(n for n, one in enumerate(description.objects) if one.noun == "apple")
    grown = enlarge_small(description, NOUNS)
    assert grown.objects[apple].scale == pytest.approx(1.8)
    assert extent(grown.objects[apple], NOUNS) == pytest.approx(
        1.8 * extent(SceneObject("apple"), NOUNS), rel=0.01
    )
    small = parse_prompt("A man holds a small apple.")
    assert enlarge_small(small, NOUNS).objects == small.objects
    alone = parse_prompt("An apple and a cup.")
    assert enlarge_small(alone, NOUNS).objects == alone.objects


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("A woman holds a cup.", "cup"),
        ("A man stands at night, three candles, a cake.", "candle"),
        ("A girl stands in a kitchen. Two plates.", "plate"),
    ],
)
def test_the_camera_comes_near_for_small_things(prompt, noun) -> None:
    scene = compose_scene(parse_prompt(prompt), seed=0, size=SIZE, duration_s=1.0)
    thing = next(one for one in scene.actors if one.noun.name == noun)
    image = project(scene.camera(0.5), SIZE, thing.corners(0.5))
    assert np.all(image[:, 2] > 0.0)
    extents = np.ptp(image[:, :2], axis=0) / [SIZE.width, SIZE.height]
    assert np.sqrt(np.prod(extents)) > 0.08
    person = next(one for one in scene.actors if one.noun.name in ("woman", "man", "girl"))
    head = project(scene.camera(0.5), SIZE, person.anchor("head", 0.5)[None, :, 3])[0]
    assert 0.0 < head[0] < SIZE.width
    assert 0.0 < head[1] < SIZE.height


def test_what_an_activity_holds_comes_on_no_table() -> None:
    description = set_on_table(parse_prompt("a man reads a book"), NOUNS)
    assert not any(one.noun == "table" for one in description.objects)


@pytest.mark.parametrize("noun", ["microwave", "tv"])
def test_an_appliance_in_a_room_stands_on_a_table(noun: str) -> None:
    assert (noun, "on", "table") in placed(f"a {noun} in a room")
    assert not placed(f"a {noun} on a lawn")

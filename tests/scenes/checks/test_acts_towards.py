"""Acts on other things: who overtakes, throws at, sits at, writes on or enters something."""

import numpy as np
import pytest
from tests.scenes.checks.test_words import check, report, told
from tests.scenes.staged import DURATION_S, stage, thing

from texvent_scenes.checks.body_boxes import BodyBoxes
from texvent_scenes.checks.relations import find_violations
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.scene_input import understand


@pytest.mark.parametrize(
    "text",
    [
        "a horse overtakes a dog that runs left",
        "a van overtakes a bus on a road",
        "runners run to the right while a cyclist overtakes them",
    ],
)
def test_who_overtakes_goes_the_same_way(text):
    word = "overtakes"
    check(text, word, is_shown=True)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("a man walks to the left and a woman walks to the right beside him", "beside"),
        ("a car drives left and a van that drives right overtakes it", "overtakes"),
        ("a man runs right and a dog runs left next to him", "next to"),
    ],
)
def test_two_that_go_apart_do_not_overtake_follow_or_accompany(text, word):
    assert word not in report(text).shown


def test_two_on_a_seesaw_sit_at_its_ends_and_go_up_in_turn():
    objects = thing("child", ("sit",), count=2), thing("seesaw", ("work",))
    first, second = stage(*objects, relations=(("on", 0, 1),)).actors[:2]
    places = [[one.middle(at) for at in (0.3, 0.9)] for one in (first, second)]
    assert 2.0 < np.linalg.norm(places[0][0] - places[1][0]) < 3.0
    risen = [float((last - begun)[2]) for begun, last in places]
    assert risen[0] * risen[1] < 0.0


@pytest.mark.parametrize("kind", ["walk", "run"])
@pytest.mark.parametrize("nouns", [("girl", "woman"), ("man", "dog"), ("cat", "horse", "cow")])
def test_those_on_foot_go_the_same_way_unless_it_is_said(nouns, kind):
    objects = [thing(noun, (kind,)) for noun in nouns]
    ways = [one.middle(DURATION_S) - one.middle(0.0) for one in stage(*objects).actors]
    assert all(way @ ways[0] > 0.0 for way in ways)
    objects[1] = thing(nouns[1], (kind, "left"))
    objects[0] = thing(nouns[0], (kind, "right"))
    ways = [one.middle(DURATION_S) - one.middle(0.0) for one in stage(*objects).actors]
    assert ways[1] @ ways[0] < 0.0


@pytest.mark.parametrize(
    "text", ["a woman walks beside a boy", "a man runs next to a dog", "a cow walks beside a horse"]
)
def test_who_is_walked_beside_walks_too(text):
    assert told(text) == ""
    assert "stand" not in str(report(text).scene)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("a woman points at a car", "at"),
        ("a man waves to a woman", "to"),
        ("a girl waves at a dog", "at"),
        ("a boy throws a ball at a hoop", "at"),
        ("a girl rolls a ball to a dog", "to"),
        ("a man kicks a football at a wall", "at"),
    ],
)
def test_who_points_waves_or_throws_is_turned_to_the_target(text, word):
    check(text, word, is_shown=True)


@pytest.mark.parametrize("yaw", [0.0, 1.0, 2.5])
def test_what_is_thrown_behind_the_thrower_is_not_thrown_at_something(yaw):
    """A body that faces along `yaw`, another one ahead of it, and one behind."""
    way = np.array([np.cos(yaw), np.sin(yaw), 0.0])
    still, line = np.zeros((5, 1)), np.linspace(0.0, 1.0, 5)[:, None]

    def body(middle):
        """A cube of 0.2 m."""
        parts = np.stack([middle[:1] - 0.1, middle[:1] + 0.1], axis=1)
        ahead = np.tile(way[:2], (5, 1))
        size = np.full((5, 3), 0.2)
        return BodyBoxes(middle, size, middle, middle[-1] - middle[0], parts, ahead)

    def violations(turn, flown):
        bodies = [still * way, flown * line * way, 4.0 * turn + still * way]
        said = understand("a boy throws a ball towards a tree", NOUNS)
        return [one.value for one in find_violations(said, [[body(one)] for one in bodies])]

    assert "towards" not in violations(way, 3.0)
    assert "towards" in violations(-way, -3.0), "it faces away"
    assert "towards" in violations(way, -3.0), "it flies away"
    assert "towards" in violations(way, 1.0), "it falls short"


@pytest.mark.parametrize(
    ("text", "is_shown"),
    [
        ("a woman sits at a piano", True),
        ("a boy sits at a drum", False),
        ("a man sits at a keyboard", False),
        ("a man sits at a desk", True),
        ("a girl sits at a table", True),
        ("two men sit at a table", True),
        ("a woman sits at a fire", True),
    ],
)
def test_who_sits_at_a_thing_that_has_a_seat_is_on_one(text, is_shown):
    check(text, "at", is_shown)


@pytest.mark.parametrize(
    "text",
    ["a man writes on a whiteboard", "a woman writes on a sign", "a man claps on a fence"],
)
def test_nobody_stands_on_what_is_upright_to_do_something_on_it(text):
    assert "on" not in report(text).shown
    assert "on the" in told(text)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a woman gets in a taxi", "gets in", True),
        ("a cat enters a building", "enters", True),
        ("a man gets into a van", "gets into", True),
        ("a man enters a room", "enters", False),
        ("a dog enters a forest", "enters", False),
        ("a car enters a city", "enters", False),
        ("a man gets into an airplane", "gets into", False),  # which is out of view
        ("a woman gets on a horse", "gets on", False),
        ("a man gets in a glorp", "gets in", False),
    ],
)
def test_who_enters_something_goes_into_a_thing_in_view(text, word, is_shown):
    check(text, word, is_shown)

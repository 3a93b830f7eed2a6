"""Acts on other things: who overtakes, throws at, sits at, writes on or enters something."""

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.staged import DURATION_S, stage, thing
from tests.scenes.test_short_prompts import is_right, report

from texvent.sensor import SensorSize
from texvent_scenes.checks.clip.body_boxes import BodyBoxes
from texvent_scenes.checks.clip.relation_rules import RULES
from texvent_scenes.checks.clip.relations import find_violations
from texvent_scenes.description import Claim
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.staged_prompt import stage as stage_prompt


def test_two_on_a_seesaw_sit_at_its_ends_and_go_up_in_turn():
    objects = thing("child", ("sit",), count=2), thing("seesaw", ("work",))
    first, second = stage(*objects, relations=(("on", 0, 1),)).actors[:2]
    places = [[one.middle(at) for at in (0.3, 0.9)] for one in (first, second)]
    assert 2.0 < np.linalg.norm(places[0][0] - places[1][0]) < 3.0
    risen = [float((last - begun)[2]) for begun, last in places]
    assert risen[0] * risen[1] < 0.0


@pytest.mark.parametrize(
    ("text", "kind"),
    [("two kids on swings in the park", "work"), ("children on a seesaw", "work"),
     ("a dog runs past a girl on a swing", "work"), ("a girl on a swing reads a book", "stand"),
     ("a man jumps off a swing", "stand"), ("an empty swing", "stand")],
)  # fmt: skip
def test_a_swing_swings_who_only_sits_on_it_and_the_report_says_so(text, kind):
    said = understand(text, NOUNS)
    (seat,) = (one for one in said.objects if one.noun in ("swing", "seesaw"))
    assert seat.motion.kind == kind
    assert any("swings who is on it" in one for one in said.notes) == (kind == "work")


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
    assert is_right(text)
    assert "stand" not in str(report(text).scene)


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


def claim(word, kind, text):
    """The report of a scene of whose first object something is claimed that nobody said."""
    nouns = list_nouns()
    scene = replace(understand(text, nouns), claims=(Claim(word, kind, "", 0),))
    return stage_prompt(
        scene, scene.words, nouns, seed=0, size=SensorSize(173, 130), duration_s=2.0
    )[1]


@pytest.mark.parametrize("text", ["a truck drives", "a car turns", "a parked bus"])
def test_what_goes_along_its_heading_does_not_reverse(text):
    assert "reverses" in claim("reverses", "reverse", text).not_shown


@pytest.mark.parametrize(
    ("x_m", "is_so"), [(-0.3, (True, True)), (0.3, (False, True)), (1.5, (False, False))]
)
def test_who_goes_into_something_ends_between_its_parts(x_m, is_so):
    """A ball that rolls to x, into a goal whose net is behind its posts, and a box around x = 0."""
    way = np.array([[5.0, 0.0, 0.1], [x_m, 0.0, 0.1]])
    ball = BodyBoxes(way, np.full((2, 3), 0.2), way, way[1] - way[0], way[:1, None] + [[0.0]])
    for (low, high), held in zip([(-1.2, 0.0), (-1.0, 1.0)], is_so, strict=True):
        size = np.tile([2.4, 5.0, 2.2], (2, 1))
        parts = np.array([[[low, -2.5, 0.0], [high, 2.5, 2.2]]])
        hollow = BodyBoxes(np.zeros((2, 3)), size, way, np.zeros(3), parts)
        assert RULES["into"](ball, hollow).all() == held


@pytest.mark.parametrize(
    "text",
    ["a football rolls into a goal", "a man walks into a house", "a car drives into a garage"],
)
def test_who_goes_into_an_opening_is_inside_at_the_end(text):
    said = report(text)
    assert "into" in said.shown or "into" in " ".join(said.not_shown)
    assert "into" in said.shown or said.out_of_view


@pytest.mark.parametrize("text", ["a ball rolls", "a bird flies up", "a drone hovers"])
def test_what_does_not_come_down_does_not_fall(text):
    assert "drops" in claim("drops", "fall", text).not_shown

"""Words of what is hardly in view: acts, ways and relations, in three unrelated prompts each."""

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.test_short_prompts import report

from texvent.sensor import SensorSize
from texvent_scenes.checks.body_boxes import BodyBoxes
from texvent_scenes.checks.relation_rules import RULES
from texvent_scenes.description import Claim
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.staged_prompt import stage


def claim(word, kind, text):
    """The report of a scene of whose first object something is claimed that nobody said."""
    nouns = list_nouns()
    scene = replace(understand(text, nouns), claims=(Claim(word, kind, "", 0),))
    return stage(scene, scene.words, nouns, seed=0, size=SensorSize(173, 130), duration_s=2.0)[1]


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

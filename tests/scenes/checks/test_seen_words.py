"""Words of what is hardly in view: acts, ways and relations, in three unrelated prompts each."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from texvent.sensor import SensorSize
from texvent_scenes.checks.body_boxes import BodyBoxes
from texvent_scenes.checks.relation_rules import RULES
from texvent_scenes.description import Claim
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.staged_prompt import stage


@cache
def report(text):
    return ProceduralGenerator(ProceduralConfig(duration=2.0), size=SensorSize(173, 130)).report(
        text
    )


def claim(word, kind, text):
    """The report of a scene of whose first object something is claimed that nobody said."""
    nouns = list_nouns()
    scene = replace(understand(text, nouns), claims=(Claim(word, kind, "", 0),))
    return stage(scene, scene.words, nouns, seed=0, size=SensorSize(173, 130), duration_s=2.0)[1]


@pytest.mark.parametrize(
    ("text", "hidden", "lost", "kept"),
    [
        ("a man walks while a tram passes", "tram", ["passes"], ["man", "walks"]),
        ("a dog lies while a helicopter flies fast", "helicopter", ["flies", "fast"], ["dog"]),
        ("a cat sits on a roof", "cat", ["sits", "on"], []),
        ("a man walks under a bridge", "bridge", ["under"], ["man", "walks"]),
        ("a boy sits on a wall while a plane passes", "airplane", ["passes"], ["boy", "sits"]),
        ("a woman reads a book while a bus drives left", "bus", ["drives", "left"], ["woman"]),
    ],
)  # fmt: skip
def test_acts_and_ways_of_what_nobody_sees_are_not_shown(text, hidden, lost, kept):
    said = report(text)
    assert any(one.startswith(hidden) for one in said.out_of_view)
    told = " ".join([*said.not_shown, *said.not_understood])
    assert not {*lost} & {*said.shown}
    assert all(one in told for one in lost)
    assert {*kept} <= {*said.shown}


@pytest.mark.parametrize(
    ("text", "word", "is_so"),
    [
        ("a dog follows a tree", "follows", False),
        ("a man follows a bench", "follows", False),
        ("a car follows a house", "follows", False),
        ("a dog chases a cat", "chases", True),
        ("a car follows a truck", "follows", True),
        ("a boy runs after a ball", "runs after", True),
    ],
)
def test_who_follows_heads_for_something_that_moves(text, word, is_so):
    assert (word in report(text).shown) is is_so


@pytest.mark.parametrize(
    ("text", "word", "is_so"),
    [
        ("a truck reverses", "reverses", True),
        ("a car backs up", "backs up", True),
        ("a bus reverses, then drives forward", "reverses", True),
        ("a man walks backward", "backward", True),
        ("a fan spins backward", "backward", False),
        ("a truck drives", "reverses", False),
        ("a car turns", "reverses", False),
        ("a parked bus", "reverses", False),
    ],
)
def test_what_reverses_goes_against_its_heading(text, word, is_so):
    """Of scenes without it, the claim is made here."""
    if is_so:
        assert word in report(text).shown
        return
    assert word in claim(word, "reverse", text).not_shown


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


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("a bird lands, pecks, and flies away again", "flies away"),
        ("a man walks, stops, and sits down", "sits down"),
        ("a car drives, turns, and stops", "stops"),
    ],
)
def test_the_last_act_of_a_list_has_its_subject(text, word):
    assert word in report(text).shown


@pytest.mark.parametrize(
    "text",
    [
        "a girl reads a book while leaves fall around her",
        "a man walks while snow falls around him",
        "a dog stands while rain falls around it",
    ],
)
def test_what_comes_down_on_all_is_around(text):
    assert "around" in report(text).shown


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("a tennis ball is dropped from 2 m and bounces", "dropped"),
        ("a basketball is dropped from 3 m and bounces", "dropped"),
        ("a football drops from 1 m and bounces", "drops"),
    ],
)
def test_what_bounces_from_a_height_falls_first(text, word):
    assert word in report(text).shown


@pytest.mark.parametrize("text", ["a ball rolls", "a bird flies up", "a drone hovers"])
def test_what_does_not_come_down_does_not_fall(text):
    assert "drops" in claim("drops", "fall", text).not_shown

"""Verbs, words of speed and of movement are shown only where the picture moves as they say."""

from __future__ import annotations

import warnings
from functools import cache

import numpy as np
import pytest

from texvent.errors import TexventWarning
from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.generate.seen_things import find_evidence, image_points, look_for_things
from texvent.generate.seen_words.motion.image_motion import measure_motion
from texvent.generate.seen_words.motion.verb_senses import judge_sense
from texvent.generate.seen_words.picture import Picture
from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.report import PromptReport
from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)
DURATION_S = 2.0


@cache
def report_of(prompt: str) -> PromptReport:
    generator = ProceduralGenerator(ProceduralConfig(duration=DURATION_S), seed=0, size=SIZE)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TexventWarning)
        return generator.report(prompt)


@pytest.mark.parametrize(
    ("prompt", "word", "reason"),
    [
        ("a frog stands up", "stands up", "frog does so all the time"),
        ("a penguin sits down", "sits down", "penguin does so all the time"),
        ("a man twirls her", "twirls", "it is not done to her"),
        ("a toddler falls backwards", "backwards", "falls forwards"),
        ("a lantern hangs in the forest", "hangs", "lantern stands on the ground"),
        ("a boy draws a house", "draws", "child hardly moves"),
        ("a woman folds a towel and puts it on the shelf", "puts", "towel stays where it is"),
    ],
)
def test_a_verb_that_is_not_seen_is_named(prompt: str, word: str, reason: str) -> None:
    report = report_of(prompt)
    assert word not in report.shown
    assert f"{word} ({reason})" in report.not_shown


@pytest.mark.parametrize(
    ("prompt", "words"),
    [
        ("a man stands on the grass", {"stands"}),
        ("a man dances", {"dances"}),
        ("a hand makes a fist", {"makes", "fist"}),
        ("a girl blows out a candle", {"blows", "candle"}),
        ("a woman paints a fence", {"paints", "fence"}),
        ("water pours into a glass", {"pours", "glass"}),
        ("a woman waves", {"waves"}),
        ("a car drives fast along a road", {"drives", "fast"}),
        ("a dog runs quickly", {"runs", "quickly"}),
        ("a snail crawls slowly", {"crawls", "slowly"}),
        ("a man walks, stops and waves", {"walks", "stops", "waves"}),
        ("a man kicks a ball", {"kicks", "ball"}),
        ("people crossing the street", {"crossing", "street"}),
        ("a man stands up", {"man", "stands up"}),
        ("a dog lies down", {"dog", "lies down"}),
        ("hands typing on a keyboard", {"typing"}),
        ("a helicopter takes off", {"helicopter", "takes off"}),
        ("a train departs", {"departs"}),
        ("a car arrives and stops", {"arrives", "stops"}),
        ("a car accelerates", {"accelerates"}),
        ("an eagle circles", {"circles"}),
        ("a woman knocks on a door", {"knocks", "door"}),
    ],
)
def test_a_verb_that_is_seen_stays(prompt: str, words: set[str]) -> None:
    assert words <= set(report_of(prompt).shown)


def test_what_goes_too_slowly_is_not_fast_and_what_stands_still_does_not_go() -> None:
    description = parse_prompt("a car drives fast left")
    scene = compose_scene(description, seed=0, size=SIZE, duration_s=DURATION_S)
    assert not find_evidence(scene, description, SIZE, DURATION_S).places

    class Slowed(type(scene)):
        share = 0.13

        def primitives(self, time_s):
            return super().primitives(0.5 + self.share * time_s)

        def camera(self, time_s):  # it goes along
            return super().camera(0.5 + self.share * time_s)

    slowed = Slowed(**vars(scene))
    words = find_evidence(slowed, description, SIZE, DURATION_S).places
    assert words["fast"] == "car is not fast in the picture"
    assert "drives" not in words
    slowed.__class__.share = 0.01
    words = find_evidence(slowed, description, SIZE, DURATION_S).places
    assert words["drives"] == words["fast"] == "car hardly moves"


def test_what_is_kicked_must_move() -> None:
    description = parse_prompt("a man kicks a ball")
    scene = compose_scene(description, seed=0, size=SIZE, duration_s=DURATION_S)
    ball = next(one.instance for one in scene.actors if one.noun.name == "ball")

    class Held(type(scene)):
        def primitives(self, time_s):
            shapes, first = super().primitives(time_s), super().primitives(0.0)
            own = shapes.instance == ball
            shapes.to_world[own] = first.to_world[own]
            return shapes

    words = find_evidence(Held(**vars(scene)), description, SIZE, DURATION_S).places
    assert words["kicks"] == "ball hardly moves"


def test_motion_is_measured_in_sizes_of_the_thing() -> None:
    description = parse_prompt("a ball rolls left")
    scene = compose_scene(description, seed=0, size=SIZE, duration_s=DURATION_S)
    found = look_for_things(scene, SIZE, DURATION_S)
    picture = Picture(scene, SIZE, image_points(SIZE), found.views)
    (one,) = measure_motion(picture, [1], 0.0, DURATION_S).values()
    actor = scene.actors[0]
    way = np.linalg.norm(actor.middle(DURATION_S) - actor.middle(0.0)) / actor.model.height
    assert one.shift == pytest.approx(way, rel=0.25)
    assert one.speed * DURATION_S == pytest.approx(one.shift, rel=0.1)
    assert abs(one.lift) < 0.3
    still = measure_motion(picture, [1], 0.5, 0.5)[1]
    assert still[:5] == (0.0, 0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("prompt", "word", "fault"),
    [
        ("a man runs over a bridge", "runs", None),
        ("a man spins once", "spins", None),
        ("a man knocks", "knocks", None),
        ("a man spins him around", "spins", "it is not done to him"),
    ],
)
def test_words_after_a_verb_may_change_its_sense(prompt: str, word: str, fault: str | None) -> None:
    description = parse_prompt(prompt)
    claim = next(one for one in description.claims if one.word == word)
    assert judge_sense(claim, description) == fault

"""Words that only the staged scene tells: each check in three unrelated sentences or scenes."""

import re
from pathlib import Path

import numpy as np
import pytest
from tests.examples import one_of
from tests.scenes.test_short_prompts import is_right, report

from texvent.sensor import SensorSize
from texvent_scenes.checks.bodies.acts import is_arc
from texvent_scenes.checks.words import is_in_line
from texvent_scenes.colours import SURFACES
from texvent_scenes.models.materials import has_colour
from texvent_scenes.models.protocol import ModelPart
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.rendered_scene import Shape
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.staged_prompt import stage

TABLE = Path(__file__).with_name("words.txt").read_text(encoding="utf-8")
ROWS = re.findall(r"^([^#\n].*) => (.*?)(?:  #.*)?$", TABLE, re.MULTILINE)


@pytest.mark.long
@pytest.mark.parametrize(("text", "said"), ROWS)
def test_each_word_is_in_the_list_that_the_picture_makes_right(text, said):
    found = report(text)
    told = " ".join([*found.not_understood, *found.not_shown])
    for one in said.split(", "):
        kind, _, word = one.partition(" ")
        holds = {
            "all": is_right(text),
            "drawn": not found.not_shown,
            "lost": word not in found.shown and word in told,
            "unread": f" {word} " in f" {' '.join(found.not_understood)} ",
            "uncertain": word in found.uncertain,
            "sure": not found.uncertain,
            "seen": not found.out_of_view,
            "also": word in found.shown,
            "not": word not in found.shown,
            "hidden": any(each.startswith(word) for each in found.out_of_view),
        }
        assert holds.get(kind, one in found.shown and one not in told), (one, found)
    assert ("uncertain" in " ".join(found.lines())) == bool(found.uncertain)


def test_a_number_of_repetitions_is_that_of_the_clip():
    shown = [
        n
        for n in [*range(1, 9)][:: one_of()]
        if f"{n} times" in report(f"a woman jumps {n} times").shown
    ]
    assert len(shown) <= 1


def test_a_number_of_which_some_are_out_of_view_is_not_shown():
    text = "a child stands between two trees"
    assert ("two" in report(text).shown) == ("tree (1 of 2)" not in report(text).out_of_view)


@pytest.mark.parametrize("text", ["a ball bounces", "a man waves", "a pigeon walks"])
def test_a_clip_too_short_for_a_motion_judges_none(text):
    config = ProceduralConfig(duration=0.125)
    said = ProceduralGenerator(config, size=SensorSize(48, 36)).report(text)
    assert text.split()[-1] in said.shown


@pytest.mark.parametrize(
    ("angle", "stray", "expected"),
    [(np.pi / 2, 0.0, True), (2 * np.pi, 0.0, True), (0.5, 0.0, False), (np.pi, 0.2, False)],
)
def test_a_way_is_an_arc_if_it_stays_on_its_circle(angle, stray, expected):
    at = np.linspace(0.3, 0.3 + angle, 9)
    radius = 3.0 * (1.0 + stray * (-1.0) ** np.arange(9))
    way = np.column_stack([radius * np.cos(at) + 5.0, radius * np.sin(at) - 2.0])
    assert is_arc(way) == expected


def test_a_straight_way_is_no_arc():
    assert not is_arc(np.column_stack([np.linspace(0, 5, 9), np.linspace(1, 3, 9)]))
    assert not is_arc(np.ones((9, 2)))


@pytest.mark.parametrize(
    ("places", "expected"),
    [
        ([(0, 0), (1, 0.1), (2, -0.1), (3, 0)], True),
        ([(0, 0), (1, 1), (2, 2)], True),
        ([(0, 0), (1, 0.8), (2, 0), (3, 0.8)], False),
        ([(0, 0), (0.2, 0), (3, 0)], False),
        ([(0, 0)], False),
    ],
)
def test_a_row_is_straight_and_even(places, expected):
    assert is_in_line(np.array(places, dtype=float)) == expected


def part(colour, side):
    return ModelPart(Shape.BOX, np.hstack([side * np.eye(3), np.zeros((3, 1))]), colour)


def test_a_colour_is_that_of_enough_of_the_surface():
    large, small = part((0.8, 0.8, 0.8), 1.0), part((0.01, 0.01, 0.01), 0.2)
    assert has_colour([large, small], SURFACES["white"])
    assert not has_colour([large, small], SURFACES["black"])
    assert has_colour([large, small, small], SURFACES["black"])
    assert not has_colour([large], SURFACES["red"])


@pytest.mark.parametrize(("duration_s", "is_shown"), [(1.2, False), (2.5, True)])
def test_what_opens_and_closes_is_closed_in_the_clip(duration_s, is_shown):
    made = ProceduralGenerator(ProceduralConfig(duration=duration_s), size=SensorSize(173, 130))
    said = made.report("the doors open and close again and again")
    assert ("open and close" in said.shown) == is_shown


@pytest.mark.parametrize(
    ("text", "gait"),
    [("a horse trots on grass", "trot"), ("a dog trots along a road", "trot"),
     ("a deer runs at 4 m/s", "trot"), ("a horse gallops on grass", "run"),
     ("a dog runs along a road", "run")],
)  # fmt: skip
def test_four_footed_animals_gallop_above_the_speed_of_a_trot(text, gait):
    nouns = list_nouns()
    scene = understand(text, nouns)
    staged, *_ = stage(scene, scene.words, nouns, seed=0, size=SensorSize(173, 130), duration_s=1.0)
    assert {one.pose(0.5).activity for one in staged.actors if one.is_mover} == {gait}

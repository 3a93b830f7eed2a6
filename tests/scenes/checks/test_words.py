"""Words that only the staged scene tells: each check in three unrelated sentences or scenes."""

from functools import cache

import numpy as np
import pytest

from texvent.sensor import SensorSize
from texvent_scenes.checks.acts import is_arc
from texvent_scenes.checks.words import is_in_line
from texvent_scenes.colours import SURFACES
from texvent_scenes.models.materials import has_colour
from texvent_scenes.models.protocol import ModelPart
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.rendered_scene import Shape
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.staged_prompt import stage


@cache
def report(text):
    return ProceduralGenerator(ProceduralConfig(duration=2.0), size=SensorSize(173, 130)).report(
        text
    )


def told(text):
    """Words that are not shown, without the reasons."""
    said = report(text)
    return " ".join([*said.not_understood, *said.not_shown])


def check(text, word, is_shown):
    """That a word is in one list of the report: of those that are shown, or of the others."""
    assert (word in report(text).shown) == is_shown
    assert (word in told(text)) == (not is_shown)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a black and white football rolls", "white", True),
        ("a black and white panda sits", "black", True),
        ("a black and white cube spins", "white", False),
    ],
)
def test_a_second_colour_is_that_of_the_body(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a vase on a wooden table", "wooden", True),
        ("a cat sits under a wooden table", "wooden", True),
        ("a man in leather gloves walks", "leather", False),
        ("a brick cloud in the sky", "brick", False),
    ],
)
def test_a_material_that_a_thing_has_anyway_is_shown(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a lake at night", "at night", True),
        ("candlelight in a kitchen at night", "candlelight", False),
        ("a moonlit garden in the evening", "moonlit", False),
        ("a sunny afternoon in a park", "afternoon", True),
        ("a lizard in soft daylight from above, tight side view", "from above", False),
    ],
)
def test_a_light_or_a_view_that_another_word_takes_the_place_of_is_not_shown(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a duck swims on a pond", "swims", True),
        ("a fish swims in an aquarium", "swims", True),
        ("a surfer paddles across the lawn", "paddles", False),
        ("a boat sails on a road", "sails", False),
        ("a stack of three books", "stack of", True),
        ("a forklift carries a stack of pallets", "stack of", False),
    ],
)
def test_what_is_afloat_is_in_water_and_a_stack_is_one_on_the_other(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize("text", ["a bicycle lies on the grass", "a car lies on a road"])
def test_what_stands_upright_does_not_lie(text):
    check(text, "lies", is_shown=False)


@pytest.mark.parametrize(
    "text",
    ["a book lies on a table", "a cat lies on a sofa", "a man lies", "a bottle lies on a table",
     "a chair lies on the grass"],
)  # fmt: skip
def test_what_is_flat_or_lies_down_lies(text):
    check(text, "lies", is_shown=True)


@pytest.mark.parametrize(
    ("text", "is_shown"),
    [
        ("a drone flies in a circle around a tree", True),
        ("a cat walks in a circle", True),
        ("a boat sails in circles", True),
    ],
)
def test_a_circle_is_what_the_way_is(text, is_shown):
    check(text, next(one for one in ("in a circle", "in circles") if one in text), is_shown)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("a person claps seven times", "seven times"),
        ("a hand opens and closes 9 times", "9 times"),
        ("a cube falls on a table twice", "twice"),
    ],
)
def test_repetitions_that_a_clip_has_not_are_named(text, word):
    check(text, word, is_shown=False)


def test_a_number_of_repetitions_is_that_of_the_clip():
    shown = [n for n in range(1, 9) if f"{n} times" in report(f"a woman jumps {n} times").shown]
    assert len(shown) <= 1


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("a car drives off a bridge", "off"),
        ("a man walks into a tree", "into"),
    ],
)
def test_a_way_that_the_bodies_do_not_take_is_named(text, word):
    check(text, word, is_shown=False)


@pytest.mark.parametrize(
    ("text", "verb", "rate"),
    [
        ("a black disc spins at 3 Hz", "spins", "3 hz"),
        ("a checkerboard spins at 30 rpm", "spins", "30 rpm"),
        ("a white disc rotates quickly", "rotates", "quickly"),
    ],
)
def test_a_rate_is_shown_with_its_motion(text, verb, rate):
    shown = report(text).shown
    assert (rate in shown) == (verb in shown) == ("disc" not in text)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("two cars pass each other on a road", "each other", True),
        ("a red dog and a white dog run towards each other", "towards", True),
        ("two girls throw a ball to each other", "each other", False),
    ],
)
def test_what_is_mutual_is_so_of_both(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a fan with spinning blades", "spinning", True),
        ("a clock with a moving second hand", "moving", True),
        ("a parked car, its wheels turning", "turning", False),
    ],
)
def test_parts_that_are_said_to_move_do(text, word, is_shown):
    check(text, word, is_shown)


def test_a_number_of_which_some_are_out_of_view_is_not_shown():
    text = "a child stands between two trees"
    assert ("two" in report(text).shown) == ("tree (1 of 2)" not in report(text).out_of_view)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a pendulum swings to and fro", "to and fro", True),
        ("a metronome ticks back and forth", "back and forth", True),
        ("a fan rotates to and fro", "to and fro", False),
    ],
)
def test_what_moves_by_itself_may_go_to_and_fro(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "is_shown"),
    [
        ("a plane takes off from a runway", True),
        ("a helicopter rises from a field", True),
        ("a bear walks from a forest", False),
    ],
)
def test_what_rises_from_a_place_was_on_its_ground(text, is_shown):
    check(text, "from", is_shown)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a pigeon walks in front of a bus", "walks", False),
        ("a cat walks across a table", "walks", True),
        ("a butterfly hovers above a flower", "hovers", True),
    ],
)
def test_who_walks_is_on_the_ground_and_who_flies_is_not(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a basketball bounces", "bounces", True),
        ("a boy throws a ball and it bounces", "bounces", False),
        ("a woman walks to a chair and sits down", "sits down", True),
        ("a man sits on a chair reading a book", "reading a book", True),
        ("a skateboarder jumps over a bench", "jumps", True),
    ],
)
def test_what_is_done_is_seen_to_be_done(text, word, is_shown):
    check(text, word, is_shown)


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


@pytest.mark.parametrize("noun", ["square", "lamp"])
@pytest.mark.parametrize(("rate_hz", "is_shown"), [("0.1", False), ("1", True)])
def test_what_flashes_goes_off_in_the_clip(noun, rate_hz, is_shown):
    check(f"a {noun} flashes at {rate_hz} Hz", "flashes", is_shown)


@pytest.mark.parametrize(("duration_s", "is_shown"), [(1.2, False), (2.5, True)])
def test_what_opens_and_closes_is_closed_in_the_clip(duration_s, is_shown):
    made = ProceduralGenerator(ProceduralConfig(duration=duration_s), size=SensorSize(173, 130))
    said = made.report("the doors open and close again and again")
    assert ("open and close" in said.shown) == is_shown


@pytest.mark.parametrize(
    ("text", "gait"),
    [
        ("a horse trots on grass", "trot"),
        ("a dog trots along a road", "trot"),
        ("a deer runs at 4 m/s", "trot"),
        ("a horse gallops on grass", "run"),
        ("a dog runs along a road", "run"),
    ],
)
def test_four_footed_animals_gallop_above_the_speed_of_a_trot(text, gait):
    nouns = list_nouns()
    scene = understand(text, nouns)
    staged, *_ = stage(scene, scene.words, nouns, seed=0, size=SensorSize(173, 130), duration_s=1.0)
    assert {one.pose(0.5).activity for one in staged.actors if one.is_mover} == {gait}


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("leaves blow across a street", "across", True),
        ("smoke drifts across a field", "across", False),
        ("sparks fly past a window", "past", False),
        ("a horse gallops along a fence", "along", True),
        ("a cat walks along a fence", "along", True),
        ("a boat drifts sideways", "sideways", False),
        ("a soap bubble floats to the right", "to the right", True),
        ("a man eats an apple, a dog behind him", "behind", True),
        ("a monkey hangs from a branch", "hangs", False),
        ("stones arranged in a spiral", "spiral", False),
        ("a robot dances in a triangle", "triangle", False),
        ("the camera glides over a kitchen counter", "over", False),
        ("the camera pans over a bookshelf", "over", True),
        ("the camera moves past a fence", "past", True),
        ("the camera flies ahead and stops in front of a mug", "in front of", False),
        ("a pedestrian crossing laterally at dusk", "crossing", True),
        ("a car waits at a pedestrian crossing", "pedestrian crossing", True),
    ],
)
def test_ways_and_sides_are_shown_where_the_picture_has_them(text, word, is_shown):
    check(text, word, is_shown)


def test_what_has_a_fixed_place_does_not_rise():
    for text in ("an elevator going up", "an escalator rises", "a house floats up"):
        assert "above the ground with nothing below it" in told(text)

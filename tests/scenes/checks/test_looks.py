"""Looks that bodies have by themselves, patterns, and clothes: shown where they are to be seen."""

from functools import cache

import numpy as np
import pytest

from texvent.sensor import SensorSize
from texvent_scenes.models.materials import MATERIALS
from texvent_scenes.models.people.outfit import CLOTHES, list_props
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.shapes import bounds
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.staged_prompt import stage

from ..every_row import for_every

SIZE = SensorSize(173, 130)


@cache
def report(text):
    return ProceduralGenerator(ProceduralConfig(duration=1.0), size=SIZE).report(text)


@pytest.mark.parametrize(
    ("text", "word", "is_so"),
    [
        ("colorful kites in the sky", "colorful", True),
        ("three colored balls bouncing", "colored", True),
        ("a colorful refrigerator", "colorful", False),
        ("a round plate on a table", "round", True),
        ("a round table in a kitchen", "round", True),
        ("a round refrigerator", "round", False),
        ("a long pencil on a table", "long", True),
        ("a long sphere", "long", False),
        ("a fluffy rabbit hops", "fluffy", True),
        ("a fluffy car drives", "fluffy", False),
        ("a flat plate on a table", "flat", True),
        ("a flat tree", "flat", False),
        ("a glowing lantern at night", "glowing", True),
        ("a glowing sheep", "glowing", False),
        ("a shiny van drives", "shiny", True),
        ("a shiny sheep", "shiny", False),
    ],
)  # fmt: skip
def test_a_look_is_shown_of_what_has_it(text, word, is_so):
    said = report(text)
    assert (word in " ".join(said.shown)) is is_so
    assert (word in " ".join([*said.not_shown, *said.not_understood])) is not is_so


@pytest.mark.parametrize(
    ("text", "shown", "lost"),
    [
        ("a glass bottle on a table", {"glass", "bottle"}, set()),
        ("a glass pot on a stove", {"pot"}, {"glass"}),
        ("a cat sits behind dusty glass", {"cat"}, {"behind", "dusty", "glass"}),
        ("a cat sits behind a glass", {"behind", "glass"}, set()),
        ("a stack of books on a desk", {"stack of", "books", "on"}, set()),
        ("a pile of coins", {"coins"}, {"pile of"}),
        ("a pyramid of cups", {"cups"}, {"pyramid"}),
        ("a pyramid in the desert", {"pyramid"}, set()),
        ("a bus with two doors", {"bus"}, {"two", "doors"}),
        ("a dark tunnel", {"tunnel"}, {"dark"}),
        ("a square red box", {"red", "box"}, {"square"}),
        ("a cloudy sky over a city", {"city"}, {"cloudy"}),
        ("a fox walks in fog, mountains behind it", {"fox"}, {"mountains"}),
        ("a foggy desert with mountains in the distance", set(), {"mountains in the distance"}),
        ("a drone with blue propeller guards hovers", {"drone", "hovers"}, {"blue", "propeller"}),
        ("a horse with a white blaze trots", {"horse", "trots"}, {"white", "blaze"}),
        ("a toddler in striped pajamas sits", {"striped", "pajamas", "sits"}, set()),
        ("an empty street", {"empty", "street"}, set()),
        ("a park filled with children", {"park", "filled with", "children"}, set()),
        ("a yellow taxi with black stripes", {"yellow", "taxi"}, {"black", "stripes"}),
        ("a man in a dark suit walks", {"dark", "suit", "walks"}, set()),
        ("a woman in a red dress and a white hat walks", {"white", "hat", "walks"}, set()),
    ],
)
def test_what_no_picture_has_is_not_shown(text, shown, lost):
    said = report(text)
    assert shown <= {*said.shown, *said.uncertain}
    assert lost <= {*said.not_shown, *said.not_understood}


@pytest.mark.parametrize("text", ["a dog runs round a tree", "a man walks round the car"])
def test_round_before_a_thing_is_around_it(text):
    assert "round" not in report(text).not_understood


@for_every(("striped", "checkered", "spotted"))
def test_a_pattern_has_two_colours_far_apart_in_any_colour(name):
    for colour in ("white", "black", "yellow"):
        nouns, text = list_nouns(), f"a {colour} {name} sphere"
        scene = understand(text, nouns)
        staged, said, *_ = stage(scene, scene.words, nouns, seed=0, size=SIZE, duration_s=1.0)
        (part,) = staged.actors[0].model.parts(Pose(0.0, 0.0, 0.0, "stand"))
        assert part.texture is MATERIALS[name].texture
        assert name in " ".join(said.shown)
        assert abs(sum(part.colour) - sum(part.second_colour)) / 3.0 > 0.25


@for_every(CLOTHES)
def test_clothes_show_on_who_wears_them_in_their_colour(name):
    said = report(f"a man in a green {name} walks")
    assert {"green", "man", "walks"} <= {*said.shown}
    assert not [*said.not_understood, *said.not_shown, *said.substituted]


@pytest.mark.parametrize(
    ("text", "words", "is_so"),
    [("a man juggles four green balls", {"four", "green"}, True),
     ("a drummer plays a blue drum", {"blue"}, True),
     ("a drummer plays seven drums", {"seven"}, False),
     ("a girl in a striped dress walks", {"striped"}, True),
     ("a man in leather gloves", {"leather"}, False)],
)  # fmt: skip
def test_what_is_part_of_another_body_looks_as_is_said(text, words, is_so):
    said = report(text)
    assert words <= {*(said.shown if is_so else (*said.not_shown, *said.not_understood))}


@pytest.mark.parametrize("act", ["chop", "slice", "knead", "wipe table"])
@pytest.mark.parametrize("size", [0.7, 1.0])
def test_a_counter_is_closed_below_the_top_on_which_an_act_is_done(act, size):
    prop = list_props(act, size)[0]
    bench, counter = (prop.as_said(1, None, noun).draw(0.0) for noun in ("", "kitchen counter"))
    (low, high), (first, last) = map(bounds, (bench, counter))
    assert np.allclose([low, high], [first, last], atol=0.05)
    below = [0.64 * size, 0.2 * size, 0.4 * size]
    held = [[(bounds([one])[0] < below).all() and (bounds([one])[1] > below).all()
             for one in parts] for parts in (bench, counter)]  # fmt: skip
    assert [any(each) for each in held] == [False, True]


@pytest.mark.parametrize("count", [1, 3, 8])
def test_props_come_in_the_number_and_colour_that_is_said(count):
    (prop,) = list_props("juggle")
    drawn = prop.as_said(count, (0.0, 1.0, 0.0)).draw(0.3)
    assert [one.colour for one in drawn] == count * [(0.0, 1.0, 0.0)]
    assert len({tuple(one.to_body[:, 3]) for one in drawn}) == count

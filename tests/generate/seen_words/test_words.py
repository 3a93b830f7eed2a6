"""Words of light, weather, colour and size are shown only where the picture shows them."""

from __future__ import annotations

import warnings

import pytest

from texvent.errors import TexventWarning
from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.scenes.report import PromptReport
from texvent.sensor import SensorSize


def report_of(prompt: str) -> PromptReport:
    generator = ProceduralGenerator(ProceduralConfig(duration=2.0), seed=0, size=SensorSize(87, 65))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TexventWarning)
        return generator.report(prompt)


@pytest.mark.parametrize(
    ("prompt", "word"),
    [
        ("a dog runs up a steep slope", "slope"),
        ("a kingfisher flies over a field, backlit by the rising sun", "rising sun"),
        ("a car drives along a road with long shadows at noon", "long shadows"),
        ("a cat sits in a room at sunset", "sunset"),
        ("a glass cube spins", "glass"),
        ("a tall vase on a table", "tall"),
        ("a tiny dog runs", "tiny"),
        ("dust floats in a kitchen", "dust"),
        ("a man in a white coat walks", "coat"),
        ("table tennis rally", "table tennis"),
        ("snowy mountains behind a road", "snowy"),
        ("curls of wood fall on a table", "wood"),
        ("a boat sails and a man stands at the bow", "bow"),
        ("a pile of chairs in a room", "a pile of"),
        ("a dog runs over a field, overhead", "overhead"),
        ("a man walks behind a bar in a hall", "hall"),
        ("a man in a black apron walks left", "apron"),
        ("a beetle on sand, extreme close-up at ground level", "at ground level"),
        ("a woman dances, the camera tilts up with her and back down", "up"),
        ("a singer stands in strong light from above", "from above"),
        ("a man throws darts at a dartboard", "dartboard"),
        ("lorries drive on a motorway", "motorway"),
        ("a wheat field in the sun", "wheat field"),
        ("a sheep grazes on hills", "hills"),
        ("view from inside a car driving through a city", "car"),
        ("a woman wears a woollen hat", "woollen"),
        ("cars drive in heavy rain", "heavy rain"),
        ("snowflakes drift past a tree on an empty road", "road"),
        ("a motorboat with white sails on the sea", "sails"),
        ("a cup on a table in a kitchen, backlit", "backlit"),
        ("a boat on a lake, soft light from the left", "from the left"),
        ("a drone flies past a tall building", "tall"),
        ("waves crash against the rocks of a coast", "waves crash"),
        ("a street after a rain shower", "rain"),
        ("a dog walks in the empty night", "empty"),
    ],
)  # fmt: skip
def test_what_the_picture_does_not_show_is_named(prompt: str, word: str) -> None:
    report = report_of(prompt)
    assert word not in report.shown
    named = {one.partition(" (")[0] for one in report.not_shown} | set(report.not_understood)
    named |= {one.said for one in report.substituted}
    assert word in named or any(word.endswith(one) for one in named)


@pytest.mark.parametrize(
    ("prompt", "words"),
    [
        ("a red car drives left on a road in the rain", {"red", "car", "rain", "road"}),
        ("a white dog runs over green grass on a sunny day", {"white", "dog", "sunny"}),
        ("a car drives at night", {"car", "night"}),
        ("a man stands in thick fog", {"man", "fog"}),
        ("a small ball lies beside a big box", {"small", "ball", "big", "box"}),
        ("snow falls on a house", {"snow", "house"}),
        ("a white dog runs on a beach in warm light", {"warm", "dog"}),
        ("a man hammers in a dim workshop", {"dim"}),
        ("a cup in a kitchen, blue light", {"blue", "cup"}),
        ("a flickering candle on a table", {"flickering", "candle", "table"}),
        ("elephants on a snowy meadow before mountains", {"snowy", "meadow"}),
        ("a city skyline with tall skyscrapers", {"skyline"}),
        ("a walk up a mountain trail, first person view", {"trail"}),
        ("a man and a woman stand in front of a bicycle", {"front"}),
        ("a lamp lights the empty night in a city", {"empty", "night"}),
    ],
)  # fmt: skip
def test_what_is_plainly_seen_is_shown(prompt: str, words: set[str]) -> None:
    assert words <= set(" ".join(report_of(prompt).shown).split())


def test_of_things_that_are_not_held_the_owner_is_not_shown() -> None:
    assert "her" in report_of("a woman walks past her bicycle").not_understood
    assert "her" not in report_of("a woman rides her bicycle").not_understood


def test_what_an_act_brings_along_is_noted() -> None:
    notes = report_of("a woman plays tennis").notes
    assert any("tennis racket" in note for note in notes)


def test_a_window_of_something_is_a_window_by_itself() -> None:
    report = report_of("a woman looks out of the window of a train")
    assert "window" not in report.shown


def test_an_empty_street_is_told_by_its_kerb() -> None:
    report = ProceduralGenerator(ProceduralConfig(duration=0.5), size=SensorSize(96, 72)).report(
        "a car drives down an empty street"
    )
    assert "street" in report.shown


def test_animals_of_the_colour_of_the_ground_are_not_told_from_it() -> None:
    assert any("around it" in one for one in report_of("six giraffes in a savanna").not_shown)

"""Kinds of things, compounds that mislead, and the names of outside lists."""

from __future__ import annotations

import pytest

from texvent.errors import InputError
from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.language.vocabulary.opaque import OPAQUE_COMPOUNDS
from texvent.scenes.models.kinds import KINDS, find_kind
from texvent.scenes.models.kinds.looks import LOOKS
from texvent.scenes.models.nouns import NOUNS

from ..every_row import for_every

COCO = (
    "person", "bicycle", "car", "motorcycle", "airplane", "bus", "train", "truck", "boat",
    "traffic light", "fire hydrant", "stop sign", "parking meter", "bench", "bird", "cat", "dog",
    "horse", "sheep", "cow", "elephant", "bear", "zebra", "giraffe", "backpack", "umbrella",
    "handbag", "tie", "suitcase", "frisbee", "skis", "snowboard", "sports ball", "kite",
    "baseball bat", "baseball glove", "skateboard", "surfboard", "tennis racket", "bottle",
    "wine glass", "cup", "fork", "knife", "spoon", "bowl", "banana", "apple", "sandwich",
    "orange", "broccoli", "carrot", "hot dog", "pizza", "donut", "cake", "chair", "couch",
    "potted plant", "bed", "dining table", "toilet", "tv", "laptop", "computer mouse", "remote",
    "keyboard", "cell phone", "microwave", "oven", "toaster", "sink", "refrigerator", "book",
    "clock", "vase", "scissors", "teddy bear", "hair drier", "toothbrush",
)  # fmt: skip
WORDS = {
    word.replace("-", " "): noun.name
    for noun in NOUNS.values()
    for word in (noun.name, *noun.synonyms, *noun.plurals)
}


def read(prompt: str) -> tuple[list[str], dict[str, str], tuple[str, ...]]:
    """Nouns shown, substitutions and words that are not understood.

    A bicycle of which nothing is said is parked, which is a model of its own.
    """
    found = parse_prompt(prompt)
    said = {each.said: each.shown for each in found.substituted}
    nouns = [each.noun.removeprefix("parked ") for each in found.objects]
    return nouns, said, found.not_understood


def test_cocos_classes_are_shown() -> None:
    kinds = {word for words in KINDS.values() for word in words}
    assert len(COCO) == 80
    assert [name for name in COCO if name not in WORDS and name not in kinds] == []
    assert sum(name in WORDS for name in COCO) >= 76
    for name in COCO:
        nouns, said, lost = read(f"a {name}")
        assert len(nouns) == 1, name
        assert lost == (), name
        assert set(said.values()) <= set(nouns)


def test_every_alias_is_a_synonym_or_a_kind_of_one_noun() -> None:
    assert set(KINDS) <= set(NOUNS)
    owner: dict[str, str] = {}
    for noun, words in KINDS.items():
        for word in words:
            assert word == word.lower()
            assert owner.setdefault(word, noun) == noun, word
            assert word not in WORDS, f"{word} is a synonym too"
    assert len(owner) > 1500
    assert {word: find_kind(word) for word in owner} == owner


@for_every(sorted(KINDS))
def test_every_kind_is_shown_as_its_noun_and_named(noun: str) -> None:
    for word in KINDS[noun]:
        nouns, substituted, _ = read(f"the {word}")
        assert nouns == [noun], word
        assert substituted == {word.replace("-", " "): LOOKS.get(noun, noun)}, word


OTHERS = (
    "banjo", "mandolin", "toad", "alligator", "sea lion", "tarantula",
    "wasp", "vulture", "crystal ball", "comet", "bracelet", "moped",
    "cathedral", "viaduct", "bass guitar", "dreidel", "gramophone", "tepee", "crayon",
    "rugby ball", "athlete", "businesswoman", "geese",
    "birds of prey", "sunglasses",
)  # fmt: skip
"""What somebody who sees the model of its noun would call another thing."""


@pytest.mark.parametrize("word", OTHERS)
def test_another_thing_is_named_as_shown_by_its_noun(word: str) -> None:
    nouns, substituted, _ = read(f"the {word}")
    assert substituted == {word: nouns[0]}


@pytest.mark.parametrize(
    "word",
    ["windowsill", "bath mat", "garlic", "coffee", "marker", "crowbar", "bus driver",
     "flight attendant", "heavy bag", "shopping mall", "pipette", "apartment building", "ski boots",
     "moving walkway", "mural", "sponge", "shampoo", "risotto", "honey", "trainer", "florist"],
)  # fmt: skip
def test_an_everyday_word_is_shown_as_what_it_is_like(word: str) -> None:
    nouns, substituted, lost = read(f"the {word}")
    assert substituted == {word: nouns[0]}
    assert lost == ()


def test_what_misleads_is_neither_noun_nor_kind() -> None:
    kinds = {word for words in KINDS.values() for word in words}
    assert not set(OPAQUE_COMPOUNDS) & (set(WORDS) | kinds)
    assert len(set(OPAQUE_COMPOUNDS)) == len(OPAQUE_COMPOUNDS)


@pytest.mark.parametrize(
    ("prompt", "noun", "said"),
    [
        ("a cocker spaniel runs", "dog", "cocker spaniel"),
        ("two tiger sharks swim", "shark", "tiger sharks"),
        ("a monarch butterfly flies", "butterfly", "monarch butterfly"),
        ("a bald eagle soars", "eagle", "bald eagle"),
        ("a magnolia sways", "tree", "magnolia"),
        ("a trombone", "trumpet", "trombone"),
        ("a hatchback drives left", "car", "hatchback"),
        ("a grapefruit", "orange", "grapefruit"),
        ("a vehicle turns", "car", "vehicle"),
    ],
)
def test_a_kind_is_shown_as_its_thing_and_named(prompt: str, noun: str, said: str) -> None:
    nouns, substituted, _ = read(prompt)
    assert nouns == [noun]
    assert substituted == {said: noun}


@for_every(OPAQUE_COMPOUNDS)
def test_a_compound_that_misleads_is_not_shown_as_its_last_word(compound: str) -> None:
    try:
        nouns, _, lost = read(f"a {compound} on a rock")
    except InputError:
        return
    assert nouns == ["rock"], nouns
    assert set(compound.split()) - {"of", "the"} <= set(" ".join(lost).split())


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("a hot dog on a plate", ["hot dog", "plate"]),
        ("a water tower", ["water tower"]),
        ("a computer mouse", ["computer mouse"]),
        ("a water balloon", ["water balloon"]),
        ("a stone bridge", ["stone bridge"]),
        ("a fire engine", ["fire engine"]),
        ("a bus stops", ["bus"]),
        ("a bus stop", ["bus stop"]),
        ("a pair of scissors", ["scissors"]),
    ],
)
def test_compounds_are_read_as_one_thing(prompt: str, nouns: list[str]) -> None:
    assert read(prompt)[0] == nouns

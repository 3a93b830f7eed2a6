"""Every word of degree that the reader takes is measured in the picture, or reported."""

from __future__ import annotations

import pytest

from texvent.generate.seen_words.degrees import MEASURED_HERE, UNMEASURED
from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.language.vocabulary.motion import PACES
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Lexicon, Role
from texvent.scenes.models.nouns import NOUNS

OF_DEGREE = {Role.SIZE, Role.SHADE, Role.PACE, Role.ROAD, Role.STEEP}
MEASURED_ELSEWHERE: dict[str, tuple[str, ...]] = {
    "things": ("tiny", "miniature", "small", "little", "big", "large", "huge", "massive", "giant",
               "enormous", "gigantic", "tall", "short", "in the background", "in the foreground"),
    "verbs": ("very slowly", "slowly", "slow", "lazily", "at low speed", "gently", "gentle",
              "leisurely", "calmly", "quickly", "quick", "swiftly", "fast", "faster", "rapidly",
              "rapid", "very fast", "at top speed", "at high speed", "at full speed", "wildly",
              "speeding", *PACES[1.0]),
    "light": ("bright", "dark", "unlit", "well lit", "brightly lit", "bright day", "clear day",
              "bright sun", "bright sunlight", "long shadows", "hazy", "low sun", "full moon",
              "full of stars"),
    "lighting": ("harsh", "strong", "brilliant", "dim", "dimly lit", "low light"),
    "places": ("steep", "uphill", "downhill", "sloping", "hilly"),
    "views": ("low", "high", "close", "tight", "wide", "medium", "full", "mid", "panoramic"),
}  # fmt: skip
"""Module of `seen_words` → words that it measures."""
KNOWN = {
    word
    for table in (MEASURED_HERE, MEASURED_ELSEWHERE, UNMEASURED)
    for words in table.values()
    for word in words
}
ENGLISH = """
long tall short high low deep shallow wide narrow broad thick thin heavy light strong weak powerful
gentle soft hard harsh bright brilliant dim dull dark faint pale vivid intense slight slightly
gently softly barely hardly heavily lightly strongly brightly dimly densely dense sparse busy
crowded packed full empty quiet calm rough fierce violent wild huge large big vast enormous giant
massive small little tiny miniature great far distant close remote steep flat slow slowly fast
quickly quick rapid rapidly swift swiftly sudden suddenly flickering glowing shimmering blazing
sharp blurry clear hazy murky loud tight loose smooth bumpy winding straight curved round old new
young warm cold hot cool wet dry fresh rich plain fine
"""
WORDS = frozenset(ENGLISH.split())


def test_the_table_has_every_word_of_degree_of_the_lexicon() -> None:
    lexicon = Lexicon(NOUNS)
    found = {
        " ".join(words)
        for words, meanings in lexicon._meanings.items()
        for one in meanings
        if one.role in OF_DEGREE and one.pos in (Pos.ADJECTIVE, Pos.ADVERB)
    }
    assert found - KNOWN - {"slope"} == set()


def test_phrases_of_light_and_weather_with_a_word_of_degree_are_in_the_table() -> None:
    found = {
        " ".join(words)
        for words, meanings in Lexicon(NOUNS)._meanings.items()
        for one in meanings
        if one.role in (Role.LIGHT, Role.WEATHER, Role.CLOUDS, Role.SHADOW)
        and words[0] in WORDS
        and not one.is_plural
    }
    assert found - KNOWN == set()


@pytest.mark.parametrize("noun", ["car", "rain"])
def test_words_of_degree_that_no_picture_is_measured_by_are_not_taken(noun: str) -> None:
    taken = set()
    for word in WORDS:
        prompt = f"a cat sits beside a {word} {noun}"
        taken |= {one.word for one in parse_prompt(prompt).claims if one.word == word}
    assert taken - KNOWN == set()

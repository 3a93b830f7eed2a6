"""Sentences become scenes, and every word of them is accounted for."""

from __future__ import annotations

import time

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from tests.scenes.read.facts import PROMPTS, grade
from tests.scenes.read.words import sentences

from texvent.errors import InputError
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.read import find_noun, find_place, read
from texvent.scenes.read.draft import is_grammar
from texvent.scenes.read.lexicon import lexicon_of
from texvent.scenes.read.scenes import read_text
from texvent.scenes.read.tokens import split_prompt
from texvent.scenes.spec.data import checked_scene
from texvent.scenes.spec.description import to_description

MOST_WRONG, MOST_SILENT = 0.07, 0.03
MOST_SECONDS = 0.001
"""Mean time to read a prompt."""


def test_facts_of_short_prompts_are_right():
    graded = [(prompt["text"], *grade(prompt)) for prompt in PROMPTS]
    facts = sum(len(prompt["facts"]) for prompt in PROMPTS)
    wrong = [fact for _, faults, _ in graded for fact in faults]
    silent = [text for text, faults, is_reported in graded if faults and not is_reported]
    assert len(wrong) <= MOST_WRONG * facts, wrong
    assert len(silent) <= MOST_SILENT * len(PROMPTS), silent


words = st.sampled_from(sorted(" ".join(phrase) for phrase in lexicon_of(None).senses))
texts = st.lists(words | st.sampled_from([",", ".", "and", "the", "a", "then", "wug", "7", "2 Hz",
                                          '"STOP"', "a.png"]), max_size=14).map(" ".join)  # fmt: skip


@settings(max_examples=400, deadline=None)
@given(texts | st.text(max_size=80))
@example("a the and of")
@example("the camera. camera camera moves moves it")
def test_every_content_word_is_in_one_list_of_the_report(text):
    reading, is_empty = read_text(text)
    lists = (reading.shown, [one.said for one in reading.substituted], reading.not_understood)
    listed = [word for one in lists for word in one]
    assert len(listed) == len(set(listed))
    for token in split_prompt(text, lexicon_of(None)):
        if not token.is_sign and not is_grammar(token):
            assert token.text in listed
    assert is_empty or to_description(reading.scene).objects or reading.scene.place or True
    checked_scene(reading.scene)


def test_a_prompt_is_read_in_less_than_a_millisecond():
    prompts = [prompt["text"] for prompt in PROMPTS]
    lexicon_of(None)
    started = time.perf_counter()
    for prompt in prompts:
        read_text(prompt)
    assert (time.perf_counter() - started) / len(prompts) < MOST_SECONDS


@pytest.mark.parametrize("prompt", ["", " \n", "wug", "the of and", "xyz!?"])
def test_a_prompt_without_a_known_word_is_refused(prompt):
    with pytest.raises(InputError, match="prompt"):
        read(prompt)


def test_words_are_found_by_their_names():
    assert [find_noun(one, NOUNS) for one in ("Automobiles", "terrier", "wug")] == [
        "car", "dog", None
    ]  # fmt: skip
    assert [find_place(one) for one in ("meadows", "wug")] == ["grass", None]


@pytest.mark.parametrize(("prompt", "expected"), sentences())
def test_sentences_say(prompt, expected):
    reading, _ = read_text(prompt)
    assert say(reading) == expected


def say(reading) -> str:
    """A reading in a line, as words.toml's sentences have it."""
    from tests.scenes.read.words import say_reading

    return say_reading(reading)

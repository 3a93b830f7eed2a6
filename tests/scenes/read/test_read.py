"""Sentences become scenes, and every word of them is accounted for."""

from functools import partial

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tests.examples import examples, one_of
from tests.scenes.every_row import for_every
from tests.scenes.read.expected import (
    PROMPTS,
    grade,
    list_claims,
    read_once,
    say,
    sentences,
    stored_claims,
)

from texvent.errors import InputError
from texvent_scenes import read as reader
from texvent_scenes.models.activities import ACTIVITIES
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.people.outfit import list_props
from texvent_scenes.models.tables import read_table
from texvent_scenes.read.parsing.lexicon import lexicon_of
from texvent_scenes.read.parsing.quantities import read_height, read_quantity, read_stated
from texvent_scenes.read.parsing.tokens import split_prompt
from texvent_scenes.scene_input import list_words, read
from texvent_scenes.spec.data import checked_scene

MOST_WRONG, MOST_SILENT = 0.07, 0.03
"""Share of facts that are wrong, and of prompts that are wrong without a word in the report."""
WORDS = sorted(" ".join(phrase) for phrase in lexicon_of(None))
VOCABULARY = list_words(NOUNS)
SIGNS = [",", ".", "and", "the", "a", "then", "of", "it", "wug", "7", "2 Hz", "1e9",
         "99999999 m/s", '"STOP"', "a.png"]  # fmt: skip


def test_facts_of_short_prompts_are_right():
    graded = [(prompt["text"], *grade(prompt)) for prompt in PROMPTS]
    facts = sum(len(prompt["facts"]) for prompt in PROMPTS)
    wrong = [fact for _, faults, _ in graded for fact in faults]
    silent = [text for text, faults, is_reported in graded if faults and not is_reported]
    assert len(wrong) <= MOST_WRONG * facts, wrong
    assert len(silent) <= MOST_SILENT * len(PROMPTS), silent


@examples(300)
@given(
    st.lists(st.sampled_from(WORDS) | st.sampled_from(SIGNS), max_size=14).map(" ".join)
    | st.text(max_size=80)
)
@example("a the and of")
@example("the camera. camera camera moves moves it")
@example("without a of the no of")
@example("a dog behind a cat. the cat is behind the dog. the dog follows the dog")
@example("behind them a dog")
@example("a wug and a dog behind them, a cat with it")
@example("24 dogs, 24 cats, 24 cars, 24 trees")
@example("apple pies a 3 dof camera motion apple pies")
def test_any_text_is_read_and_each_content_word_is_in_one_list(text):
    reading = reader.read(text, NOUNS)
    lists = (reading.shown, [one.said for one in reading.substituted], reading.not_understood)
    listed = [word for one in lists for word in one]
    assert len(listed) == len(set(listed))
    compounds = " ".join(["", *listed, ""])  # "face shield"
    for token in split_prompt(text, lexicon_of(None)):
        is_told = token.text in listed or f" {token.text} " in compounds
        assert token.is_sign or token.is_grammar or is_told
    assert checked_scene(reading.scene, VOCABULARY) == reading.scene


@pytest.mark.parametrize("text", ["a dog, ", "a dog behind a cat ", "a bowl of ", "x y, and "])
def test_long_texts_are_read_too(text):
    reading = reader.read(text * (1000 // one_of()), NOUNS)
    assert checked_scene(reading.scene, VOCABULARY) == reading.scene


@pytest.mark.parametrize("prompt", ["", " \n", "wug", "the of and", "xyz!?"])
def test_a_prompt_without_a_known_word_is_refused(prompt):
    with pytest.raises(InputError, match="prompt"):
        read(prompt)


@for_every(sentences, is_quick=True)
def test_sentences_say(row):
    prompt, expected = row
    assert say(read_once(prompt)) == expected


def test_sentences_claim_what_they_claimed():
    found, stored = list_claims(), stored_claims()
    assert [*found] == [*stored]
    assert {one: found[one] for one in found if found[one] != stored[one]} == {}


@pytest.mark.parametrize(
    "text", ["a ball is dropped from {} m", "a ball falls after {} seconds", "{} dogs run"]
)
def test_a_number_beyond_all_is_not_understood(text):
    lost = reader.read(text.format("7" * 400), NOUNS).not_understood
    assert any("7" * 400 in one for one in lost)


LEXICON = lexicon_of(None)
AFTER = read_table("words", "read")["said_after"]
RANGES = {"speed_m_s": (0.0, 1000.0), "start_s": (0.0, 86_400.0)} | dict.fromkeys(
    ("height_m", "distance_m"), (0.0, 10_000.0)
)
QUANTITIES = [
    *((partial(read_quantity, lexicon=LEXICON), f"{{}} {' '.join(unit)}", *one.value)
      for unit, senses in LEXICON.items() for one in senses if one.kind == "unit"),
    *((read, f"{{}} {unit}{after}", field, factor)
      for unit, factor in AFTER["from"]["units"].items()
      for read, after, field in ((read_height, " above the ground", "height_m"),
                                 (partial(read_quantity, lexicon=LEXICON), "", "distance_m"))),
    *((read_stated, f"{first} {{}} {unit}{' height' * (first == 'at')}", how["field"], factor)
      for first, how in AFTER.items() for unit, factor in how["units"].items()),
]  # fmt: skip


@for_every(QUANTITIES, is_quick=True)
def test_a_quantity_in_any_unit_is_understood_up_to_its_bounds(row):
    read, text, field, factor = row
    least, most = RANGES.get(field, (0.001, 100_000.0))
    inside = (least + 1e-6, *np.geomspace(least + 0.01, most, 9) * (1.0 - 1e-9))
    for value in (*inside, least - 1e-6, most * 1.001):
        words = text.format(f"{value / factor:.12f}").split()
        length, said = read(words, 0) or (len(words), ())
        expected = [("adverb", (field, pytest.approx(value)))] if value in inside else []
        assert (length, list(said)) == (len(words), expected)


@pytest.mark.parametrize(
    "text",
    [
        "two cars pass each other on a road",
        "a red bus and a blue car drive towards each other",
        "two dogs run towards each other",
    ],
)
def test_things_go_to_each_other_in_opposite_directions(text):
    reading = reader.read(text, NOUNS)
    ways = [motion.direction for one in reading.scene.objects for motion in one.motions]
    assert sorted(ways) == ["left", "right"]
    assert "mutual" in {one.kind for one in reading.claims}


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("a clock with a moving second hand", "second hand"),
        ("a camera zooms in on a clock, its second hand turning", "second hand"),
        ("a fan with spinning blades", "blades"),
    ],
)
def test_parts_that_move_are_claimed_of_their_owner(text, part):
    reading = reader.read(text, NOUNS)
    assert part in reading.shown
    claims = [one for one in reading.claims if one.kind not in ("part", "seen")]
    assert [(one.kind, one.subject) for one in claims] == [("parts", 0)]


@pytest.mark.parametrize(
    ("text", "word", "is_so"),
    [
        ("a dog jumps onto a sofa and lies down", "lies down", True),
        ("a bus drives and stops", "stops", True),
        ("a fish sleeps", "sleeps", False),
    ],
)
def test_a_change_is_shown_where_something_is_before_it(text, word, is_so):
    assert (word in reader.read(text, NOUNS).shown) == is_so


@pytest.mark.parametrize(
    ("text", "nouns"),
    [
        ("a ball bounces over the stones and slides back into the lake", {"ball", "rock"}),
        ("a door opens beside the shelves and swings back", {"door", "shelf"}),
        ("a snake crawls past the logs and rolls back to the tree", {"snake", "log", "tree"}),
        ("a man with trees and swings", {"man", "tree", "swing"}),
        ("a park has benches and slides on the grass", {"bench", "slide"}),
    ],
)
def test_what_is_done_after_and_is_no_thing(text, nouns):
    assert {one.noun for one in reader.read(text, NOUNS).scene.objects} == nouns


@pytest.mark.parametrize(
    ("text", "doers"),
    [
        ("a table tennis rally between two players", {"person": 2}),
        ("a tennis match between a man and a woman", {"man": 1, "woman": 1}),
        ("a game of badminton between two robots", {"robot": 2}),
    ],
)
def test_those_between_whom_an_act_is_do_it_and_nobody_else(text, doers):
    objects = reader.read(text, NOUNS).scene.objects
    rally = [one for one in objects if any("rally" in each.kind for each in one.motions)]
    assert {one.noun: one.count for one in rally} == doers


_SHOWN_TOO = {
    "vegetables", "soup", "stew", "egg", "page", "plank", "letter", "soap bubble", "beer glass",
    "omelette", "bread", "towel", "shirt", "dress", "trousers", "uniform", "clothesline", "rug",
    "flower", "cymbal", "keyboard", "bar", "fruit", "glass",
}  # fmt: skip
"""Nouns that shapes of acts show, or whose act tells them: keys of a laptop, clothes on a board."""
_NO_THINGS = {("take a swing", "swing"), ("shadow box", "box")}


def test_words_of_acts_name_nothing_that_is_not_drawn_with_them():
    lexicon = lexicon_of(None)
    named = set()
    for name, act in ACTIVITIES.items():
        props = list_props(name)
        drawn = {word for one in props for noun in (*one.nouns, one.name)
                 for word in (noun, *noun.split())}  # fmt: skip
        for phrase in act.words if props else ():
            tokens = split_prompt(" ".join(phrase.split()[1:]), lexicon)
            nouns = [one.nouns for one in tokens if one.nouns and one.text not in drawn]
            named |= {(phrase, noun) for own in nouns if not own & drawn for noun in own}
    assert {one for one in named if one[1] not in _SHOWN_TOO} == _NO_THINGS


def test_no_participle_is_made_of_the_last_of_several_words():
    shots = [text for text, senses in LEXICON.items() if any(one.kind == "shot" for one in senses)]
    assert ("rotating", "camera") in shots
    assert not [one for one in shots if len(one) > 2 and one[-1] == "camera" and "withing" in one]

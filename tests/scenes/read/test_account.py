"""Every word of a sentence is accounted for exactly once: used and held, or named as missing."""

import itertools
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.scenes.read.phrases import ENDS, OBJECTS, RELATIONS, SUBJECTS, VERBS

from texvent.errors import InputError
from texvent.sensor import SensorSize
from texvent_scenes import read as reader
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator

FUNCTION_WORDS = frozenset(
    re.findall(
        r"\w+",
        "a an the this that these those his her its their it they them him he she and or but while "
        "as which who where when is are was were be of there then so also own",
    )
)
"""Articles, pronouns, copulas and conjunctions: all other words of a sentence are accounted for."""


def words_of(text: str) -> list[str]:
    return re.findall(r"[\w.]+", text.casefold().replace("-", " "))


def assert_accounted(text: str) -> None:
    """Words of a text against the lists of its reading."""
    reading = reader.read(text, NOUNS)
    listed = (*reading.shown, *(one.said for one in reading.substituted), *reading.not_understood)
    assert len(listed) == len(set(listed))
    told = [word for phrase in listed for word in words_of(phrase)]
    missing = [one for one in words_of(text) if one not in (*told, *FUNCTION_WORDS)]
    # "starts to spin" has no preposition, "towards the camera" is one phrase.
    assert not [one for one in missing if one not in ("to", "camera")], (text, listed)


@examples(200)
@given(st.tuples(*map(st.sampled_from, (SUBJECTS, VERBS, RELATIONS, OBJECTS, ENDS))))
def test_no_word_but_articles_copulas_and_conjunctions_is_in_no_list(parts):
    assert_accounted(" ".join(filter(None, parts)))


@pytest.mark.parametrize("relation", RELATIONS)
def test_each_relation_is_in_a_list_whatever_it_goes_to(relation):
    for verb, other in itertools.product(VERBS, OBJECTS):
        assert_accounted(f"a dog {verb} {relation} {other}")


STAGED = [
    "a man in a red jacket walks past a bench and sits on it",
    "a ball on a table next to a chair, without people",
    "a car comes down a road at high speed towards a parked truck",
    "two of three balls roll left across a narrow zorp",
    "a cat walks across a table near a sofa",
    "a robot arm above a conveyor belt in a factory",
    "a woman opens a red umbrella, a man takes off his black hat",
    "a dog jumps after 5 s",
    "a black disc spins at 2 Hz in a sunny kitchen",
    "a bottle on a desk beside a laptop",
    "three birds fly over a lighthouse in the distance",
    "a window next to a door",
    "a boat crosses a lake towards a pier where a man stands",
]


@pytest.mark.parametrize("text", STAGED)
def test_what_a_check_does_not_hold_leaves_the_shown_words_and_is_named(text):
    generator = ProceduralGenerator(ProceduralConfig(duration=1.0), size=SensorSize(96, 72))
    try:
        report = generator.report(text)
    except InputError as error:
        told = str(error)
        shown = ()
    else:
        shown = report.shown
        told = " ".join([*shown, *report.faults()])
        bare = {*report.not_shown, *report.out_of_view, *report.too_small}
        others = [*report.not_understood, *(one.said for one in report.substituted)]
        assert not {*shown} & {*bare, *others}
    assert len(shown) == len(set(shown))
    missing = [one for one in words_of(text) if one not in (*words_of(told), *FUNCTION_WORDS)]
    assert not [one for one in missing if one != "to"], told

"""Words that may mean something else, as words around them are not understood."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.scenes.evidence import Evidence, report_on
from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.language.word_claims import MANY_LOST


def doubts(prompt: str) -> dict[str, tuple[str, ...]]:
    return {claim.word: claim.lost for claim in parse_prompt(prompt).claims if claim.lost}


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        ("a red car drives left past two trees", {}),
        ("a dog swats at a ball", {}),  # a ball is one, whatever is done to it
        ("a woman has a wug and a cup", {}),
        ("a dog sits beside a wug chair", {"chair": ("wug",)}),
        ("a dog runs in a wug night", {}),  # night is night
        ("a mother koala sits", {}),
        ("a man runs slowly past a wug", {"runs": ("past",), "slowly": ("past",)}),
        ("a dog runs beside a wug", {}),
        ("a dog stands on a wug", {}),  # what rests does so whatever it rests on
        ("a dog sits on a tiled chair", {}),  # how it looks, not what it is
        ("a camel walks through the Zorbland desert", {}),
        ("a dog runs. A cat swats", {}),
        ("an ironic dog runs", {}),  # an adjective changes neither noun nor verb
    ],
)
def test_what_goes_with_a_lost_word_is_in_doubt(
    prompt: str, expected: dict[str, tuple[str, ...]]
) -> None:
    assert doubts(prompt) == expected


def test_a_noun_before_a_lost_noun_says_what_that_is_like() -> None:
    assert "piano" in doubts("A woman at a piano tournament.")
    assert not doubts("A woman at a piano.")


def test_in_a_crowded_prompt_a_lost_word_puts_verbs_and_relations_of_its_sentence_in_doubt() -> (
    None
):
    crowded = "A man, a dog, a car, a tree and a chair. A cat runs beside a table near the wug."
    assert {"runs", "beside"} <= set(doubts(crowded))
    assert not {"man", "dog", "car", "tree", "chair", "cat", "table"} & set(doubts(crowded))
    assert not doubts("A cat runs beside a table near the wug.")


def test_what_is_shown_as_something_else_is_not_in_doubt_besides() -> None:
    description = parse_prompt("a dog beside a wug vehicle")
    assert [one.said for one in description.substituted] == ["vehicle"]
    assert not doubts("a dog beside a wug vehicle")


def test_where_many_words_are_lost_what_is_said_of_things_is_in_doubt() -> None:
    few = "A red dog runs at dusk. The quarterly fiscal audit explains joint ventures."
    many = f"{few[:-1]}, monetary policy, legal theory, civic virtue and annual budgets."
    assert len(parse_prompt(many).not_understood) >= MANY_LOST
    assert doubts(few) == {}
    assert set(doubts(many)) == {"red", "runs"}


def test_the_report_lists_words_in_doubt_with_the_lost_ones() -> None:
    description = parse_prompt("a dog beside a wug chair")
    report = report_on(description, Evidence(faults={0: [None], 1: [None]}))
    assert report.shown == ("dog",)
    assert report.in_doubt == ("chair (without wug)", "beside (without wug)")
    assert not report.is_faithful
    hidden = report_on(description, Evidence(faults={0: [None], 1: ["hidden"]}))
    assert not hidden.in_doubt  # it is not in the picture at all
    assert "chair (hidden)" in hidden.not_shown


def test_a_word_that_is_lost_at_one_place_is_not_shown_as_well() -> None:
    description = parse_prompt("a baby koala sits beside her baby. A wug beside the dog swats dog")
    lost = {one.said for one in description.substituted} | set(description.not_understood)
    assert lost & set(description.shown)  # at another place
    assert not lost & set(description.report().shown)


WORDS = ("dog", "cat", "runs", "sits", "left", "wug", "swats", "on", "a", "red", "road", ".")


@given(
    st.lists(st.sampled_from(WORDS), min_size=1, max_size=12).map(lambda w: "a dog. " + " ".join(w))
)
def test_no_word_is_in_doubt_unless_another_is_lost(prompt: str) -> None:
    description = parse_prompt(prompt)
    lost = set(" ".join(description.not_understood).split())
    for claim in description.claims:
        assert set(" ".join(claim.lost).split()) <= lost

"""A word is listed as shown only if what it stands for is to be seen in the staged scene."""

from __future__ import annotations

import pytest

from texvent.scenes.evidence import Evidence, Unmet, report_on
from texvent.scenes.language.parser import parse_prompt

SEEN = [None]
PROMPT = "a huge red lorry drives left behind three seagulls"


def test_all_is_shown_if_all_is_seen() -> None:
    description = parse_prompt(PROMPT)
    report = report_on(description, Evidence(faults={0: SEEN, 1: SEEN * 3}))
    assert report == description.report()
    assert set(report.shown) == {
        "huge", "red", "lorry", "drives", "left", "behind", "three", "seagulls"
    }  # fmt: skip


@pytest.mark.parametrize(
    ("faults", "still", "shown", "not_shown"),
    [
        (
            {0: ["hidden"], 1: SEEN * 3}, (), {"three", "seagulls"},
            ("lorry (hidden)", "huge (truck hidden)", "red (truck hidden)",
             "drives (truck hidden)", "left (truck hidden)", "behind (truck hidden)"),
        ),
        (
            {0: SEEN, 1: ["too small"] * 3}, (), {"huge", "red", "lorry", "drives", "left"},
            ("seagulls (too small)", "behind (gull too small)", "three (gull too small)"),
        ),
        (
            {0: SEEN, 1: [None, "cut off", None]}, (),
            {"huge", "red", "lorry", "drives", "left", "behind", "seagulls"},
            ("1 of 3 gulls (cut off)", "three (not all gulls in view)"),
        ),
        (
            {0: SEEN, 1: SEEN * 3}, (0, 1),
            {"huge", "red", "lorry", "behind", "three", "seagulls"},
            ("drives (no motion to be seen)", "left (no motion to be seen)"),
        ),
    ],
    ids=["object", "other", "copy", "motion"],
)  # fmt: skip
def test_what_is_said_of_an_unseen_thing_is_not_shown_either(
    faults, still, shown, not_shown
) -> None:
    report = report_on(parse_prompt(PROMPT), Evidence(faults=faults, still=frozenset(still)))
    assert set(report.shown) == shown
    assert report.not_shown == not_shown
    assert not report.is_faithful


def test_of_many_four_must_be_seen_and_of_a_count_half() -> None:
    cows = parse_prompt("a herd of cows runs")
    few = report_on(cows, Evidence(faults={0: [None] * 3 + ["too small"] * 6}))
    assert "cows (too small)" in few.not_shown
    four = Evidence(faults={0: [None] * 4 + ["too small"] * 5})
    assert report_on(parse_prompt("cows run"), four).is_faithful
    assert report_on(cows, four).not_shown == ("a herd of (not all cows in view)",)
    most = report_on(cows, Evidence(faults={0: [None] * 5 + ["too small"] * 4}))
    assert most.is_faithful


def test_copies_are_counted_where_the_prompt_counts_them() -> None:
    unseen = Evidence(faults={0: [None, None, "hidden"]})
    assert report_on(parse_prompt("three dogs run"), unseen).not_shown == (
        "1 of 3 dogs (hidden)", "three (not all dogs in view)"
    )  # fmt: skip
    assert report_on(parse_prompt("dogs run"), unseen).is_faithful
    assert report_on(parse_prompt("some dogs run"), unseen).is_faithful
    few = Evidence(faults={0: [None, None, None, "hidden", "hidden"]})
    assert report_on(parse_prompt("several dogs run"), few).not_shown == (
        "several (not all dogs in view)",
    )


def test_what_no_word_names_is_no_word_that_is_lost() -> None:
    jam = parse_prompt("a bus stuck in traffic")
    faults = {index: ["hidden"] for index in range(len(jam.objects))}
    lost = report_on(jam, Evidence(faults={**faults, 0: SEEN})).not_shown
    assert len(jam.objects) > 1
    assert not lost


def test_a_plural_of_which_one_is_seen_and_adjectives_of_a_lost_noun_are_not_shown() -> None:
    one = report_on(parse_prompt(PROMPT), Evidence(faults={0: SEEN, 1: [None, "hidden", "hidden"]}))
    assert "seagulls (only one in view)" in one.not_shown
    sky = parse_prompt("red sky over a lake")
    assert "red" in report_on(sky, Evidence()).shown
    assert "red" not in report_on(sky, Evidence(places={"sky": "out of view"})).shown


def test_what_is_said_of_a_noun_in_doubt_is_in_doubt() -> None:
    report = report_on(parse_prompt("a big stage lamp behind a drummer"), Evidence())
    assert {one.partition(" (")[0] for one in report.in_doubt} == {"lamp", "big", "behind"}


def test_a_word_leaves_the_shown_ones_with_its_motion_relation_or_move() -> None:
    seen = {0: SEEN, 1: SEEN}
    turns = parse_prompt("a car turns left, then a dog runs")
    report = report_on(turns, Evidence([Unmet("car turns left", motion=(0, 0))], seen))
    assert report.shown == ("car", "dog", "runs")
    under = parse_prompt("a cat sleeps under a chair")
    report = report_on(under, Evidence([Unmet("under the chair", relation=(0, (1,)))], seen))
    assert "under" not in report.shown
    assert {"cat", "chair"} <= set(report.shown)
    pans = parse_prompt("a dog sits, the camera pans left")
    report = report_on(pans, Evidence([Unmet("camera pan left", move="pan")], {0: SEEN}))
    assert "pans" not in report.shown
    assert report.not_shown == ("camera pan left",)


def test_a_kind_that_is_not_seen_is_no_substitute() -> None:
    spaniel = parse_prompt("a spaniel runs on a beach")
    report = report_on(spaniel, Evidence(faults={0: ["cut off"]}, places={"beach": "out of view"}))
    assert report.substituted == report.shown == ()
    assert report.not_shown == (
        "spaniel (cut off)", "beach (out of view)", "runs (dog cut off)"
    )  # fmt: skip


@pytest.mark.parametrize(
    ("prompt", "shown"),
    [
        ("A video of a car, at very high resolution, with its wheels", {"car", "wheels"}),
        ("the camera looks at a dog in a kitchen with soft light", {"dog", "kitchen", "soft"}),
        ("a dog runs through the frame, without a cat", {"dog", "runs", "no cat"}),
        ("a ball on a table under a lamp", {"ball", "table", "under", "lamp"}),
    ],
)
def test_words_of_grammar_are_never_shown(prompt: str, shown: set[str]) -> None:
    assert set(parse_prompt(prompt).shown) <= shown
    assert shown - {"wheels", "under"} <= set(parse_prompt(prompt).shown)


def test_what_is_said_of_a_speck_is_not_shown() -> None:
    description = parse_prompt("a red car stands next to a tree")
    report = report_on(
        description,
        Evidence(faults={0: SEEN, 1: SEEN}, qualities={("name", 0): "too small"}),
    )
    assert not {"red", "car", "next to"} & set(report.shown)
    assert "tree" in report.shown

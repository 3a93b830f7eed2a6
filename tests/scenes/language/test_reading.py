"""What a sentence means: whose verb it is, in which order, what is reported."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from texvent.errors import InputError
from texvent.scenes.description import Picture, SceneDescription
from texvent.scenes.language.grammar.clauses import read_clauses
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.language.words.english import correct_spelling, list_verb_forms
from texvent.scenes.language.words.lexicon import Lexicon
from texvent.scenes.language.words.tagging import tag_words
from texvent.scenes.language.words.tokens import tokenize_prompt
from texvent.scenes.models.nouns import NOUNS

KNOWN = Lexicon(NOUNS)


def clauses_of(prompt: str) -> list[Clause]:
    words, _ = tag_words(tokenize_prompt(prompt), KNOWN)
    return read_clauses(words)


def who_does_what(prompt: str) -> list[tuple[str, str, str]]:
    """Subjects, verb and objects of every clause with a verb."""
    return [
        (
            " & ".join(group.text for group in clause.subjects),
            clause.verb.text,
            " & ".join(group.text for group in clause.objects),
        )
        for clause in clauses_of(prompt)
        if clause.verb is not None
    ]


@pytest.mark.parametrize(
    ("prompt", "clauses"),
    [
        (
            "a dog barks while two cats chase a mouse",
            [("dog", "barks", ""), ("two cats", "chase", "mouse")],
        ),
        ("a woman holding a baby waves from the window", [
            ("woman", "holding", "baby"), ("woman", "waves", "")]),
        ("the rabbit that eats a carrot hops away", [
            ("rabbit", "eats", "carrot"), ("rabbit", "hops", "")]),
        ("a cat crouches, wiggles its tail and leaps", [
            ("cat", "crouches", ""), ("cat", "wiggles", "tail"), ("cat", "leaps", "")]),
        ("a boat sails past, water spraying from its bow", [
            ("boat", "sails", ""), ("water", "spraying", "")]),
        ("a boat with dolphins jumping", [("dolphins", "jumping", "")]),
        ("when the light changes, the bus goes left", [
            ("light", "changes", ""), ("bus", "goes", "")]),
        ("behind the house stands a cow", [("cow", "stands", "")]),
        ("a hoop held by a boy", [("hoop", "held", "")]),
        ("a flock of birds crosses the frame", [("a flock of birds", "crosses", "frame")]),
        ("a deer stands in the road", [("deer", "stands", "")]),
        ("a chair, the light flickers", [("light", "flickers", "")]),
    ],
)  # fmt: skip
def test_a_verb_belongs_to_the_subject_of_its_own_clause(
    prompt: str, clauses: list[tuple[str, str, str]]
) -> None:
    assert who_does_what(prompt) == clauses


def motions(description: SceneDescription) -> dict[str, list[tuple[str, str | None]]]:
    return {
        one.noun: [(motion.kind, motion.direction) for motion in (one.motion, *one.then) if motion]
        for one in description.objects
    }


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        ("a car turns left, then stops", {"car": [("turn", "left"), ("stand", None)]}),
        ("a dog runs. It stops and jumps", {
            "dog": [("run", None), ("stand", None), ("jump", None)]}),
        ("a car drives left while a dog sits", {
            "car": [("drive", "left")], "dog": [("sit", None)]}),
        ("a man on a horse gallops to the right", {
            "man": [("stand", None)], "horse": [("run", "right")]}),
        ("a truck backs up", {"truck": [("reverse", None)]}),
        ("a man turns around", {"man": [("turn", "around")]}),
        ("a person does jumping jacks", {"person": [("jumping jack", None)]}),
        ("right arm clockwise", {"person": [("right arm clockwise", None)]}),
        ("hand waving", {"hand": [("wave", None)]}),
    ],
)  # fmt: skip
def test_motions_follow_each_other(
    prompt: str, expected: dict[str, list[tuple[str, str | None]]]
) -> None:
    found = motions(parse_prompt(prompt))
    assert found == expected


def test_speeds_change_and_begin_when_they_are_said_to() -> None:
    faster = parse_prompt("a car accelerates").objects[0].motion
    assert faster is not None
    assert faster.end_pace is not None
    assert faster.end_pace > faster.pace
    late = parse_prompt("after two seconds the dog jumps").objects[0].motion
    assert late is not None
    assert late.start_s == 2.0


@pytest.mark.parametrize(
    ("prompt", "shown", "reported"),
    [
        ("a unicorn shark swims", ["shark"], ("unicorn",)),
        ("a red and blue ball bounces", ["ball"], ("blue",)),
        ("a man saws a unicorn", ["man"], ("unicorn",)),
        ("a car drives through a wug", ["car"], ("through", "wug")),
        ("a statue of a horse", ["statue"], ("of", "horse")),
        ("an excavator swings its arm", ["excavator"], ("swings", "arm")),
        ("a hedgehog curls into a ball", ["hedgehog"], ("curls", "ball")),
        ("two men shake hands", ["man"], ("shake", "hands")),
        ("a baker slides a peel into an oven", ["person"], ("slides", "peel", "oven")),
    ],
)
def test_what_is_not_shown_is_reported_and_does_nothing_else(
    prompt: str, shown: list[str], reported: tuple[str, ...]
) -> None:
    if not all(noun in NOUNS for noun in shown):
        pytest.fail(f"the nouns of this test are missing: {shown}")
    description = parse_prompt(prompt)
    assert [one.noun for one in description.objects] == shown
    assert description.not_understood == reported


def test_kinds_are_shown_as_what_they_are_kinds_of_and_named() -> None:
    description = parse_prompt("a chef waves in a laboratory")
    pairs = [(one.said, one.shown) for one in description.substituted]
    assert pairs == [("chef", "person"), ("laboratory", "office")]
    assert "waves" in description.shown


def test_every_word_is_in_one_list() -> None:
    description = parse_prompt("a purple wug and a chef drive left past two trees at dusk")
    said = [one.said for one in description.substituted]
    lists = (*description.shown, *said, *description.not_understood)
    assert sorted(lists) == sorted(set(lists))
    assert set(lists) >= {"purple", "wug", "chef", "drive", "left", "two", "trees", "dusk"}


@pytest.mark.parametrize(
    ("prompt", "moves"),
    [
        ("driving through a city", [("travel", "forward", 0)]),
        ("first-person view riding a bicycle through a forest", [("travel", "forward", 0)]),
        ("the camera pans left, then tilts up at a house", [("pan", "left", 0), ("tilt", "up", 1)]),
        ("the camera turns left in a street", [("pan", "left", 0)]),
        ("the camera cranes up over a house", [("crane", "up", 0)]),
        ("the camera does not move, a dog runs", [("static", None, 0)]),
        ("tracking shot of a running dog", [("follow", None, 0)]),
        ("a car drives, zoom in", [("zoom", "in", 0)]),
    ],
)
def test_cameras(prompt: str, moves: list[tuple[str, str | None, int]]) -> None:
    shot = parse_prompt(prompt).shot
    assert [(move.kind, move.direction, move.phase) for move in shot.moves] == moves


def test_acts_bind_people_to_things() -> None:
    def acts(prompt: str) -> list[tuple[str, str, list[str]]]:
        description = parse_prompt(prompt)
        names = [one.noun for one in description.objects]
        return [(r.kind, names[r.subject], [names[t] for t in r.targets])
                for r in description.relations]  # fmt: skip

    assert acts("a girl carries a box") == [("carry", "child", ["box"])]
    assert acts("a man in a red hat waves") == [("wear", "man", ["hat"])]
    assert acts("a woman with an umbrella walks") == [("hold", "woman", ["umbrella"])]
    assert acts("a hoop held by a boy") == [("hold", "child", ["basketball hoop"])]
    assert acts("a car kicks a ball") == []


def test_pictures_by_file_squares_and_text(tmp_path: Path) -> None:
    path = tmp_path / "photo.png"
    cv2.imwrite(str(path), np.zeros((4, 6, 3), np.uint8))
    assert parse_prompt(f"a poster of {path}").objects[0].picture == Picture("file", str(path))
    board = parse_prompt("a 9x6 checkerboard tilts").objects[0]
    assert board.picture == Picture("checkerboard", "9x6")
    sign = parse_prompt('a billboard with the text "SALE 50"').objects[0]
    assert sign.picture == Picture("text", "SALE 50")
    digit = parse_prompt("the digit 7 moves right").objects[0]
    assert (digit.noun, digit.picture) == ("poster", Picture("text", "7"))
    with pytest.raises(InputError, match="does not exist"):
        parse_prompt(f"a poster of {tmp_path / 'none.png'}")


def test_spelling_is_corrected_with_a_note() -> None:
    description = parse_prompt("a bycicle drives left")
    assert description.objects[0].noun == "bicycle"
    assert any("'bycicle' is read as 'bicycle'" in note for note in description.notes)
    assert correct_spelling("lamplighter", ["lamplight", "lamplights"]) is None
    assert correct_spelling("hat", ["cat"]) is None


def test_a_prompt_in_another_language_is_refused() -> None:
    with pytest.raises(InputError, match="not to be English"):
        parse_prompt("ein Hund läuft über die Wiese")


def test_verb_forms_are_english() -> None:
    assert [word for word, _ in list_verb_forms("swim")] == [
        "swim", "swims", "swimming", "swam", "swum",
    ]  # fmt: skip


def test_lamps_blink_and_things_smoke() -> None:
    lamp = parse_prompt("a lamp flickering at 50 Hz on a table").objects[0]
    assert lamp.blink_hz == 50.0
    smoke = parse_prompt("smoke rises from a house").effects[0]
    assert (smoke.kind, smoke.source) == ("smoke", 0)
    cup = parse_prompt("a cup of steaming coffee").effects
    assert [one.kind for one in cup] == ["steam"]


def test_crossings_and_bends_of_roads() -> None:
    assert parse_prompt("a car at a junction").surroundings.road == "crossing"
    assert parse_prompt("a truck on a winding road").surroundings.road == "curved"

"""Captions: read and checked."""

import json
from pathlib import Path

import pytest

from texvent.errors import FileFormatError, InputError
from texvent_lab.nt_imagenet import images
from texvent_lab.nt_imagenet.captions import (
    CaptionCheck,
    check_captions,
    find_duplicates,
    normalised,
    read_captions,
)


def check(caption: str) -> CaptionCheck:
    return check_captions({"a": caption})["a"]


def test_captions_are_read_from_tables_and_lines(tmp_path: Path) -> None:
    table, lines = tmp_path / "a.csv", tmp_path / "a.jsonl"
    table.write_text('id,caption\na,"A tench,\nheld."\nb,Two\n')
    lines.write_text('{"id": "a", "caption": "A tench, held."}\n{"name": "b", "prompt": "Two"}\n')
    assert read_captions(table) == read_captions(lines) == {"a": "A tench, held.", "b": "Two"}
    lines.write_text('"no id"\n')
    with pytest.raises(FileFormatError, match="line 1 needs id"):
        read_captions(lines)
    lines.write_text('{"id": "a", "caption": "x"}\n{"id": "a", "caption": "y"}\n')
    with pytest.raises(FileFormatError, match="line 2 gives a another caption than before"):
        read_captions(lines)


@pytest.mark.parametrize(("words", "is_fine"), [(38, False), (39, True), (124, True), (125, False)])
def test_lengths_are_those_of_the_paper(words: int, is_fine: bool) -> None:
    found = check(" ".join(["word"] * words))
    assert found.words == words
    assert ("length" not in found.problems) == is_fine


@pytest.mark.parametrize(
    ("caption", "is_refusal"),
    [
        ("I'm sorry, but I can't help with that.", True),
        ("I’m unable to see the image.", True),
        ("As an AI, I see no picture.", True),
        ("A sorry dog that cannot stand.", False),
    ],
)
def test_refusals_are_told_from_descriptions(caption: str, is_refusal: bool) -> None:
    assert check(caption).is_refusal == is_refusal
    assert check(caption.replace("'", "’")).is_refusal == is_refusal


def test_duplicates_differ_in_case_and_punctuation_alone() -> None:
    captions = {"a": "A dog, running.", "b": "a dog running", "c": "a dog runs"}
    assert find_duplicates(captions) == [("a", "b")]
    checks = check_captions(captions)
    assert [id for id, one in checks.items() if one.is_duplicate] == ["b"]
    assert normalised("ﬁsh — Ünder  water!") == "fish ünder water"


def test_captions_are_kept_per_model_and_made_once(tmp_path, monkeypatch):
    asked = []

    def describe(path, pipeline):
        asked.append((path.stem, pipeline))
        if path.stem == "b":
            raise InputError("b is damaged")
        return f"{path.stem} by {pipeline}"

    monkeypatch.setattr(images, "_load", lambda model, device: f"{model} on {device}")
    monkeypatch.setattr(images, "_describe", describe)
    paths = {one: tmp_path / f"{one}.png" for one in "cab"}
    kept, told = tmp_path / "kept.json", []
    for model, names in (("m", "ca"), ("m", "cab"), ("n", "a"), ("m", "a")):
        some = {one: paths[one] for one in names}
        found, failures = images.make_captions(
            some, model, kept, device="cpu", progress=lambda *one: told.append(one)
        )
        assert list(found.items()) == [(one, f"{one} by {model} on cpu") for one in names
                                       if one != "b"]  # fmt: skip
        assert failures == ({"b": "b is damaged"} if "b" in names else {})
    assert [name for name, _ in asked] == ["c", "a", "b", "a"]
    assert told == [("captions", 0, 2), ("captions", 1, 2), ("captions", 0, 1), ("captions", 0, 1)]
    assert {model: [*own] for model, own in json.loads(kept.read_text()).items()} == {
        "m": ["c", "a"], "n": ["a"]
    }  # fmt: skip

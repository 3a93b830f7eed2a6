"""`texvent scenes`: words by family, assets first; the sizes of nouns; bad input in a line."""

from __future__ import annotations

import pytest
from tests.scenes.assets.glb_bar import write_bar

from texvent.cli.app import main


def test_the_list_has_families_other_names_and_assets_first(tmp_path, capsys, monkeypatch) -> None:
    monkeypatch.setenv("COLUMNS", "160")
    write_bar(tmp_path / "magic_wand.glb")
    assert main(["scenes", "--assets", str(tmp_path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].split() == ["assets", "magic", "wand"]
    car = next(line for line in lines if line.startswith("vehicles") and " car " in line)
    assert "automobile" in car


def test_a_word_lists_the_nouns_that_have_it_with_their_sizes(capsys) -> None:
    assert main(["scenes", "cube"]) == 0
    _, *rows = map(str.rstrip, capsys.readouterr().out.splitlines())
    assert any(row.split()[1] == "cube" and row.endswith("0.8 x 0.8 x 0.8 m") for row in rows)


@pytest.mark.parametrize(
    ("word", "family", "name"),
    [("strol", "", ""), ("stroll", "motion", "walk"), ("meadow", "place", "grass"),
     ("twilight", "light", "dusk"), ("dark red", "colour", "red"), ("wooden", "material", "wood"),
     ("mist", "weather", "fog"), ("pan", "camera move", "pan"), ("atop", "relation", "on")],
)  # fmt: skip
def test_all_that_a_sentence_says_can_be_looked_up(word, family, name, capsys) -> None:
    assert (main(["scenes", word]) == 0) is bool(family)
    said = capsys.readouterr()
    rows = [row.split() for row in said.out.splitlines()]
    assert any(row[: len(family.split()) + 1] == [*family.split(), name] for row in rows) or (
        "is in no list; did you mean 'stroll'" in said.err
    )


@pytest.mark.parametrize(("word", "found"), [("meadows", "grass"), ("reefs", "underwater")])
def test_a_plural_is_found_and_not_listed(word, found, capsys):
    assert main(["scenes", word]) == 0
    printed = capsys.readouterr().out
    assert found in printed
    assert word not in printed

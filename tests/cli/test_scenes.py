"""`texvent scenes`: words by family, assets first; the sizes of nouns; bad input in a line."""

import pytest

from texvent.cli.app import main


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

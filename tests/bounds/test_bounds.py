"""Fields take what they took: every number up to the same bounds, and the same pairs."""

import importlib
import math
import re
from dataclasses import dataclass
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.bounds.bounds import TABLE, Record, last_taken, lines_of, stored_table, table
from tests.bounds.words import SETTLED, stored_lines
from tests.bounds.words import lines_of as lines_of_words

from texvent.errors import ConfigError


def test_every_record_takes_what_it_took():
    """`python -m tests.bounds.bounds` writes the table anew, in an environment with torch."""
    found, stored = table(), stored_table()
    for name in {*stored} - {*found}:
        with pytest.raises(ImportError):
            importlib.import_module(name.rpartition(".")[0])
    others = {name: {*lines} ^ {*stored.get(name, ())} for name, lines in found.items()}
    assert {name: lines for name, lines in others.items() if lines} == {}


def test_every_refusal_of_a_field_is_an_error_of_an_option():
    said = re.findall(r"(?:\| |: )(\w+(?:Error|Exception)): ", TABLE.read_text(encoding="utf-8"))
    assert {*said} == {"ConfigError", "InputError"}


STATED = re.compile(r"it must be (?:at least )?([-+\d.e]+?)(?:\.\.([-+\d.e]+))?(?: [^,]*)?$")


def test_what_is_said_of_a_bound_is_what_is_taken():
    count = 0
    for line in (one for lines in stored_table().values() for one in lines):
        taken, *said = line.split(" | ")
        stated = {one.groups() if (one := STATED.search(each)) else () for each in said}
        name, _, bounds = taken.partition(": ")
        bounds = bounds.split(" .. ")
        if not bounds[1:] or len(stated) != 1 or not all(f"{name} is " in one for one in said):
            continue
        for bound, words in zip(bounds, *stated, strict=False):
            assert words is None or float(bound) == pytest.approx(float(words), 1e-5), line
            count += 1
    assert count > 200


@pytest.mark.long
@pytest.mark.parametrize("command", SETTLED)
def test_odd_words_of_options_meet_the_errors_that_they_met(command, tmp_path):
    """`python -m tests.bounds.words` writes them anew."""
    stored = [one for one in stored_lines() if re.match(rf"{re.escape(command)} --[\w-]+:", one)]
    assert [*lines_of_words(command, tmp_path)] == stored


@given(data=st.data(), kind=st.sampled_from([int, float, Fraction]))
def test_the_last_that_is_taken_is_found_to_the_last_bit(data, kind):
    start, bound = sorted(data.draw(st.lists(st.integers(-(10**9), 10**9), min_size=2, max_size=2)))
    bound, end = kind(bound), kind(10**30)
    assert last_taken(lambda one: one <= bound, kind(start), end) == bound
    assert last_taken(lambda one: -one <= bound, kind(-start), -end) == -bound
    if kind is not int:
        below = last_taken(lambda one: one < bound, kind(start - 1), end)
        assert below == math.nextafter(bound, -math.inf)


def test_a_record_is_told_by_its_bounds_and_by_what_excludes_each_other():
    @dataclass
    class Example:
        count: int
        share: float = 0.5
        is_whole: bool = False

        def __post_init__(self) -> None:
            if not (1 <= self.count < 9 and 0.0 <= self.share <= 1.0):
                raise ConfigError("beyond")
            if self.is_whole and self.share < 1.0:
                raise ConfigError("a part")

    Example.__annotations__ = {"count": int, "share": float, "is_whole": bool}
    lines = [*lines_of(Record(Example))]
    refused = "ConfigError: beyond"
    assert lines[:2] == [f"count: 1 .. 8 | {refused}", f"share: 0.0 .. 1.0 | {refused}"]
    assert [one[: one.index("(")] for one in lines[2:]] == ["share, is_whole: 1 "]
    assert lines[2].endswith("1.0, True: taken")

"""What errors echo is bounded and on one line, whatever it is."""

import numpy as np
import pytest

from texvent._registry import suggest
from texvent.errors import MAX_REASON, MAX_SHOWN, InputError, one_line, shown
from texvent.runtime.file_names import usable_path


def bomb():
    value = ["x"] * 10
    for _ in range(12):
        value = [value] * 10
    return value


@pytest.mark.parametrize(
    "value",
    ["x" * 200_000, 10**6000, bomb(), np.zeros((400, 400)), {"a" * 900: "b" * 900}, "a\nb\0"],
    ids=["text", "digits", "aliases", "array", "mapping", "lines"],
)
def test_a_value_is_shown_in_one_short_line(value):
    assert len(shown(value)) <= MAX_SHOWN
    assert len(shown(value).splitlines()) == 1


def test_short_values_are_shown_as_they_are_written():
    assert [shown(one) for one in ("v3e", 0.5, [1, "a"], np.int64(7))] == [
        "'v3e'",
        "0.5",
        "[1, 'a']",
        "7",
    ]


def test_the_words_of_a_library_are_cut_to_one_line():
    assert one_line(ValueError("one\n  two")) == "one two"
    assert one_line(ValueError()) == "ValueError"
    assert len(one_line(ValueError("x" * 5000))) == MAX_REASON


def test_a_message_is_one_line():
    assert str(InputError("one\ntwo")) == "one two"


def test_a_long_list_of_names_is_cut():
    names = tuple(f"option_{number}" for number in range(100))
    assert len(suggest("nothing", names)) < 200
    assert len(suggest("x" * 200_000, names)) < 200
    assert len(suggest(bomb(), names)) < 200


@pytest.mark.parametrize("name", ["a\0b", "n" * 256, "a/" * 2500])
def test_a_name_that_no_file_can_have_is_refused(name):
    with pytest.raises(InputError, match="is no file name"):
        usable_path(name)

"""What errors echo is bounded and on one line, whatever it is."""

import numpy as np
import pytest

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
    assert shown(value).isprintable()


def test_the_words_of_a_library_are_cut_to_one_line():
    assert one_line(ValueError("one\n  two")) == "one two"
    assert one_line(ValueError()) == "ValueError"
    assert len(one_line(ValueError("x" * 5000))) == MAX_REASON


@pytest.mark.parametrize("name", ["a\0b", "n" * 256, "a/" * 2500])
def test_a_name_that_no_file_can_have_is_refused(name):
    with pytest.raises(InputError, match="is no file name"):
        usable_path(name)

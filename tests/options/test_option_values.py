"""Values of options: converted to the declared types, and back to plain values."""

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Literal

import pytest

from texvent.errors import ConfigError
from texvent.options.values import plain, with_options


@dataclass(frozen=True, kw_only=True)
class Example:
    """An example."""

    rate: Fraction | None = None
    size: int = 3
    weight: float = 0.5
    is_on: bool = True
    mode: Literal["one", "two"] = "one"
    path: Path | None = None


def test_values_are_converted_to_the_declared_type():
    got = with_options(
        Example(),
        {"rate": "30000/1001", "size": 4.0, "weight": 2, "mode": "two", "path": "a/b"},
        where="test",
    )
    assert got == Example(
        rate=Fraction(30000, 1001), size=4, weight=2.0, mode="two", path=Path("a/b")
    )


def test_a_decimal_rate_means_what_is_written():
    assert with_options(Example(), {"rate": 29.97}, where="test").rate == Fraction(2997, 100)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"sise": 3}, "test: unknown option 'sise'; .*did you mean 'size'"),
        ({"size": 3.5}, "test: size is 3.5; it must be a whole number"),
        ({"size": True}, "whole number"),
        ({"weight": "heavy"}, "must be a number"),
        ({"is_on": 1}, "must be true or false"),
        ({"mode": "three"}, "mode is 'three'; allowed: one, two"),
        ({"rate": "1/0"}, "it must be a rate such as 24"),
    ],
)
def test_wrong_values_fail_with_what_is_allowed(options, message):
    with pytest.raises(ConfigError, match=message):
        with_options(Example(), options, where="test")


def test_plain_values_leave_out_none_and_keep_fractions_exact():
    got = plain({"a": Example(rate=Fraction(24)), "b": [Fraction(1, 3), Path("x")], "c": None})
    assert got == {
        "a": {"rate": 24, "size": 3, "weight": 0.5, "is_on": True, "mode": "one"},
        "b": ["1/3", "x"],
    }

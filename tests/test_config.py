"""Configs: one place for names, defaults, types and help."""

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Literal

import pytest

from texvent.config import (
    CaptureConfig,
    InterpolateConfig,
    RunConfig,
    option_help,
    option_names,
    plain,
    with_options,
)
from texvent.errors import ConfigError


@dataclass(frozen=True, kw_only=True)
class Example:
    """An example."""

    rate: Fraction | None = None
    """A rate,
    in two lines."""
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
        ({"rate": "1/0"}, "a number or a fraction"),
    ],
)
def test_wrong_values_fail_with_what_is_allowed(options, message):
    with pytest.raises(ConfigError, match=message):
        with_options(Example(), options, where="test")


def test_help_is_the_text_under_the_field_on_one_line():
    assert option_help(Example) == {"rate": "A rate, in two lines."}


@pytest.mark.parametrize("config_type", [RunConfig, CaptureConfig, InterpolateConfig])
def test_every_option_has_help(config_type):
    assert set(option_help(config_type)) == set(option_names(config_type))


def test_plain_values_leave_out_none_and_keep_fractions_exact():
    got = plain({"a": Example(rate=Fraction(24)), "b": [Fraction(1, 3), Path("x")], "c": None})
    assert got == {
        "a": {"rate": 24, "size": 3, "weight": 0.5, "is_on": True, "mode": "one"},
        "b": ["1/3", "x"],
    }


@pytest.mark.parametrize(
    "bad",
    [
        lambda: RunConfig(seed=-1),
        lambda: CaptureConfig(fps=Fraction(0)),
        lambda: CaptureConfig(start=2.0, stop=1.0),
        lambda: InterpolateConfig(max_intermediate=-1),
        lambda: InterpolateConfig(count_percentile=float("nan")),
    ],
)
def test_options_out_of_range_are_refused(bad):
    with pytest.raises(ConfigError, match="must be"):
        bad()

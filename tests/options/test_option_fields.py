"""What a config dataclass declares: names, former names and help."""

from dataclasses import dataclass
from typing import ClassVar

import pytest

from texvent.config import CaptureConfig, InterpolateConfig, RunConfig
from texvent.errors import ConfigError
from texvent.options.fields import (
    RemovedOption,
    RenamedOptionWarning,
    former_names,
    option_help,
    option_names,
    renamed,
    with_current_names,
)


@dataclass(frozen=True, kw_only=True)
class Example:
    """An example."""

    removed: ClassVar = {"shape": RemovedOption("round", "leave it out: all are round")}

    rate: float | None = None
    """A rate,
    in two lines."""
    size: int = renamed(3, was="side")
    """A size."""


def test_help_is_the_text_under_the_field_on_one_line():
    assert option_help(Example) == {"rate": "A rate, in two lines.", "size": "A size."}


@pytest.mark.parametrize("config_type", [RunConfig, CaptureConfig, InterpolateConfig])
def test_every_option_has_help(config_type):
    assert set(option_help(config_type)) == set(option_names(config_type))


def test_a_field_may_say_its_former_name():
    assert former_names([Example]) == {"side": "size"}
    assert Example().size == 3


def test_a_former_name_is_taken_with_a_notice():
    with pytest.warns(RenamedOptionWarning, match="test: option 'side' is now 'size'"):
        assert with_current_names({"side": 4}, [Example], where="test") == {"size": 4}


def test_both_names_of_an_option_are_refused():
    with pytest.raises(ConfigError, match="'side' is the former name of 'size', which is given"):
        with_current_names({"side": 4, "size": 4}, [Example], where="test")


def test_a_removed_option_is_taken_if_it_says_what_holds_now():
    assert with_current_names({"shape": "round", "size": 4}, [Example], where="test") == {"size": 4}
    with pytest.raises(ConfigError, match="test: shape 'square' was removed; leave it out: all"):
        with_current_names({"shape": "square"}, [Example], where="test")

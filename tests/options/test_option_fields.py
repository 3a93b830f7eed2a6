"""Options of a config dataclass: names and help."""

from dataclasses import dataclass

import pytest

from texvent._registry import SIMULATORS
from texvent.config import CaptureConfig, InterpolateConfig, RunConfig
from texvent.options.values import option_help, option_names


@dataclass(frozen=True, kw_only=True)
class Example:
    """An example."""

    rate: float | None = None
    """A rate,
    in two lines."""
    size: int = 3
    """A size."""


def test_help_is_the_text_under_the_field_on_one_line():
    assert option_help(Example) == {"rate": "A rate, in two lines.", "size": "A size."}


@pytest.mark.parametrize(
    "config_type",
    [
        RunConfig,
        CaptureConfig,
        InterpolateConfig,
        *(SIMULATORS.load(name).config_type for name in SIMULATORS.builtin),
    ],
)
def test_every_option_has_help(config_type):
    assert set(option_help(config_type)) == set(option_names(config_type))

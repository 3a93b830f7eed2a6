"""The typed keywords of the Python API are the options of the dataclasses."""

import inspect
import typing
from typing import Any, Literal

import pytest

from texvent._registry import GENERATORS, SIMULATORS
from texvent.api.functions import generate, simulate, video
from texvent.config import CaptureConfig, InterpolateConfig, RunConfig
from texvent.generation.video_models.config import DiffusersConfig
from texvent.options import keywords
from texvent.options.values import option_names

SIMULATOR_CONFIGS = [SIMULATORS.load(name).config_type for name in SIMULATORS.builtin]
GENERATOR_CONFIGS = [GENERATORS.load(name).config_type for name in GENERATORS.shipped()]


def literals(hint: Any) -> set[Any]:
    """Values of every Literal in a type."""
    inside = typing.get_args(hint)
    return (
        set(inside) if typing.get_origin(hint) is Literal else set().union(*map(literals, inside))
    )


@pytest.mark.parametrize(
    ("typed", "configs"),
    [
        (keywords.RunOptions, [RunConfig]),
        (keywords.InterpolateOptions, [InterpolateConfig]),
        (keywords.SimulatorOptions, SIMULATOR_CONFIGS),
        (keywords.CaptureOptions, [CaptureConfig]),
        (keywords.GeneratorOptions, [*GENERATOR_CONFIGS, DiffusersConfig]),
    ],
)
def test_keywords_are_the_options_of_these_classes_with_their_choices(typed, configs):
    names = {name for config in configs for name in option_names(config)}
    hints = typing.get_type_hints(typed)
    assert set(hints) - {"generator"} == names
    for name in names:
        of = (typing.get_type_hints(one).get(name) for one in configs)
        assert literals(hints[name]) == set().union(*map(literals, of)), name


def test_signatures_name_every_option():
    of_prompt, of_frames = keywords.GenerateOptions, keywords.SimulateOptions
    for function, typed in ((generate, of_prompt), (simulate, of_frames), (video, of_prompt)):
        assert set(typed.__annotations__) < set(inspect.signature(function).parameters)

"""The public names and keywords, and what importing them costs."""

import inspect
import re
import subprocess
import sys
import typing
from pathlib import Path
from typing import Any, Literal

import pytest

import texvent
from texvent._registry import GENERATORS, SIMULATORS
from texvent.api.functions import generate, simulate, video
from texvent.config import CaptureConfig, InterpolateConfig, RunConfig
from texvent.generation.video_models.config import DiffusersConfig
from texvent.options import keywords
from texvent.options.values import option_names

PUBLIC = set(texvent.__all__)
"""The lines of `__init__.pyi`, which mypy checks."""
HEAVY = ("torch", "numba", "cv2", "av", "h5py", "rich")


def loaded_by(statement: str) -> set[str]:
    code = f"{statement}\nimport sys; print(' '.join(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


def test_the_public_names_are_few_and_all_exist():
    assert {"generate", "simulate", "EventStream"} < PUBLIC
    assert len(PUBLIC) <= 40
    assert all(hasattr(texvent, name) for name in PUBLIC)
    assert set(dir(texvent)) == PUBLIC


def test_the_page_of_the_api_names_all_of_them_and_no_others():
    page = (Path(__file__).parents[2] / "docs/api.md").read_text(encoding="utf-8")
    table = page.partition("| name | gives |")[2].partition("\n\n")[0]
    rows = [row.split("|")[1] for row in table.splitlines() if row.startswith("| `")]
    named = [name for row in rows for name in re.findall(r"`(\w+)", row)]
    assert sorted(named) == sorted(PUBLIC)


def test_the_api_and_the_value_types_load_no_heavy_package():
    names = ("generate", "simulate", "video", "open", "compare", "EventStream", "EventPackets")
    loaded = loaded_by(f"import texvent; {'; '.join(f'texvent.{name}' for name in names)}")
    assert not set(HEAVY) & loaded


def test_no_module_has_the_name_of_a_function():
    modules = {path.stem for path in Path(texvent.__path__[0]).iterdir()}
    assert {name for name in PUBLIC & modules if callable(getattr(texvent, name))} == set()


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

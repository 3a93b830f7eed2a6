"""Events and files stay what they are: for a seed and options, and for events."""

import json
import os
import subprocess
import sys
from dataclasses import fields
from pathlib import Path
from typing import Any, Literal, get_args, get_origin, get_type_hints

import pytest
from tests.contract.golden import (
    EVENTS_FILE,
    FILES_FILE,
    OPTION_CASES,
    digest,
    event_cases,
    file_cases,
)

from texvent._registry import INTERPOLATORS, SIMULATORS
from texvent.config import InterpolateConfig, RunConfig

CASES = dict(event_cases())
ROOT = Path(__file__).parents[2]
IN_PRESETS = {"cache=local", "timestamp_rule=eq7"}
"""Of the preset "paper"."""


def test_golden_events_cover_all_cases() -> None:
    assert list(json.loads(EVENTS_FILE.read_text())) == list(CASES)


WITHOUT = {
    "seed": "every case has one",
    "interpolator_weights": "a file of several MB",
    "threshold_map": "a file",
    "interpolate=rife": "needs torch",
    "rife_flow=each": "needs torch",
}


def test_golden_events_have_every_switch_and_choice() -> None:
    """What is off by default, and each choice of an option: a preset may have it, or a case."""
    said = {word for name in CASES for word in name.split(" ")}
    names = {word.partition("=")[0] for word in said}
    models = [SIMULATORS.load(name) for name in SIMULATORS.builtin]
    for config_type in (RunConfig, InterpolateConfig, *(one.config_type for one in models)):
        hints = get_type_hints(config_type)
        for field in fields(config_type):
            hint = hints[field.name]
            choices = get_args(hint) if get_origin(hint) is Literal else ()
            if field.name == "interpolate":
                choices = tuple(INTERPOLATORS.builtin)
            wanted = {f"{field.name}={one}" for one in choices if one != field.default} - said
            if not field.default and field.name not in names:
                wanted.add(field.name)
            assert wanted <= {*WITHOUT, *IN_PRESETS}, wanted - {*WITHOUT, *IN_PRESETS}


def test_no_golden_of_an_option_is_that_of_another_case() -> None:
    """An option that changes nothing in its case pins nothing."""
    stored = list(json.loads(EVENTS_FILE.read_text()).values())
    for digest_of_option in stored[-len(OPTION_CASES) :]:
        assert stored.count(digest_of_option) == 1


@pytest.mark.long
def test_a_rendered_scene_has_the_same_events_on_older_processors() -> None:
    """NumPy computes powers of float32 by other code where a processor has AVX-512 or AVX2."""
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

    name = "prompt=car simulator=voltmeter interpolate=exact"
    code = "import tests.contract.golden as g; print(g.digest(N, dict(g.event_cases())[N]()))"
    newer = " ".join(one for one in __cpu_dispatch__ if __cpu_features__.get(one))
    environment = os.environ | {"NPY_DISABLE_CPU_FEATURES": newer}
    command = [sys.executable, "-c", code.replace("N", repr(name))]
    made = subprocess.run(command, env=environment, cwd=ROOT, capture_output=True, check=True)
    assert made.stdout.decode().strip() == json.loads(EVENTS_FILE.read_text())[name]


# SENPI's own threshold is high for so small a clip: most of its events are noise.
@pytest.mark.filterwarnings("ignore:only .* events are signal")
@pytest.mark.parametrize("name", CASES)
def test_golden_events_are_those_of_the_release(name: str) -> None:
    made: Any = CASES[name]()
    assert digest(name, made) == json.loads(EVENTS_FILE.read_text())[name]


def test_golden_files_are_those_of_the_release(tmp_path: Path) -> None:
    assert dict(file_cases(tmp_path)) == json.loads(FILES_FILE.read_text())

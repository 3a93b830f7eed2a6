"""Compiled kernels are kept on disk, and compiled again when anything they use changes."""

import gc
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numba
import pytest
from packaging.requirements import Requirement

from texvent.runtime.jit import jit

SOURCE = Path(__file__).parents[2] / "src" / "texvent"

ENTRY = """
from texvent.runtime.jit import jit
from kernels.inner import (
    add,
)
from kernels import limits
from kernels.limits import Limits

@jit
def run(x, limits):
    return add(x) + below(x) + limits.upper

@jit(error_model="numpy", inner=True)
def below(x):
    return 0 * x

result = run(1, Limits(limits.LIMIT))
print(result, sum(run.stats.cache_hits.values()) if hasattr(run, "stats") else 0)
"""
LIMITS = """
from typing import NamedTuple

LIMIT = 100

class Limits(NamedTuple):
    upper: int
"""
INNER = """
from texvent.runtime.jit import jit
from .steps import STEP

@jit(inline="always")
def add(x):
    return x + STEP
"""


@pytest.fixture
def package(tmp_path):
    folder = tmp_path / "kernels"
    folder.mkdir()
    files = {"__init__": "", "entry": ENTRY, "inner": INNER, "steps": "STEP = 10\n"}
    for name, text in (files | {"limits": LIMITS}).items():
        (folder / f"{name}.py").write_text(text)
    return folder


def run(package, **environment):
    """What the kernel returns in a process of its own, and how often it came from disk."""
    path = os.pathsep.join(map(str, (package.parent, SOURCE.parent)))
    command = [sys.executable, "-c", "import kernels.entry"]
    done = subprocess.run(
        command,
        # A .pyc file is taken for its source where both have one size and one second of change.
        env=os.environ | {"PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1"} | environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return tuple(map(int, done.stdout.split()))


def edit(path, before, after):
    text = path.read_text()
    assert before in text
    path.write_text(text.replace(before, after))


EDITS = (
    ("steps", "10", "20", 121),
    ("limits", "100", "200", 221),
)
"""File, text before and after, and what the kernel returns from then on."""


@pytest.mark.long
def test_a_kernel_is_compiled_again_when_a_file_that_it_uses_changes(package):
    assert run(package) == (111, 0)
    for name, before, after, result in EDITS:
        edit(package / f"{name}.py", before, after)
        assert run(package) == (result, 0)


def test_an_inner_function_is_refused_to_python():
    half = jit(inner=True)(lambda x: 0.5 * x)
    assert jit(lambda x: half(x))(3.0) == 1.5
    if hasattr(half, "py_func"):  # not with NUMBA_DISABLE_JIT=1
        with pytest.raises(TypeError, match="which only kernels call"):
            half(3.0)


def test_a_kernel_is_read_from_disk_when_other_files_change(package):
    run(package)
    (package / "other.py").write_text("A = 2\n")
    os.utime(package / "inner.py", (0, 0))
    assert run(package) == (111, 1)
    assert all(file.name.startswith("entry.run") for file in package.rglob("*.nbc"))


def test_every_kernel_of_the_library_uses_this_decorator():
    raw = re.compile(r"numba\.n?jit|from numba import .*jit")
    files = [file for file in SOURCE.parent.rglob("*.py") if file != SOURCE / "runtime" / "jit.py"]
    assert [file.name for file in files if raw.search(file.read_text("utf-8"))] == []


def test_a_kernel_is_compiled_once_for_all_constants_that_callers_pass():
    @jit
    def add(x, y):
        return x + y

    @jit
    def several(x):
        return add(add(add(x, 1), 2), 3)

    assert several(4) == 10
    assert len(getattr(add, "signatures", [()])) == 1


def test_numba_is_bounded():
    project = tomllib.loads((SOURCE.parents[1] / "pyproject.toml").read_text("utf-8"))["project"]
    (requirement,) = (
        one for one in map(Requirement, project["dependencies"]) if one.name == "numba"
    )
    assert any(part.operator == "<" for part in requirement.specifier)
    assert requirement.specifier.contains(numba.__version__)


@pytest.mark.parametrize("is_on", [True, False])
def test_compiling_leaves_garbage_collection_as_it_was(is_on):
    @jit(inner=True)
    def below(x):
        return x + 1

    @jit
    def add(x):
        return below(x)

    (gc.enable if is_on else gc.disable)()
    try:
        assert add(1) == 2
        assert gc.isenabled() is is_on
        with pytest.raises(numba.TypingError):
            add("1")
        assert gc.isenabled() is is_on
    finally:
        gc.enable()

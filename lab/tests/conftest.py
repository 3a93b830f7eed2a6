"""What the tests of texvent set up and lend: profiles of hypothesis, stand-ins, fixtures."""

import importlib
import sys
import tomllib
from importlib.util import find_spec
from pathlib import Path

import pytest
from tests.conftest import moving_texture, spawn

from texvent import _registry

from . import arrays_as_torch

__all__ = ["moving_texture", "spawn"]
HAS_TORCH = find_spec("torch") is not None


def pytest_runtest_setup(item):
    """Skip what needs torch itself, also while arrays stand for it."""
    if not HAS_TORCH and item.get_closest_marker("torch"):
        pytest.skip("make test-torch runs the tests that need torch")


@pytest.fixture
def plug_ins(monkeypatch):
    """The parts of lab/pyproject.toml, found as where the laboratory is installed."""
    text = (Path(__file__).parents[1] / "pyproject.toml").read_text()
    groups = tomllib.loads(text)["project"]["entry-points"]
    plugged_in = _registry._plugged_in

    def find(group, *, is_own):
        return plugged_in(group, is_own=True) if is_own else groups.get(group, {})

    monkeypatch.setattr(_registry, "_plugged_in", find)


@pytest.fixture(scope="module")
def torch():
    """torch; where it is not installed, arrays that stand for it, to be imported by tests alone."""
    if HAS_TORCH:
        yield importlib.import_module("torch")
        return
    before = {*sys.modules}
    found = arrays_as_torch.modules()
    sys.modules |= found
    yield found["torch"]
    arrays_as_torch.forget(before)

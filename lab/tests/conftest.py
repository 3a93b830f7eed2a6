"""What the tests of texvent set up and lend: profiles of hypothesis, stand-ins, fixtures."""

import tomllib
from pathlib import Path

import pytest
from tests.conftest import moving_texture, spawn

from texvent import _registry

__all__ = ["moving_texture", "spawn"]


@pytest.fixture
def plug_ins(monkeypatch):
    """The parts of lab/pyproject.toml, found as where the laboratory is installed."""
    text = (Path(__file__).parents[1] / "pyproject.toml").read_text()
    groups = tomllib.loads(text)["project"]["entry-points"]
    plugged_in = _registry._plugged_in

    def find(group, *, is_own):
        return plugged_in(group, is_own=True) if is_own else groups.get(group, {})

    monkeypatch.setattr(_registry, "_plugged_in", find)

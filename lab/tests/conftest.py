"""What the tests of texvent set up and lend: profiles of hypothesis, stand-ins, fixtures."""

import tomllib
from functools import partial
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
    own = partial(_registry._plugged_in, is_own=True)
    monkeypatch.setattr(
        _registry,
        "_plugged_in",
        lambda group, *, is_own: own(group) if is_own else groups.get(group, {}),
    )

"""What tests of the node share."""

import pytest

from texvent import _registry


@pytest.fixture
def held_back(monkeypatch) -> str:
    """Name of a simulator whose events all come at the end; see held_back.py."""
    name = "held-back"
    found = {"texvent.simulators": {name: "tests.ros.held_back:HeldBack"}}
    monkeypatch.setattr(_registry, "_plugged_in", lambda group: found.get(group, {}))
    return name

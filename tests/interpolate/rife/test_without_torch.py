"""Without its packages, RIFE says which extra to install; nothing else needs torch."""

import sys

import pytest

from texvent.errors import MissingDependencyError
from texvent.weights.fetch import pull_weights


def test_pulling_without_torch_downloads_nothing(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "torch", None)
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("TEXVENT_DATA", str(tmp_path / "data"))
    with pytest.raises(MissingDependencyError, match=r"pip install 'texvent\[rife\]'") as told:
        pull_weights("rife")
    assert "\n" not in str(told.value)
    assert list(tmp_path.iterdir()) == []

"""The cache folder lies where the user can write."""

import os
import tempfile
from pathlib import Path

import pytest

from texvent.runtime.files.cache_folder import cache_folder


def test_a_user_without_a_home_has_a_folder_too(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("TEXVENT_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(os.path, "expanduser", lambda path: path)  # an entry is nowhere
    assert cache_folder("videos").is_relative_to(tempfile.gettempdir())
    monkeypatch.setenv("XDG_CACHE_HOME", "/here")
    assert cache_folder("videos") == Path("/here/texvent/videos")

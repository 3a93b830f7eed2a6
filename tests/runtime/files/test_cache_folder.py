"""The cache folder lies where the user can write."""

import os
import tempfile
from pathlib import Path

import pytest

from texvent.data.pull import data_folder
from texvent.generation import opensora
from texvent.runtime.files.cache_folder import cache_folder


def test_a_user_without_a_home_has_a_folder_too(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("TEXVENT_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(os.path, "expanduser", lambda path: path)  # an entry is nowhere
    assert cache_folder("videos").is_relative_to(tempfile.gettempdir())
    monkeypatch.setenv("XDG_CACHE_HOME", "/here")
    assert cache_folder("videos") == Path("/here/texvent/videos")


@pytest.mark.parametrize(
    ("variable", "folder"),
    [("TEXVENT_CACHE", cache_folder), ("TEXVENT_DATA", data_folder),
     (opensora.ROOT_VARIABLE, opensora._root)],
)  # fmt: skip
def test_a_folder_that_a_variable_names_may_begin_with_the_home(variable, folder, monkeypatch):
    monkeypatch.setenv(variable, "~/here")
    assert folder() == Path.home() / "here"
    monkeypatch.setenv(variable, "/there")
    assert folder() == Path("/there")

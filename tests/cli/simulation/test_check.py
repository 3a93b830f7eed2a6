"""`texvent check` prints what it found, and advises options that exist."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest
from tests.video_check.made_clips import encode, pan

from texvent.cli.app import main
from texvent.options.values import option_names
from texvent.settings.resolution import resolve
from texvent.video_check.checks import CHECKS

OF_GENERATE = {"seed", "on_failure"}


@pytest.fixture(scope="module")
def clip(tmp_path_factory):
    """A pan whose every fourth frame is shown twice."""
    images = np.repeat(pan(24), np.resize([1, 1, 1, 2], 24), axis=0)
    return encode(images, tmp_path_factory.mktemp("check") / "clip.mp4", fps=30, crf="16")


@pytest.mark.parametrize("columns", [80, 120])
def test_the_table_names_what_was_found_first_and_fits(clip, capsys, monkeypatch, columns):
    monkeypatch.setenv("COLUMNS", str(columns))
    assert main(["check", str(clip), "-q"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= columns
    first = next(line for line in lines if line.startswith(("! ", "frozen")))
    assert first.startswith("! repeated")
    assert lines[-1] == "found: repeated frames"
    assert "30 fps" in lines[-2]


def test_json_has_all_measurements(clip, capsys):
    assert main(["check", str(clip), "-q", "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["found"] == ["repeated frames"]
    assert [one["check"] for one in facts["findings"]] == [check.name for check in CHECKS]
    assert facts["measurements"]["pattern_period"] == 5


def test_advice_names_options_that_exist():
    settings = resolve("simulate", {})
    known = {name for group in settings.groups().values() for name in option_names(type(group))}
    named = r"(?:`|\b)([a-z_]+)(?:`|=')"
    advised = {name for check in CHECKS for name in re.findall(named, check.help)}
    assert advised <= known | OF_GENERATE
    assert "deflicker" in advised

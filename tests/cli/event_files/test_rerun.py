"""`texvent rerun`; the recording itself is tested in tests/view/test_rerun_export.py."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import texvent
from texvent.cli.app import main


@pytest.fixture(autouse=True)
def _recording(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    columns = ([1, 2, 3], [1, 2, 3], [5, 9, 2000], [1, 0, 1])
    texvent.EventStream.from_columns(*columns, size=(64, 48)).save("a.h5")


def test_without_rerun_the_extra_is_named(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "rerun", None)
    assert main(["rerun", "a.h5"]) == 4
    assert "pip install 'texvent[rerun]'" in capsys.readouterr().err


def test_another_extension_is_refused(capsys):
    assert main(["rerun", "a.h5", "-o", "a.html"]) == 2
    assert "must end in .rrd; got a.html" in capsys.readouterr().err


@pytest.mark.app
def test_a_recording_is_kept_that_the_viewer_can_read():
    pytest.importorskip("rerun")
    assert main(["rerun", "a.h5", "-o", "a.rrd"]) == 0
    assert Path("a.rrd").stat().st_size > 1000
    verified = subprocess.run(
        [sys.executable, "-m", "rerun", "rrd", "verify", "a.rrd"], check=False
    )
    assert verified.returncode == 0

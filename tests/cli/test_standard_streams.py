"""Commands whose standard output or error is closed, full, or read by nobody any more."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

import texvent

TEXVENT = f"{sys.executable} -m texvent.cli.app"
ROWS = "".join(f"{index / 1000:.6f} {index % 240} {index % 180} 1\n" for index in range(3000))


def shell(folder, words, redirected):
    """Exit code of a command in a shell, and what it says on the streams that are left."""
    line = f"( {TEXVENT} {words}; echo $? > code ) {redirected}"
    done = subprocess.run(line, shell=True, cwd=folder, capture_output=True, text=True, timeout=600)
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    return int((folder / "code").read_text()), done.stderr


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "e.txt").write_text(ROWS)
    return tmp_path


STREAMS = {
    ">&-": 0,
    "2>&-": 0,
    "<&- >&- 2>&-": 0,
    ">/dev/full": 3,
    "2>/dev/full": 0,
    ">/dev/full 2>/dev/full": 3,
    "| true": 0,
    "| head -1": 0,
}
"""Redirection → exit code of a command that succeeds."""


@pytest.mark.parametrize(("redirected", "code"), STREAMS.items())
def test_every_command_keeps_its_result_and_its_exit_code(folder, redirected, code):
    convert = "convert e.txt a.npz --sensor 240x180"
    assert shell(folder, convert, redirected)[0] == code
    assert len(texvent.load(folder / "a.npz")) == 3000
    for words in ("info e.txt --sensor 240x180", "--help", "convert --help all", "scenes"):
        assert shell(folder, words, redirected)[0] == code
    assert shell(folder, "info nosuch.txt", redirected)[0] == 2


@pytest.mark.parametrize("redirected", ["2>/dev/full", "2>&-", ">&- 2>/dev/full"])
@pytest.mark.parametrize(
    ("words", "made"),
    [
        (
            "generate 'a wug and a ball' --duration 0.1 --sensor 48x36 -o a.h5 --previews none",
            "a.h5",
        ),
        ("simulate v.npy --fps 30 -o a.h5 --previews none", "a.h5"),
    ],
)
def test_lost_progress_and_warnings_stop_no_run(folder, redirected, words, made):
    np.save(folder / "v.npy", np.arange(4 * 36 * 48, dtype=np.uint8).reshape(4, 36, 48))
    assert shell(folder, words, redirected)[0] == 0
    assert texvent.load(folder / made).size == (48, 36)

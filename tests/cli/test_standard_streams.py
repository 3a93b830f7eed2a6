"""Commands whose standard output or error is closed, full, or read by nobody any more."""

import itertools
import subprocess
import sys

import numpy as np
import pytest

import texvent

TEXVENT = f"{sys.executable} -m texvent"
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


WORDS = ("info e.txt --sensor 240x180", "convert --help all", "scenes")


@pytest.mark.long
@pytest.mark.parametrize(
    ("redirected", "words"), [*zip(STREAMS, itertools.cycle(WORDS), strict=False)]
)
def test_every_command_keeps_its_result_and_its_exit_code(folder, redirected, words):
    for one in ("--help", words):
        assert shell(folder, one, redirected)[0] == STREAMS[redirected]
    assert shell(folder, "nosuch", redirected)[0] == 2


@pytest.mark.long
@pytest.mark.parametrize("redirected", [">/dev/full", "<&- >&- 2>&-"])
def test_a_file_is_written_whatever_becomes_of_the_streams(folder, redirected):
    words = "convert e.txt a.npz --sensor 240x180"
    assert shell(folder, words, redirected)[0] == STREAMS[redirected]
    assert len(texvent.load(folder / "a.npz")) == 3000


@pytest.mark.long
@pytest.mark.parametrize("redirected", ["2>/dev/full", "2>&-", ">&- 2>/dev/full"])
def test_lost_progress_and_warnings_stop_no_run(folder, redirected):
    np.save(folder / "still.npy", np.full((3, 12, 16), 100, np.uint8))
    words = "simulate still.npy --fps 20 -o a.h5 --previews none --interpolate none"
    assert shell(folder, words, redirected)[0] == 0
    assert texvent.load(folder / "a.h5").size == (16, 12)

"""What becomes of progress: a function, a bar, or nothing."""

import io
import sys

import numba
import pytest

from texvent.runtime.console_progress import ConsoleProgress
from texvent.runtime.jit import jit
from texvent.runtime.progress import NoProgress, _tell_terminal
from texvent.runtime.progress_option import open_progress


def test_a_function_is_called_at_every_step_and_line():
    calls = []
    with open_progress(lambda *step: calls.append(step)) as progress:
        progress.announce("loading")
        progress.advance("denoise", 1, 30)
        progress.announce("a note")
        progress.advance("simulate", 2, None)
    assert calls == [
        (0, None, "loading"),
        (1, 30, "denoise"),
        (1, 30, "a note"),
        (2, None, "simulate"),
    ]


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize(
    ("option", "stderr", "has_bar"),
    [
        (None, io.StringIO(), False),
        (None, Terminal(), True),
        (False, Terminal(), False),
        (True, io.StringIO(), True),
    ],
)
def test_a_bar_shows_in_a_terminal_unless_told_otherwise(monkeypatch, option, stderr, has_bar):
    monkeypatch.setattr(sys, "stderr", stderr)
    with open_progress(option) as progress:
        assert isinstance(progress, ConsoleProgress if has_bar else NoProgress)


def test_short_work_draws_no_bar_and_long_work_does(monkeypatch):
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr("texvent.runtime.console_progress.time.monotonic", lambda: clock[0])
    monkeypatch.setenv("TERM", "xterm")
    clock = [0.0]
    with ConsoleProgress() as progress:
        clock[0] = 0.1
        progress.advance("simulate", 1, 3)
    assert terminal.getvalue() == ""
    with ConsoleProgress() as progress:
        clock[0] = 2.0
        progress.advance("simulate", 2, 3)
    assert "simulate" in terminal.getvalue()


def test_a_terminal_is_told_once_that_kernels_are_compiled(monkeypatch, tmp_path):
    terminal = Terminal()
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(sys, "stderr", terminal)
    _tell_terminal.cache_clear()
    for value in (1, 2.0):
        with ConsoleProgress():
            assert jit(lambda x: x + 1)(value) == value + 1
    assert terminal.getvalue().count("compiling (once)") == (0 if numba.config.DISABLE_JIT else 1)

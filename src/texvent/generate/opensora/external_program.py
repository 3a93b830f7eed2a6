"""Run an external program: it stops with all its children, and its last output is kept."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
from collections.abc import Sequence
from pathlib import Path

from texvent.errors import TexventError

GRACE_S = 10.0
"""Time to end by itself after SIGTERM."""
LAST_LINES = 4
LONGEST_LINE = 300


def run_program(command: Sequence[str], *, cwd: Path | None, log: Path) -> None:
    """Run a program to its end; Ctrl-C or any other exception ends it and its children.

    Args:
        command: program and arguments; no shell is involved.
        cwd: folder to run in.
        log: file for everything it prints.

    Raises:
        TexventError: it cannot be started, or ends with an error; its last lines are quoted.
    """
    process: subprocess.Popen[bytes] | None = None
    with log.open("wb") as output:
        try:
            process = subprocess.Popen(
                command,
                cwd=cwd,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                # A group of its own, so that a terminal's Ctrl-C reaches it only through us.
                start_new_session=True,
            )
            code = process.wait()
        except OSError as error:
            raise TexventError(f"{command[0]} cannot be started: {error.strerror}") from error
        except BaseException:
            if process is not None:
                _end(process)
            raise
    if code != 0:
        raise TexventError(
            f"{Path(command[0]).name} ended with code {code}; its last output: {_last_output(log)}"
        )


def _end(process: subprocess.Popen[bytes]) -> None:
    """End the whole process group: SIGTERM, then SIGKILL; on Windows the tree of processes."""
    if not hasattr(os, "killpg"):
        _end_tree(process)
        return
    for request in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, request)
            process.wait(GRACE_S)
        except ProcessLookupError:
            return
        except subprocess.TimeoutExpired:
            continue
        return


def _end_tree(process: subprocess.Popen[bytes]) -> None:
    command = ["taskkill", "/F", "/T", "/PID", str(process.pid)]
    with contextlib.suppress(OSError):
        subprocess.run(command, capture_output=True, check=False)
    process.kill()  # does nothing if it has ended
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(GRACE_S)


def _last_output(log: Path) -> str:
    lines = [line.strip() for line in log.read_text("utf-8", "replace").splitlines()]
    words = [line[:LONGEST_LINE] for line in lines if line][-LAST_LINES:]
    return " | ".join(words) if words else "(none)"

"""Job of the page: one run of the command line, its last lines and its files."""

from __future__ import annotations

import subprocess
import sys
import threading
from collections import deque
from collections.abc import Sequence
from pathlib import Path

MOST_LINES = 20
"""Lines of a run that the page shows, the latest."""
SCENE_MARK = "[[objects]]"
"""Text that no sentence contains, and nearly every scene file in TOML does."""


class Job:
    """A run in a process of its own.

    Args:
        folder: an empty folder for its files.
        command: "generate" or "simulate".
        options: flags of the command.
        subject: a prompt, the text of a scene file, or the path of a video.
    """

    def __init__(self, folder: Path, command: str, options: Sequence[str], subject: str) -> None:
        self.folder = folder
        self._is_stopped = False
        self._lines: deque[str] = deque(maxlen=MOST_LINES)
        files = "-o", str(folder / "events.h5"), "--previews", "mp4,html"
        words = command, *options, *files, "--", _operand(subject, folder)
        self._process = subprocess.Popen(
            [sys.executable, "-m", "texvent.cli.app", *words],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    @property
    def state(self) -> str:
        """running, done, failed or stopped."""
        if self._process.poll() is None:
            return "running"
        self._reader.join()
        if self._is_stopped:
            return "stopped"
        return "failed" if self._process.returncode else "done"

    def describe(self) -> dict[str, str]:
        """State and text, JSON-ready."""
        state = self.state
        return {"state": state, "text": "\n".join(self._lines) or state}

    def stop(self) -> None:
        """End the run, if it is not over; returns when its process has cleaned up."""
        if self._process.poll() is None:
            self._is_stopped = True
            self._process.terminate()
            self._process.wait()

    def file(self, name: str) -> Path | None:
        """A result by its file name; None where there is none."""
        path = self.folder / name
        return path if self.state == "done" and path.is_file() else None

    def _read(self) -> None:
        if self._process.stderr is not None:
            with self._process.stderr as lines:
                self._lines.extend(line.rstrip() for line in lines)


def _operand(subject: str, folder: Path) -> str:
    """The subject as a command takes it: the text of a scene file as a file."""
    is_json = subject.lstrip().startswith("{")
    if not is_json and SCENE_MARK not in subject:
        return subject
    path = folder / ("scene.json" if is_json else "scene.toml")
    path.write_text(subject, encoding="utf-8")
    return str(path)

"""Page of `texvent app`: prompts and videos in, events out, one job at a time.

Prompts, scenes and videos may name files of this machine, as on the command line.
"""

from __future__ import annotations

import contextlib
import functools
import json
import shutil
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from texvent._registry import GENERATORS, SIMULATORS
from texvent.config import RunConfig
from texvent.io.atomic import temporary_folder
from texvent.sensor import SENSORS
from texvent.web.server import HTML, NOTHING_POLICY, Answer, Gets, PageServer, page_text

VIEWER_POLICY = (
    "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; "
    "style-src 'unsafe-inline'; img-src data:; frame-ancestors 'self'"
)
RESULTS = {
    "/events": ("events.h5", "application/octet-stream", NOTHING_POLICY),
    "/video": ("events.events.mp4", "video/mp4", NOTHING_POLICY),
    "/page": ("events.events.html", HTML, VIEWER_POLICY),
}
"""Files that a run writes, their kinds, and what a browser may do with them."""
MOST_LINES = 20
"""Lines of a run that the page shows, the latest."""
SCENE_MARK = "[[objects]]"
"""Text that no sentence contains, and nearly every scene file in TOML does."""


class Job:
    """A run in a process of its own, which ends with this one, however that ends.

    Its words go through a pipe: those that start a process are shown to every user of the machine.

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
            [sys.executable, "-m", "texvent.cli.simulation.job"],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
        )
        self._send(words)
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

    def _send(self, words: Sequence[str]) -> None:
        """Give the process its words; the pipe stays open as long as this process lives."""
        with contextlib.suppress(BrokenPipeError):  # it has ended already, and says why
            if self._process.stdin is not None:
                self._process.stdin.write(json.dumps(words) + "\n")
                self._process.stdin.flush()

    def _read(self) -> None:
        if self._process.stderr is not None:
            with self._process.stderr as lines:
                self._lines.extend(line.rstrip() for line in lines)
        with contextlib.suppress(BrokenPipeError):
            if self._process.stdin is not None:
                self._process.stdin.close()


def _operand(subject: str, folder: Path) -> str:
    """The subject as a command takes it: the text of a scene file as a file."""
    is_json = subject.lstrip().startswith("{")
    if not is_json and SCENE_MARK not in subject:
        return subject
    path = folder / ("scene.json" if is_json else "scene.toml")
    path.write_text(subject, encoding="utf-8")
    return str(path)


class JobServer(PageServer):
    """The page and its latest job, in a folder that is deleted at the end.

    Raises:
        InputError: the port is taken.
    """

    def __init__(self, *, port: int = 0) -> None:
        self.job: Job | None = None
        self._jobs = 0
        self._lock = threading.Lock()
        self._ended = contextlib.ExitStack()
        gets: Gets = {path: functools.partial(self._result, path) for path in RESULTS}
        gets = {"/job": self._state, **gets}
        posts = {"/run": lambda values: self.begin(*_command(values)), "/stop": self._stop}
        with self._ended as ended:
            self.folder = ended.enter_context(temporary_folder())
            super().__init__(page_html(), gets, posts, port=port)
            self._ended = ended.pop_all()

    def begin(self, command: str, options: list[str], subject: str) -> None:
        """Start a job, which takes the place of the one before; arguments as those of `Job`."""
        with self._lock:
            self._jobs += 1
            if self.job is not None:
                self.job.stop()
                shutil.rmtree(self.job.folder, ignore_errors=True)
            folder = self.folder / f"job-{self._jobs}"
            folder.mkdir()
            self.job = Job(folder, command, options, subject)

    def close(self) -> None:
        """Stop the job and the server, and delete all files."""
        self._stop({})
        super().close()
        self._ended.close()

    def _stop(self, values: Mapping[str, Any]) -> None:
        if self.job is not None:
            self.job.stop()

    def _state(self, query: Mapping[str, str]) -> Answer:
        nothing = {"state": "none", "text": ""}
        return Answer(json.dumps(nothing if self.job is None else self.job.describe()))

    def _result(self, path: str, query: Mapping[str, str]) -> Answer | None:
        name, kind, policy = RESULTS[path]
        file = None if self.job is None else self.job.file(name)
        return None if file is None else Answer(file.read_bytes(), kind, policy)


def _command(values: Mapping[str, Any]) -> tuple[str, list[str], str]:
    """Command, flags and subject of the page's fields; empty fields are left to the defaults."""
    texts = {name: str(text).strip() for name, text in values.items()}
    video = texts.get("video", "")
    named: tuple[str, ...] = ("simulator", "preset", "sensor", "seed")
    if not video:
        named = (*named, "generator", "duration")
    flags = [f"--{name}={texts[name]}" for name in named if texts.get(name)]
    return ("simulate", flags, video) if video else ("generate", flags, texts.get("prompt", ""))


def page_html() -> str:
    """The page, with the names to choose from."""
    choices = {
        "generators": GENERATORS.names(),
        "simulators": SIMULATORS.names(),
        "simulator": RunConfig.simulator,
        "presets": {name: list(SIMULATORS.load(name).presets) for name in SIMULATORS.names()},
        "sensors": list(SENSORS),
    }
    return page_text("job_page.html", choices)

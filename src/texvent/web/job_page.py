"""Page of `texvent app`: prompts and videos in, events out.

Prompts, scenes and videos may name files of this machine, as on the command line.
"""

from __future__ import annotations

import json
import shutil
import tempfile
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent._registry import GENERATORS, SIMULATORS
from texvent.config import RunConfig
from texvent.sensor import SENSORS
from texvent.web.job import Job
from texvent.web.server import NOTHING_POLICY, Answer, LocalServer, html_answer, page_text

VIEWER_POLICY = (
    "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; "
    "style-src 'unsafe-inline'; img-src data:; frame-ancestors 'self'"
)
RESULTS = {
    "/events": ("events.h5", "application/octet-stream", NOTHING_POLICY),
    "/video": ("events.events.mp4", "video/mp4", NOTHING_POLICY),
    "/page": ("events.events.html", "text/html; charset=utf-8", VIEWER_POLICY),
}
"""Files that a run writes, their kinds, and what a browser may do with them."""


class PageServer(LocalServer):
    """The page and its latest job, in a folder that is deleted at the end.

    Raises:
        InputError: the port is taken.
    """

    def __init__(self, *, port: int = 0) -> None:
        """Listen at once; arguments as those of `LocalServer`."""
        self.job: Job | None = None
        self._jobs = 0
        self._lock = threading.Lock()
        super().__init__(port=port)
        self.folder = Path(tempfile.mkdtemp(prefix="texvent-app-"))

    def begin(self, command: str, options: list[str], subject: str) -> Job:
        """Start a job, which takes the place of the one before; arguments as those of `Job`."""
        with self._lock:
            self._jobs += 1
            if self.job is not None:
                self.job.stop()
                shutil.rmtree(self.job.folder, ignore_errors=True)
            folder = self.folder / f"job-{self._jobs}"
            folder.mkdir()
            self.job = Job(folder, command, options, subject)
            return self.job

    def get(self, path: str, query: Mapping[str, str]) -> Answer | None:
        """The page, the state of the job, or one of its files."""
        del query
        job = self.job
        if path == "/":
            return html_answer(page_html())
        if path == "/job":
            return Answer(
                json.dumps({"state": "none", "text": ""} if job is None else job.describe())
            )
        file, kind, policy = RESULTS.get(path, ("", "", ""))
        result = job.file(file) if job is not None and file else None
        return None if result is None else Answer(result.read_bytes(), kind, policy)

    def post(self, path: str, values: Mapping[str, Any]) -> bool:
        """Start or stop a job."""
        if path == "/run":
            self.begin(*_command(values))
        elif path == "/stop" and self.job is not None:
            self.job.stop()
        return path in ("/run", "/stop")

    def close(self) -> None:
        """Stop the job and the server, and delete all files."""
        if self.job is not None:
            self.job.stop()
        super().close()
        shutil.rmtree(self.folder, ignore_errors=True)


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
    return page_text(
        "job.html",
        {
            "generators": GENERATORS.names(),
            "simulators": SIMULATORS.names(),
            "simulator": RunConfig.simulator,
            "presets": {name: list(SIMULATORS.load(name).presets) for name in SIMULATORS.names()},
            "sensors": list(SENSORS),
        },
    )

"""Job of the page: one run in a thread, with its progress and its files."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from texvent.errors import TexventError, warnings_to
from texvent.events import EventStream
from texvent.generate.scene_input import Subject
from texvent.pipeline import Simulation
from texvent.run.files import RunFiles, write_run
from texvent.run.prepare import prepare_prompt, prepare_source
from texvent.scenes.report import PromptReport
from texvent.scenes.spec.files import parse_scene
from texvent.settings.resolution import resolve
from texvent.video import Frame

SCENE_MARK = "[[objects]]"
"""Text that no sentence contains, and nearly every scene file in TOML does."""


class _StoppedError(Exception):
    """Raised inside a run that was given up."""


@dataclass
class Job:
    """One run: of a prompt or the text of a scene file, or of a video.

    Args:
        folder: an empty folder for its files.
        options: options of `texvent.generate` or `texvent.simulate`.
        prompt: what to show; or ...
        video: ... a video file.
    """

    folder: Path
    options: Mapping[str, Any]
    prompt: str = ""
    video: Path | None = None
    state: Literal["running", "done", "failed", "stopped"] = "running"
    text: str = "starting"
    """Progress, summary or error."""
    share: float | None = None
    """Part that is done, 0..1; None where it is not known."""
    _stop: threading.Event = field(default_factory=threading.Event)
    _thread: threading.Thread | None = None
    _events: int = 0
    _frames: int = 0

    def start(self, *, after: Job | None = None) -> None:
        """Run in a thread, as soon as the thread of another job has ended."""
        before = None if after is None else after._thread

        def wait_and_run() -> None:
            if before is not None and before.is_alive():
                self.text = "waiting for the end of the job before"
                before.join()
            self.run()

        self._thread = threading.Thread(target=wait_and_run, daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Give the run up at its next step."""
        self._stop.set()

    def run(self) -> None:
        """Run; `state` and `text` are the outcome."""
        warnings: list[str] = []
        try:
            self._say(self.text, None)
            with warnings_to(warnings.append):
                simulation = self._prepare()
                write_run(simulation, self._files(), on_step=lambda *step: self._count(*step))
        except (TexventError, OSError) as error:
            self.state, self.text = "failed", str(error)
        except _StoppedError:
            self.state, self.text = "stopped", "Stopped."
        except MemoryError:
            self.state, self.text = "failed", "memory ran out; choose a smaller sensor"
        else:
            self.state, self.text = "done", _summary(simulation, self._events, warnings)

    def describe(self) -> dict[str, Any]:
        """State, text and progress, JSON-ready."""
        return {"state": self.state, "text": self.text, "share": self.share}

    def file(self, name: str) -> Path | None:
        """A result by name: events, video or page; None where there is none."""
        path = dict(zip(("events", "video", "page"), self._files().paths, strict=True)).get(name)
        return path if path is not None and self.state == "done" and path.is_file() else None

    def announce(self, line: str) -> None:
        """Progress of a slow generator, as a line."""
        self._say(line, None)

    def advance(self, stage: str, done: int, total: int | None) -> None:
        """Progress of a slow generator, in steps."""
        self._say(stage, done / total if total else None)

    def _prepare(self) -> Simulation:
        if self.video is None:
            settings = resolve("generate", self.options)
            return prepare_prompt(_subject(self.prompt), settings, progress=self)
        return prepare_source(str(self.video), resolve("simulate", self.options), progress=self)

    def _files(self) -> RunFiles:
        return RunFiles(events=self.folder / "events.h5", previews=("mp4", "html"))

    def _count(self, frame: Frame, packet: EventStream) -> None:
        self._events += len(packet)
        self._frames += frame.is_source
        self._say(f"frame {self._frames}, {self._events:,} events", None)

    def _say(self, text: str, share: float | None) -> None:
        if self._stop.is_set():
            raise _StoppedError
        self.text, self.share = text, share


def _subject(text: str) -> Subject:
    """The prompt, or the scene in a text that is written as a scene file."""
    is_json = text.lstrip().startswith("{")
    if not is_json and SCENE_MARK not in text:
        return text
    return parse_scene(text, ".json" if is_json else ".toml")


def _summary(simulation: Simulation, count: int, warnings: list[str]) -> str:
    run = simulation.settings.run
    lines = [
        f"{count:,} events on {simulation.video.size} pixels",
        f"simulator {run.simulator}, preset {run.preset}",
    ]
    report = PromptReport.of_metadata(simulation.video.metadata)
    lines += report.lines() if report is not None else []
    return "\n".join(dict.fromkeys([*lines, *warnings]))

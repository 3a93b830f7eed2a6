"""One job in a process of its own: `python -m texvent.web.worker`, job on stdin, answers on stdout.

A job that crashes a decoder, eats memory or never ends takes only this process with it.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent._registry import GENERATORS
from texvent.capture.open import open_frames
from texvent.errors import FileFormatError, InputError, TexventError, shown, warnings_to
from texvent.events import EventStream
from texvent.generate.scene_input import Subject
from texvent.io.files import extension_of, open_events, save
from texvent.pipeline import Simulation
from texvent.run.files import RunFiles, write_run
from texvent.run.prepare import prepare_prompt, prepare_video
from texvent.scenes.literals import find_literals
from texvent.scenes.report import PromptReport
from texvent.scenes.spec.files import parse_scene
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.video import MICROSECONDS, Frame
from texvent.web.job import Answer, ConvertJob, Job, SimulateJob, answer_line, read_job
from texvent.web.limits import Limits
from texvent.web.process_limits import bound_memory, bounded_probe

SCENE_MARK = "[[objects]]"
"""What no sentence holds, and nearly every scene file in TOML does."""
OWN_GENERATOR = next(iter(GENERATORS.builtin))
SendAnswer = Callable[[Answer], None]


def main() -> int:
    """Do the job on stdin; returns 0, or 1 after an answer with the error."""

    def send(answer: Answer) -> None:
        sys.stdout.write(answer_line(answer) + "\n")
        sys.stdout.flush()

    try:
        job = read_job(sys.stdin.readline())
        _bound(job)
        send(convert(job) if isinstance(job, ConvertJob) else simulate(job, send))
    except TexventError as error:
        send(Answer(kind="failed", text=str(error)))
        return 1
    except MemoryError:
        send(Answer(kind="failed", text="the job needs more memory than it may take here"))
        return 1
    return 0


def _bound(job: Job) -> None:
    """Bound memory, except of learned generators: those map whole graphics cards."""
    if isinstance(job, ConvertJob):
        bound_memory(Limits().max_memory_gb)
    elif job.video is not None or job.options.get("generator") in (None, OWN_GENERATOR):
        bound_memory(job.limits.max_memory_gb)


def simulate(job: SimulateJob, send: SendAnswer) -> Answer:
    """Events, preview video and page in the job's folder.

    Raises:
        InputError: the job is larger than its limits allow, or its input cannot be used.
        ConfigError: an unknown option, or a value out of range.
    """
    send(Answer(kind="progress", text="starting"))
    warnings: list[str] = []
    with warnings_to(warnings.append):
        simulation = _prepare(job, _JobProgress(send))
        if job.video is None:
            warnings.clear()  # The prompt's report says the same.
        _check_size(simulation.video.size, job.limits)
        folder = Path(job.folder)
        tally = _Tally(simulation.video.frame_count, job.limits, send)
        output = RunFiles(events=(folder / "events.h5",), previews=("mp4", "html"))
        write_run(simulation, output, metadata=_shown(simulation), on_step=tally.add)
    files = dict(zip(("events", "video", "page"), output.paths, strict=True))
    return Answer(
        kind="done",
        text=_summary(simulation, tally.events, warnings),
        files={name: str(path) for name, path in files.items()},
    )


def convert(job: ConvertJob) -> Answer:
    """The events in another format, folders as one zip file.

    Raises:
        InputError: the format cannot hold these events.
        MissingDependencyError: the format needs an extra.
    """
    target = Path(job.folder) / f"events{extension_of(job.format)}"
    save(target, open_events(job.source), format=job.format, overwrite=True)
    if target.is_dir():
        target = Path(shutil.make_archive(str(target), "zip", root_dir=target))
    return Answer(kind="done", text=f"events as {job.format}", files={"download": str(target)})


class _JobProgress:
    """Passes on what a slow generator reports."""

    def __init__(self, send: SendAnswer) -> None:
        self._send = send

    def announce(self, line: str) -> None:
        self._send(Answer(kind="progress", text=line))

    def advance(self, stage: str, done: int, total: int | None) -> None:
        share = done / total if total else None
        self._send(Answer(kind="progress", share=share, text=stage))


def _prepare(job: SimulateJob, progress: _JobProgress) -> Simulation:
    options = dict(job.options)
    if job.video is None:
        if float(options.get("duration") or 0) > job.limits.max_seconds:
            raise InputError(
                f"duration is {options['duration']} s; at most {job.limits.max_seconds:g} s here"
            )
        settings = resolve("generate", options)
        _check_size(settings.size or SensorSize(1, 1), job.limits)
        if settings.generator == OWN_GENERATOR:
            _refuse_files(job.prompt or "")
        return prepare_prompt(_subject(job.prompt or ""), settings, progress=progress)
    settings = resolve("simulate", options)
    # A damaged or crafted file shows itself here, before it can take the time of a whole job.
    with bounded_probe():
        next(iter(open_frames(job.video, settings.source, size=settings.size)), None)
    video = open_frames(job.video, settings.source, size=settings.size)
    _check_length(video, job.limits)
    return prepare_video(video, settings, progress=progress)


def _subject(text: str) -> Subject:
    """The prompt, or the scene of a text that is written as a scene file.

    Raises:
        FileFormatError, ConfigError: it is a wrong scene.
        InputError: the scene names files: they would be those of this machine.
    """
    if not text.lstrip().startswith("{") and SCENE_MARK not in text:
        return text
    try:
        scene = parse_scene(text, ".json" if text.lstrip().startswith("{") else ".toml")
    except FileFormatError as error:
        raise FileFormatError(f"the scene {error}") from error
    for one in scene.objects:
        picture = one.picture.value if one.picture and one.picture.kind == "file" else None
        for file in (picture, one.model):
            if file is not None:
                raise InputError(f"{shown(file)}: this page shows no files in scenes")
    return scene


def _refuse_files(prompt: str) -> None:
    """Refuse a prompt that names a file: it would be one of this machine, not of the visitor."""
    for begin, end, picture in find_literals(prompt):
        if picture.kind == "file":
            raise InputError(f"{shown(prompt[begin:end])}: this page shows no picture files")


def _check_length(video: Any, limits: Limits) -> None:
    """Refuse a long video before any work, where its container says how long it is."""
    if video.frame_count is None or not video.fps:
        return
    seconds = float(video.frame_count / video.fps)
    if seconds > limits.max_seconds:
        raise InputError(
            f"the video is {seconds:.1f} s long; at most {limits.max_seconds:g} s are taken here. "
            "Cut it, or run texvent simulate on your own machine"
        )


def _check_size(size: SensorSize, limits: Limits) -> None:
    if size.width * size.height > limits.max_pixels:
        raise InputError(
            f"{size} is {size.width * size.height:,} pixels; at most {limits.max_pixels:,} are "
            "taken here. Choose a sensor"
        )


@dataclass
class _Tally:
    """Counts what a run makes, tells the page, and ends a run that grows beyond its limits."""

    total: int | None
    limits: Limits
    send: SendAnswer
    events: int = 0
    frames: int = 0
    first_us: int | None = None

    def add(self, frame: Frame, packet: EventStream) -> None:
        self.first_us = frame.t_us if self.first_us is None else self.first_us
        self.events += len(packet)
        if frame.t_us - self.first_us > self.limits.max_seconds * MICROSECONDS:
            raise InputError(
                f"the video is longer than {self.limits.max_seconds:g} s, which is the most taken "
                "here"
            )
        if self.events > self.limits.max_events:
            raise InputError(
                f"more than {self.limits.max_events:,} events; choose a smaller sensor, or give "
                "fewer seconds"
            )
        if frame.is_source:
            self.frames += 1
            share = min(1.0, self.frames / self.total) if self.total else None
            text = f"frame {self.frames}, {self.events:,} events"
            self.send(Answer(kind="progress", share=share, text=text))


def _shown(simulation: Simulation) -> dict[str, Any]:
    """Provenance without the server's folders: uploads have meaningless temporary paths."""
    metadata = simulation.provenance
    source = {
        name: Path(value).name if isinstance(value, str) and Path(value).is_absolute() else value
        for name, value in metadata["source"].items()
    }
    return {**metadata, "source": source}


def _summary(simulation: Simulation, count: int, warnings: list[str]) -> str:
    run = simulation.settings.run
    lines = [
        f"{count:,} events on {simulation.video.size} pixels",
        f"simulator {run.simulator}, preset {run.preset}",
    ]
    if simulation.settings.generator is None:
        fit = f"frames fitted to {run.sensor}" if run.sensor else "the video's own size"
        lines.append(fit)
    report = PromptReport.of_metadata(simulation.video.metadata)
    lines += report.lines() if report is not None else []
    return "\n".join(dict.fromkeys([*lines, *warnings]))


if __name__ == "__main__":
    sys.exit(main())

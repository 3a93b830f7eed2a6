"""Carry out a simulation: check its outputs, show progress, sum it up.

A dry run simulates parts of the clip, and tells what the whole run would take.
"""

from __future__ import annotations

import copy
import itertools
import time
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, cast

import tomli_w

from texvent.capture.frame_source import known_times_us
from texvent.capture.given_times import check_increasing
from texvent.cli.notices import say, write_out
from texvent.cli.outputs import OutputOptions
from texvent.errors import few
from texvent.events import EventStream
from texvent.frames import MICROSECONDS, Frame, FrameStream
from texvent.pairs.scene_change import SceneChange
from texvent.pairs.time_jump import check_times
from texvent.pipeline import Simulation
from texvent.prompt_report import PromptReport
from texvent.run.files import RunFiles, write_run
from texvent.run.prepare import estimate_bytes, prepare_source
from texvent.runtime.console_progress import ConsoleProgress
from texvent.settings.resolution import Settings, unmeasured_sensor

PARTS = 4
"""Parts of a clip that are tried, from its beginning to its end."""
PART_PAIRS = 3
"""Pairs of frames of a part. Pixels at rest fire late, so the first one of later parts does not
count."""
MOST_SECONDS = 10.0
"""No further part is begun after this time, which begins when the first one has been compiled; and
none goes on for longer, but for so many steps."""
LEAST_STEPS = 8


def estimate_run(simulation: Simulation) -> str:
    """Events, time and memory of a run in two lines, from parts of its clip; nothing is written.

    Every part is simulated twice: the first time may compile kernels, the second one is timed. Of a
    scene whose light flickers fast, a share of one pair tells what all take.

    Raises:
        InputError: the frames cannot be used.

    Warns:
        TexventWarning: of jumps in time, wherever they are.
    """
    times_us = known_times_us(simulation.video) or ()
    check_increasing(times_us, "the video", "; give a frame rate that replaces them (`fps`)")
    check_times(times_us)
    total = simulation.video.frame_count
    size = size_text(estimate_bytes(simulation.settings, simulation.video.size))
    memory = f"memory about {size}, however long the clip is"
    counted: list[int] = []
    seconds, pairs, begun = 0.0, 0.0, 0.0
    for start, part in _parts(simulation.video, total):
        trial = replace(simulation, video=part, warns=False)
        _try(trial)
        begun = begun or time.perf_counter()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # said the first time
            events, part_pairs, part_s = _try(trial)
        counted += events[1:] if start and len(events) > 1 else events
        pairs, seconds = pairs + part_pairs, seconds + part_s
        if time.perf_counter() - begun > MOST_SECONDS:
            break
    if not counted:
        return f"no events: there is one frame only, so nothing could change\n{memory}"
    named = f"{pairs:.0f}" if pairs >= 1.0 else f"{pairs:.2g}"
    tried = f"{named} of {'unknown' if total is None else total - 1} pairs of frames tried"
    rate = sum(counted) / len(counted)
    if total is None:
        return f"about {rate:,.0f} events per pair ({tried})\n{memory}"
    whole_s = seconds / pairs * (total - 1)
    return f"about {rate * (total - 1):,.0f} events in {whole_s:,.1f} s ({tried})\n{memory}"


def _try(trial: Simulation) -> tuple[list[int], float, float]:
    """Events of each pair of a part, how many pairs that is, and the time that they take, s.

    Where not even one pair is done in time, its beginning tells its events.
    """
    started, counts, source_us, tried_s = time.perf_counter(), [0], 0, 0.0
    fps, pairs = float(getattr(trial.video, "fps", None) or 0.0), 0.0
    elapsed_s, last_us = 0.0, 0
    with closing(cast(Any, trial.steps())) as steps:
        for number, (frame, packet) in enumerate(steps, start=1):
            counts[-1] += len(packet)
            last_us, elapsed_s = frame.t_us, time.perf_counter() - started
            if frame.is_source:
                counts.append(0)
                source_us, pairs, tried_s = last_us, len(counts) - 2.0, elapsed_s
            if elapsed_s > MOST_SECONDS and number >= LEAST_STEPS and (pairs >= 1.0 or fps):
                break
    share = (last_us - source_us) * fps / MICROSECONDS
    if pairs < 1.0 and share > 0.0:
        return [round(counts[-1] / share)], share, elapsed_s
    return counts[1:-1], pairs, tried_s


def _parts(video: FrameStream, total: int | None) -> Iterator[tuple[int, FrameStream]]:
    """Parts of a video, each with the number of its first frame.

    Scenes begin anywhere. Other frames are read from the first on, for `MOST_SECONDS` at most.
    Where the whole is short, or its length unknown, there is one part at its beginning.
    """
    length, starts = PART_PAIRS + 1, [0]
    most = PARTS * PART_PAIRS + 1
    if total is None or total <= most:
        length = most
    else:
        starts = [part * (total - length) // (PARTS - 1) for part in range(PARTS)]
    if hasattr(video, "from_frame"):
        for start in starts:
            yield start, _with_frames(video, partial(_frames_from, start, length))
        return
    frames, read_s = enumerate(video), 0.0
    for start in starts:
        found, begun = [], time.perf_counter()
        for number, frame in frames:
            if number >= start:
                found.append(frame)
            if len(found) == length or (
                start and read_s + time.perf_counter() - begun > MOST_SECONDS
            ):
                break
        read_s += time.perf_counter() - begun
        if len(found) > 1 or not start:
            yield start, _with_frames(video, partial(_frames_of, tuple(found)))


def _frames_from(start: int, length: int, video: Any) -> Iterator[Frame]:
    return itertools.islice(video.from_frame(start), length)


def _frames_of(found: Sequence[Frame], _: Any) -> Iterator[Frame]:
    return iter(found)


def _with_frames(video: FrameStream, read: Callable[[Any], Iterator[Frame]]) -> FrameStream:
    """The video, of which `read` gives the frames: interpolators ask it for all else.

    A wrapper would have to be of every protocol that the video is of, and of no other.
    """
    kind = type(video)
    part = copy.copy(video)
    part_kind = type(kind.__name__, (kind,), {"__slots__": (), "__iter__": lambda one: read(one)})
    object.__setattr__(part, "__class__", part_kind)
    return part


def size_text(size: float) -> str:
    """Bytes for people, such as "1.2 GB"."""
    for unit, name in ((2**40, "TB"), (2**30, "GB"), (2**20, "MB")):
        if size >= unit:
            return f"{size / unit:,.1f} {name}"
    return f"{size / 2**10:,.0f} KB"


SIGNALLED = 128
"""Exit code of a process ended by signal n is this + n, as shells expect."""


def print_settings(settings: Settings) -> int:
    """Write the resolved options to stdout as TOML; returns exit code 0."""
    tables = settings.as_tables()
    tables["run"]["device"] = settings.run.device
    write_out(tomli_w.dumps(tables))
    return 0


@dataclass
class RunCounts:
    """Counters of a run."""

    events: int = 0
    on_events: int = 0
    source_frames: int = 0
    intermediate_frames: int = 0
    last_us: int = 0
    first_us: int | None = None
    scene_changes: list[str] = field(default_factory=list)

    def add(self, frame: Frame, packet: EventStream) -> None:
        """Count one step."""
        self.events += len(packet)
        self.on_events += int(packet.p.sum())
        self.source_frames += frame.is_source
        self.intermediate_frames += not frame.is_source
        if len(packet):
            self.first_us = int(packet.t[0]) if self.first_us is None else self.first_us
            self.last_us = int(packet.t[-1])

    def add_scene_change(self, change: SceneChange, t_us: int) -> None:
        """Note a scene cut or flash at `t_us`."""
        self.scene_changes.append(f"{change.name.lower()} at {t_us / MICROSECONDS:.3f} s")

    @property
    def seconds(self) -> float:
        """From the first event to the last, s: as `texvent info` counts."""
        return (self.last_us - (self.first_us or 0)) / MICROSECONDS


def run_source(
    source: str | Path,
    settings: Settings,
    options: OutputOptions,
    *,
    prompt: str | None,
    subject: str,
) -> int:
    """Simulate a video into its files; returns exit code 0.

    Raises:
        TexventError: as `execute`, and as `texvent.run.prepare.prepare_source`.
    """
    files = options.files(subject)
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        simulation = prepare_source(source, settings, prompt=prompt, progress=progress)
    return execute(simulation, options, files)


def execute(simulation: Simulation, options: OutputOptions, files: RunFiles) -> int:
    """Run a simulation into its files; nothing appears under its name before it is complete.

    Returns:
        Exit code: 0; or, if the run was stopped by a signal and kept what it had, 128 + its number.

    Raises:
        OutputError: a file exists already, or cannot be written.
        InputError: the frames cannot be used.
    """
    if options.dry_run:
        return _estimate(simulation, options, files)
    progress = ConsoleProgress(is_quiet=options.quiet)
    for line in _notes(simulation):
        progress.announce(line)
    tally, started, total = RunCounts(), time.perf_counter(), simulation.video.frame_count

    def count(frame: Frame, packet: EventStream) -> None:
        tally.add(frame, packet)
        progress.advance("frames", tally.source_frames, total)

    with progress:
        early = write_run(simulation, files, on_step=count, on_scene_change=tally.add_scene_change)
    for line in _summary(tally, time.perf_counter() - started):
        progress.announce(line)
    if early is not None:
        progress.announce(
            f"stopped  at {early.t_us / MICROSECONDS:.3f} s; the files end there (complete = false)"
        )
    if not options.quiet:
        for written in files.outputs:
            write_out(f"{written}\n")
    if early is None:
        return 0
    if early.error is not None:
        raise early.error
    return SIGNALLED + (early.signal or 0)


def _estimate(simulation: Simulation, options: OutputOptions, files: RunFiles) -> int:
    """Say what is shown of a prompt and what the run would take; returns exit code 0."""
    if not options.quiet:
        for line in describe_scene(simulation.video.metadata, with_words=True):
            say(line)
    write_out(estimate_run(simulation) + "\n")
    there = [str(path) for path in files.outputs if path.exists()]
    if there and not (options.overwrite or options.quiet):
        say(f"note     the run needs --overwrite: there is already {few(there)}")
    return 0


def describe_scene(metadata: Mapping[str, Any], *, with_words: bool = False) -> Iterator[str]:
    """Lines on the scene of a prompt; warnings have named words that are not shown."""
    report = PromptReport.of_metadata(metadata)
    if report is None:
        return
    yield from (f"scene    {line}" for line in (*report.scene, *report.notes))
    yield from (f"drawn    {line}" for line in report.caption)
    if with_words and report.shown:
        yield f"shown    {', '.join(report.shown)}"


def _notes(simulation: Simulation) -> Iterator[str]:
    yield from describe_scene(simulation.video.metadata)
    run = simulation.settings.run
    yield f"model    {run.simulator}, preset {run.preset}"
    if simulation.device.note is not None:
        yield f"device   {simulation.device.note}"
    unmeasured = unmeasured_sensor(run)
    if unmeasured is not None:
        yield f"note     {unmeasured}"


def _summary(tally: RunCounts, seconds: float) -> list[str]:
    """Summary of a run that took `seconds`."""
    rate = tally.events / tally.seconds if tally.seconds else 0.0
    share = f", {tally.on_events / tally.events:.0%} ON" if tally.events else ""
    lines = [
        f"events   {tally.events:,} in {tally.seconds:.3f} s ({rate:,.0f} per second{share})",
        f"frames   {tally.source_frames:,} source + {tally.intermediate_frames:,} intermediate, "
        f"computed in {seconds:.1f} s (elapsed)",
    ]
    if tally.scene_changes:
        more = ", ..." if len(tally.scene_changes) > 8 else ""
        shown = ", ".join(tally.scene_changes[:8]) + more
        lines.append(f"note     not smeared over the interval: {shown}")
    return lines

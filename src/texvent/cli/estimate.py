"""`--dry-run`: run excerpts of a video into a scratch folder; say what the whole would take."""

from __future__ import annotations

import itertools
import os
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent.pipeline import Simulation
from texvent.run.files import RunFiles, write_run
from texvent.runtime.memory import peak_bytes
from texvent.sensor import SensorSize
from texvent.video import Frame, FrameStream, MovingStream, RenderableStream
from texvent.view.page.sample import SAMPLE_EVENTS

EXCERPTS = 5
"""Spread over the clip, because scenes change."""
EXCERPT_PAIRS = 8
WHOLE_PAIRS = 48
"""A video of so few pairs is tried whole."""
SPREAD, SPREAD_PAIRS = 4, 5
"""Excerpts, and pairs of each, of a video that can begin anywhere: nothing between is rendered."""
TRIAL_SECONDS = 6.0
"""No further excerpt is begun after this long."""
BLOCKS_BYTES = 48 * 2**20
"""What a long run holds beyond an excerpt: full blocks and queues of the writers."""


@dataclass(frozen=True)
class Trial:
    """What an excerpt took."""

    pairs: int
    events: int
    seconds: float
    sizes: Mapping[str, int]
    """Extension → bytes."""


@dataclass(frozen=True)
class Estimate:
    """What a run would take, extrapolated from excerpts of it."""

    pairs_tried: int
    pairs_total: int | None
    """None where the source does not say how long it is."""
    events_per_pair: float
    seconds_fixed: float
    seconds_per_pair: float
    sizes_fixed: Mapping[str, float]
    """Extension → bytes that a file has in any case."""
    sizes_per_pair: Mapping[str, float]
    peak_bytes: int | None
    """Highest resident memory, which does not grow with the clip; None where the system does not
    tell it."""

    def events(self, pairs: int) -> float:
        """Events of a clip of that many pairs of frames."""
        return self.events_per_pair * pairs

    def seconds(self, pairs: int) -> float:
        """Time, s."""
        return self.seconds_fixed + self.seconds_per_pair * pairs

    def sizes(self, pairs: int) -> dict[str, float]:
        """Bytes by extension; a page holds a sample of the events, so its size has an end."""
        counted = min(pairs, SAMPLE_EVENTS / max(self.events_per_pair, 1e-9))
        return {
            kind: fixed + self.sizes_per_pair[kind] * (counted if kind == ".html" else pairs)
            for kind, fixed in self.sizes_fixed.items()
        }


def estimate_run(simulation: Simulation, files: RunFiles) -> Estimate:
    """Run excerpts with all their files and measure.

    Raises:
        InputError: the frames cannot be used.
    """
    video = simulation.video
    if simulation.settings.interpolate.interpolate == "motion" and isinstance(video, MovingStream):
        video = video.with_motion()
        simulation = replace(simulation, video=video)
    total = None if video.frame_count is None else max(video.frame_count - 1, 0)
    with tempfile.TemporaryDirectory(prefix="texvent-estimate-") as folder:
        scratch = _Scratch(simulation, files, Path(folder))
        frames = iter(video)
        first = scratch.run(itertools.islice(frames, 2))  # imports and compiles
        began_s = _process_seconds()
        begin_at = getattr(video, "from_frame", None)
        frames = frames if video.is_live else iter(video)
        if begin_at is not None and total is not None and total > SPREAD * SPREAD_PAIRS:
            trials = _run_spread(scratch, begin_at, total)
        elif total is not None and total <= WHOLE_PAIRS:
            short_video = [*frames]
            total = len(short_video) - 1
            trials = [scratch.run(iter(part)) for part in (short_video[:2], short_video)]
        else:
            trials = _run_excerpts(scratch, frames, total)
    short = min((one for one in trials if one.pairs == 1), key=_seconds, default=first)
    rest = [one for one in trials if one.pairs > 1]
    pairs = sum(one.pairs - short.pairs for one in rest)
    per_pair = max(sum(one.seconds - short.seconds for one in rest), 0.0) / max(pairs, 1)
    growth = {
        kind: max(sum(one.sizes[kind] - size for one in rest), 0) / max(pairs, 1)
        for kind, size in short.sizes.items()
    }
    peak = peak_bytes()
    return Estimate(
        pairs_tried=sum(one.pairs for one in trials),
        pairs_total=total,
        events_per_pair=sum(one.events for one in rest) / max(sum(one.pairs for one in rest), 1),
        seconds_fixed=max(began_s - per_pair * first.pairs, 0.0),
        seconds_per_pair=per_pair,
        sizes_fixed={kind: size - growth[kind] for kind, size in short.sizes.items()},
        sizes_per_pair=growth,
        peak_bytes=None if peak is None else peak + BLOCKS_BYTES,
    )


def _seconds(trial: Trial) -> float:
    return trial.seconds


def _run_spread(
    scratch: _Scratch, begin_at: Callable[[int], Iterator[Frame]], total: int
) -> list[Trial]:
    """A single pair, which tells what a run takes in any case, and the middles of equal parts."""
    trials = [scratch.run(itertools.islice(begin_at(0), 2))]
    for part in range(SPREAD):
        first = ((2 * part + 1) * total // SPREAD - SPREAD_PAIRS) // 2
        trials.append(scratch.run(itertools.islice(begin_at(first), SPREAD_PAIRS + 1)))
    return trials


def _run_excerpts(scratch: _Scratch, frames: Iterator[Frame], total: int | None) -> list[Trial]:
    """Excerpts at equal distances while there is time; of a video of unknown length, one.

    Each comes after one of a single pair, which tells what a run takes in any case.
    """
    started, trials = time.perf_counter(), []
    used = EXCERPT_PAIRS + 3
    stride = max((total or 0) // EXCERPTS, used)
    for _ in range(EXCERPTS):
        for count in (2, EXCERPT_PAIRS + 1):
            trial = scratch.run(itertools.islice(frames, count))
            if trial.pairs > 0:
                trials.append(trial)
        for _ in itertools.islice(frames, stride - used):
            if time.perf_counter() - started > TRIAL_SECONDS:
                return trials
        if time.perf_counter() - started > TRIAL_SECONDS:
            break
    return trials


def _process_seconds() -> float:
    """Time since this process began, s: with imports and compilation, as every run has them."""
    try:
        fields = Path("/proc/self/stat").read_text(encoding="ascii").rpartition(")")[2].split()
        started_s = int(fields[19]) / os.sysconf("SC_CLK_TCK")
        return time.clock_gettime(time.CLOCK_BOOTTIME) - started_s
    except (OSError, ValueError, AttributeError):
        return time.process_time()


class _Scratch:
    """Runs excerpts into files of a folder that is thrown away."""

    def __init__(self, simulation: Simulation, files: RunFiles, folder: Path) -> None:
        self._simulation = simulation
        events = [folder / f"{number}{path.suffix}" for number, path in enumerate(files.events)]
        self._files = replace(files, events=events, overwrite=True, keep_partial=False)
        self.no_sizes = {path.suffix: 0 for path in self._files.outputs}

    def run(self, frames: Iterator[Frame]) -> Trial:
        """Run an excerpt; one without a frame takes nothing."""
        first = next(frames, None)
        if first is None:
            return Trial(0, 0, 0.0, self.no_sizes)
        video = _excerpt(self._simulation.video, itertools.chain([first], frames))
        pairs, events = -1, 0

        def count(frame: Frame, packet: Any) -> None:
            nonlocal pairs, events
            pairs, events = pairs + frame.is_source, events + len(packet)

        started = time.perf_counter()
        write_run(replace(self._simulation, video=video), self._files, on_step=count)
        seconds = time.perf_counter() - started
        sizes = dict(self.no_sizes)
        for path in self._files.outputs:
            sizes[path.suffix] += _size(path)
        return Trial(pairs, events, seconds, sizes)


def _size(path: Path) -> int:
    """Bytes of a file with what lies beside it, or of a folder."""
    beside = path.with_name(f"{path.name}.json")
    found = path.rglob("*") if path.is_dir() else (path, beside)
    return sum(one.stat().st_size for one in found if one.is_file())


@dataclass(frozen=True, eq=False)
class _Excerpt:
    """Frames of another stream, read once."""

    whole: FrameStream
    frames: Iterator[Frame]
    is_live: bool = False
    frame_count: int | None = None

    @property
    def size(self) -> SensorSize:
        return self.whole.size

    @property
    def fps(self) -> Fraction | None:
        return self.whole.fps

    @property
    def metadata(self) -> Mapping[str, Any]:
        return self.whole.metadata

    def __iter__(self) -> Iterator[Frame]:
        return self.frames


@dataclass(frozen=True, eq=False)
class _RenderableExcerpt(_Excerpt):
    """The same of a stream that renders any instant."""

    @property
    def flicker_hz(self) -> float | None:
        return getattr(self.whole, "flicker_hz", None)

    def at(self, t_us: int) -> Frame:
        whole: Any = self.whole
        frame: Frame = whole.at(t_us)
        return frame


@dataclass(frozen=True, eq=False)
class _SceneExcerpt(_RenderableExcerpt):
    """The same of a scene that knows its truth."""

    @property
    def class_names(self) -> Mapping[int, str]:
        return getattr(self.whole, "class_names", {})

    def ground_truth(self, t0_us: int, t1_us: int) -> Any:
        whole: Any = self.whole
        return whole.ground_truth(t0_us, t1_us)

    @property
    def has_moving_light(self) -> bool:
        return bool(getattr(self.whole, "has_moving_light", False))

    def with_motion(self) -> _SceneExcerpt:
        return self

    def luma_of(self, t_us: int, wanted: Any) -> Any:
        whole: Any = self.whole
        return whole.luma_of(t_us, wanted)

    def camera_at(self, t_us: int) -> Any:
        whole: Any = self.whole
        return whole.camera_at(t_us)

    def instances_at(self, t_us: int, points: Any) -> Any:
        whole: Any = self.whole
        return whole.instances_at(t_us, points)


def _excerpt(whole: FrameStream, frames: Iterator[Frame]) -> FrameStream:
    if all(hasattr(whole, name) for name in ("ground_truth", "camera_at", "instances_at")):
        return _SceneExcerpt(whole, frames)
    kind = _RenderableExcerpt if isinstance(whole, RenderableStream) else _Excerpt
    return kind(whole, frames)


def describe_estimate(estimate: Estimate) -> str:
    """The estimate in a few lines."""
    per_pair = (
        f"{estimate.events_per_pair:,.0f} events and {estimate.seconds_per_pair:.3f} s per pair "
        f"of frames ({estimate.pairs_tried} tried)"
    )
    peak = estimate.peak_bytes
    size = "not told by this system" if peak is None else f"{peak / 2**20:,.0f} MB"
    memory = f"memory {size}, however long the clip is"
    if estimate.pairs_total is None:
        return f"about {per_pair}; length unknown\n{memory}"
    pairs = estimate.pairs_total
    sizes = estimate.sizes(pairs)
    files = ", ".join(f"{size_text(size)} {kind}" for kind, size in sizes.items())
    return (
        f"about {estimate.events(pairs):,.0f} events, in {estimate.seconds(pairs):,.1f} s "
        f"({pairs} pairs)\n{per_pair}\n"
        f"files  {size_text(sum(sizes.values()))}: {files}\n{memory}"
    )


def size_text(size: float) -> str:
    """Bytes for people, such as "1.2 GB"."""
    for unit, name in ((2**40, "TB"), (2**30, "GB"), (2**20, "MB")):
        if size >= unit:
            return f"{size / unit:,.1f} {name}"
    return f"{size / 2**10:,.0f} KB"

"""A few pairs of a video run by themselves, timed without what happens only once."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import zip_longest
from pathlib import Path
from typing import Any, NamedTuple

from texvent.events import EventStream
from texvent.io.files import save
from texvent.pipeline import Simulation
from texvent.run.files import RunFiles, write_run
from texvent.sensor import SensorSize
from texvent.video import Frame, FrameStream, RenderableStream

MOST_PAIRS = 3
"""Pairs that are tried, spread over the clip, because scenes change."""
MOST_SECONDS = 10.0
"""No pair is begun after this long, and one that is not done by then is left."""
GROWING_PREVIEWS = ("mp4",)
"""Previews that take time for every pair; the others take it once."""


@dataclass(frozen=True)
class Trial:
    """What a pair of frames takes, told by as much of it as there was time for."""

    events: float
    seconds: float
    """One stage after the other."""
    cpu_seconds: float
    """Of all threads."""
    sizes: Mapping[str, int]
    """Extension → bytes of the files that were tried; none of a pair that was left."""


class Pair(NamedTuple):
    """Two neighbouring source frames, and what reading the second one took."""

    first: Frame
    second: Frame
    taken: Taken


class Taken(NamedTuple):
    """Time without compilation, s."""

    seconds: float
    cpu_seconds: float


NOTHING = Taken(0.0, 0.0)


class Clock:
    """Time since it was made, compilation left out, which happens once on a machine."""

    def __init__(self, compiled: Callable[[], float]) -> None:
        """Start.

        Args:
            compiled: gives the seconds that all kernels took to compile or load until now.
        """
        self._compiled = compiled
        self._began = time.perf_counter(), time.process_time(), compiled()

    def read(self) -> Taken:
        """The time until now."""
        began_s, began_cpu_s, compiled_s = self._began
        once_s = self._compiled() - compiled_s
        seconds = max(time.perf_counter() - began_s - once_s, 0.0)
        # Of compilation only the wall time is known.
        return Taken(seconds, seconds if once_s else time.process_time() - began_cpu_s)


def read_pairs(
    video: FrameStream, total: int | None, compiled: Callable[[], float], clock: Clock
) -> Iterator[Pair]:
    """Pairs from equal parts of a video, while there is time.

    A video that can begin anywhere gives the middles. Of others the frames between are read, as far
    as a share of the time allows; of a video of unknown length the pairs follow each other.

    Args:
        video: the frames.
        total: how many pairs it has, if that is known.
        compiled: as `Clock` takes it.
        clock: started with the estimate.
    """
    begin_at: Any = getattr(video, "from_frame", None)
    total = total or 0
    is_seekable = begin_at is not None and total > MOST_PAIRS
    frames = iter(()) if is_seekable else iter(video)
    first = next(frames, None)
    for part in range(1, MOST_PAIRS + 1):
        if is_seekable:
            frames = begin_at((2 * part - 1) * total // (2 * MOST_PAIRS))
            first = next(frames, None)
        reading = Clock(compiled)
        second = next(frames, None)
        if first is None or second is None:
            return
        yield Pair(first, second, reading.read())
        first = second
        for _ in range(0 if is_seekable else total // MOST_PAIRS - 1):
            if clock.read().seconds > MOST_SECONDS * part / MOST_PAIRS:
                break
            first = next(frames, None)
        if clock.read().seconds > MOST_SECONDS:
            return


class _TimeIsUpError(Exception):
    """Leaves a pair that takes too long."""


class Scratch:
    """Runs pairs into files of a folder that is thrown away."""

    def __init__(
        self,
        simulation: Simulation,
        files: RunFiles,
        folder: Path,
        compiled: Callable[[], float],
        clock: Clock,
    ) -> None:
        """Name the files in the folder.

        Args:
            simulation: the whole run.
            files: those of the whole run.
            folder: an empty one.
            compiled: as `Clock` takes it.
            clock: started with the estimate.
        """
        self._simulation, self._compiled, self._clock = simulation, compiled, clock
        events = [folder / f"{number}{path.suffix}" for number, path in enumerate(files.events)]
        self._files = replace(files, events=events, overwrite=True, keep_partial=False)
        previews = tuple(kind for kind in files.previews if kind in GROWING_PREVIEWS)
        self._growing = replace(self._files, previews=previews)
        self._closing_cpu_s: float | None = None
        """Of files without an event, those of `_growing`."""
        self.sizes_fixed: Mapping[str, int] = {}
        """Extension → bytes of files with hardly an event."""

    def first(self, pair: Pair) -> Trial:
        """Run a pair with all files, which imports and compiles."""
        self._run([pair.first], self._files)
        self.sizes_fixed = {
            kind: size + self._begun.get(kind, 0) for kind, size in _sizes(self._files).items()
        }
        return self._run([pair.first, pair.second], self._files, pair.taken)[0]

    def later(self, pair: Pair) -> Trial:
        """Run a pair with the files that take time for every pair."""
        if self._closing_cpu_s is None:
            self._closing_cpu_s = self._run([pair.first], self._growing)[1]
        trial, closing_cpu_s = self._run([pair.first, pair.second], self._growing, pair.taken)
        # What the writers still had to do when the pair was simulated.
        more_s = max(closing_cpu_s - self._closing_cpu_s, 0.0) if trial.sizes else 0.0
        return replace(
            trial, seconds=trial.seconds + more_s, cpu_seconds=trial.cpu_seconds + more_s
        )

    @property
    def _begun(self) -> Mapping[str, int]:
        """Extension → bytes that the first event adds to a file, beside its own."""
        none = EventStream.empty(self._simulation.video.size)
        one = EventStream.from_columns([0], [0], [0], [0], size=none.size)
        begun: dict[str, int] = {}
        for path, format in zip_longest(self._files.events, self._files.formats):
            sizes = []
            for events in (none, one):
                save(path, events, format=format, overwrite=True)
                sizes.append(_size(path))
            begun[path.suffix] = begun.get(path.suffix, 0) + sizes[1] - sizes[0]
        return begun

    def _run(
        self, frames: Sequence[Frame], files: RunFiles, reading: Taken = NOTHING
    ) -> tuple[Trial, float]:
        """Write the events of frames; a pair that is not done in time counts as far as it got.

        Returns:
            What it took from the first frame on, and the processor time of closing the files.
        """
        start_us, span_us = frames[0].t_us, max(frames[-1].t_us - frames[0].t_us, 1)
        share, fired, is_whole = 0.0, 0, True
        running, closing = Clock(self._compiled), Clock(self._compiled)
        taken = NOTHING

        def count(frame: Frame, packet: Any) -> None:
            nonlocal share, fired, running, closing, taken
            fired += len(packet)
            share = (frame.t_us - start_us) / span_us
            if share == 0:
                running = Clock(self._compiled)
            taken, closing = running.read(), Clock(self._compiled)
            if 0 < share < 1 and self._clock.read().seconds > MOST_SECONDS:
                raise _TimeIsUpError

        video = excerpt(self._simulation.video, iter(frames))
        try:
            write_run(replace(self._simulation, video=video), files, on_step=count)
        except _TimeIsUpError:
            is_whole = False
        closing_cpu_s = closing.read().cpu_seconds
        done = share or 1.0
        trial = Trial(
            events=fired / done,
            seconds=taken.seconds / done + reading.seconds,
            cpu_seconds=taken.cpu_seconds / done + reading.cpu_seconds,
            sizes=_sizes(files) if is_whole else {},
        )
        return trial, closing_cpu_s


def _sizes(files: RunFiles) -> dict[str, int]:
    """Extension → bytes."""
    sizes = {path.suffix: 0 for path in files.outputs}
    for path in files.outputs:
        sizes[path.suffix] += _size(path)
    return sizes


def _size(path: Path) -> int:
    """Bytes of a file and its sidecar, or of a folder."""
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


def excerpt(whole: FrameStream, frames: Iterator[Frame]) -> FrameStream:
    """Frames of a stream as a stream that can do what the whole can."""
    if all(hasattr(whole, name) for name in ("ground_truth", "camera_at", "instances_at")):
        return _SceneExcerpt(whole, frames)
    kind = _RenderableExcerpt if isinstance(whole, RenderableStream) else _Excerpt
    return kind(whole, frames)

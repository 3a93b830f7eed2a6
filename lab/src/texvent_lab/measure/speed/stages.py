"""The whole pipeline per pair of source frames: each stage alone, then all of them overlapped."""

from __future__ import annotations

import itertools
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal, TypeVar

from texvent.capture.open import open_frames
from texvent.extending import INTERPOLATORS
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.pairing import pair_frames
from texvent.io.files import open_writer
from texvent.pairs.frame_pair import FramePair
from texvent.pipeline import video_to_events
from texvent.runtime.background_writer import BackgroundWriter
from texvent.settings.resolution import Settings, resolve
from texvent.simulate.build import benefits_from_denser_frames, build_simulator
from texvent.video import Frame, FrameStream
from texvent_lab.measure.speed.timing import Quartiles, rounded

STAGES = ("decode", "luma", "count", "flow", "warp", "simulate", "write")
"""`count` is Eq. 4 with the search for cuts; `write` packs the events into universal HDF5."""
WARM_UP_PAIRS = 2
"""Pairs that are not timed: kernels load."""

Item = TypeVar("Item")
Engine = Literal["drawn", "fused"]


class StageClock:
    """Wall time of each stage of each pair, s; a stage inside another is not counted twice."""

    def __init__(self) -> None:
        self.pairs: list[dict[str, float]] = []
        self._now: dict[str, float] = defaultdict(float)
        self._open: list[str] = []
        self._since = 0.0

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Count the block for a stage of the pair at hand."""
        self._charge()
        self._open.append(name)
        try:
            yield
        finally:
            self._charge()
            self._open.pop()

    def each(self, name: str, items: Iterable[Item]) -> Iterator[Item]:
        """The items; making each counts for a stage."""
        source = iter(items)
        while True:
            with self.stage(name):
                item: Any = next(source, self)
            if item is self:
                return
            yield item

    def end_pair(self) -> None:
        """What follows belongs to the next pair."""
        self._charge()
        self.pairs.append(dict(self._now))
        self._now.clear()

    def _charge(self) -> None:
        now = time.perf_counter()
        if self._open:
            self._now[self._open[-1]] += now - self._since
        self._since = now

    @property
    def timed(self) -> list[dict[str, float]]:
        """The pairs behind the warm-up."""
        return self.pairs[WARM_UP_PAIRS:]


class _TimedInterpolator:
    """An interpolator whose work per pair, its optical flow, counts as a stage."""

    def __init__(self, inner: Any, clock: StageClock) -> None:
        self._inner = inner
        self._clock = clock

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Any:
        with self._clock.stage("flow"):
            return self._inner.between(first, second, times_us)


def measure_pipeline(
    clip: Path, name: str, *, interpolate: str, engine: Engine, pairs: int
) -> dict[str, Any]:
    """One row: stages alone, and the same pairs through the overlapped pipeline.

    Args:
        clip: a video file with two pairs more than are measured.
        name: what to call it.
        interpolate: option of that name.
        engine: "drawn" makes every intermediate frame and steps the simulator through it, the
            readable path; "fused" is what a run does: no intermediate frame is drawn, so `warp`
            is a part of `simulate`.
        pairs: how many pairs are timed.
    """
    settings = resolve("simulate", {"interpolate": interpolate})
    video = open_frames(str(clip), settings.source)
    clock = StageClock()
    count = pairs + WARM_UP_PAIRS
    with tempfile.TemporaryDirectory() as folder:
        part = _Part(video, count + 1)
        events = _run_alone(part, settings, clock, engine, Path(folder) / "alone.h5")
        overlapped = None
        if engine == "fused":
            overlapped = _run_overlapped(video, settings, count, Path(folder) / "overlapped.h5")
    stages = {
        stage: Quartiles.of([one.get(stage, 0.0) for one in clock.timed], scale=1e3).as_json()
        for stage in STAGES
    }
    alone = [sum(one.values()) for one in clock.timed]
    row = {
        "clip": name,
        "size": str(video.size),
        "interpolate": interpolate,
        "engine": engine,
        "pairs": len(alone),
        "events_per_pair": rounded(events / len(clock.pairs)),
        "stages_ms": stages,
        "alone_ms": Quartiles.of(alone, scale=1e3).as_json(),
    }
    if overlapped is not None:
        row["overlapped_ms"] = rounded(overlapped * 1e3)
        row["gain_by_overlap"] = rounded(sum(alone) / len(alone) / overlapped)
    return row


class _Part:
    """The first frames of a stream."""

    def __init__(self, whole: FrameStream, count: int) -> None:
        self._whole = whole
        self._count = count

    def __getattr__(self, name: str) -> Any:
        return getattr(self._whole, name)

    def __iter__(self) -> Iterator[Frame]:
        return itertools.islice(iter(self._whole), self._count)


def _run_alone(
    video: Any, settings: Settings, clock: StageClock, engine: Engine, path: Path
) -> int:
    """One stage after the other, in one thread of ours; returns the number of events."""
    simulator = build_simulator(settings.run, settings.simulate)
    inner = INTERPOLATORS.load(settings.interpolate.interpolate)(settings.interpolate, video)
    policy = CountPolicy(
        settings.interpolate,
        video,
        inner,
        balance=simulator.balance,
        contrast_threshold=simulator.contrast_threshold,
        counts_motion=benefits_from_denser_frames(simulator),
    )
    frames = _with_luma(clock.each("decode", video), clock)
    interpolator = _TimedInterpolator(inner, clock)
    planned = clock.each("count", pair_frames(frames, interpolator, settings.interpolate, policy))
    if engine == "fused":
        steps = (step for pair in planned for step in simulator.advance(pair))
    else:
        drawn = _with_timed_frames(planned, clock)
        steps = ((frame, simulator.step(frame)) for pair in drawn for frame in pair.frames)
    total = 0
    with open_writer(path, size=video.size) as writer:
        for frame, packet in clock.each("simulate", steps):
            total += len(packet)
            with clock.stage("write"):
                writer.append(packet)
            if frame.is_source and frame.t_us > 0:
                clock.end_pair()
    return total


def _with_luma(frames: Iterable[Frame], clock: StageClock) -> Iterator[Frame]:
    for frame in frames:
        with clock.stage("luma"):
            frame.luma  # noqa: B018  (a cached property)
        yield frame


def _with_timed_frames(pairs: Iterable[FramePair], clock: StageClock) -> Iterator[FramePair]:
    for pair in pairs:
        yield replace(pair, between=clock.each("warp", pair.between))


def _run_overlapped(video: FrameStream, settings: Settings, pairs: int, path: Path) -> float:
    """Seconds per pair behind the warm-up of what `texvent simulate --previews none` does."""
    done = -1
    started = ended = 0.0
    with open_writer(path, size=video.size) as writer, BackgroundWriter(writer) as behind:
        for frame, packet in video_to_events(video, settings).steps():
            behind.append(packet)
            if not frame.is_source:
                continue
            done += 1
            ended = time.perf_counter()
            if done == WARM_UP_PAIRS:
                started = ended
            if done == pairs:
                break
    if done <= WARM_UP_PAIRS:
        raise ValueError(f"the clip has {done} pairs of frames; give one with more")
    return (ended - started) / (done - WARM_UP_PAIRS)

"""Time per frame of every pixel model, and the least that memory allows.

    python -m texvent_lab.measure.model_kernels [--steps 24] [--model physical:clean ...]

The clip is the one of `texvent_lab.measure.speed`: a random share of the pixels jumps by about two
thresholds per frame. Whole `step` calls are timed: checks, the pixels, noise, order, the finished
packet. The floor is reading the frame from main memory and one byte of state per pixel and the
events from the cache. "2 clips" is two clips at once, a thread each, per frame of both together;
"shared" is one clip whose frames two threads share, where the model does that; both are elapsed
time. CPU time is that of one thread, which a busy machine stretches less.
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any, NamedTuple

from texvent.extending import SIMULATORS
from texvent.sensor import SensorSize
from texvent_lab.measure.speed.floor import Bandwidth, measure_bandwidth
from texvent_lab.measure.speed.scenes import Bytes, jumping_pixels, to_and_fro

SIZES = (SensorSize(346, 260), SensorSize(1280, 720))
DENSITIES = (0.001, 0.01, 0.05, 0.2)
CASES = (
    "senpi",
    "esim",
    "v2e",
    "v2e:peer-common",
    "voltmeter",
    "physical",
    "physical:clean",
)
"""MODEL or MODEL:PRESET."""
SHARING = ("v2e", "voltmeter", "physical")
"""Models whose frames threads share."""
FRAMES = 16
"""Frames that differ: at 720p together more than the caches hold."""
VARIABLE = "TEXVENT_NUM_THREADS"


class Row(NamedTuple):
    """Medians per frame of one model at one size and density, ms."""

    model: str
    size: SensorSize
    density: float
    events: float
    """Per frame."""
    cpu_ms: float
    """CPU time of one thread."""
    elapsed_ms: float
    """One thread."""
    floor_ms: float
    clips_ms: float
    """Two clips at once."""
    shared_ms: float | None
    """One clip on two threads; None where its frames are not shared."""

    @property
    def mpixel_per_s(self) -> float:
        """By CPU time."""
        return self.size.width * self.size.height / self.cpu_ms / 1e3

    @property
    def mevents_per_s(self) -> float:
        """By CPU time."""
        return self.events / self.cpu_ms / 1e3


class Run:
    """One model on one endless clip, compiled and on its way."""

    def __init__(self, model: str, frames: Bytes) -> None:
        name, _, preset = model.partition(":")
        simulator: Any = SIMULATORS.load(name)
        self._simulator = simulator(simulator.presets[preset] if preset else None)
        self._frames = to_and_fro(frames)
        self.step()
        self.step()
        self.step()

    def step(self) -> int:
        """Simulate the next frame; returns the number of its events."""
        return len(self._simulator.step(next(self._frames)))

    def milliseconds(self, steps: int, clock: Callable[[], float]) -> float:
        """Median per step."""
        times = []
        for _ in range(steps):
            start = clock()
            self.step()
            times.append((clock() - start) * 1e3)
        return statistics.median(times)


def measure_models(
    steps: int, bandwidth: Bandwidth, models: Sequence[str] = CASES
) -> Iterator[Row]:
    """A row per model, size and density.

    Args:
        steps: how many are timed for each figure.
        bandwidth: of one thread.
        models: MODEL or MODEL:PRESET each.
    """
    for model in models:
        for size in SIZES:
            for density in DENSITIES:
                frames = jumping_pixels(size, density, FRAMES)
                yield _measure(model, size, density, frames, steps, bandwidth)


def _measure(
    model: str,
    size: SensorSize,
    density: float,
    frames: Bytes,
    steps: int,
    bandwidth: Bandwidth,
) -> Row:
    with threads_at_most(1):
        run = Run(model, frames)
        events = sum(run.step() for _ in range(steps)) / steps
        cpu_ms = run.milliseconds(steps, time.thread_time)
        elapsed_ms = run.milliseconds(steps, time.perf_counter)
        clips_ms = _two_clips(model, frames, steps)
    shared_ms = None
    if model.partition(":")[0] in SHARING:
        with threads_at_most(2):
            shared_ms = Run(model, frames).milliseconds(steps, time.perf_counter)
    floor_ms = bandwidth.floor_s(size, events) * 1e3
    return Row(model, size, density, events, cpu_ms, elapsed_ms, floor_ms, clips_ms, shared_ms)


def _two_clips(model: str, frames: Bytes, steps: int) -> float:
    """Milliseconds per frame of two clips at once: the best of three, over frames of both."""
    runs = [Run(model, frames) for _ in range(2)]
    times = []
    with ThreadPoolExecutor(len(runs)) as pool:
        for _ in range(3):
            start = time.perf_counter()
            list(pool.map(lambda run: [run.step() for _ in range(steps)], runs))
            times.append(time.perf_counter() - start)
    return min(times) / (steps * len(runs)) * 1e3


@contextmanager
def threads_at_most(count: int) -> Iterator[None]:
    """So many threads share a frame, whatever the machine has."""
    before = os.environ.get(VARIABLE)
    os.environ[VARIABLE] = str(count)
    try:
        yield
    finally:
        if before is None:
            del os.environ[VARIABLE]
        else:
            os.environ[VARIABLE] = before


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--steps", type=int, default=24, help="steps timed for each figure")
    parser.add_argument("--model", nargs="+", default=CASES, help="MODEL or MODEL:PRESET")
    arguments = parser.parse_args()
    print(
        f"{'model':16} {'size':9} {'density':>7} {'events':>8} {'cpu ms':>7} {'elapsed':>7}"
        f" {'floor':>6} {'2 clips':>7} {'shared':>7} {'Mpx/s':>6} {'Mev/s':>6}"
    )
    for row in measure_models(arguments.steps, measure_bandwidth(1), arguments.model):
        shared = "-" if row.shared_ms is None else f"{row.shared_ms:.2f}"
        print(
            f"{row.model:16} {row.size!s:9} {row.density:7.1%} {row.events:8.0f}"
            f" {row.cpu_ms:7.2f} {row.elapsed_ms:7.2f} {row.floor_ms:6.3f} {row.clips_ms:7.2f}"
            f" {shared:>7} {row.mpixel_per_s:6.0f} {row.mevents_per_s:6.1f}",
            flush=True,
        )


if __name__ == "__main__":
    main()

"""Simulators alone: time per frame by model, size, density and threads, and the floor."""

from __future__ import annotations

import itertools
import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from texvent.extending import SIMULATORS
from texvent.sensor import SensorSize
from texvent.video import Frame
from texvent_lab.measure.speed.scenes import Bytes, jumping_pixels, to_and_fro
from texvent_lab.measure.speed.timing import Bandwidth, Quartiles, rounded, seconds

SIZES = (SensorSize(346, 260), SensorSize(1280, 720))
DENSITIES = (0.001, 0.01, 0.05, 0.2)
WARM_UP_FRAMES = 3
BATCH = 16
"""Frames that a model is given at once."""
THREADS = "TEXVENT_NUM_THREADS"


@dataclass(frozen=True)
class Plan:
    """How much is measured."""

    frames: int
    """Frames that differ: together more than the caches hold, so that each comes from DRAM."""
    steps: int
    """Steps that are timed."""
    models: tuple[str, ...] = ("texvent", "esim")
    """One event per pixel and frame (the paper preset), and several."""


QUICK = Plan(frames=16, steps=24)
FULL = Plan(
    frames=48, steps=96, models=("texvent", "esim", "v2e", "senpi", "voltmeter", "physical")
)


@contextmanager
def threads_at_most(count: int) -> Iterator[None]:
    """So many threads share a frame, whatever the machine has."""
    before = os.environ.get(THREADS)
    os.environ[THREADS] = str(count)
    try:
        yield
    finally:
        if before is None:
            del os.environ[THREADS]
        else:
            os.environ[THREADS] = before


class Run:
    """One simulator on one endless clip."""

    def __init__(self, model: str, frames: Bytes) -> None:
        presets = SIMULATORS.load(model).presets
        config = presets["paper" if model == "texvent" else next(iter(presets))]
        self.simulator: Any = SIMULATORS.load(model)(config)
        self._frames: Iterator[Frame] = to_and_fro(frames)
        self.events = 0

    def step(self) -> float:
        """Simulate the next frame; returns the seconds it took."""
        frame = next(self._frames)
        packet: list[Any] = []
        taken = seconds(lambda: packet.append(self.simulator.step(frame)))
        self.events += len(packet[0])
        return taken

    def warm_up(self) -> Run:
        """Let everything compile, and forget what was counted until then."""
        self.steps(WARM_UP_FRAMES)
        self.events = 0
        return self

    def steps(self, count: int) -> list[float]:
        """Seconds of each of the next frames."""
        return [self.step() for _ in range(count)]


def measure_kernels(plan: Plan, bandwidths: dict[int, Bandwidth]) -> list[dict[str, Any]]:
    """A row per model, size, density and way of working.

    "clip" is one thread, frame by frame; "clips" two threads, each with a clip of its own.
    """
    rows = []
    for size, density in itertools.product(SIZES, DENSITIES):
        frames = jumping_pixels(size, density, plan.frames)
        for model in plan.models:
            ways, events = _measure_ways(model, frames, plan.steps)
            for way, time_ms in ways.items():
                floor_s = bandwidths[1 if way == "clip" else 2].floor_s(size, events)
                row = {"model": model, "size": str(size), "density": density, "way": way}
                rows.append({**row, **_figures(size, events, time_ms, floor_s * 1e3)})
    return rows


def _measure_ways(model: str, frames: Bytes, steps: int) -> tuple[dict[str, Quartiles], float]:
    """Milliseconds per frame by way of working, and events per frame."""
    with threads_at_most(1):
        one = Run(model, frames).warm_up()
        ways = {"clip": Quartiles.of(one.steps(steps), scale=1e3)}
        events = one.events / steps
        ways["clips"] = _in_two_threads(model, frames, steps)
    return ways, events


def _in_two_threads(model: str, frames: Bytes, steps: int) -> Quartiles:
    """Milliseconds per frame of two clips at once: elapsed time over frames of both."""
    runs = [Run(model, frames).warm_up() for _ in range(2)]
    chunks, per_chunk = 6, max(1, steps // 6)
    with ThreadPoolExecutor(len(runs)) as pool:

        def both() -> None:
            list(pool.map(lambda run: run.steps(per_chunk), runs))

        times = [seconds(both) / (per_chunk * len(runs)) for _ in range(chunks)]
    return Quartiles.of(times, scale=1e3)


def _figures(
    size: SensorSize, events: float, time_ms: Quartiles, floor_ms: float
) -> dict[str, Any]:
    per_second = 1e3 / time_ms.median
    return {
        "events_per_frame": rounded(float(events)),
        "ms_per_frame": time_ms.as_json(),
        "mpixel_per_s": rounded(size.width * size.height * per_second / 1e6),
        "mevents_per_s": rounded(events * per_second / 1e6),
        "floor_ms": rounded(floor_ms),
        "times_floor": rounded(time_ms.median / floor_ms),
    }

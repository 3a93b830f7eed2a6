"""Simulators alone: time per frame by model, size, density and threads."""

from __future__ import annotations

import itertools
import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from texvent.brightness import balanced_log
from texvent.extending import SIMULATORS
from texvent.frames import Frame
from texvent.sensor import SensorSize
from texvent_lab.measure.speed.scenes import Bytes, jumping_pixels, to_and_fro
from texvent_lab.measure.speed.timing import quartiles, rounded, seconds

SIZES = (SensorSize(346, 260), SensorSize(1280, 720))
DENSITIES = (0.001, 0.01, 0.05, 0.2)
WARM_UP_FRAMES = 3
THREADS = "TEXVENT_NUM_THREADS"


@dataclass(frozen=True)
class KernelPlan:
    """Sizes, densities, frames, steps and models."""

    frames: int
    """Frames that differ: together more than the caches hold, so that each comes from DRAM."""
    steps: int
    """Steps that are timed."""
    models: tuple[str, ...]
    sizes: tuple[SensorSize, ...] = SIZES
    densities: tuple[float, ...] = DENSITIES


QUICK = KernelPlan(
    frames=16, steps=24, models=("texvent", "esim"), sizes=SIZES[:1], densities=DENSITIES[2:3]
)
"""One event per pixel and frame (the paper preset), and several."""
FULL = KernelPlan(
    frames=48, steps=96, models=("texvent", "esim", "v2e", "voltmeter", "senpi", "physical")
)


@contextmanager
def one_thread_per_frame() -> Iterator[None]:
    """Keep the kernels to one thread, whatever the machine has."""
    before = os.environ.get(THREADS)
    os.environ[THREADS] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ[THREADS]
        else:
            os.environ[THREADS] = before


class WarmSimulator:
    """One simulator on one endless clip, warmed up."""

    def __init__(self, model: str, frames: Bytes) -> None:
        """Compile everything, and count events from then on."""
        presets = SIMULATORS.load(model).presets
        config = presets["paper" if model == "texvent" else next(iter(presets))]
        self.simulator: Any = SIMULATORS.load(model)(config)
        self._frames: Iterator[Frame] = to_and_fro(frames)
        self.events = 0
        self.steps(WARM_UP_FRAMES)
        self.events = 0

    def steps(self, count: int) -> list[float]:
        """Seconds of each of the next frames."""
        return [seconds(self._step) for _ in range(count)]

    def _step(self) -> None:
        self.events += len(self.simulator.step(next(self._frames)))


def measure_kernels(plan: KernelPlan) -> list[dict[str, Any]]:
    """A row per model, size, density and way of working.

    "clip" is one thread, frame by frame; "clips" two threads, each with a clip of its own.
    """
    rows = []
    for size, density in itertools.product(plan.sizes, plan.densities):
        frames = jumping_pixels(size, density, plan.frames)
        for model in plan.models:
            with one_thread_per_frame():
                one = WarmSimulator(model, frames)
                ways = {"clip": quartiles(one.steps(plan.steps), scale=1e3)}
                ways["clips"] = _in_two_threads(model, frames, plan.steps)
            events = one.events / plan.steps
            for way, time_ms in ways.items():
                per_second = 1e3 / time_ms["median"]
                rows.append({
                    "model": model, "size": str(size), "density": density, "way": way,
                    "events_per_frame": rounded(events), "ms_per_frame": time_ms,
                    "mpixel_per_s": rounded(size.width * size.height * per_second / 1e6),
                    "mevents_per_s": rounded(events * per_second / 1e6),
                })  # fmt: skip
    return rows


def _in_two_threads(model: str, frames: Bytes, steps: int) -> dict[str, Any]:
    """Milliseconds per frame of two clips at once: elapsed time over frames of both."""
    runs = [WarmSimulator(model, frames) for _ in range(2)]
    chunks, per_chunk = 6, max(1, steps // 6)
    with ThreadPoolExecutor(len(runs)) as pool:

        def both() -> None:
            list(pool.map(lambda run: run.steps(per_chunk), runs))

        times = [seconds(both) / (per_chunk * len(runs)) for _ in range(chunks)]
    return quartiles(times, scale=1e3)


def measure_definition() -> dict[str, Any]:
    """Milliseconds per frame of Eq. 5 alone in NumPy, at the size and density of `QUICK`."""
    config = SIMULATORS.load("texvent").presets["paper"]
    clip = to_and_fro(jumping_pixels(QUICK.sizes[0], QUICK.densities[0], QUICK.frames))
    reference = balanced_log(next(clip).luma, config.balance)

    def step() -> None:
        brightness = balanced_log(next(clip).luma, config.balance)
        fires = np.abs(brightness - reference) >= config.contrast_threshold
        reference[fires] = brightness[fires]

    return quartiles([seconds(step) for _ in range(QUICK.steps)], scale=1e3)

"""Time per frame of the Texvent simulator, by backend, size and event density.

    python -m benchmarks.texvent_kernel [--frames 30]

Each row times whole `step` calls (checks, logarithm, Eqs. 5-7, sorting, the finished packet) and,
apart from them, the scan for crossings alone. The clip is a grey picture of which a random share
of pixels jumps by 0.3 log units per frame, so the density is known. Frames are made before the
clock starts; the first step of a run, which compiles, is not timed. One thread.
"""

from __future__ import annotations

import argparse
import itertools
import time
from typing import Literal

import numpy as np

from texvent.brightness import balanced_log
from texvent.sensor import SensorSize
from texvent.simulate.kernels.select import load_kernels
from texvent.simulate.texvent import TexventConfig, TexventSimulator
from texvent.video import Frame

SIZES = (SensorSize(346, 260), SensorSize(1280, 720))
DENSITIES = (0.001, 0.01, 0.05, 0.2)
DARK, BRIGHT = 100, 145
FRAME_US = 5_000
PixelType = type[np.uint8] | type[np.float32]
KINDS: tuple[tuple[PixelType, Literal["adaptive", "none"]], ...] = (
    (np.uint8, "adaptive"),
    (np.float32, "none"),
)


def make_clip(size: SensorSize, density: float, count: int, dtype: PixelType) -> list[Frame]:
    """Frames in which about `density` of the pixels jump by ln(175 / 130) = 0.297."""
    rng = np.random.default_rng(0)
    bright = np.zeros(size.shape, np.bool_)
    frames = []
    for index in range(count):
        bright = bright ^ (rng.random(size.shape) < density)
        frames.append(Frame(np.where(bright, BRIGHT, DARK).astype(dtype), index * FRAME_US))
    return frames


def time_steps(frames: list[Frame], config: TexventConfig, backend: str) -> tuple[list[float], int]:
    """Milliseconds of each step but the first two, and the number of events in them."""
    simulator = TexventSimulator(config, backend=backend)
    for frame in frames[:2]:
        simulator.step(frame)
    elapsed, events = [], 0
    for frame in frames[2:]:
        start = time.perf_counter()
        packet = simulator.step(frame)
        elapsed.append((time.perf_counter() - start) * 1e3)
        events += len(packet)
    return elapsed, events


def time_scan(frames: list[Frame], backend: str) -> list[float]:
    """Milliseconds of each scan for crossings between neighbouring frames, but the first."""
    find = load_kernels(backend).find_crossings
    images = [balanced_log(frame.luma, 30.0) for frame in frames[:8]]
    elapsed = []
    for before, now in itertools.pairwise(images):
        start = time.perf_counter()
        find(now, before, 0.2)
        elapsed.append((time.perf_counter() - start) * 1e3)
    return elapsed[1:]


def _row(times: list[float]) -> str:
    low, median, high = np.percentile(times, (25, 50, 75))
    return f"{median:8.2f} ({high - low:5.2f})"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--frames", type=int, default=30, help="frames per row, at least 5")
    count = max(5, parser.parse_args().frames)
    print("milliseconds per frame: median (interquartile range)")
    print("size       pixels   noise     backend    density  events/frame  step              scan")
    for size in SIZES:
        for dtype, noise in KINDS:
            for density in DENSITIES:
                frames = make_clip(size, density, count, dtype)
                for backend in ("reference", "cpu"):
                    # Every pixel counts as dark, so that noise costs what it can cost at most.
                    config = TexventConfig(noise=noise, noise_intensity=255.0)
                    steps, events = time_steps(frames, config, backend)
                    scans = time_scan(frames, backend)
                    print(
                        f"{size!s:10} {dtype.__name__:8} {noise:9} {backend:10} {density:7.1%}"
                        f" {events / len(steps):13,.0f} {_row(steps)} {_row(scans)}"
                    )


if __name__ == "__main__":
    main()

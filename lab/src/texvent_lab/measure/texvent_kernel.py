"""Time per frame of the Texvent simulator, and the least that memory allows.

    python -m texvent_lab.measure.texvent_kernel [--frames 48] [--rounds 5] [--cold]

The clip is a grey image of which a random share of pixels jumps by 0.3 log units per frame, so
the density is known. A row times whole `step` calls (checks, Eqs. 5-7, noise, order, the finished
packet). Its floor is what any program must do: read the frame from main memory and the reference
from the cache, and write 14 bytes per event. Floor and step take turns in every round, frames are
more than the last cache holds, and nothing that compiles is timed. One thread, unless stated;
percentiles are over frames and rounds.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.sensor import SensorSize
from texvent.simulate.texvent.simulator import TexventConfig, TexventSimulator
from texvent.video import Frame

SIZES = (SensorSize(346, 260), SensorSize(1280, 720))
DENSITIES = (0.001, 0.01, 0.05, 0.2)
DARK, BRIGHT = 100, 145
FRAME_US = 5_000
PixelType = type[np.uint8] | type[np.uint16] | type[np.float32]
TYPES: tuple[PixelType, ...] = (np.uint8, np.uint16, np.float32)
WARM_UP = 3
"""Steps that are not timed: the first has nothing to compare with, the others compile."""


class Times(NamedTuple):
    """Milliseconds per frame, and what the frames gave."""

    step: list[float]
    """Of whole steps."""
    floor: list[float]
    """Of reading the same frames and writing as many events."""
    events: int
    """Events in all timed steps."""

    @property
    def events_per_second(self) -> float:
        """At the 10th percentile of the time."""
        return self.events / len(self.step) / (percentile(self.step, 10) * 1e-3)

    @property
    def ratio_to_floor(self) -> float:
        """Of the 10th percentiles."""
        return percentile(self.step, 10) / percentile(self.floor, 10)


def make_clip(size: SensorSize, density: float, count: int, dtype: PixelType) -> list[Frame]:
    """Frames in which about `density` of the pixels jump by ln(175 / 130) = 0.297."""
    rng = np.random.default_rng(0)
    scale = 257 if dtype is np.uint16 else 1
    bright = np.zeros(size.shape, np.bool_)
    frames = []
    for index in range(count):
        bright = bright ^ (rng.random(size.shape, np.float32) < density)
        pixels = np.where(bright, BRIGHT * scale, DARK * scale).astype(dtype)
        frames.append(Frame(pixels, index * FRAME_US))
    return frames


def time_frames(frames: Sequence[Frame], config: TexventConfig, *, rounds: int = 5) -> Times:
    """Time every step of a clip, and its floor, in turns.

    Args:
        frames: at least four; all but the first three are timed.
        config: options of the model.
        rounds: how often the clip is simulated.
    """
    steps, floors, events = [], [], 0
    simulator = TexventSimulator(config)
    for _ in range(rounds):
        simulator.reset()
        counts = []
        for index, frame in enumerate(frames):
            start = time.perf_counter()
            packet = simulator.step(frame)
            elapsed = time.perf_counter() - start
            if index >= WARM_UP:
                steps.append(elapsed * 1e3)
                counts.append(len(packet))
        events += sum(counts)
        floors += _time_floor(frames, counts)
    return Times(steps, floors, events)


def _time_floor(frames: Sequence[Frame], counts: Sequence[int]) -> list[float]:
    """Milliseconds of reading each frame and the one before the clip, and of writing events."""
    reference = frames[0].pixels.reshape(-1).copy()
    out = np.empty(14 * max(counts), np.uint8)
    elapsed = []
    _read_and_write(reference, reference, out)
    for frame, count in zip(frames[WARM_UP:], counts, strict=True):
        pixels = frame.pixels.reshape(-1)
        start = time.perf_counter()
        _read_and_write(pixels, reference, out[: 14 * count])
        elapsed.append((time.perf_counter() - start) * 1e3)
    return elapsed


@numba.njit(nogil=True)
def _read_and_write(frame: NDArray[Any], reference: NDArray[Any], out: NDArray[np.uint8]) -> bool:
    differs = False
    for i in range(frame.size):
        differs |= frame[i] != reference[i]
    for i in range(out.size):
        out[i] = differs
    return differs


def clips_per_second(
    clips: Sequence[Sequence[Frame]], config: TexventConfig, threads: int
) -> float:
    """Clips simulated per second, each by one thread, so many at a time."""

    def run(clip: Sequence[Frame]) -> int:
        simulator = TexventSimulator(config)
        return sum(len(simulator.step(frame)) for frame in clip)

    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(run, clips[:threads]))
        start = time.perf_counter()
        list(pool.map(run, clips))
        return len(clips) / (time.perf_counter() - start)


def time_cold_start() -> Iterator[tuple[str, float]]:
    """What, and seconds until the first events.

    Each in a process of its own; the first has nothing in Numba's cache.
    """
    program = (
        "import time; start = time.perf_counter()\n"
        "import numpy as np\n"
        "from texvent.simulate.texvent.simulator import TexventSimulator\n"
        "from texvent.video import Frame\n"
        "imported = time.perf_counter()\n"
        "simulator = TexventSimulator()\n"
        "for k in range(3):\n"
        "    simulator.step(Frame(np.full((720, 1280), 60 * k, np.uint8), 5000 * k))\n"
        "print(time.perf_counter() - imported)\n"
    )
    with tempfile.TemporaryDirectory() as cache:
        for name in ("nothing compiled yet", "compiled before"):
            made = subprocess.run(
                [sys.executable, "-c", program],
                env=os.environ | {"NUMBA_CACHE_DIR": str(Path(cache))},
                check=True,
                capture_output=True,
                text=True,
            )
            yield name, float(made.stdout)


def percentile(times: Sequence[float], percent: float) -> float:
    """Percentile 0..100 of some times."""
    return float(np.percentile(times, percent))


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--frames", type=int, default=48, help="frames per clip, at least 8")
    parser.add_argument("--rounds", type=int, default=5, help="how often each clip is simulated")
    parser.add_argument("--cold", action="store_true", help="also time the first start (20 s)")
    arguments = parser.parse_args()
    count = max(8, arguments.frames)
    print("size      pixels   density  events/frame  ms: p10 median  floor  ratio  Mevents/s")
    for size in SIZES:
        for dtype in TYPES:
            for density in DENSITIES:
                frames = make_clip(size, density, count, dtype)
                times = time_frames(frames, TexventConfig(), rounds=arguments.rounds)
                print(
                    f"{size!s:9} {dtype.__name__:8} {density:7.1%}"
                    f" {times.events / len(times.step):13,.0f}"
                    f" {percentile(times.step, 10):8.3f} {statistics.median(times.step):6.3f}"
                    f" {percentile(times.floor, 10):6.3f} {times.ratio_to_floor:6.1f}"
                    f" {times.events_per_second / 1e6:10.0f}"
                )
    clips = [make_clip(SIZES[1], 0.05, count, np.uint8)] * 4
    one, two = (clips_per_second(clips, TexventConfig(), threads) for threads in (1, 2))
    print(f"\nclips at once, 1280x720, 5 %: 2 threads {two / one:.2f} times one thread")
    if arguments.cold:
        for name, first in time_cold_start():
            print(f"{name}: first events after {first:.2f} s")


if __name__ == "__main__":
    main()

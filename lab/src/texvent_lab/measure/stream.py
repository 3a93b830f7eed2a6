"""Clips per hour of the training stream, beside a plain NumPy simulator in the same run.

    python -m texvent_lab.measure.stream [--device cuda] [--randomize recommended] [--json FILE]

Clips of 40 frames and 128x128 px with grids of 5 bins, from 8-bit clips in memory, everything drawn
as V2V draws it; a grid spans five frames of the video, so that a clip has 200 intervals. The plain
simulator is V2V's model, written down as arrays: one frame after the other, in one thread, once by
the functions of NumPy that V2V's program calls and once by the fastest ones that do the same. Both
make grids alone, of clips with the same draws; the plain one's have no times within a frame, and
its time leaves out crops and batches. On a CPU both are timed by the seconds of one core that they
take, so that a busy machine counts little, and the stream by the clock too; on a GPU by the clock.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.extending import require
from texvent.training import Clip, EventStream
from texvent.training.draws import RANGES
from texvent_lab.bench.document import describe_environment, write_document
from texvent_lab.measure.speed.timing import quartiles, rounded

HOUR = 3600.0


@dataclass(frozen=True)
class StreamPlan:
    """Sizes and repeats."""

    batch: int = 12
    frames: int = 40
    side: int = 128
    bins: int = 5
    randomize: str = "v2v"
    """Pixels of the stream; those of the plain simulator are V2V's."""
    repeats: int = 15
    """Batches that are timed; one before them is not."""
    plain: int = 12
    """Clips of the plain simulators, at most a batch."""


class Textures:
    """Blurred textures that slide by a pixel a frame, a little larger than the crops."""

    known_truth: Sequence[str] = ()

    def __init__(self, plan: StreamPlan) -> None:
        """Textures as long as a clip of the plan."""
        self._count = plan.frames * plan.bins + 1
        self._side = plan.side + 16

    def __len__(self) -> int:
        """Few, so that none is made twice."""
        return 4

    def name(self, index: int) -> str:
        """Its number."""
        return f"texture {index}"

    def read(self, index: int, truth: Sequence[str], most_bytes: int) -> Clip:
        """See `texvent.training.ClipSource`."""
        rng = np.random.default_rng(index)
        film = rng.random((self._side, self._side + self._count))
        for axis in (0, 1, 0, 1):
            film = np.mean([np.roll(film, shift, axis) for shift in range(-3, 4)], axis=0)
        film = np.clip(128 + (film - film.mean()) / film.std() * 50, 0, 255).astype(np.uint8)
        frames = [film[:, at : at + self._side] for at in range(self._count)]
        return Clip(np.stack(frames), np.arange(self._count) * 41_667)


class PlainNumpy(NamedTuple):
    """Functions that the plain simulator calls."""

    normal: Callable[[tuple[int, ...]], NDArray[np.float64]]
    floor_divide: Callable[[NDArray[np.float64], float], NDArray[np.float64]]


def plain_kinds() -> dict[str, PlainNumpy]:
    """The functions of V2V's program, and the fastest that do the same."""
    generator, legacy = np.random.default_rng(0), np.random.RandomState(0)
    return {
        "v2v": PlainNumpy(lambda shape: legacy.randn(*shape), np.floor_divide),
        "lean": PlainNumpy(generator.standard_normal, lambda one, by: np.floor(one / by)),
    }


def simulate_plainly(
    frames: NDArray[np.uint8], drawn: dict[str, float], bins: int, numpy: PlainNumpy
) -> NDArray[np.float32]:
    """Signed counts per pixel and interval, [W, bins, H, W], of a potential per pixel."""
    on, off = drawn["threshold_on"], drawn["threshold_off"]
    shape, rng = frames.shape[1:], np.random.default_rng(0)
    brightness = np.log(1e-3 + (frames / 255.0) ** 2.2)
    potential = rng.random(shape) * (on + off) - off
    is_hot = rng.random(shape) < drawn["hot_fraction"]
    hot = np.where(is_hot, drawn.get("hot_noise", 0.0) * numpy.normal(shape), 0.0)
    counts = []
    for before, now in pairwise(brightness):
        potential += now - before
        potential += drawn.get("noise", 0.0) * numpy.normal(shape)
        potential += hot
        up = np.where(potential >= on, numpy.floor_divide(potential, on), 0.0)
        down = np.where(potential <= -off, numpy.floor_divide(-potential, off), 0.0)
        potential -= up * on
        potential += down * off
        counts.append(up - down)
    return np.array(counts).reshape(-1, bins, *shape).astype(np.float32)


def measure(plan: StreamPlan, device: str) -> dict[str, Any]:
    """All figures, ready for JSON."""
    torch = require("torch", extra="torch")
    is_cpu = device == "cpu"
    clock = time.process_time if is_cpu else time.perf_counter

    def wait() -> None:
        if not is_cpu:
            torch.cuda.synchronize()

    batches = iter(_stream(plan, device, "grids"))
    first = next(batches)
    wait()
    begin, begin_s, times, clock_times = clock(), time.perf_counter(), [], []
    for _ in islice(batches, plan.repeats):
        wait()
        times.append(clock() - begin)
        clock_times.append(time.perf_counter() - begin_s)
        begin, begin_s = clock(), time.perf_counter()
    batches.close()
    per_clip = quartiles([one / plan.batch for one in times])
    plain = {name: _time_plain(plan, first.draws, kind) for name, kind in plain_kinds().items()}
    return {
        "schema": 2,
        "environment": describe_environment(),
        "device": device if is_cpu else torch.cuda.get_device_name(),
        "cores": os.cpu_count(),
        "load_average": rounded(os.getloadavg()[0]),
        "randomize": plan.randomize,
        "clip": {"frames": plan.frames, "side": plan.side, "bins": plan.bins},
        "events_per_clip": rounded(_count_events(plan, device)),
        "stream_s_per_clip": per_clip,
        "stream_clips_per_hour": rounded(HOUR / per_clip["median"]),
        "stream_clock_s_per_clip": quartiles([one / plan.batch for one in clock_times]),
        "plain_s_per_clip": plain,
        "ratio": {name: rounded(one["median"] / per_clip["median"]) for name, one in plain.items()},
    }


def _stream(plan: StreamPlan, device: str, output: str) -> EventStream:
    return EventStream(
        Textures(plan), batch=plan.batch, frames=plan.frames, size=(plan.side, plan.side),
        bins=plan.bins, frames_per_grid=plan.bins, outputs=(output,), device=device,
        randomize=plan.randomize,
    )  # fmt: skip


def _count_events(plan: StreamPlan, device: str) -> float:
    """Mean events of the clips that are timed."""
    batches = iter(_stream(plan, device, "counts"))
    next(batches)
    numbers = [float(batch.counts.sum()) / plan.batch for batch in islice(batches, plan.repeats)]
    batches.close()
    return float(np.mean(numbers))


def _time_plain(plan: StreamPlan, draws: Mapping[str, Any], numpy: PlainNumpy) -> dict[str, Any]:
    """Seconds of one core per clip of a batch."""
    frames, times = Textures(plan).read(0, (), 0).frames[:, : plan.side, : plan.side], []
    for clip in range(plan.plain):
        drawn = {name: float(values[clip]) for name, values in draws.items()}
        begin = time.process_time()
        simulate_plainly(frames, drawn, plan.bins, numpy)
        times.append(time.process_time() - begin)
    return quartiles(times)


def main() -> int:
    """Measure, print, write; 2 without the device."""
    parser = argparse.ArgumentParser(prog="python -m texvent_lab.measure.stream")
    parser.add_argument("--device", default="cpu")
    parser.add_argument("--randomize", choices=RANGES, default=StreamPlan.randomize)
    parser.add_argument("--json", type=Path, help="write the figures here")
    chosen = parser.parse_args()
    if chosen.device != "cpu" and not require("torch", extra="torch").cuda.is_available():
        print("nothing was measured: torch finds no GPU", file=sys.stderr)
        return 2
    document = measure(StreamPlan(randomize=chosen.randomize), chosen.device)
    if chosen.json is not None:
        write_document(chosen.json, document, overwrite=True)
    for name, value in document.items():
        print(f"{name}: {value}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Time of the GPU backend, beside the copy bandwidth of the same GPU in the same run.

    python -m texvent_lab.measure.gpu [--json FILE] [--rife FILE] [--real-size MODEL] [--tiny]

Whole calls as a user makes them: frames on the device → events on the device, in order, the one
wait for their number included. A few calls follow each other without another wait, as in a loop
over batches. Warm-up calls, which compile the kernels, are not timed. The CPU's kernels see the
first clip of a batch, frame by frame with all cores. Pairs with RIFE are whole runs: frames in the
host's memory → packets; without its weights random ones take their place, which take as long.
Videos of a model go from its decoder to the last packet (`generated_video.py`), and training
batches are those of `stream.py`. The file is written after every row; none is begun after
`Plan.seconds`. A part that fails is noted under "failed"; the next begins. `--tiny` tries all out.
"""

from __future__ import annotations

import argparse
import itertools
import json
import os
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from texvent.config import InterpolateConfig
from texvent.errors import InputError, one_line
from texvent.extending import INTERPOLATORS, SIMULATORS, require
from texvent.frames import Frame, Video
from texvent.interpolate.rife.network import RIFE_4_0, RifeNetwork
from texvent.interpolate.rife.weights import find_rife_weights, write_rife_weights
from texvent.pipeline import video_to_events
from texvent.runtime.devices import find_gpu
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.simulation import gpu
from texvent.simulation.gpu.launch import EXTRA
from texvent.simulation.gpu.support import MODELS, RunDevice, find_model
from texvent_lab.bench.document import describe_environment, markdown_table, write_document
from texvent_lab.measure import stream
from texvent_lab.measure.flat_memory import measure_memory
from texvent_lab.measure.generated_video import Wan, measure_generated, moving_texture
from texvent_lab.measure.real_size import PUBLISHED, measure_real_size
from texvent_lab.measure.speed.timing import quartiles, rounded

HD = SensorSize(1280, 720)
DARK, BRIGHT = 100, 150
"""At δ = 0.2 one balanced event, ln(180 / 130) = 0.325, two of ESIM, ln(150 / 100) = 0.405, and at
0.3 about two of `physical`, 2.2 · 0.405 = 0.89, whose photoreceptor follows slowly."""
FRAME_US = 1_000
FRAMES_PER_PAIR = 8
CPU_WARM_UP = 3


@dataclass(frozen=True)
class Plan:
    """Sizes, densities and repeats of the measurement."""

    size: SensorSize = HD
    densities: tuple[float, ...] = (0.001, 0.01, 0.05, 0.2)
    batches: tuple[int, ...] = (1, 2, 4, 8, 16, 32)
    frames: int = 64
    """Frames of every clip in a call."""
    repeats: int = 15
    calls: int = 4
    """Calls of the simulator that are timed together."""
    copy_bytes: int = 2**30
    pair_sizes: tuple[SensorSize, ...] = (SensorSize(640, 480), HD)
    pairs: int = 48
    """Pairs of a run with RIFE; the first half is not timed."""
    wan: Wan | None = field(default_factory=Wan)
    """Pipeline of a video model; None: none."""
    streams: tuple[stream.StreamPlan, ...] = (
        stream.StreamPlan(),
        stream.StreamPlan(randomize="physical"),
    )
    """Training batches."""
    long_run: int = 10_000
    """Frames of the run whose memory is looked at."""
    seconds: float = 300.0
    """Time after which no row is begun."""


SMALL = SensorSize(24, 16)
TINY = Plan(
    size=SMALL, densities=(0.2,), batches=(1, 2), frames=2, repeats=1, calls=1, copy_bytes=2**20,
    pair_sizes=(SMALL,), pairs=2, long_run=20, seconds=1e6,
    wan=Wan(
        size=SensorSize(16, 16), frames=5, steps=1, heads=2, head_width=12, layers=1,
        inner_width=32, text_width=32, decoder_width=4,
    ),
    streams=tuple(
        stream.StreamPlan(1, 2, 8, 2, randomize, repeats=1, plain=1)
        for randomize in ("v2v", "physical")
    ),
)  # fmt: skip
"""Every part, as small as it can be."""


def measure(
    plan: Plan,
    device: str,
    save: Callable[[dict[str, Any]], None] = lambda document: None,
    weights: Path | None = None,
) -> dict[str, Any]:
    """All figures, ready for JSON, those that matter most first.

    Args:
        plan: sizes and repeats.
        device: of everything but decoding and files.
        save: called with what there is after every row.
        weights: those of RIFE; None: those that were pulled.
    """
    end_s = time.monotonic() + plan.seconds
    copy = measure_copy(plan, device)
    parts = {
        "pairs": measure_pairs(plan, device, weights),
        "stream": (stream.measure(one, device) for one in plan.streams),
        "generated": ()
        if plan.wan is None
        else measure_generated(plan.wan, _chosen(device), weights),
        "simulation": measure_simulation(plan, device, copy["median"]),
        "memory": ()
        if not plan.long_run
        else measure_memory(plan.pair_sizes[0], plan.long_run, _chosen(device)),
    }
    document: dict[str, Any] = {
        "schema": 2,
        "environment": describe(device),
        "copy_gb_per_s": copy,
        **{name: [] for name in parts},
        "failed": {},
    }
    for name, rows in parts.items():
        waiting = iter(rows)
        try:
            while time.monotonic() < end_s and (row := next(waiting, None)) is not None:
                document[name].append(row)
                save(document)
        except Exception as error:  # noqa: BLE001  (the next part may run)
            traceback.print_exc()
            document["failed"][name] = one_line(error)
            save(document)
    return document


def _chosen(device: str) -> RunDevice:
    return RunDevice(find_gpu(device) or require("torch", extra=EXTRA).device(device))


def measure_pairs(plan: Plan, device: str, weights: Path | None = None) -> Iterator[dict[str, Any]]:
    """Milliseconds per pair of source frames with RIFE, by size and preset, and its precision.

    Args:
        plan: sizes and number of pairs.
        device: of everything but decoding and files.
        weights: those of RIFE; None: those that were pulled, or random ones.
    """
    with tempfile.TemporaryDirectory() as scratch:
        try:
            found, kind = find_rife_weights(weights), "published"
        except InputError:
            if weights is not None:
                raise
            found, kind = Path(scratch) / "random.safetensors", "random"
            write_rife_weights(RifeNetwork(RIFE_4_0), found)
        for row in _measure_pairs(plan, device, found):
            yield {**row, "weights": kind}


def _measure_pairs(plan: Plan, device: str, weights: Path) -> Iterator[dict[str, Any]]:
    chosen = _chosen(device)
    for size, preset in itertools.product(plan.pair_sizes, ("paper", "accurate")):
        video = moving_texture(size, plan.pairs + 1)
        options = {"preset": preset, "interpolate": "rife", "device": "cpu"}
        settings = resolve("simulate", {**options, "interpolator_weights": weights})
        run = replace(video_to_events(video, settings), device=chosen)
        events, between, times = 0, 0, [time.perf_counter()]
        for frame, packet in run.steps():
            events, between = events + len(packet), between + (not frame.is_source)
            if frame.is_source:
                times.append(time.perf_counter())
        late = np.diff(times[1 + plan.pairs // 2 :])
        yield {
            "preset": preset,
            "size": str(size),
            "pairs": plan.pairs,
            "events_per_pair": rounded(events / plan.pairs),
            "frames_between": rounded(between / plan.pairs),
            "ms_per_pair": rounded(float(late.mean()) * 1e3),
            "levels_from_float32": measure_precision(video, settings.interpolate, chosen.gpu),
        }


def measure_precision(video: Video, config: InterpolateConfig, device: Any) -> float:
    """Largest difference of a frame at the middle from that of the float32 network, levels."""
    images = []
    for one in (device, None):
        kind: Any = INTERPOLATORS.load("rife")
        first, second = video[0], video[1]
        middle = [(first.t_us + second.t_us) // 2]
        (frame,) = kind(config, video, device=one).between(first, second, middle)
        images.append(frame.pixels)
    return rounded(float(np.abs(images[0] - images[1]).max()))


def describe(device: str) -> dict[str, Any]:
    """Device and versions."""
    torch, triton = require("torch", extra=EXTRA), require("triton", extra=EXTRA)
    facts = {**describe_environment(), "triton": triton.__version__}
    if device == "cuda":
        return {**facts, "device": torch.cuda.get_device_name(), "cuda": torch.version.cuda}
    return {**facts, "device": "CPU, Triton's interpreter"}


def measure_copy(plan: Plan, device: str) -> dict[str, Any]:
    """GB/s of a copy within the device's memory, bytes read and written."""
    torch = require("torch", extra=EXTRA)
    source = torch.empty(plan.copy_bytes, dtype=torch.uint8, device=device)
    target = torch.empty_like(source)
    times = _times(lambda: target.copy_(source), plan.repeats, device)
    return quartiles([2 * plan.copy_bytes / 1e9 / one for one in times])


def measure_simulation(plan: Plan, device: str, copy: float) -> Iterator[dict[str, Any]]:
    """Microseconds per frame: by density, by batch, and of the other kinds."""
    usual = plan.batches[len(plan.batches) // 2]
    cases: list[tuple[str, str, float, int]] = []
    cases += [("paper", "uint8", density, usual) for density in plan.densities]
    cases += [("paper", "uint8", 0.01, batch) for batch in plan.batches if batch != usual]
    cases += [(model, "uint8", 0.01, usual) for model in ("accurate", "esim", "physical")]
    cases += [("paper", "float32", 0.01, usual)]
    for model, pixels, density, batch in cases:
        frames = make_clips(plan, density, batch, pixels, device)
        clips = _Clips(_config(model), frames, plan)
        times = _times(clips.run, plan.repeats, device, calls=plan.calls)
        count = batch * plan.frames
        per_frame = quartiles(times, scale=1e6 / count)
        rate = frames.element_size() * frames.numel() / 1e9 / (per_frame["median"] * count * 1e-6)
        yield {
            "model": model,
            "size": str(plan.size),
            "pixels": pixels,
            "density": density,
            "batch": batch,
            "frames": plan.frames,
            "events_per_frame": rounded(clips.events / count),
            "us_per_frame": per_frame,
            "cpu_us_per_frame": measure_cpu(clips.config, frames, plan),
            "frames_gb_per_s": rounded(rate),
            "share_of_copy": rounded(rate / copy),
        }


def measure_cpu(config: Any, frames: Any, plan: Plan) -> dict[str, Any]:
    """Microseconds per frame of the CPU's kernels, frames in its memory."""
    simulator = SIMULATORS.load(find_model(config))(config)
    clip = frames[0].cpu().numpy()
    times = []
    for index in range(CPU_WARM_UP + plan.repeats):
        is_source = index % FRAMES_PER_PAIR == 0
        frame = Frame(clip[index % len(clip)], index * FRAME_US, is_source=is_source)
        start = time.perf_counter()
        simulator.step(frame)
        if index >= CPU_WARM_UP:
            times.append(time.perf_counter() - start)
    return quartiles(times, scale=1e6)


def make_clips(plan: Plan, density: float, batch: int, pixels: str, device: str) -> Any:
    """[B, T, H, W] in which about `density` of the pixels change level in every frame."""
    torch = require("torch", extra=EXTRA)
    generator = torch.Generator(device).manual_seed(0)
    shape = plan.size.shape
    bright = torch.zeros(batch, *shape, dtype=torch.bool, device=device)
    dtype = getattr(torch, pixels)
    clips = torch.empty(batch, plan.frames, *shape, dtype=dtype, device=device)
    for index in range(plan.frames):
        bright ^= torch.rand(batch, *shape, device=device, generator=generator) < density
        clips[:, index] = torch.where(bright, BRIGHT, DARK).to(dtype)
    return clips


def _config(model: str) -> Any:
    """Options of a simulator's first preset, or of a preset of Texvent."""
    presets = SIMULATORS.load(model if model in MODELS else "texvent").presets
    return presets.get(model, next(iter(presets.values())))


class _Clips:
    """A simulator that gets the same frames again and again, later every time."""

    def __init__(self, config: Any, frames: Any, plan: Plan) -> None:
        self.config = config
        self._simulator = gpu.GpuSimulator(config)
        self._frames = frames
        self._steps_us = np.arange(1, plan.frames + 1) * FRAME_US
        self._is_source = np.arange(plan.frames) % FRAMES_PER_PAIR == 0
        self._calls = 0
        self.events = 0

    def run(self) -> None:
        times_us = self._steps_us + self._calls * self._steps_us[-1]
        self.events = len(self._simulator.step(self._frames, times_us, self._is_source))
        self._calls += 1


def _times(call: Callable[[], Any], repeats: int, device: str, *, calls: int = 1) -> list[float]:
    """Seconds per call in each repeat after two untimed ones; the device is idle in between."""
    torch = require("torch", extra=EXTRA)
    wait = torch.cuda.synchronize if device == "cuda" else _nothing
    times = []
    for index in range(repeats + 2):
        wait()
        start = time.perf_counter()
        for _ in range(calls):
            call()
        wait()
        if index >= 2:
            times.append((time.perf_counter() - start) / calls)
    return times


def _nothing() -> None:
    """The CPU has finished when a call returns."""


def as_markdown(document: dict[str, Any]) -> str:
    """The figures as tables."""
    simulation = [
        (
            row["model"], row["pixels"], f"{row['density']:.1%}", str(row["batch"]),
            f"{row['events_per_frame']:,.0f}", _spread(row["us_per_frame"]),
            _spread(row["cpu_us_per_frame"]), f"{row['share_of_copy']:.1%}",
        )
        for row in document["simulation"]
    ]  # fmt: skip
    head = ("model", "pixels", "jumping", "clips", "events", "us per frame", "CPU", "share of copy")
    lines = [f"{name}: {value}" for name, value in document["environment"].items()]
    lines.append(f"copy: {document['copy_gb_per_s']['median']} GB/s\n")
    lines.append(markdown_table(head, simulation))
    names = ("preset", "size", "weights", "frames_between", "ms_per_pair", "levels_from_float32")
    pairs = [tuple(str(row[name]) for name in names) for row in document["pairs"]]
    lines.append(markdown_table(names, pairs))
    of_videos = ("video", "interpolate", "frames_between", "events", "last_event_s", "file_s")
    made = [tuple(str(row[name]) for name in of_videos) for row in document["generated"]]
    lines.append(markdown_table(of_videos, made))
    for row in document["stream"]:
        lines += [f"{name}: {value}" for name, value in row.items()]
    lines += [f"memory: {row}" for row in document["memory"]]
    lines += [f"failed: {name}: {reason}" for name, reason in document["failed"].items()]
    return "\n".join(lines)


def _spread(times: dict[str, Any]) -> str:
    return f"{times['median']:g} ({times['q1']:g}-{times['q3']:g})"


def main() -> int:
    """Measure, print, write; 2 without a GPU."""
    parser = argparse.ArgumentParser(prog="python -m texvent_lab.measure.gpu")
    parser.add_argument("--json", type=Path, help="write the figures here")
    parser.add_argument("--rife", type=Path, help="weights of RIFE; default: those pulled")
    parser.add_argument(
        "--real-size", choices=PUBLISHED, help="a model of published size, random weights, alone"
    )
    parser.add_argument("--tiny", action="store_true", help="try every part out, on a CPU too")
    chosen = parser.parse_args()
    is_there = require("torch", extra=EXTRA).cuda.is_available()
    device = "cuda" if is_there else "cpu"
    if not is_there:
        os.environ.setdefault("TRITON_INTERPRET", "1")
    if not is_there and (chosen.real_size is not None or not chosen.tiny):
        what = "" if chosen.real_size is None else ", which --real-size needs, --tiny or not"
        print(f"nothing was measured: torch finds no GPU{what}", file=sys.stderr)
        return 2

    def save(document: dict[str, Any]) -> None:
        if chosen.json is not None:
            write_document(chosen.json, document, overwrite=True)

    if chosen.real_size is not None:
        name = chosen.real_size
        row = measure_real_size(name, PUBLISHED[name], device, steps=8)
        save(row)
        print(json.dumps(row, indent=1))
        return 0
    document = measure(TINY if chosen.tiny else Plan(), device, save, chosen.rife)
    print(as_markdown(document))
    return 1 if document["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())

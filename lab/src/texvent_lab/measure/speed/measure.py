"""Everything that is measured, as one JSON document."""

from __future__ import annotations

import dataclasses
import importlib.util
import os
import tempfile
import time
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

from texvent.sensor import SensorSize
from texvent_lab.bench.document import describe_environment
from texvent_lab.measure.speed.kernels import FULL, QUICK, measure_kernels
from texvent_lab.measure.speed.peers import run_on_one_core
from texvent_lab.measure.speed.scenes import (
    EXCERPT,
    embedded_heavy_clip,
    measure_startup,
    write_video,
)
from texvent_lab.measure.speed.stages import Engine, measure_pipeline
from texvent_lab.measure.speed.tables import check_targets
from texvent_lab.measure.speed.timing import measure_bandwidth

SCHEMA_VERSION = 1
HD = SensorSize(1280, 720)
HD_FPS = Fraction(25)
THREADS = (1, 2)
VARIANTS: tuple[tuple[str, Engine], ...] = (
    ("none", "fused"),
    ("flow", "drawn"),
    ("flow", "fused"),
)
GPU_BENCHMARK = "texvent_lab.measure.gpu"


class Options(NamedTuple):
    """What the command line chose."""

    quick: bool
    heavy: Path | None
    video: Path | None


def measure(options: Options) -> dict[str, Any]:
    """The document that `docs/results/speed.schema.json` describes."""
    started, load = time.perf_counter(), os.getloadavg()[0]
    bandwidths = {threads: measure_bandwidth(threads) for threads in THREADS}
    document: dict[str, Any] = {
        "schema_version": SCHEMA_VERSION,
        "quick": options.quick,
        "environment": describe_environment(),
        "load_at_start": round(load, 2),
        "bandwidth": {str(threads): one.as_json() for threads, one in bandwidths.items()},
        "kernels": measure_kernels(QUICK if options.quick else FULL, bandwidths),
        "pipeline": _measure_pipelines(options),
        "peers": run_on_one_core(_words(options)),
        "startup": measure_startup(quick=options.quick),
        "gpu": _measure_gpu(options.quick),
    }
    document["targets"] = check_targets(document)
    document["load_at_end"] = round(os.getloadavg()[0], 2)
    document["seconds"] = round(time.perf_counter() - started, 1)
    return document


def _words(options: Options) -> list[str]:
    words = ["--quick"] if options.quick else []
    for flag, path in (("--heavy-clip", options.heavy), ("--video", options.video)):
        words += [flag, str(path)] if path is not None else []
    return words


def _measure_pipelines(options: Options) -> list[dict[str, Any]]:
    """Real video and an embedded 720p clip, with and without motion compensation."""
    pairs = 4 if options.quick else 20
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        moving = embedded_heavy_clip(HD, pairs + 4).pixels
        clips = {
            "heavy 720p": write_video(Path(folder) / "heavy.mp4", list(moving), HD_FPS),
            (options.video or EXCERPT).name: options.video or EXCERPT,
        }
        for name, clip in clips.items():
            for interpolate, engine in VARIANTS:
                rows.append(
                    measure_pipeline(
                        clip, name, interpolate=interpolate, engine=engine, pairs=pairs
                    )
                )
    return rows


def _measure_gpu(quick: bool) -> dict[str, Any]:
    """What `texvent_lab.measure.gpu` measures, or why it does not."""
    for module in ("torch", "triton", GPU_BENCHMARK):
        if importlib.util.find_spec(module) is None:
            return {"available": False, "note": f"no GPU: {module} is not installed"}
    torch: Any = importlib.import_module("torch")
    if not torch.cuda.is_available():
        return {"available": False, "note": "no GPU: torch finds no CUDA device"}
    benchmark: Any = importlib.import_module(GPU_BENCHMARK)
    plan = benchmark.Plan()
    if quick:
        plan = dataclasses.replace(plan, densities=(0.01,), batches=(8,), repeats=5)
    return {"available": True, **benchmark.measure(plan, "cuda")}

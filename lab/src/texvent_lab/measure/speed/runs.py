"""Whole runs: time per pair of source frames or step of an event camera, and from launch."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import av
import numpy as np

from texvent.capture.open import open_frames
from texvent.event_camera import EventCamera
from texvent.io.files import open_writer
from texvent.pipeline import video_to_events
from texvent.runtime.background_writer import BackgroundWriter
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent_lab.measure.speed.scenes import EXCERPT, Bytes, embedded_heavy_clip, to_and_fro
from texvent_lab.measure.speed.timing import quartiles, rounded, seconds

WARM_UP_PAIRS = 2
"""Pairs that are not timed: kernels load."""
STEP_SIZES = (SensorSize(346, 260), SensorSize(640, 480))
STEP_MODELS = ("texvent", "esim", "v2e")
HD, HD_FPS = SensorSize(1280, 720), Fraction(25)
CLIP_SIZE, CLIP_FRAMES = SensorSize(640, 360), 50
"""Of the clip of two seconds whose first events are timed."""
WATCHED_RUN = """
import os, sys, time
from texvent.cli.app import main
from texvent.io.hdf5.storage import Hdf5Writer
append = Hdf5Writer.append
def watched(self, packet):
    append(self, packet)
    if len(packet):
        os.write(1, str(time.time() - float(sys.argv[1])).encode())
        os._exit(0)
Hdf5Writer.append = watched
main(["simulate", *sys.argv[2:], "-q", "--previews", "none"])
"""
"""Prints the time since launch, s, at which the first events reach the file, and stops there."""


def measure_runs(video: Path | None, *, pairs: int) -> list[dict[str, Any]]:
    """A row per clip, a real and an embedded one, and interpolation."""
    with tempfile.TemporaryDirectory() as folder:
        moving = embedded_heavy_clip(HD, pairs + WARM_UP_PAIRS + 2).pixels
        real = video or EXCERPT
        clips = {"heavy 720p": write_video(Path(folder) / "heavy.mp4", moving), real.name: real}
        return [
            measure_run(clip, name, interpolate=interpolate, pairs=pairs)
            for name, clip in clips.items()
            for interpolate in ("none", "flow")
        ]


def measure_run(clip: Path, name: str, *, interpolate: str, pairs: int) -> dict[str, Any]:
    """Milliseconds per pair of the run that `texvent simulate --previews none` does.

    Args:
        clip: a video file with `WARM_UP_PAIRS` more pairs than are timed.
        name: of the row.
        interpolate: option of that name.
        pairs: number of pairs that are timed.
    """
    settings = resolve("simulate", {"interpolate": interpolate})
    video = open_frames(str(clip), settings.source)
    ends: list[float] = []
    events = 0
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "out.h5"
        with open_writer(path, size=video.size) as writer, BackgroundWriter(writer) as behind:
            for frame, packet in video_to_events(video, settings).steps():
                behind.append(packet)
                events += len(packet)
                ends += [time.perf_counter()] if frame.is_source else []
                if len(ends) > WARM_UP_PAIRS + pairs:
                    break
    if len(ends) <= WARM_UP_PAIRS + pairs:
        raise ValueError(f"the clip has {len(ends) - 1} pairs of frames; give one with more")
    return {
        "clip": name,
        "size": str(video.size),
        "interpolate": interpolate,
        "pairs": pairs,
        "events_per_pair": rounded(events / (len(ends) - 1)),
        "ms_per_pair": rounded((ends[-1] - ends[WARM_UP_PAIRS]) * 1e3 / pairs),
    }


def measure_steps(*, steps: int) -> list[dict[str, Any]]:
    """A row per size and model: latency of `EventCamera.step`, heavy motion, default options."""
    rows = []
    for size in STEP_SIZES:
        clip = embedded_heavy_clip(size).pixels
        for model in STEP_MODELS:
            frames, events = to_and_fro(clip), []
            with EventCamera(size, simulator=model) as camera:

                def step() -> None:
                    frame = next(frames)  # noqa: B023  (called in this turn)
                    events.append(len(camera.step(frame.pixels, frame.t_us)))  # noqa: B023

                times = [seconds(step) for _ in range(WARM_UP_PAIRS + 1 + steps)]
            median, late = np.percentile(times[-steps:], (50, 95)).tolist()
            rows.append({
                "model": model, "size": str(size), "steps": steps,
                "events_per_step": rounded(sum(events[-steps:]) / steps),
                "ms_median": rounded(median * 1e3), "ms_p95": rounded(late * 1e3),
            })  # fmt: skip
    return rows


def write_video(path: Path, frames: Bytes) -> Path:
    """An H.264 file of grey frames [N, H, W], for the decoder to work on."""
    with av.open(str(path), "w") as container:
        stream: Any = container.add_stream("libx264", rate=HD_FPS)
        stream.height, stream.width = frames.shape[1:]
        stream.pix_fmt = "yuv420p"
        stream.options = {"crf": "20", "preset": "ultrafast"}
        for pixels in frames:
            container.mux(stream.encode(av.VideoFrame.from_ndarray(pixels, format="gray")))
        container.mux(stream.encode(None))
    return path


def measure_startup() -> dict[str, Any]:
    """Times from launch, s."""
    repeats = 9
    report: dict[str, Any] = {
        f"{name}_cpu_s": quartiles([_cpu_seconds(words) for _ in range(repeats)])
        for name, words in {
            "help": ("--help",),
            "generate_help": ("generate", "--help"),
            "simulate_help": ("simulate", "--help"),
        }.items()
    }
    with tempfile.TemporaryDirectory() as folder:
        frames = embedded_heavy_clip(CLIP_SIZE, CLIP_FRAMES).pixels
        clip = write_video(Path(folder) / "two seconds.mp4", frames)
        warm = [_first_events(clip, folder) for _ in range(repeats + 1)][1:]
        report["first_events_s"] = quartiles(warm)
        nothing_compiled = {"NUMBA_CACHE_DIR": f"{folder}/empty"}
        report["cold_first_events_s"] = rounded(_first_events(clip, folder, nothing_compiled))
    return report


def _cpu_seconds(words: Sequence[str]) -> float:
    """CPU time of one `texvent` command, user and system, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "texvent.cli.app", *words]
    subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _first_events(clip: Path, folder: str, environment: dict[str, str] | None = None) -> float:
    """Seconds from launch to the first events handed to the file."""
    command = [sys.executable, "-c", WATCHED_RUN, str(time.time()), str(clip)]
    done = subprocess.run(
        [*command, "-o", f"{folder}/out.h5", "--overwrite"],
        env={**os.environ, **(environment or {})},
        capture_output=True,
        text=True,
        check=True,
    )
    return float(done.stdout)

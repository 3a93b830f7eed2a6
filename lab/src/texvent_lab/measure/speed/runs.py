"""Whole runs: time per pair of source frames or step of an event camera, and of commands."""

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

from texvent.api.event_camera import EventCamera
from texvent.capture.open import open_frames
from texvent.io.files import open_writer
from texvent.pipeline import video_to_events
from texvent.runtime.work.worker_threads import BackgroundWriter
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent_lab.measure.speed.scenes import (
    EXCERPT,
    HEAVY_SIZE,
    Bytes,
    embedded_heavy_clip,
    to_and_fro,
)
from texvent_lab.measure.speed.timing import rounded, seconds

WARM_UP_PAIRS = 2
"""Pairs that are not timed: kernels load."""
REPEATS = 2
"""Runs of a whole command; the fastest counts."""
STEP_SIZES = (SensorSize(346, 260), SensorSize(640, 480))
STEP_MODELS = ("texvent", "esim", "v2e")
HD, HD_FPS = SensorSize(1280, 720), Fraction(25)
CLIP_FRAMES = 60
"""Frames of the clip of 2.36 s at 25 frames per second that the circuit model is timed on."""
DEMO = ("generate", "a red car drives left past two trees at dusk")
COMMANDS = {
    "--help": ("--help",),
    "demo": DEMO,
    "demo, nothing compiled": DEMO,
    "city driving at night, 1 s": ("generate", "city driving at night", "--duration", "1"),
    "a fan, 1 s": ("generate", "a fan", "--duration", "1"),
    "traffic at 640x480, .5 s": (
        "generate", "cars drive past houses on a street", "--duration", "0.5",
        "--sensor", "640x480", "--previews", "none",
    ),
    "physical, 2.36 s": ("simulate", "CLIP", "--simulator", "physical", "--previews", "none"),
    "optical flow, 720p, 2 s": (
        "simulate", "FILM", "--start", "1", "--stop", "3", "--previews", "none",
    ),
}  # fmt: skip
"""Whole commands, whose kernels are compiled but for one."""


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


def measure_commands(video: Path | None) -> list[dict[str, Any]]:
    """A row per command of `COMMANDS`: processor time and time of the clock, s.

    Args:
        video: 720p video of at least three seconds; None: no row of optical flow.
    """
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        frames = embedded_heavy_clip(HEAVY_SIZE, CLIP_FRAMES).pixels
        files = {"CLIP": write_video(Path(folder) / "clip.mp4", frames), "FILM": video}
        for name, words in COMMANDS.items():
            cold = "nothing compiled" in name
            if video is None and "FILM" in words:
                continue
            own = [str(files.get(word, word)) for word in words]
            own += ["-o", f"{folder}/out.h5", "--overwrite"] if len(words) > 1 else []
            environment = {"NUMBA_CACHE_DIR": f"{folder}/empty"} if cold else {}
            times = [_time_command(own, environment) for _ in range(1 if cold else REPEATS)]
            cpu_s, clock_s = min(times)
            rows.append({"command": name, "cpu_s": rounded(cpu_s), "clock_s": rounded(clock_s)})
    return rows


def _time_command(words: Sequence[str], environment: dict[str, str]) -> tuple[float, float]:
    """Processor time of one `texvent` command, user and system, and time of the clock, s."""
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    command = [sys.executable, "-m", "texvent.cli.app", *words]
    environment = {**os.environ, **environment}
    subprocess.run(command, env=environment, capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return cpu_s, time.perf_counter() - started

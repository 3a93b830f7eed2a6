"""Frames to measure on: known densities, heavy motion, real video at 200 fps equivalent."""

from __future__ import annotations

import itertools
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import av
import numpy as np
from numpy.typing import NDArray

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig, InterpolateConfig
from texvent.interpolate.flow import FlowInterpolator
from texvent.interpolate.pairing import densify
from texvent.sensor import SensorSize
from texvent.video import Frame, Video, frame_time_us
from texvent_lab.measure.speed.timing import Quartiles, rounded

Bytes = NDArray[np.uint8]

DARK, BRIGHT = 100, 173
"""Levels between which pixels jump: by ln(203 / 130) = 0.45 in the paper preset's balanced log, by
0.55 in a plain one: one event of the paper preset, about two of models with several."""
FRAME_US = 5_000
HEAVY_SIZE = SensorSize(346, 260)
HEAVY_FPS = Fraction(24)
HEAVY_GAMMA = 0.92
"""Brings the embedded heavy clip's mean |Δ ln I| to 0.27."""
EXCERPT = Path(__file__).parents[5] / "tests" / "clips" / "bigbuckbunny_excerpt.mp4"
DENSE_FPS = 200


def jumping_pixels(size: SensorSize, density: float, count: int) -> Bytes:
    """Frames in which a random share of the pixels jumps between two levels.

    Returns:
        [count, H, W]; from each frame to the next, forwards or backwards, about `density` of the
        pixels change.
    """
    rng = np.random.default_rng(0)
    bright = np.zeros(size.shape, np.bool_)
    frames = np.empty((count, *size.shape), np.uint8)
    for index in range(count):
        bright ^= rng.random(size.shape, np.float32) < density
        frames[index] = np.where(bright, BRIGHT, DARK)
    return frames


def to_and_fro(frames: Bytes) -> Iterator[Frame]:
    """The frames forwards, backwards and so on, without end, `FRAME_US` apart."""
    order = [*range(len(frames)), *range(len(frames) - 2, 0, -1)]
    for index, which in enumerate(itertools.cycle(order)):
        yield Frame(frames[which], index * FRAME_US)


def heavy_clip(path: Path | None) -> Video:
    """A clip of heavy motion, 8-bit grey: the one of a file, or an embedded one like it.

    Args:
        path: .npz with `gray` [N, H, W] uint8 and `t_us` [N].
    """
    if path is None:
        return embedded_heavy_clip()
    with np.load(path) as stored:
        return Video(stored["gray"], stored["t_us"].tolist(), HEAVY_FPS)


def embedded_heavy_clip(size: SensorSize = HEAVY_SIZE, count: int = 9) -> Video:
    """Two textures that pan against each other, 5 px per frame: mean |Δ ln I| about 0.27."""
    rng = np.random.default_rng(7)
    height, width = size.shape
    step = 5
    far = _texture(rng, height, width + step * count)
    near = _texture(rng, height, width + step * count)
    mask = _texture(rng, height, width + step * count) > 0.55
    frames = np.empty((count, height, width), np.uint8)
    for index in range(count):
        left, right = step * index, step * (count - index)
        shown = np.where(
            mask[:, right : right + width],
            near[:, right : right + width],
            far[:, left : left + width],
        )
        frames[index] = np.rint(255.0 * shown**HEAVY_GAMMA)
    times = [frame_time_us(index, HEAVY_FPS) for index in range(count)]
    return Video(frames, times, HEAVY_FPS)


def _texture(rng: np.random.Generator, height: int, width: int) -> NDArray[np.float64]:
    """Smooth noise of 12 px grain, 0..1."""
    grain = 12
    coarse = rng.random((height // grain + 2, width // grain + 2))
    y, x = np.arange(height) / grain, np.arange(width) / grain
    top, left = y.astype(int), x.astype(int)
    fy, fx = (y - top)[:, None], (x - left)[None, :]
    rows = coarse[top] * (1 - fy) + coarse[top + 1] * fy
    return np.asarray(rows[:, left] * (1 - fx) + rows[:, left + 1] * fx)


def mean_log_change(frames: Bytes) -> float:
    """Mean |Δ ln max(I, 1)| from frame to frame."""
    return float(np.abs(np.diff(np.log(np.maximum(frames, 1.0)), axis=0)).mean())


def source_frames(path: Path, count: int) -> Video:
    """The first frames of a video, as they are decoded, in memory."""
    frames = list(itertools.islice(iter(open_frames(path, CaptureConfig())), count))
    return Video(np.stack([one.pixels for one in frames]), [one.t_us for one in frames])


def dense_video(source: Video, count: int) -> Video:
    """A video at 200 fps equivalent: flow interpolation between its frames, 8-bit grey.

    Rounded to 8 bits, because that is what all programs under test can read.
    """
    step_us = source.times_us[1] - source.times_us[0]
    between = round(step_us * DENSE_FPS / 1e6) - 1
    config = InterpolateConfig(fixed_count=max(0, between), detect_cuts=False)
    interpolator = FlowInterpolator(config, source)
    dense = densify(source, interpolator, config, balance=30.0, contrast_threshold=0.2)
    frames = list(itertools.islice(dense, count))
    pixels = np.stack([np.rint(one.luma).astype(np.uint8) for one in frames])
    return Video(pixels, [one.t_us for one in frames], Fraction(DENSE_FPS))


def write_video(path: Path, frames: Sequence[Any], fps: Fraction) -> Path:
    """An H.264 file of grey frames, for the decoder to work on."""
    with av.open(str(path), "w") as container:
        stream: Any = container.add_stream("libx264", rate=fps)
        stream.height, stream.width = frames[0].shape
        stream.pix_fmt = "yuv420p"
        stream.options = {"crf": "20", "preset": "ultrafast"}
        for pixels in frames:
            container.mux(stream.encode(av.VideoFrame.from_ndarray(pixels, format="gray")))
        container.mux(stream.encode(None))
    return path


CLIP_SIZE = SensorSize(640, 360)
CLIP_FPS = Fraction(25)
CLIP_FRAMES = 50
"""Two seconds."""
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


def measure_startup(*, quick: bool) -> dict[str, Any]:
    """Times from launch, s."""
    repeats = 3 if quick else 9
    report: dict[str, Any] = {
        f"{name}_cpu_s": Quartiles.of([_cpu_seconds(words) for _ in range(repeats)]).as_json()
        for name, words in {
            "help": ("--help",),
            "generate_help": ("generate", "--help"),
            "simulate_help": ("simulate", "--help"),
        }.items()
    }
    with tempfile.TemporaryDirectory() as folder:
        clip = Path(folder) / "two seconds.mp4"
        frames = embedded_heavy_clip(CLIP_SIZE, CLIP_FRAMES).pixels
        write_video(clip, list(frames), CLIP_FPS)
        warm = [_first_events(clip, folder) for _ in range(repeats + 1)][1:]
        report["first_events_s"] = Quartiles.of(warm).as_json()
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

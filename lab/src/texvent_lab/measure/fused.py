"""Time per pair of frames, with the intermediate frames drawn and with the fused pass.

    python -m texvent_lab.measure.fused               # a texture at several speeds
    python -m texvent_lab.measure.fused --clip a.mp4  # a clip

Times are processor time of the process, ms per pair, the least of five runs, in turn; flow (both
directions) and count (Eq. 4 alone) are what both need. The events are the same.
"""

from __future__ import annotations

import argparse
import itertools
import os
import sys
import time
from collections import deque
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.extending import INTERPOLATORS
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.pairing import pair_frames
from texvent.pairs.frame_pair import FramePair
from texvent.settings.resolution import resolve
from texvent.simulate.build import build_simulator
from texvent.video import Frame, Video
from texvent_lab.measure.interpolation_scenes import moving_scene

FRAME_US = 41_667
SPEEDS = (0.25, 1, 3, 10, 24)
"""Motion of the timed texture, px per frame."""
SIZE = (346, 260)
REPEATS = 5
MODELS: Mapping[str, Mapping[str, Any]] = {
    "texvent paper": {"simulator": "texvent", "preset": "paper"},
    "esim": {"simulator": "esim"},
    "texvent accurate": {"simulator": "texvent", "preset": "accurate"},
}


def time_pairs(video: Video, options: Mapping[str, Any]) -> dict[str, float]:
    """Milliseconds per pair of each way of getting the same clip's events."""
    settings = resolve("simulate", options)
    config = settings.interpolate
    simulator = build_simulator(settings.run, settings.simulate)

    def plan() -> list[FramePair]:
        interpolator = INTERPOLATORS.load(config.interpolate)(config, video)
        policy = CountPolicy(
            config,
            video,
            interpolator,
            balance=simulator.balance,
            contrast_threshold=simulator.contrast_threshold,
        )
        return list(pair_frames(video, interpolator, config, policy))

    def draw_and_step() -> None:
        simulator.reset()
        for frame in itertools.chain.from_iterable(pair.frames for pair in pairs):
            simulator.step(frame)

    def advance() -> None:
        simulator.reset()
        for pair in pairs:
            deque(simulator.advance(pair), maxlen=0)

    pairs = plan()
    work: dict[str, Callable[[], Any]] = {
        "flow and count": plan,
        "drawn": draw_and_step,
        "fused": advance,
    }
    least = dict.fromkeys(work, float("inf"))
    for _ in range(REPEATS):
        for name, function in work.items():
            start = time.process_time()
            function()
            least[name] = min(least[name], time.process_time() - start)
    number = len(video) - 1
    counts = [len(pair.times_us) for pair in pairs[1:]]
    return {
        "K": float(np.mean(counts)),
        **{name: 1000 * seconds / number for name, seconds in least.items()},
    }


def compare_times(clip: Path | None, frames: int) -> None:
    """Print milliseconds per pair."""
    os.environ["TEXVENT_NUM_THREADS"] = "1"
    if clip is not None:
        videos = {clip.name: _read(clip, frames)}
    else:
        videos = {f"{speed:g} px per frame": _texture(speed) for speed in SPEEDS}
    for model, options in MODELS.items():
        for name, video in videos.items():
            times = time_pairs(video, options)
            cells = " | ".join(f"{what} {value:.1f}" for what, value in times.items())
            sys.stdout.write(f"| {model} | {name} | {cells} |\n")
            sys.stdout.flush()


def _texture(speed: float, count: int = 4) -> Video:
    frames = [moving_scene(speed * index, "smooth", *SIZE) for index in range(count)]
    levels = np.rint(np.stack(frames)).astype(np.uint8)
    return Video(levels, [FRAME_US * index for index in range(count)])


def _read(path: Path, count: int) -> Video:
    frames: list[Frame] = []
    for frame in open_frames(path, CaptureConfig()):
        frames.append(frame)
        if len(frames) == count:
            break
    levels = np.stack([np.rint(frame.luma).astype(np.uint8) for frame in frames])
    return Video(levels, [frame.t_us for frame in frames])


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--clip", type=Path, help="a video")
    parser.add_argument("--frames", type=int, default=5, help="of the clip")
    options = parser.parse_args()
    compare_times(options.clip, options.frames)


if __name__ == "__main__":
    main()

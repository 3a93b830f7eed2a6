"""Drawn frames, fused pairs and continuous time: events against truth, and time per pair.

    python -m benchmarks.engines                      # exact scenes: STPP, van Rossum, nearest
    python -m benchmarks.engines --time               # ms per pair, a texture at several speeds
    python -m benchmarks.engines --time --clip a.mp4  # ms per pair on a clip

Fidelity is that of `texvent bench fidelity`: thresholds are fitted on one texture and scored on two
others, 24 frames per second in 8 bits. Times are processor time of the process, the least of five
runs, engines in turn; flow (both directions) and count are what all of them need.
"""

from __future__ import annotations

import argparse
import itertools
import os
import sys
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, Literal

import numpy as np

from benchmarks.interpolation_scenes import moving_scene
from texvent._registry import INTERPOLATORS
from texvent.bench.fidelity.entries import Entry
from texvent.bench.fidelity.results import Score
from texvent.bench.fidelity.run import FidelityPlan, record_truths, score_entry
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.pairing import pair_frames
from texvent.pairs.frame_pair import FramePair
from texvent.run.settings import Settings, resolve
from texvent.simulate.build import build_simulator
from texvent.video import Frame, Video

METRICS = ("stpp", "van_rossum", "nearest", "count_ratio")
FRAME_US = 41_667
SPEEDS = (0.25, 1, 3, 10, 24)
"""Motion of the timed texture, px per frame."""
SIZE = (346, 260)
REPEATS = 5
ENGINES: Mapping[str, Mapping[str, Any]] = {
    "frames": {},
    "frames, motion floor": {"motion_floor": True},
    "frames, 40 per pair": {"count": "fixed", "fixed_count": 40},
    "continuous": {"engine": "continuous"},
}
MODELS: Mapping[str, Mapping[str, Any]] = {
    "esim": {"simulator": "esim"},
    "texvent accurate": {"simulator": "texvent", "preset": "accurate"},
}


@dataclass(frozen=True, kw_only=True)
class EngineEntry(Entry):
    """A simulator by one engine."""

    title: str
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """How the table calls it."""
        return self.title

    def settings(self, seed: int) -> Settings:
        """Resolved options of a run."""
        return resolve("simulate", {**self.options, "interpolate": self.interpolate, "seed": seed})


def compare_fidelity(scenes: Sequence[str]) -> None:
    """Print one table per model and kind of pixel."""
    plan = FidelityPlan(scenes=scenes, targets=("ideal", "noisy"), metrics=METRICS)
    for scene in scenes:
        for truth, _ in record_truths(plan, scene):
            sys.stdout.write(f"\n{scene}, {truth.target} pixels\n")
            for model, engine in ((model, engine) for model in MODELS for engine in ENGINES):
                entry = EngineEntry(
                    simulator=str(MODELS[model]["simulator"]),
                    interpolate="flow",
                    title=f"{model}, {engine}",
                    options={**MODELS[model], **ENGINES[engine]},
                )
                score = score_entry(plan, truth, entry)
                sys.stdout.write(f"| {entry.name} | {_describe(score)} |\n")
                sys.stdout.flush()


def _describe(score: Score | tuple[str, str]) -> str:
    if isinstance(score, tuple):
        return score[1]
    cells = [f"{score.summary(metric).mean:.3f}" for metric in METRICS[:3]]
    return " | ".join([f"{score.threshold:.3f}", f"{score.default_ratio:.2f}", *cells])


def time_engines(video: Video, options: Mapping[str, Any]) -> dict[str, float]:
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

    def advance(engine: Literal["frames", "continuous"]) -> None:
        run = replace(settings.run, engine=engine)
        model = build_simulator(run, settings.simulate)
        for pair in pairs:
            deque(model.advance(pair), maxlen=0)

    pairs = plan()
    work: dict[str, Callable[[], Any]] = {
        "flow and count": plan,
        "drawn": draw_and_step,
        "fused": partial(advance, "frames"),
    }
    if settings.run.simulator == "esim" or settings.run.preset == "accurate":
        work["continuous"] = partial(advance, "continuous")
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
    models = {"texvent paper": {"simulator": "texvent"}, **MODELS}
    if clip is not None:
        videos = {clip.name: _read(clip, frames)}
    else:
        videos = {f"{speed:g} px per frame": _texture(speed) for speed in SPEEDS}
    for model, options in models.items():
        for name, video in videos.items():
            times = time_engines(video, options)
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
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--time", action="store_true", help="measure time instead of fidelity")
    parser.add_argument("--clip", type=Path, help="a video, with --time")
    parser.add_argument("--frames", type=int, default=5, help="of the clip")
    parser.add_argument("--scenes", default="mixed,translate,fast,slow")
    options = parser.parse_args()
    if options.time:
        compare_times(options.clip, options.frames)
    else:
        compare_fidelity(options.scenes.split(","))


if __name__ == "__main__":
    main()

"""Other programs' simulators on our frames, and ours on the same 8-bit grey frames.

Noise, refractory time and bandwidth are off everywhere, so that the cores that turn brightness into
events are compared. Peers are installed by name (the extra `./lab[peers]`) and are never
a dependency; one that is missing is reported as such.
"""

from __future__ import annotations

import argparse
import functools
import importlib
import json
import math
import os
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np

from texvent.extending import SIMULATORS
from texvent.frames import Video
from texvent.pipeline import video_to_events
from texvent.settings.resolution import resolve
from texvent.simulation.model_options import with_contrast_threshold
from texvent_lab.measure.speed.scenes import (
    EXCERPT,
    dense_video,
    embedded_heavy_clip,
    source_frames,
)
from texvent_lab.measure.speed.timing import quartiles, rounded

Simulate = Callable[[Video, float], int]
"""Frames and contrast threshold → number of events, all of them made and held in memory."""
OWN_THRESHOLD = 0.2
"""Contrast threshold of ours."""
LOWEST, HIGHEST, CLOSE, MAX_TRIALS = 0.01, 3.0, 0.02, 12
"""Thresholds that are tried; relative difference of two event counts that counts as equal."""
ONE_THREAD = dict.fromkeys(
    ("RAYON_NUM_THREADS", "NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENCV_FOR_THREADS_NUM"), "1"
)
"""Environment variables by which thread pools are limited."""


@dataclass(frozen=True)
class Peer:
    """A simulator of another project."""

    name: str
    package: str
    prepare: Callable[[], Simulate]
    """Import the package and return the simulator; ImportError where it is not installed."""

    @property
    def version(self) -> str | None:
        """Version of its package; None where it is not installed."""
        try:
            return metadata.version(self.package)
        except metadata.PackageNotFoundError:
            return None


def _eventcv(**options: Any) -> Callable[[], Simulate]:
    def prepare() -> Simulate:
        eventcv: Any = importlib.import_module("eventcv")

        def simulate(clip: Video, threshold: float) -> int:
            fps = 1e6 * (len(clip) - 1) / (clip.times_us[-1] - clip.times_us[0])
            thresholds = {"pos_thres": threshold, "neg_thres": threshold}
            return len(eventcv.simulate(clip.pixels, fps=fps, **thresholds, **options))

        return simulate

    return prepare


def _prepare_evlib() -> Simulate:
    torch: Any = importlib.import_module("torch")
    evlib: Any = importlib.import_module("evlib.simulation")
    torch.set_num_threads(1)

    def simulate(clip: Video, threshold: float) -> int:
        config = evlib.ESIMConfig(
            positive_threshold=threshold,
            negative_threshold=threshold,
            refractory_period_ms=0.0,
            device="cpu",
            dtype="float32",
        )
        core = evlib.ESIMSimulator(config)
        return sum(len(core.process_frame(frame.pixels, frame.t_us * 1e-6)[0]) for frame in clip)

    return simulate


def _model(name: str, preset: str) -> Simulate:
    simulator_class = SIMULATORS.load(name)
    config = simulator_class.presets[preset]
    config = replace(config, noise="none") if hasattr(config, "noise") else config

    def simulate(clip: Video, threshold: float) -> int:
        simulator = simulator_class(with_contrast_threshold(config, threshold))
        return sum(len(simulator.step(frame)) for frame in clip)

    return simulate


def _with_flow(clip: Video, threshold: float) -> int:
    options = {
        "preset": "paper", "interpolate": "flow", "noise": "none", "contrast_threshold": threshold,
        "detect_cuts": False,  # most pairs of the heavy clip would count as cuts, and have no flow
    }  # fmt: skip
    steps = video_to_events(clip, resolve("simulate", options)).steps()
    return sum(len(packet) for _, packet in steps)


QUIET = {
    "sigma_thres": 0.0, "refractory_us": 0, "cutoff_hz": 0.0, "leak_rate_hz": 0.0,
    "shot_noise_rate_hz": 0.0,
}  # fmt: skip
CORES = (
    Peer("eventcv, upsample off", "eventcv", _eventcv(upsample="off", **QUIET)),
    Peer("evlib", "evlib", _prepare_evlib),
)
ADAPTIVE = Peer(
    "eventcv, adaptive (its default)", "eventcv", _eventcv(upsample="adaptive", **QUIET)
)
OURS = {
    "texvent, paper preset": ("texvent", "paper"),
    "texvent, default": ("texvent", "accurate"),
    "texvent, esim": ("esim", "default"),
}
"""One event per pixel and frame; several; and the peers' own model, several."""


def measure_peers(*, quick: bool, video: Path | None) -> list[dict[str, Any]]:
    """All rows: cores on heavy motion and on real video, and whole runs with interpolation.

    Args:
        quick: the heavy clip alone, three times.
        video: real video; None: an excerpt that the tests have.
    """
    rounds, clips = 3 if quick else 15, {"heavy": embedded_heavy_clip()}
    with_flow = clips.copy()
    if not quick:
        source = source_frames(video or EXCERPT, 13)
        clips["real video, 200 fps"] = dense_video(source, 81)
        grey = np.stack([np.rint(frame.luma) for frame in source]).astype(np.uint8)
        with_flow["real video"] = Video(grey, source.times_us)
    rows = [
        measure_duel(clip, name, ours, _model(*model), CORES, rounds=rounds)
        for ours, model in OURS.items()
        for name, clip in clips.items()
    ]
    ours = "texvent, paper preset, with flow"
    return rows + [
        measure_duel(clip, name, ours, _with_flow, (ADAPTIVE,), rounds=rounds)
        for name, clip in with_flow.items()
    ]


def measure_duel(
    clip: Video, name: str, ours: str, own: Simulate, peers: Sequence[Peer], *, rounds: int
) -> dict[str, Any]:
    """One row: our model at its own threshold, each peer at the one that gives as many events.

    Args:
        clip: frames.
        name: of the clip.
        ours: name of our model.
        own: our model.
        peers: the others.
        rounds: how often each runs, in turns.

    Returns:
        Thresholds, events and CPU milliseconds of all threads per pair of frames.
    """
    pairs = len(clip) - 1
    own(clip, OWN_THRESHOLD)
    target = own(clip, OWN_THRESHOLD)
    calls: list[tuple[dict[str, Any], Callable[[], int]]] = []

    def add(row: dict[str, Any], simulate: Simulate, threshold: float, count: int) -> None:
        row |= {"threshold": rounded(threshold), "events_per_pair": rounded(count / pairs)}
        calls.append((row, lambda: simulate(clip, threshold)))

    our_row: dict[str, Any] = {"name": ours}
    add(our_row, own, OWN_THRESHOLD, target)
    peer_rows = []
    for peer in peers:
        row: dict[str, Any] = {"name": peer.name, "version": peer.version, "installed": True}
        peer_rows.append(row)
        try:
            simulate = peer.prepare()
        except ImportError as error:
            row |= {"installed": False, "problem": f"not installed ({error})"}
            continue
        add(row, simulate, *match_count(functools.partial(simulate, clip), target))
    times: list[list[float]] = [[] for _ in calls]
    for _ in range(rounds):
        for own_times, (_, call) in zip(times, calls, strict=True):
            start = time.process_time()
            call()
            own_times.append(time.process_time() - start)
    for own_times, (row, _) in zip(times, calls, strict=True):
        row["ms_per_pair"] = quartiles(own_times, scale=1e3 / pairs)
    return {"clip": name, "size": str(clip.size), "pairs": pairs, "ours": our_row,
            "peers": peer_rows}  # fmt: skip


def match_count(count_of: Callable[[float], int], target: int) -> tuple[float, int]:
    """The threshold at which a falling function is closest to a count, and that count.

    Bisection of the threshold's logarithm; ends within `CLOSE` or after `MAX_TRIALS`.
    """
    low, high = LOWEST, HIGHEST
    best = (math.nan, -1)
    for _ in range(MAX_TRIALS):
        threshold = math.sqrt(low * high)
        count = count_of(threshold)
        if best[1] < 0 or abs(count - target) < abs(best[1] - target):
            best = (threshold, count)
        if abs(count - target) <= CLOSE * target:
            break
        low, high = (threshold, high) if count > target else (low, threshold)
    return best


def run_on_one_core(*, quick: bool, video: Path | None) -> list[dict[str, Any]]:
    """The rows, measured by a child process that is kept on one core."""
    words = ["--quick"] if quick else []
    words += [] if video is None else ["--video", str(video)]
    done = subprocess.run(
        [sys.executable, "-m", "texvent_lab.measure.speed.peers", *words],
        env={**os.environ, **ONE_THREAD},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise RuntimeError(f"the comparison with peers failed: {done.stderr[-2000:]}")
    rows: list[dict[str, Any]] = json.loads(done.stdout.splitlines()[-1])
    return rows


def main() -> None:
    """Keep this process on one core, measure and print JSON."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--video", type=Path)
    options = parser.parse_args()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    print(json.dumps(measure_peers(quick=options.quick, video=options.video)))


if __name__ == "__main__":
    main()

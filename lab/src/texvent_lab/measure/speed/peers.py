"""Other programs' simulators on our frames, and ours on the same 8-bit grey frames.

Noise, refractory time and bandwidth are off everywhere, so that what is compared is the core that
turns brightness into events. Peers are installed by name (`pip install 'texvent-lab[peers]'`)
and are never a dependency; one that is missing is reported as such.
"""

from __future__ import annotations

import argparse
import importlib
import json
import math
import os
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import metadata
from pathlib import Path
from typing import Any

from texvent.extending import SIMULATORS
from texvent.pipeline import video_to_events
from texvent.settings.resolution import resolve
from texvent.simulate.model_options import with_contrast_threshold
from texvent.video import Video
from texvent_lab.measure.speed.scenes import EXCERPT, dense_video, heavy_clip, source_frames
from texvent_lab.measure.speed.timing import Quartiles, cpu_in_turns, rounded

Simulate = Callable[[Video, float], int]
"""Frames and contrast threshold → number of events, all of them made and held in memory."""


@dataclass(frozen=True)
class Contender:
    """A simulator core that takes frames."""

    name: str
    package: str
    needs: tuple[str, ...]
    """Modules without which it cannot run."""
    prepare: Callable[[], Simulate]
    """Import what it needs and return the simulator."""
    own_threshold: float | None = None
    """Where it is run as it comes, not at our event count."""

    @property
    def version(self) -> str | None:
        """Version of its package, or None where it is not installed."""
        try:
            return metadata.version(self.package)
        except metadata.PackageNotFoundError:
            return None

    def missing(self) -> str | None:
        """Why it cannot run here, or None."""
        for module in self.needs:
            try:
                importlib.import_module(module)
            except ImportError as error:
                return f"{module} is not installed ({error})"
        return None


def _prepare_eventcv(upsample: str) -> Simulate:
    eventcv: Any = importlib.import_module("eventcv")

    def simulate(clip: Video, threshold: float) -> int:
        events = eventcv.simulate(
            clip.pixels,
            fps=_fps(clip),
            pos_thres=threshold,
            neg_thres=threshold,
            sigma_thres=0.0,
            refractory_us=0,
            cutoff_hz=0.0,
            leak_rate_hz=0.0,
            shot_noise_rate_hz=0.0,
            upsample=upsample,
        )
        return len(events)

    return simulate


def _prepare_shipped_eventcv() -> Simulate:
    eventcv: Any = importlib.import_module("eventcv")

    def simulate(clip: Video, threshold: float) -> int:
        shown = eventcv.simulate(
            clip.pixels, fps=_fps(clip), pos_thres=threshold, neg_thres=threshold
        )
        return len(shown)

    return simulate


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


def _prepare_ours(model: str, preset: str) -> Simulate:
    simulator_class = SIMULATORS.load(model)
    config = simulator_class.presets[preset]
    config = replace(config, noise="none") if hasattr(config, "noise") else config

    def simulate(clip: Video, threshold: float) -> int:
        simulator = simulator_class(with_contrast_threshold(config, threshold))
        return sum(len(simulator.step(frame)) for frame in clip)

    return simulate


def _prepare_pipeline(interpolate: str) -> Simulate:
    def simulate(clip: Video, threshold: float) -> int:
        options = {
            "preset": "paper",
            "interpolate": interpolate,
            "noise": "none",
            "contrast_threshold": threshold,
        }
        steps = video_to_events(clip, resolve("simulate", options)).steps()
        return sum(len(packet) for _, packet in steps)

    return simulate


def _fps(clip: Video) -> float:
    return 1e6 * (len(clip) - 1) / (clip.times_us[-1] - clip.times_us[0])


PEERS = (
    Contender("eventcv, upsample off", "eventcv", ("eventcv",), lambda: _prepare_eventcv("off")),
    Contender("evlib", "evlib", ("torch", "evlib"), _prepare_evlib),
)
ADAPTIVE = Contender(
    "eventcv, adaptive (its default)", "eventcv", ("eventcv",), lambda: _prepare_eventcv("adaptive")
)
AS_SHIPPED = Contender(
    "eventcv, all defaults (adaptive, with its noise)",
    "eventcv",
    ("eventcv",),
    lambda: _prepare_shipped_eventcv(),
    own_threshold=0.2,
)
OURS = (
    Contender("texvent, paper preset", "texvent", (), lambda: _prepare_ours("texvent", "paper")),
    Contender("texvent, default", "texvent", (), lambda: _prepare_ours("texvent", "accurate")),
    Contender("texvent, esim", "texvent", (), lambda: _prepare_ours("esim", "default")),
)
"""One event per pixel and frame; several; and the peers' own model, several."""
OURS_WITH_FLOW = Contender(
    "texvent, paper preset, with flow", "texvent", (), lambda: _prepare_pipeline("flow")
)


LOWEST, HIGHEST = 0.01, 3.0
"""Contrast thresholds that are tried."""
CLOSE = 0.02
"""Relative difference of two event counts that counts as equal."""
MAX_TRIALS = 12
OWN_THRESHOLD = 0.2
ONE_THREAD = dict.fromkeys(
    ("RAYON_NUM_THREADS", "NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENCV_FOR_THREADS_NUM"), "1"
)
"""Environment variables by which thread pools are limited."""


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


def ratio_to_fastest(ours_ms: float, peers_ms: Sequence[float]) -> float | None:
    """How many times as long the fastest peer takes as we do; below 1 it is faster.

    Args:
        ours_ms: our time.
        peers_ms: the peers' times, in the same unit.

    Returns:
        None where there is no peer to compare with.

    Example:
        >>> ratio_to_fastest(2.0, [11.0, 5.0])
        2.5
    """
    return min(peers_ms) / ours_ms if peers_ms else None


def measure_duel(
    clip: Video, name: str, ours: Contender, peers: Sequence[Contender], *, rounds: int
) -> dict[str, Any]:
    """One row: our model at its own threshold, each peer at the one that gives as many events.

    A peer with a threshold of its own runs at that.
    """
    pairs = len(clip) - 1
    own: Simulate = ours.prepare()
    own(clip, OWN_THRESHOLD)
    target = own(clip, OWN_THRESHOLD)
    calls: dict[str, Callable[[], int]] = {ours.name: lambda: own(clip, OWN_THRESHOLD)}
    rows = [_match(clip, peer, target, calls) for peer in peers]
    times = cpu_in_turns(calls, rounds=rounds)
    for row in rows:
        if row["installed"]:
            row["ms_per_pair"] = _per_pair(times, row["name"], pairs).as_json()
    ours_ms = _per_pair(times, ours.name, pairs)
    medians = [row["ms_per_pair"]["median"] for row in rows if row["installed"]]
    ratio = ratio_to_fastest(ours_ms.median, medians)
    return {
        "clip": name,
        "size": str(clip.size),
        "pairs": pairs,
        "ours": {
            "name": ours.name,
            "threshold": OWN_THRESHOLD,
            "events_per_pair": rounded(target / pairs),
            "ms_per_pair": ours_ms.as_json(),
        },
        "peers": rows,
        "ratio_to_fastest_peer": None if ratio is None else rounded(ratio),
    }


def _match(
    clip: Video, peer: Contender, target: int, calls: dict[str, Callable[[], int]]
) -> dict[str, Any]:
    """What is known of a peer before it is timed; adds the call to time."""
    row: dict[str, Any] = {"name": peer.name, "package": peer.package, "version": peer.version}
    problem = peer.missing()
    if problem is not None:
        return {**row, "installed": False, "problem": problem}
    simulate = peer.prepare()
    if peer.own_threshold is None:
        threshold, count = match_count(lambda tried: simulate(clip, tried), target)
    else:
        threshold, count = peer.own_threshold, simulate(clip, peer.own_threshold)
    calls[peer.name] = lambda: simulate(clip, threshold)
    pairs = len(clip) - 1
    return {
        **row,
        "installed": True,
        "threshold": rounded(threshold),
        "events_per_pair": rounded(count / pairs),
        "count_difference": rounded(count / target - 1),
    }


def _per_pair(times: Mapping[str, Sequence[float]], name: str, pairs: int) -> Quartiles:
    return Quartiles.of(times[name], scale=1e3 / pairs)


def measure_duels(*, quick: bool, heavy: Path | None, video: Path | None) -> list[dict[str, Any]]:
    """All rows: cores on heavy motion and on real video, and the whole way with interpolation."""
    rounds = 3 if quick else 15
    clip = heavy_clip(heavy)
    shown = heavy.name if heavy is not None else "embedded heavy scene"
    real = video or EXCERPT
    source = source_frames(real, 3 if quick else 13)
    dense = dense_video(source, 13 if quick else 81)
    rows = []
    for ours in OURS:
        rows.append(measure_duel(clip, "heavy", ours, PEERS, rounds=rounds))
        rows.append(measure_duel(dense, "real video, 200 fps", ours, PEERS, rounds=rounds))
    for name, peer in (("heavy", ADAPTIVE), ("heavy, as shipped", AS_SHIPPED)):
        rows.append(measure_duel(clip, name, OURS_WITH_FLOW, (peer,), rounds=rounds))
    return [
        {**row, "file": shown if row["clip"].startswith("heavy") else real.name} for row in rows
    ]


def run_on_one_core(words: Sequence[str]) -> list[dict[str, Any]]:
    """The rows, measured by a child process that is kept on one core."""
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
    parser.add_argument("--heavy-clip", type=Path)
    parser.add_argument("--video", type=Path)
    options = parser.parse_args()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    rows = measure_duels(quick=options.quick, heavy=options.heavy_clip, video=options.video)
    print(json.dumps(rows))


if __name__ == "__main__":
    main()

"""Ours against peers on the same frames at matched event counts, all on one core.

    python -m texvent_lab.measure.speed.duel [--quick] [--heavy-clip FILE] [--video FILE]

Times are CPU time, which on one core is what a quiet machine's clock would show. Prints its rows as
JSON. `python -m texvent_lab.measure.speed` runs it in a process of its own, because
most thread pools can only be limited before they start.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from texvent.video import Video
from texvent_lab.measure.speed.peers import (
    ADAPTIVE,
    AS_SHIPPED,
    OURS,
    OURS_WITH_FLOW,
    PEERS,
    Contender,
    Simulate,
)
from texvent_lab.measure.speed.scenes import EXCERPT, dense_video, heavy_clip, source_frames
from texvent_lab.measure.speed.timing import Quartiles, cpu_in_turns, rounded

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
        [sys.executable, "-m", "texvent_lab.measure.speed.duel", *words],
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

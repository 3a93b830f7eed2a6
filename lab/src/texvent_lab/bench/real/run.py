"""Simulators against recorded events: frames of a real sensor in, its own events as the truth."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.metrics.controls import split_halves
from texvent_lab.bench.document import describe_environment
from texvent_lab.bench.fidelity.entries import Entry, simulators_to_compare
from texvent_lab.bench.fidelity.results import FidelityReport, Reference, Score
from texvent_lab.bench.fidelity.run import (
    NULL,
    Metrics,
    check_names,
    measure_bounds,
    score_entries,
    score_recorded,
)
from texvent_lab.bench.jobs import Progress, no_progress
from texvent_lab.bench.perturbations import perturb
from texvent_lab.bench.real.recording import SEED, RealScene

HALVES = "half of the recording"
"""Row of the recording's events, one random half judged by the other."""
INTERPOLATIONS = ("none", "blend", "flow")
SENSOR_PRESETS = ("davis346", "davis240c-ecd", "clean")
"""Presets of `physical` that are compared in addition to its default."""
METRICS: Metrics = (
    *("stpp", "van_rossum", "nearest", "ef_mse", "ef_ssim", "on_difference", "count_ratio"),
)


def real_entries() -> list[Entry]:
    """All simulators by what needs frames only, and `physical` with what is known of sensors."""
    entries = [
        Entry(simulator=simulator, preset=preset, interpolate=interpolate)
        for simulator, preset in simulators_to_compare()
        for interpolate in INTERPOLATIONS
    ]
    return entries + [
        Entry(simulator="physical", preset=preset, interpolate="flow") for preset in SENSOR_PRESETS
    ]


def run_real(
    scenes: Sequence[RealScene],
    entries: Sequence[Entry],
    metrics: Metrics = METRICS,
    *,
    jobs: int = 1,
    progress: Progress = no_progress,
) -> FidelityReport:
    """Fit δ on the first half of each recording and score the second, span by span.

    Args:
        scenes: the recordings.
        entries: simulators and interpolators; see `real_entries`.
        metrics: names, or metrics.
        jobs: processes to use; 1 stays in this one.
        progress: told of every step.

    Raises:
        ConfigError: an entry does not exist, is named twice or needs true frames, or jobs is below
            1.
        InputError, FileFormatError: events of another program are damaged, or not of these frames.
    """
    check_range("jobs", jobs, 1)
    start = time.perf_counter()
    check_names(entries)
    for entry in entries:
        entry.settings(SEED)
        if entry.interpolate == "exact":
            raise ConfigError(f"{entry.name} needs the true frames, which no recording has")
        for scene in scenes:
            scene.check(entry)
    scores, skipped = score_entries(scenes, entries, metrics, jobs=jobs, progress=progress)
    return FidelityReport(
        environment=describe_environment(),
        references=[_bounds(scene, metrics) for scene in scenes],
        scores=[*(_halves(scene, metrics) for scene in scenes), *scores],
        skipped=skipped,
        seconds=time.perf_counter() - start,
        floor_name="the recording itself",
        protocol={scene.scene: _protocol(scene) for scene in scenes},
    )


def _bounds(scene: RealScene, metrics: Metrics) -> Reference:
    """Scores of the recording against itself, and with shuffled times."""
    # Shuffled as one: within a short span a shuffle changes little.
    shuffled = perturb(scene.recorded(scene.whole), NULL)
    nulls = [shuffled.cut(*span) for span in scene.scored]
    return measure_bounds(scene, scene.references, nulls, metrics)


def _halves(scene: RealScene, metrics: Metrics) -> Score:
    pairs = [split_halves(events, SEED) for events in scene.references]
    first, second = zip(*pairs, strict=True)
    return score_recorded(scene, HALVES, first, metrics, references=second)


def _protocol(scene: RealScene) -> Mapping[str, Any]:
    """Used parts of a recording, ready for JSON; times are µs on the recording's clock."""
    return {
        "frame_offset_us": scene.offset_us,
        "frames_gamma": scene.frames_gamma,
        "fit_us": list(scene.fit),
        "scored_us": [list(span) for span in scene.scored],
        "seed": SEED,
    }

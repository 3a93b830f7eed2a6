"""Simulators against recorded events: frames of a real sensor in, its own events as the truth."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from texvent.config import check_range
from texvent.errors import ConfigError, TexventError
from texvent.events import EventStream
from texvent.metrics.compare import load_metric
from texvent.metrics.controls import split_halves
from texvent.metrics.event_sharpness import estimate_patch_flow
from texvent.metrics.protocol import Metric
from texvent.options.fields import option_names
from texvent.settings.resolution import Settings, apply_options
from texvent_lab.bench.document import describe_environment
from texvent_lab.bench.fidelity.comparison import Details, describe
from texvent_lab.bench.fidelity.entries import Entry, simulate_video, simulators_to_compare
from texvent_lab.bench.fidelity.results import FidelityReport, Reference, Score
from texvent_lab.bench.fidelity.run import NULL, compare_all, fit_threshold
from texvent_lab.bench.jobs import Progress, no_progress, run_jobs
from texvent_lab.bench.real.recording import RealScene
from texvent_lab.bench.selftest.run import perturb

TARGET = "recorded"
"""What takes the place of the oracle's kind of pixels."""
HALVES = "half of the recording"
"""Row of the recording's events, one random half judged by the other."""
INTERPOLATIONS = ("none", "blend", "flow")
SENSOR_PRESETS = ("davis346", "davis240c-ecd", "clean")
"""Presets of `physical` that are compared in addition to its default."""
MAX_INTERMEDIATE = 16
PATCH_WINDOW_US = 40_000
SEED = 0


@dataclass(frozen=True, kw_only=True)
class RealPlan:
    """What a run covers.

    Raises:
        ConfigError: an unknown metric.
    """

    metrics: Sequence[str | Metric] = (
        "stpp",
        "van_rossum",
        "nearest",
        "ef_mse",
        "ef_ssim",
        "on_difference",
        "count_ratio",
    )
    entries: Sequence[Entry] = ()
    """Simulators and interpolators; none means `real_entries()`."""

    def __post_init__(self) -> None:
        for metric in self.metrics:
            if isinstance(metric, str):
                load_metric(metric)


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
    plan: RealPlan,
    *,
    jobs: int = 1,
    progress: Progress = no_progress,
) -> FidelityReport:
    """Fit δ on the first half of each recording and score the second, span by span.

    Args:
        scenes: the recordings.
        plan: what is run and measured.
        jobs: processes to use; 1 stays in this one.
        progress: told of every step.

    Raises:
        ConfigError: an entry does not exist or needs the true frames, or jobs is below 1.
    """
    check_range("jobs", jobs, 1)
    start = time.perf_counter()
    entries = list(plan.entries) or real_entries()
    for entry in entries:
        entry.settings(SEED)
        if entry.interpolate == "exact":
            raise ConfigError(f"{entry.name} needs the true frames, which no recording has")
    scores: list[Score] = []
    skipped: dict[str, str] = {}
    work = [(plan, scene, entry) for scene in scenes for entry in entries]
    for found in run_jobs(score_on_recording, work, jobs):
        if isinstance(found, Score):
            progress(f"{found.scene}: {found.entry} ({found.seconds:.1f} s)")
            scores.append(found)
        else:
            skipped[found[0]] = found[1]
    bounds = [measure_bounds(plan, scene) for scene in scenes]
    return FidelityReport(
        environment=describe_environment(),
        references=[reference for reference, _ in bounds],
        scores=[*(halves for _, halves in bounds), *scores],
        skipped=skipped,
        seconds=time.perf_counter() - start,
        floor_name="the recording itself",
        protocol={scene.name: _protocol(scene) for scene in scenes},
    )


def measure_bounds(plan: RealPlan, scene: RealScene) -> tuple[Reference, Score]:
    """What the recording scores against itself and with shuffled times; and half against half."""
    recorded = [scene.recorded(span) for span in scene.scored]
    # Shuffled as one: within a short span a shuffle changes little.
    shuffled = perturb(scene.recorded(scene.whole), NULL)
    nulls = [shuffled.cut(*span) for span in scene.scored]
    reference = Reference(
        scene=scene.name,
        target=TARGET,
        events=[len(events) for events in recorded],
        floor=compare_all(recorded, recorded, plan.metrics),
        null=compare_all(nulls, recorded, plan.metrics),
        details=_describe(recorded, recorded),
    )
    first, second = zip(*(split_halves(events, SEED) for events in recorded), strict=True)
    halves = Score(
        scene=scene.name,
        target=TARGET,
        entry=HALVES,
        track="recorded",
        threshold=None,
        is_matched=True,
        default_ratio=math.nan,
        seconds=0.0,
        values=compare_all(first, second, plan.metrics),
        details=_describe(first, second),
    )
    return reference, halves


def score_on_recording(plan: RealPlan, scene: RealScene, entry: Entry) -> Score | tuple[str, str]:
    """One entry on one recording.

    Returns:
        The score, or (name of the entry, why it cannot run).
    """
    settings = adapt_settings(entry.settings(SEED), scene)
    video = scene.frames_around(scene.fit)

    def count_events(threshold: float | None) -> int:
        return len(simulate_video(video, settings, threshold).cut(*scene.fit))

    recorded = [scene.recorded(span) for span in scene.scored]
    try:
        match, default_ratio = fit_threshold(
            count_events, len(scene.recorded(scene.fit)), entry.default_threshold
        )
        start = time.perf_counter()
        events = simulate_video(
            scene.frames_around(scene.whole), settings, match and match.threshold
        )
        seconds = time.perf_counter() - start
    except TexventError as error:
        return entry.name, str(error)
    simulated = [events.cut(*span) for span in scene.scored]
    return Score(
        scene=scene.name,
        target=TARGET,
        entry=entry.name,
        track=entry.track,
        threshold=match and match.threshold,
        is_matched=bool(match and match.is_matched),
        default_ratio=default_ratio,
        seconds=seconds,
        values=compare_all(simulated, recorded, plan.metrics),
        details=_describe(simulated, recorded),
    )


def adapt_settings(settings: Settings, scene: RealScene) -> Settings:
    """Settings that know how the frames are coded, and ask for at most 16 frames in between."""
    options: dict[str, Any] = {"max_intermediate": MAX_INTERMEDIATE}
    if "gamma" in option_names(type(settings.simulate)):
        options["gamma"] = scene.frames_gamma
    return apply_options(settings, options, where="the recording")


def _describe(predicted: Sequence[EventStream], recorded: Sequence[EventStream]) -> Details:
    details = describe(predicted, recorded, None)
    errors = [_patch_flow_error(*pair) for pair in zip(predicted, recorded, strict=True)]
    return dataclasses.replace(details, flow_error=errors)


def _patch_flow_error(predicted: EventStream, recorded: EventStream) -> float:
    """px/s between the motion that patches of both streams show at the start of a span."""
    if not len(recorded):
        return math.nan
    start_us = int(recorded.t[0])
    flows = [
        estimate_patch_flow(
            events.cut(start_us, start_us + PATCH_WINDOW_US), window_us=PATCH_WINDOW_US
        )
        for events in (predicted, recorded)
    ]
    apart = np.linalg.norm(flows[0] - flows[1], axis=2)
    known = apart[~np.isnan(apart)]
    return float(known.mean()) if known.size else math.nan


def _protocol(scene: RealScene) -> Mapping[str, Any]:
    """What was used of a recording, ready for JSON; times are µs on the recording's clock."""
    return {
        "frame_offset_us": scene.offset_us,
        "frames_gamma": scene.frames_gamma,
        "fit_us": list(scene.fit),
        "scored_us": [list(span) for span in scene.scored],
        "seed": SEED,
    }

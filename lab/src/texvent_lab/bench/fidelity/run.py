"""The oracle benchmark: simulators see 24 frames per second, and are judged by the true events."""

from __future__ import annotations

import dataclasses
import itertools
import math
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from texvent.config import check_range
from texvent.errors import ConfigError, TexventError
from texvent.events import EventStream
from texvent.metrics.compare import compare, load_metric
from texvent.metrics.protocol import Metric
from texvent.run.rate_search import ThresholdMatch, find_threshold
from texvent_lab.bench.document import describe_environment
from texvent_lab.bench.fidelity.comparison import describe
from texvent_lab.bench.fidelity.entries import Entry, choose_entries
from texvent_lab.bench.fidelity.results import FidelityReport, Reference, Score
from texvent_lab.bench.jobs import Progress, no_progress, run_jobs
from texvent_lab.bench.oracle.pixel import (
    FLOOR_SEED,
    OTHER_SEED,
    OTHER_SENSOR_SEED,
    REFERENCE_SEED,
    SENSOR_SEED,
    TARGETS,
)
from texvent_lab.bench.oracle.recording import oracle_scene, record
from texvent_lab.bench.oracle.scenes import check_scene, known_flow, scene_names
from texvent_lab.bench.selftest.run import perturb

NULL = "shuffle all times"
OTHER_SENSOR = "another sensor of the kind"
"""Row of a recording by a sensor with the same constants and other pixels: a simulator that knows
the kind of the sensor, but not each pixel, gets no closer."""


@dataclass(frozen=True, kw_only=True)
class FidelityPlan:
    """What a run of the benchmark covers.

    Raises:
        ConfigError: an unknown scene, target or metric, or no seed to fit or to score.
    """

    scenes: Sequence[str] = ("mixed", "translate", "fast", "slow")
    targets: Sequence[str] = ("noisy",)
    fit_seeds: Sequence[int] = (7,)
    """Textures on which δ is fitted."""
    score_seeds: Sequence[int] = (21, 33, 54, 68, 85, 97)
    """Textures on which the entries are scored with that δ; six and more can tell entries apart."""
    metrics: Sequence[str] = (
        "stpp",
        "van_rossum",
        "nearest",
        "ef_mse",
        "count_ratio",
    )
    entries: Sequence[Entry] = ()
    """Simulators and interpolators; none means all that are registered."""

    def __post_init__(self) -> None:
        for scene in self.scenes:
            check_scene(scene)
        for metric in self.metrics:
            load_metric(metric)
        unknown = set(self.targets) - set(TARGETS)
        if unknown or not self.fit_seeds or not self.score_seeds:
            raise ConfigError(
                f"targets {list(self.targets)}, fit seeds {list(self.fit_seeds)}, score seeds "
                f"{list(self.score_seeds)}: targets are {', '.join(TARGETS)}, seeds at least one"
            )


FULL = FidelityPlan(
    scenes=scene_names(),
    targets=tuple(TARGETS),
    fit_seeds=(7, 21),
    score_seeds=(33, 54, 68, 85, 97, 113),
    metrics=(*FidelityPlan.metrics, "ef_ssim", "active_iou"),
)
"""The paper-grade run: every scene, ideal and noisy pixels, eight seeds."""


@dataclass(frozen=True, kw_only=True)
class TrueRecordings:
    """True recordings of one scene by one kind of pixels."""

    scene: str
    target: str
    references: Mapping[int, EventStream]
    """Texture seed → the recording that counts as the truth."""


def run_fidelity(
    plan: FidelityPlan, *, jobs: int = 1, progress: Progress = no_progress
) -> FidelityReport:
    """Run the benchmark.

    Args:
        plan: what it covers.
        jobs: processes to use; 1 stays in this one.
        progress: told of every step.

    Raises:
        ConfigError: the plan names something that does not exist, or jobs is below 1.
    """
    check_range("jobs", jobs, 1)
    start = time.perf_counter()
    entries = list(plan.entries) or choose_entries()
    for entry in entries:
        entry.settings(0)
    environment = describe_environment()
    truths: list[TrueRecordings] = []
    references: list[Reference] = []
    others: list[Score] = []
    for found in run_jobs(record_truths, [(plan, scene) for scene in plan.scenes], jobs):
        for truth, reference, other in found:
            progress(f"recorded {truth.scene}, {truth.target} pixels")
            truths.append(truth)
            references.append(reference)
            others.append(other)
    scores: list[Score] = []
    skipped: dict[str, str] = {}
    work = [(plan, truth, entry) for truth, entry in itertools.product(truths, entries)]
    for score in run_jobs(score_entry, work, jobs):
        if isinstance(score, Score):
            progress(f"{score.scene}, {score.target}: {score.entry} ({score.seconds:.1f} s a run)")
            scores.append(score)
        else:
            skipped[score[0]] = score[1]
    return FidelityReport(
        environment=environment,
        fit_seeds=plan.fit_seeds,
        score_seeds=plan.score_seeds,
        references=references,
        scores=[*scores, *others],
        skipped=skipped,
        seconds=time.perf_counter() - start,
    )


def record_truths(plan: FidelityPlan, scene: str) -> list[tuple[TrueRecordings, Reference, Score]]:
    """The true recordings of one scene by each kind of pixels.

    Args:
        plan: which pixels, seeds and metrics.
        scene: name of the scene.

    Returns:
        With floor and null, and what another sensor of the kind scores.
    """
    # All at once, since drawing a scene 4,800 times a second takes longer than its pixels do.
    sensors = {
        (target, noise): (dataclasses.replace(TARGETS[target], sensor_seed=sensor), noise)
        for target in plan.targets
        for noise, sensor in (
            (REFERENCE_SEED, SENSOR_SEED),
            (FLOOR_SEED, SENSOR_SEED),
            (OTHER_SEED, OTHER_SENSOR_SEED),
        )
    }
    recordings = {
        seed: record(oracle_scene(scene, seed), sensors)
        for seed in (*plan.fit_seeds, *plan.score_seeds)
    }
    found = []
    for target in plan.targets:
        references, seconds, others = (
            {texture: all_of[target, noise] for texture, all_of in recordings.items()}
            for noise in (REFERENCE_SEED, FLOOR_SEED, OTHER_SEED)
        )
        truth = TrueRecordings(scene=scene, target=target, references=references)
        bounds = _measure_bounds(plan, truth, seconds)
        found.append((truth, bounds, _score_other_sensor(plan, truth, others)))
    return found


def _score_other_sensor(
    plan: FidelityPlan, truth: TrueRecordings, others: Mapping[int, EventStream]
) -> Score:
    """What the recordings of another sensor score against the truth."""
    simulated = [others[seed] for seed in plan.score_seeds]
    return Score(
        scene=truth.scene,
        target=truth.target,
        entry=OTHER_SENSOR,
        track="recorded",
        threshold=None,
        is_matched=True,
        default_ratio=math.nan,
        seconds=0.0,
        **_judge(plan, truth, simulated),
    )


def _judge(
    plan: FidelityPlan, truth: TrueRecordings, simulated: Sequence[EventStream]
) -> dict[str, Any]:
    """`values` and `details` of a score."""
    references = [truth.references[seed] for seed in plan.score_seeds]
    return {
        "values": compare_all(simulated, references, plan.metrics),
        "details": describe(simulated, references, known_flow(truth.scene)),
    }


def _measure_bounds(
    plan: FidelityPlan, truth: TrueRecordings, seconds: Mapping[int, EventStream]
) -> Reference:
    """What second recordings and shuffled ones score against the truth."""
    scored = [truth.references[seed] for seed in plan.score_seeds]
    floors = [seconds[seed] for seed in plan.score_seeds]
    nulls = [perturb(events, NULL) for events in scored]
    return Reference(
        scene=truth.scene,
        target=truth.target,
        events=[len(events) for events in scored],
        floor=compare_all(floors, scored, plan.metrics),
        null=compare_all(nulls, scored, plan.metrics),
        details=describe(floors, scored, known_flow(truth.scene)),
    )


def score_entry(plan: FidelityPlan, truth: TrueRecordings, entry: Entry) -> Score | tuple[str, str]:
    """One entry on one scene: δ fitted on the fitting seeds, scored on the others.

    Returns:
        The score, or (name of the entry, why it cannot run).
    """
    scenes = {seed: oracle_scene(truth.scene, seed) for seed in truth.references}

    def count_events(threshold: float | None) -> int:
        return sum(len(entry.simulate(scenes[seed], seed, threshold)) for seed in plan.fit_seeds)

    target = sum(len(truth.references[seed]) for seed in plan.fit_seeds)
    try:
        match, default_ratio = fit_threshold(count_events, target, entry.default_threshold)
        start = time.perf_counter()
        simulated = [
            entry.simulate(scenes[seed], seed, match.threshold if match else None)
            for seed in plan.score_seeds
        ]
        seconds = (time.perf_counter() - start) / len(simulated)
    except TexventError as error:
        return entry.name, str(error)
    return Score(
        scene=truth.scene,
        target=truth.target,
        entry=entry.name,
        track=entry.track,
        threshold=match.threshold if match else None,
        is_matched=bool(match and match.is_matched),
        default_ratio=default_ratio,
        seconds=seconds,
        **_judge(plan, truth, simulated),
    )


def fit_threshold(
    count_events: Callable[[float | None], int], target: int, default: float | None
) -> tuple[ThresholdMatch | None, float]:
    """The threshold at which a simulator makes as many events as there truly were.

    Args:
        count_events: threshold, or None for the preset's own → number of events.
        target: true events.
        default: where the search starts, log units; None for a simulator without a threshold.

    Returns:
        What was found, None without a threshold; events per true event before the search.
    """
    counts: dict[float | None, int] = {}

    def count(threshold: float | None) -> int:
        if threshold not in counts:
            counts[threshold] = count_events(threshold)
        return counts[threshold]

    ratio = count(default) / target if target else math.nan
    if default is None:
        return None, ratio
    if not target:
        return ThresholdMatch(default, math.nan, 0), ratio
    return find_threshold(count, target, start=default), ratio


def compare_all(
    predicted: Iterable[EventStream],
    references: Iterable[EventStream],
    metrics: Sequence[str | Metric],
) -> dict[str, list[float]]:
    """Name of the metric → value per pair of a simulated and a true stream."""
    rows = [compare(one, other, metrics) for one, other in zip(predicted, references, strict=True)]
    return {name: [row[name] for row in rows] for name in (rows[0] if rows else ())}

"""The oracle benchmark: simulators see 24 frames per second, and are judged by the true events."""

from __future__ import annotations

import itertools
import multiprocessing
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from texvent.bench.entries import Entry, default_entries
from texvent.bench.oracle import SIZE, oracle_scene, record
from texvent.bench.oracle_pixel import IDEAL, NOISY, PixelModel
from texvent.bench.perturbations import perturb
from texvent.bench.rate_matching import Match, match_rate
from texvent.bench.results import FidelityReport, Reference, Score
from texvent.bench.scenes import SCENES, build_scene
from texvent.errors import ConfigError, TexventError
from texvent.events import EventStream
from texvent.metrics.compare import compare, load_metric

TARGETS: Mapping[str, PixelModel] = {"noisy": NOISY, "ideal": IDEAL}
REFERENCE_SEED, FLOOR_SEED = 1, 2
"""Noise seeds of the reference and of the second recording."""
NULL = "shuffle all times"

Announce: TypeAlias = Callable[[str], None]


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
    score_seeds: Sequence[int] = (21, 33)
    """Textures on which the entries are scored with that δ."""
    metrics: Sequence[str] = (
        "stpp",
        "van_rossum",
        "nearest",
        "isi",
        "ef_mse",
        "batching",
        "cadence",
        "count_ratio",
    )
    entries: Sequence[Entry] = ()
    """Simulators and interpolators; none means all that are registered."""

    def __post_init__(self) -> None:
        for scene in self.scenes:
            build_scene(scene, 0, SIZE)
        for metric in self.metrics:
            load_metric(metric)
        unknown = set(self.targets) - set(TARGETS)
        if unknown or not self.fit_seeds or not self.score_seeds:
            raise ConfigError(
                f"targets {list(self.targets)}, fit seeds {list(self.fit_seeds)}, score seeds "
                f"{list(self.score_seeds)}: targets are {', '.join(TARGETS)}, seeds at least one"
            )


FULL = FidelityPlan(
    scenes=tuple(SCENES),
    targets=tuple(TARGETS),
    fit_seeds=(7, 21),
    score_seeds=(33, 54, 68),
    metrics=(*FidelityPlan.metrics, "voxel", "kernel", "ef_ssim", "active_iou"),
)
"""The paper-grade run: every scene, ideal and noisy pixels, five seeds."""


@dataclass(frozen=True, kw_only=True)
class Truth:
    """True recordings of one scene by one kind of pixels."""

    scene: str
    target: str
    references: Mapping[int, EventStream]
    """Texture seed → the recording that counts as the truth."""
    seconds: Mapping[int, EventStream]
    """Texture seed → a second recording."""


def run_fidelity(
    plan: FidelityPlan, *, jobs: int = 1, announce: Announce = lambda line: None
) -> FidelityReport:
    """Run the benchmark.

    Args:
        plan: what it covers.
        jobs: processes to use; 1 stays in this one.
        announce: told of every step.

    Raises:
        ConfigError: the plan names something that does not exist, or jobs is below 1.
    """
    if jobs < 1:
        raise ConfigError(f"jobs is {jobs}; it must be at least 1")
    start = time.perf_counter()
    entries = list(plan.entries) or default_entries()
    for entry in entries:
        entry.settings(0)
    report = FidelityReport(
        fit_seeds=plan.fit_seeds, score_seeds=plan.score_seeds, references=[], scores=[]
    )
    truths: list[Truth] = []
    references: list[Reference] = []
    for truth, reference in _run_jobs(
        record_truth,
        [(plan, scene, target) for scene in plan.scenes for target in plan.targets],
        jobs,
    ):
        announce(f"recorded {truth.scene}, {truth.target} pixels")
        truths.append(truth)
        references.append(reference)
    scores: list[Score] = []
    skipped: dict[str, str] = {}
    work = [(plan, truth, entry) for truth, entry in itertools.product(truths, entries)]
    for score in _run_jobs(score_entry, work, jobs):
        if isinstance(score, Score):
            announce(f"{score.scene}, {score.target}: {score.entry} ({score.seconds:.1f} s a run)")
            scores.append(score)
        else:
            skipped[score[0]] = score[1]
    return replace(
        report,
        references=references,
        scores=scores,
        skipped=skipped,
        seconds=time.perf_counter() - start,
    )


def record_truth(plan: FidelityPlan, scene: str, target: str) -> tuple[Truth, Reference]:
    """The true recordings of one scene, with floor and null.

    Args:
        plan: which seeds and metrics.
        scene: name of the scene.
        target: "noisy" or "ideal".
    """
    model = TARGETS[target]
    recordings = {
        seed: record(
            oracle_scene(scene, seed),
            {"reference": (model, REFERENCE_SEED), "second": (model, FLOOR_SEED)},
        )
        for seed in (*plan.fit_seeds, *plan.score_seeds)
    }
    truth = Truth(
        scene=scene,
        target=target,
        references={seed: both["reference"] for seed, both in recordings.items()},
        seconds={seed: both["second"] for seed, both in recordings.items()},
    )
    scored = [truth.references[seed] for seed in plan.score_seeds]
    floors = [truth.seconds[seed] for seed in plan.score_seeds]
    nulls = [perturb(events, NULL) for events in scored]
    reference = Reference(
        scene=scene,
        target=target,
        events=[len(events) for events in scored],
        floor=_compare_all(floors, scored, plan.metrics),
        null=_compare_all(nulls, scored, plan.metrics),
    )
    return truth, reference


def score_entry(plan: FidelityPlan, truth: Truth, entry: Entry) -> Score | tuple[str, str]:
    """One entry on one scene: δ fitted on the fitting seeds, scored on the others.

    Returns:
        The score, or (name of the entry, why it cannot run).
    """
    scenes = {seed: oracle_scene(truth.scene, seed) for seed in truth.references}
    counts: dict[float | None, int] = {}

    def count_events(threshold: float | None) -> int:
        if threshold not in counts:
            counts[threshold] = sum(
                len(entry.simulate(scenes[seed], seed, threshold)) for seed in plan.fit_seeds
            )
        return counts[threshold]

    target = sum(len(truth.references[seed]) for seed in plan.fit_seeds)
    default = entry.default_threshold
    try:
        default_count = count_events(default)
        match = _fit(count_events, target, default)
        start = time.perf_counter()
        simulated = [
            entry.simulate(scenes[seed], seed, match.threshold if match else None)
            for seed in plan.score_seeds
        ]
    except TexventError as error:
        return entry.name, str(error)
    return Score(
        scene=truth.scene,
        target=truth.target,
        entry=entry.name,
        track=entry.track,
        threshold=match.threshold if match else None,
        is_matched=bool(match and match.is_matched),
        default_ratio=default_count / target if target else float("nan"),
        seconds=(time.perf_counter() - start) / len(simulated),
        values=_compare_all(
            simulated, [truth.references[seed] for seed in plan.score_seeds], plan.metrics
        ),
    )


def _fit(
    count_events: Callable[[float | None], int], target: int, default: float | None
) -> Match | None:
    return None if default is None else match_rate(count_events, target, start=default)


def _compare_all(
    predicted: Iterable[EventStream], references: Iterable[EventStream], metrics: Sequence[str]
) -> dict[str, list[float]]:
    """Metric → value per pair."""
    rows = [compare(one, other, metrics) for one, other in zip(predicted, references, strict=True)]
    return {metric: [row[metric] for row in rows] for metric in metrics}


def _run_jobs(
    function: Callable[..., Any], arguments: Sequence[tuple[Any, ...]], jobs: int
) -> Iterator[Any]:
    """Results in the order of the arguments, computed here or in other processes."""
    if jobs == 1:
        yield from itertools.starmap(function, arguments)
        return
    # Spawned, because compiled kernels and OpenCV keep threads that a fork would break.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=context) as pool:
        futures = [pool.submit(function, *one) for one in arguments]
        try:
            for future in futures:
                yield future.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)

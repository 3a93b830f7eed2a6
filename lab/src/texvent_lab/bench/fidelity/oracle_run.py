"""The oracle benchmark: simulators see 24 frames per second, and are judged by the true events."""

from __future__ import annotations

import dataclasses
import itertools
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.metrics.compare import load_metric
from texvent.view.video_writer import write_clips
from texvent_lab.bench.document import describe_environment
from texvent_lab.bench.fidelity.entries import Entry, choose_entries
from texvent_lab.bench.fidelity.event_files import FileEntry
from texvent_lab.bench.fidelity.results import FidelityReport, Reference, Score
from texvent_lab.bench.fidelity.run import (
    NULL,
    check_names,
    measure_bounds,
    score_entries,
    score_recorded,
)
from texvent_lab.bench.jobs import Progress, no_progress, run_jobs
from texvent_lab.bench.oracle.pixel import (
    FLOOR_SEED,
    OTHER_SEED,
    OTHER_SENSOR_SEED,
    REFERENCE_SEED,
    SENSOR_SEED,
    TARGETS,
)
from texvent_lab.bench.oracle.recording import (
    LAST_US,
    SIZE,
    oracle_scene,
    record,
    render_video,
)
from texvent_lab.bench.oracle.scenes import check_scene, scene_names
from texvent_lab.bench.perturbations import perturb

OTHER_SENSOR = "another sensor of the kind"
"""Row of a recording by a sensor with the same constants and other pixels: a simulator that knows
the kind of the sensor, but not each pixel, gets no closer."""


@dataclass(frozen=True, kw_only=True)
class FidelityPlan:
    """Scenes, pixels, seeds, metrics and entries of a run.

    Raises:
        ConfigError: an unknown scene, target or metric, or no seed to fit or to score.
    """

    scenes: Sequence[str] = ("mixed", "translate", "fast", "slow")
    targets: Sequence[str] = ("noisy",)
    fit_seeds: Sequence[int] = (7,)
    """Textures on which δ is fitted."""
    score_seeds: Sequence[int] = (21, 33, 54, 68, 85, 97)
    """Textures on which the entries are scored with that δ; six and more can tell entries apart."""
    metrics: Sequence[str] = ("stpp", "van_rossum", "nearest", "ef_mse", "count_ratio")
    entries: Sequence[Entry] = ()
    """Simulators and interpolators; none means all that are registered."""

    def __post_init__(self) -> None:
        for scene in self.scenes:
            check_scene(scene)
        for metric in self.metrics:
            load_metric(metric)
        for seed in (*self.fit_seeds, *self.score_seeds):
            check_range("seed", seed, 0, 2**63 - 1)
        unknown = set(self.targets) - set(TARGETS)
        if unknown or not self.fit_seeds or not self.score_seeds:
            raise ConfigError(
                f"targets {list(self.targets)}, fit seeds {list(self.fit_seeds)}, score seeds "
                f"{list(self.score_seeds)}: targets are {', '.join(TARGETS)}, seeds at least one"
            )

    @property
    def clips(self) -> list[tuple[str, int]]:
        """(scene, texture) of every video."""
        return list(
            itertools.product(self.scenes, dict.fromkeys((*self.fit_seeds, *self.score_seeds)))
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
class OracleTruth:
    """True recordings of one scene by one kind of pixels; see `Truth`."""

    scene: str
    target: str
    fit: Mapping[int, EventStream]
    """Texture seed → recording to which δ is fitted."""
    scored: Mapping[int, EventStream]
    """Texture seed → recording that is scored."""

    @property
    def references(self) -> list[EventStream]:
        """See `Truth`."""
        return list(self.scored.values())

    @property
    def fit_count(self) -> int:
        """See `Truth`."""
        return sum(map(len, self.fit.values()))

    def count(self, entry: Entry, threshold: float | None) -> int:
        """See `Truth`."""
        return sum(len(self._simulate(entry, seed, threshold)) for seed in self.fit)

    def simulate(self, entry: Entry, threshold: float | None) -> list[EventStream]:
        """See `Truth`."""
        return [self._simulate(entry, seed, threshold) for seed in self.scored]

    def _simulate(self, entry: Entry, seed: int, threshold: float | None) -> EventStream:
        if isinstance(entry, FileEntry):
            span_us, clip = (0, LAST_US + 1), clip_name(self.scene, seed)
            return entry.packets(clip, SIZE, span_us, threshold).collect()
        return entry.simulate(oracle_scene(self.scene, seed), seed, threshold)


def clip_name(scene: str, seed: int) -> str:
    """Name of the frames of a scene with one texture, and of the files of their events."""
    return f"{scene}-{seed}"


def write_frames(plan: FidelityPlan, folder: Path, *, overwrite: bool) -> None:
    """The frames that simulators get, for programs that are not texvent's simulators.

    Args:
        plan: scenes and textures, those to fit and those to score.
        folder: gets a folder per scene and texture: `mixed-7` and so on, of 8-bit PNG files with
            their times in timestamps.txt, s.
        overwrite: whether a folder of such folders may be replaced.

    Raises:
        OutputError: the folder holds something else, or cannot be written.
    """
    rendered = ((clip_name(*pair), render_video(oracle_scene(*pair))) for pair in plan.clips)
    write_clips(rendered, folder, overwrite=overwrite)


def run_fidelity(
    plan: FidelityPlan, *, jobs: int = 1, progress: Progress = no_progress
) -> FidelityReport:
    """Run the benchmark.

    Args:
        plan: what it covers.
        jobs: processes to use; 1 stays in this one.
        progress: told of every step.

    Raises:
        ConfigError: the plan names something that does not exist or twice, or jobs is below 1.
        InputError, FileFormatError: events of another program are damaged, or not of these frames.
    """
    check_range("jobs", jobs, 1)
    start = time.perf_counter()
    entries = list(plan.entries) or choose_entries()
    check_names(entries)
    spans_us = {clip_name(*pair): (0, LAST_US) for pair in plan.clips}
    for entry in entries:
        entry.settings(0)
        if isinstance(entry, FileEntry):
            entry.check(SIZE, spans_us)
    found: list[tuple[OracleTruth, Reference, Score]] = []
    for several in run_jobs(record_truths, [(plan, scene) for scene in plan.scenes], jobs):
        found += several
        progress(f"recorded {several[0][0].scene}")
    truths, references, others = zip(*found, strict=True)
    scores, skipped = score_entries(truths, entries, plan.metrics, jobs=jobs, progress=progress)
    return FidelityReport(
        environment=describe_environment(),
        fit_seeds=list(plan.fit_seeds),
        score_seeds=list(plan.score_seeds),
        references=references,
        scores=[*scores, *others],
        skipped=skipped,
        seconds=time.perf_counter() - start,
    )


def record_truths(plan: FidelityPlan, scene: str) -> list[tuple[OracleTruth, Reference, Score]]:
    """The true recordings of one scene by each kind of pixels.

    Args:
        plan: which pixels, seeds and metrics.
        scene: name of the scene.

    Returns:
        With floor and null, and the score of another sensor of the kind.
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
        fit, scored = (
            {seed: recordings[seed][target, REFERENCE_SEED] for seed in seeds}
            for seeds in (plan.fit_seeds, plan.score_seeds)
        )
        truth = OracleTruth(scene=scene, target=target, fit=fit, scored=scored)
        floors, others = (
            [recordings[seed][target, noise] for seed in plan.score_seeds]
            for noise in (FLOOR_SEED, OTHER_SEED)
        )
        nulls = [perturb(events, NULL) for events in truth.references]
        bounds = measure_bounds(truth, floors, nulls, plan.metrics)
        found.append((truth, bounds, score_recorded(truth, OTHER_SENSOR, others, plan.metrics)))
    return found

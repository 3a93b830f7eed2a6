"""Networks trained on simulated events of objects, tested on recorded ones: all steps.

Frames, windows and predictions are files in the plan's folder, named after all that they depend on,
so that a run that was stopped goes on.
"""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent import __version__
from texvent.config import check_choices, check_range
from texvent.dataset.specification.items import Item, read_items
from texvent.dataset.specification.reading import read_specification
from texvent.dataset.specification.specification import Specification
from texvent.errors import ConfigError, InputError, shown, warnings_to
from texvent.extending import require, suggest
from texvent.runtime.files.cache_folder import make_folder
from texvent_lab.bench.detection.run import with_count
from texvent_lab.bench.digits.training import Precision, predict, train_network
from texvent_lab.bench.document import describe_environment
from texvent_lab.bench.jobs import Progress, no_progress
from texvent_lab.bench.kept_results import digest_of, make_missing, write_arrays
from texvent_lab.bench.objects.arms import Arm, Test, read_factors, with_folder
from texvent_lab.bench.objects.clips import PILOT, make_windows, match_threshold, render_clip
from texvent_lab.bench.objects.recorded import (
    TABLE_CLASSES,
    TURNTABLE_FILES,
    Frames,
    in_cells,
    read_table,
    read_turntables,
)
from texvent_lab.bench.objects.results import (
    RECORDED,
    REFERENCE,
    ObjectsReport,
    WindowSet,
    score_all,
)
from texvent_lab.train.schedule import EXTRA, Schedule

PROTOCOL = 2
"""Part of every file's name: raise it when a step computes something else from the same plan."""
CLASSES: Mapping[Test, tuple[str, ...]] = {
    "table": TABLE_CLASSES,
    "turntable": tuple(TURNTABLE_FILES),
}
SCHEDULE = Schedule(batch_size=32, learning_rate=2e-3, clip_gradient=10.0)
FOLDS = 2
"""Halves of the recorded windows, by time; a ceiling is trained on one and tested on the other."""


@dataclass(frozen=True, kw_only=True)
class ObjectsPlan:
    """Clips that are simulated, networks that are trained on them, recordings that test them.

    Raises:
        ConfigError: an unknown arm or class, or a value out of range.
    """

    configs: Path
    """Folder of the specifications table.toml and turntable.toml; their variants are the arms."""
    frames: Path
    """Labelled frames; see `read_table`."""
    turntables: Path
    """Folder of recordings; see `read_turntables`."""
    work: Path
    """Folder that keeps what was made."""
    arms: tuple[str, ...] = ()
    """Variants to train on, each for the tests that have it; none: all."""
    factors: Path | None = None
    """File of arms that differ from one in a property, in place of those; see `read_factors`."""
    clips: int | None = None
    """Clips of each test; None: as many as the specifications say."""
    steps: int = 600
    """Batches of every training."""
    seeds: int = 3
    """Networks per arm and test, and per half of the recorded windows."""
    spread: float = 0.0
    """Standard deviation of the logarithm of the contrast threshold between clips."""
    schedule: Schedule = SCHEDULE
    precision: Precision = "float32"
    """Number type of the networks' computation."""

    def __post_init__(self) -> None:
        check_range("clips", self.clips, 1)
        check_range("steps", self.steps, 1, 1_000_000)
        check_range("seeds", self.seeds, 1, 1000)
        check_range("spread", self.spread, 0.0, 2.0)
        check_choices(self)
        for test, classes in CLASSES.items():
            labels = set(read_items(self.specifications[test]).labels)
            if other := labels - set(classes):
                raise ConfigError(
                    f"{test}.toml has other classes than the recordings: {', '.join(sorted(other))}"
                    f"; label clips {', '.join(classes)}"
                )

    @cached_property
    def specifications(self) -> dict[Test, Specification]:
        """Test → what is simulated for it."""
        found = {}
        for test in CLASSES:
            one = with_count(read_specification(self.configs / f"{test}.toml"), self.clips)
            options = with_folder(one.options, self.configs)
            found[test] = dataclasses.replace(one, options=options)
        return found

    @cached_property
    def sets(self) -> Mapping[Test, Mapping[str, Arm]]:
        """Test → its arms, by name."""
        found: dict[Test, dict[str, Arm]] = {
            test: {
                variant.name: Arm(one, variant.options, spread=self.spread)
                for variant in one.variants
            }
            for test, one in self.specifications.items()
        }
        every = read_factors(self.factors, found) if self.factors else found
        self._check_arms({name for of_test in every.values() for name in of_test})
        return {
            test: {name: of_test[name] for name in self.arms or of_test if name in of_test}
            for test, of_test in every.items()
        }

    def _check_arms(self, names: set[str]) -> None:
        for arm in self.arms:
            if arm not in names:
                raise ConfigError(f"unknown arm {shown(arm)}; {suggest(arm, tuple(sorted(names)))}")

    @property
    def reference(self) -> str:
        """Arm that the others are compared with."""
        names = [name for of_test in self.sets.values() for name in of_test]
        return names[0] if self.factors else REFERENCE


@dataclass(frozen=True)
class Training:
    """One network: of an arm, or of the half of the recorded windows that is not tested."""

    test: Test
    arm: str | None
    seed: int
    fold: int = 0


@dataclass(frozen=True)
class Run:
    """A plan and the recorded windows."""

    plan: ObjectsPlan
    recorded: Mapping[Test, Frames]

    def path(self, kind: str, *facts: Any) -> Path:
        """File of a result that depends on plain values."""
        name = digest_of(__version__, PROTOCOL, kind, *facts)
        return self.plan.work / f"{kind}-{name}.npz"

    def frames_path(self, arm: Arm, item: Item) -> Path:
        """Rendered frames of a clip."""
        options = {n: one for n, one in arm.specification.options.items() if n != "assets"}
        return self.path("frames", item.key, options, arm.looks)

    def windows_path(self, test: Test, name: str) -> Path:
        """Windows of an arm."""
        arm = self.plan.sets[test][name]
        frames = [self.frames_path(arm, one).stem for one in arm.items]
        facts = (dict(arm.options), self.target(test), arm.threshold, arm.spread)
        return self.path("windows", frames, *facts)

    def prediction_path(self, one: Training) -> Path:
        """Predictions of a network."""
        plan = self.plan
        seen = one.fold if one.arm is None else self.windows_path(one.test, one.arm).stem
        digest = digest_of(self.recorded[one.test].images.tobytes())
        rate = plan.schedule.learning_rate
        facts = (seen, digest, one.test, one.seed, plan.steps, plan.schedule.batch_size, rate)
        return self.path("predicted", *facts, plan.precision)

    def target(self, test: Test) -> float:
        """Share of pixels with an event in a recorded window, to 4 digits."""
        return round(float((self.recorded[test].images != 0).mean()), 4)

    def half(self, test: Test, fold: int) -> NDArray[np.bool_]:
        """Windows of a half: of the poses of the arm, or of each recording."""
        frames = self.recorded[test]
        if test == "table":
            places = frames.groups - frames.groups.min()
        else:
            places = np.concatenate([np.arange(n) for n in np.bincount(frames.groups)])
        length = np.array([places[frames.classes == kind].max() + 1 for kind in frames.classes])
        return np.asarray((places * FOLDS // length) == fold)

    def trainings(self, test: Test, arm: str | None) -> list[Training]:
        """Networks of an arm, or of the recorded windows."""
        folds = range(FOLDS) if arm is None else range(1)
        return [Training(test, arm, seed, f) for seed in range(self.plan.seeds) for f in folds]


def run_objects(
    plan: ObjectsPlan, *, jobs: int = 1, progress: Progress = no_progress
) -> ObjectsReport:
    """Render, simulate, train and test what was not before.

    Args:
        plan: see `ObjectsPlan`.
        jobs: processes to use.
        progress: told of every step.

    Raises:
        MissingDependencyError: torch or pycocotools is not installed.
        InputError, FileFormatError: the recordings are missing or of another layout.
        ConfigError: jobs is below 1.
    """
    start = time.perf_counter()
    check_range("jobs", jobs, 1)
    require("torch", extra=EXTRA)
    require("pycocotools.cocoeval", extra="texvent-lab[detection]")
    run = Run(
        plan, {"table": read_table(plan.frames), "turntable": read_turntables(plan.turntables)}
    )
    make_folder(plan.work)
    tests: Sequence[Test] = list(CLASSES)
    clips = {
        run.frames_path(arm, one): (arm, one)
        for test in tests
        for arm in plan.sets[test].values()
        for one in arm.items
    }
    todo = list(clips.values())
    make_missing(render, run, todo, run.frames_path, jobs=jobs, progress=progress)
    sets = [(test, name) for test in tests for name in plan.sets[test]]
    make_missing(simulate, run, sets, run.windows_path, jobs=jobs, progress=progress)
    # Seed by seed: a run that is stopped has whole rounds.
    networks = sorted(
        (
            (one,)
            for test in tests
            for arm in (*plan.sets[test], None)
            for one in run.trainings(test, arm)
        ),
        key=lambda key: key[0].seed,
    )
    make_missing(train, run, networks, run.prediction_path, jobs=jobs, progress=progress)
    progress("scores")
    return ObjectsReport(
        environment=describe_environment(),
        protocol=_protocol(run),
        **{
            test: score_all(
                run.recorded[test], CLASSES[test], *_found(run, test), reference=plan.reference
            )
            for test in tests
        },
        reference=plan.reference,
        seconds=time.perf_counter() - start,
    )


def render(run: Run, arm: Arm, item: Item) -> str:
    """Render a clip."""
    with warnings_to(_leave_out):  # of objects out of view, which windows leave out too
        return render_clip(item, arm.specification.options, run.frames_path(arm, item))


def _leave_out(warning: str) -> None:
    del warning


def simulate(run: Run, test: Test, name: str) -> str:
    """Make the windows of an arm, with the threshold that gives the recorded share."""
    arm = run.plan.sets[test][name]
    paths = [run.frames_path(arm, one) for one in arm.items]
    with warnings_to(_leave_out):  # of clips at rest
        threshold = arm.threshold[0] if len(arm.threshold) == 1 else None
        if not arm.threshold:
            threshold, _ = match_threshold(paths[:PILOT], arm.options, run.target(test))
        numbers = [CLASSES[test].index(one.label or "") for one in arm.items]
        thresholds = [arm.threshold_of(one.stem, threshold) for one in paths]
        frames, events = make_windows(paths, numbers, arm.options, thresholds)
    if test == "table":
        frames = frames.select(np.isfinite(frames.boxes[:, 0]))
    facts = {"threshold": np.nan if threshold is None else threshold, "events": events}
    write_arrays(run.windows_path(test, name), **vars(frames), **facts)
    share = float((frames.images != 0).mean())
    return (
        f"{test}, {name}: threshold {threshold}, {share:.3f} of pixels, {len(frames.images)} "
        "windows"
    )


def train(run: Run, one: Training) -> str:
    """Train a network, and keep its predictions of the recorded windows, or of their other half."""
    recorded, test = run.recorded[one.test], np.ones(len(run.recorded[one.test].images), np.bool_)
    if one.arm is None:
        test = run.half(one.test, one.fold)
        learned = recorded.select(~test)
    else:
        learned = read_windows(run.windows_path(one.test, one.arm))
    if not len(learned.images):
        raise InputError(f"{one.test}, {one.arm or RECORDED}: there are no windows to learn from")
    plan, started = run.plan, time.perf_counter()
    found: NDArray[Any]
    options: dict[str, Any] = {"steps": plan.steps, "schedule": plan.schedule, "seed": one.seed}
    options["precision"] = plan.precision
    if one.test == "table":
        from texvent_lab.bench.objects.locator import locate, train_locator  # imports torch

        network = train_locator(learned, len(TABLE_CLASSES), **options)
        found = locate(network, recorded.images[test], len(TABLE_CLASSES))
        found["t"] = np.flatnonzero(test)[found["t"]]
    else:
        images = np.concatenate([in_cells(learned.images), in_cells(learned.images[:, :, ::-1])])
        network = train_network(images, np.tile(learned.classes, 2), **options)
        found = predict(network, in_cells(recorded.images[test]))
    write_arrays(run.prediction_path(one), found=found, numbers=np.flatnonzero(test))
    seconds = time.perf_counter() - started
    return f"{one.test}, {one.arm or 'recorded'}, seed {one.seed}: {seconds:.0f} s"


def read_windows(path: Path) -> Frames:
    """The windows of an arm."""
    with np.load(path) as file:
        return Frames(*(file[name] for name in ("images", "classes", "boxes", "groups")))


def _found(
    run: Run, test: Test
) -> tuple[dict[str, WindowSet], dict[str | None, list[NDArray[Any]]]]:
    """Sets of windows, and predictions per seed in the order of the recorded windows, by arm."""
    sets, found = {}, {}
    for arm in (*run.plan.sets[test], None):
        if arm is not None:
            path = run.windows_path(test, arm)
            with np.load(path) as file:
                threshold, events = float(file["threshold"]), int(file["events"])
            images = read_windows(path).images
            sets[arm] = WindowSet(
                threshold if math.isfinite(threshold) else None,
                events,
                len(images),
                float((images != 0).mean()),
            )
        per_seed: dict[int, list[Any]] = {}
        for one in run.trainings(test, arm):
            with np.load(run.prediction_path(one)) as file:
                per_seed.setdefault(one.seed, []).append((file["numbers"], file["found"]))
        found[arm] = [_joined(parts, test) for parts in per_seed.values()]
    return sets, found


def _joined(parts: list[tuple[NDArray[np.int64], NDArray[Any]]], test: Test) -> NDArray[Any]:
    numbers, found = (np.concatenate(one) for one in zip(*parts, strict=True))
    return found if test == "table" else found[np.argsort(numbers)]


def _protocol(run: Run) -> dict[str, Any]:
    plan = run.plan
    return {
        "clips": {test: len(read_items(one).all) for test, one in plan.specifications.items()},
        "steps of training": plan.steps,
        "batch size": plan.schedule.batch_size,
        "precision": plan.precision,
        "networks per arm": plan.seeds,
        "spread of thresholds": plan.spread,
        "recorded share of pixels with an event": {test: run.target(test) for test in CLASSES},
        "arms": {
            name: dict(arm.options)
            for test in ("turntable", "table")
            for name, arm in plan.sets[test].items()
        },
    }

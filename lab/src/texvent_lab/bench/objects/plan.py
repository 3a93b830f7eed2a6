"""Plan of the benchmark of objects: clips, arms, networks, files that results are kept in."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
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
from texvent.errors import ConfigError, shown
from texvent.extending import suggest
from texvent.frames import MICROSECONDS
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent_lab.bench.clip_counts import with_count
from texvent_lab.bench.digits.training import Precision
from texvent_lab.bench.fidelity.event_files import FileEntry
from texvent_lab.bench.kept_results import digest_of
from texvent_lab.bench.objects.arms import Arm, Test, clip_name, read_factors, with_folder
from texvent_lab.bench.objects.recorded import (
    SIDE,
    TABLE_CLASSES,
    TURNTABLE_FILES,
    Frames,
)
from texvent_lab.bench.objects.results import REFERENCE
from texvent_lab.train.schedule import Schedule

PROTOCOL = 3
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
    events: Mapping[str, Path] = field(default_factory=dict)
    """Arm → folder of the events that another program made of the frames of `write_frames`."""
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
        clips = tuple(self.clip_names) if self.events else ()
        others = {name: FileEntry.find(name, one, clips) for name, one in self.events.items()}
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
            | {name: Arm(self.specifications[test], {}, events=one) for name, one in others.items()}
            for test, of_test in every.items()
        }

    @property
    def clip_names(self) -> dict[str, tuple[Test, Item]]:
        """Name → a clip of the specifications."""
        every = ((test, Arm(one, {}).items) for test, one in self.specifications.items())
        return {clip_name(test, one): (test, one) for test, items in every for one in items}

    def _check_arms(self, names: set[str]) -> None:
        for arm in self.arms:
            if arm not in names:
                raise ConfigError(f"unknown arm {shown(arm)}; {suggest(arm, tuple(sorted(names)))}")

    def duration_us(self, test: Test) -> int:
        """Time of the last frame of every clip, µs."""
        source: Any = resolve("generate", self.specifications[test].options).source
        return round(float(source.duration) * MICROSECONDS)

    def check_events(self) -> None:
        """Read the files of other programs, which may hold nothing but events of the clips.

        Raises:
            InputError, FileFormatError: a file is missing, damaged, of another size or clock.
        """
        for test, arms in self.sets.items():
            names = [name for name, (kind, _) in self.clip_names.items() if kind == test]
            for arm in arms.values():
                if arm.events is not None:
                    span_us = (0, self.duration_us(test))
                    arm.events.check(SensorSize(SIDE, SIDE), dict.fromkeys(names, span_us))

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
        facts: list[Any] = [dict(arm.options), self.target(test), arm.threshold, arm.spread]
        if arm.times != "exact":
            facts.append(arm.times)
        if arm.stream:
            facts.append(["stream", arm.stream])
        if arm.events is not None:
            facts.append(arm.events.digest)
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

"""What a run of the benchmark covers, and the names of its steps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_choices, check_range
from texvent.errors import ConfigError, shown
from texvent.extending import suggest
from texvent.settings.resolution import Settings
from texvent_lab.bench.digits.arms import CHOICES, WAYS, Arm, Cell, Choice, Step, Way, find_arm
from texvent_lab.bench.digits.inputs import REPRESENTATIONS, InputSet
from texvent_lab.bench.digits.pair_fit import COORDINATES
from texvent_lab.train.schedule import Schedule

ALL_DIGITS = 10_000
"""MNIST's test images."""
SCHEDULE = Schedule(epochs=12, batch_size=64, learning_rate=1e-2)
SHOT_REPRESENTATION = "histogram"
"""Of the networks that see a few recordings."""
SHOT_ARMS = (
    "texvent accurate",
    "texvent paper",
    "physical",
    "esim",
    "v2e",
    "v2e noisy",
    "voltmeter",
    "senpi",
    "frame difference",
)


@dataclass(frozen=True, kw_only=True)
class DigitsPlan:
    """What is simulated, trained and tested.

    Raises:
        ConfigError: an unknown arm, or a value out of range.
    """

    mnist: Path
    """Folder of MNIST's test files."""
    nmnist: Path
    """Recordings; see `read_recordings`."""
    work: Path
    """Folder that keeps the results of steps."""
    arms: tuple[str, ...]
    ways: tuple[Way, ...] = ("exact", "flow")
    """For arms that take frames alone, the way is always "frames"."""
    choices: tuple[Choice, ...] = CHOICES
    digits: int = 2000
    """Simulated for training."""
    held_out: int = 500
    """Further ones, for testing on simulated events."""
    recorded: int = 500
    """Recordings that are tested on: numbers 1 and up."""
    pairs: int = 100
    """Recordings 60001 and up, which show MNIST's test images 1 and up: for fitting alone."""
    seeds: int = 3
    """Networks per set with matched thresholds."""
    other_seeds: int = 2
    """Networks per set with others, and per fold."""
    representations: tuple[str, ...] = tuple(REPRESENTATIONS)
    folds: int = 10
    """Of the networks that are trained on recordings."""
    shots: tuple[int, ...] = (1, 3, 10, 30)
    """Recordings per class that are added to simulated ones; none: that part is left out."""
    shot_arms: tuple[str, ...] = SHOT_ARMS
    """Arms whose sets they are added to, those that are in `arms`."""
    schedule: Schedule = SCHEDULE
    """Its learning rate falls to 0 in a straight line."""
    precision: Literal["float32", "bfloat16"] = "float32"
    """Number type of the networks' computation."""

    def __post_init__(self) -> None:
        check_choices(self)
        _check_names("way", self.ways, WAYS)
        _check_names("choice", self.choices, CHOICES)
        _check_names("representation", self.representations, tuple(REPRESENTATIONS))
        check_range("digits", self.digits, 10, ALL_DIGITS - self.pairs - self.held_out)
        check_range("seeds", self.seeds, 1, 1000)
        check_range("other_seeds", self.other_seeds, 1, 1000)
        if not self.cells:
            raise ConfigError("there is nothing to simulate; name an arm, a way and a choice")

    @property
    def cells(self) -> list[Cell]:
        """The sets, the most telling first."""
        ways: tuple[Way, ...] = (*self.ways, "frames")
        return [
            Cell(name, way, choice)
            for choice in self.choices
            for way in ways
            for name in self.arms
            if _is_run(find_arm(name), way, choice)
        ]

    def seeds_of(self, cell: Cell) -> int:
        """Networks of a set."""
        return self.seeds if cell.choice == "matched" else self.other_seeds

    @property
    def steps(self) -> int:
        """Batches of every training."""
        return self.schedule.epochs * -(-self.digits // self.schedule.batch_size)

    @property
    def numbers(self) -> NDArray[np.int64]:
        """Images that are simulated for training, from 1."""
        return self.pairs + 1 + np.arange(self.digits)

    @property
    def held_out_numbers(self) -> NDArray[np.int64]:
        """Images that are simulated for testing, from 1."""
        return ALL_DIGITS + 1 - self.held_out + np.arange(self.held_out)


@dataclass(frozen=True)
class Training:
    """One network."""

    cell: Cell | None
    """Simulated recordings that it sees; None: none."""
    representation: str
    seed: int
    shots: int = 0
    """Recordings per class that it sees too."""
    fold: int | None = None
    """Without a cell and shots: it sees all recordings but those of this fold; None: all."""

    @property
    def name(self) -> str:
        """How progress calls it."""
        source = self.cell.name if self.cell else "recordings"
        more = f", {self.shots} shots" if self.shots else ""
        fold = "" if self.fold is None else f", fold {self.fold + 1}"
        return f"{source}, {self.representation}{more}{fold}, seed {self.seed}"


def _check_names(kind: str, names: tuple[str, ...], allowed: tuple[str, ...]) -> None:
    for name in names:
        if name not in allowed:
            raise ConfigError(f"unknown {kind} {shown(name)}; {suggest(name, allowed)}")


def _is_run(arm: Arm, way: Way, choice: Choice) -> bool:
    """Interpolated frames are compared with matched thresholds alone."""
    is_compared = way != "flow" or choice == "matched"
    return is_compared and way in arm.ways and choice in arm.choices


def list_trainings(plan: DigitsPlan) -> list[Training]:
    """All networks of a plan, the most telling first."""
    kinds = plan.representations
    found = [
        Training(cell, kind, seed)
        for seed in range(max(plan.seeds, plan.other_seeds))
        for cell in plan.cells
        if seed < plan.seeds_of(cell)
        for kind in kinds
    ]
    found += [
        Training(None, kind, seed, fold=fold)
        for seed in range(plan.other_seeds)
        for fold in range(plan.folds)
        for kind in kinds
    ]
    found += [Training(None, kind, seed) for seed in range(plan.other_seeds) for kind in kinds]
    return [*found, *few_shot_trainings(plan)]


def few_shot_trainings(plan: DigitsPlan) -> list[Training]:
    """Networks that see a few recordings, with and without simulated ones."""
    return [
        Training(cell, SHOT_REPRESENTATION, seed, shots=shots)
        for seed in range(plan.seeds)
        for shots in plan.shots
        for cell in (None, *shot_cells(plan))
    ]


def shot_cells(plan: DigitsPlan) -> list[Cell]:
    """Sets to which recordings are added: of true frames where there are, matched if there are."""
    found: dict[str, Cell] = {}
    for cell in plan.cells:
        if cell.arm in plan.shot_arms:
            found.setdefault(cell.arm, cell)
    return list(found.values())


@dataclass(frozen=True)
class Run:
    """A plan, and what was found of its data; small, so that processes can be given it."""

    plan: DigitsPlan
    mnist: str
    """Digest of the images and labels."""
    recorded: str
    """Digest of the recordings that are tested on."""
    pairs: str
    """Digest of the recordings that are fitted to."""
    target: float
    """Events that the pair in the middle has."""
    polarity: float
    """See `polarity_agreement`, of the pairs."""

    def settings(self, cell: Cell, *, threshold: float | None = None) -> Settings:
        """Options of a simulation of an arm; see `Arm.settings`."""
        arm = find_arm(cell.arm)
        fitted = self.pair_fit_step().read()["options"] if arm.is_fitted else {}
        return arm.settings(cell.way, threshold=threshold, fitted=fitted)

    def pair_fit_step(self) -> Step:
        """Options of the physical model that are fitted to the pairs."""
        config = {"searched": COORDINATES, "pairs": self.pairs, "mnist": self.mnist}
        return Step(self.plan.work, "pair_fits", config)

    def recordings(self) -> InputSet:
        """Recordings that are tested on."""
        return InputSet.read(recorded_step(self.plan, self.recorded).path(".npz"))

    def fit_step(self, cell: Cell) -> Step:
        """The threshold at which an arm has as many events as the pairs."""
        settings = self.settings(cell)
        config = {
            "settings": settings_tables(settings),
            "pairs": self.plan.pairs,
            "target": self.target,
            "mnist": self.mnist,
        }
        return Step(self.plan.work, "thresholds", config)

    def threshold(self, cell: Cell) -> float | None:
        """Of a set; None: the preset's own, or one that is drawn."""
        return self.fit_step(cell).read()["threshold"] if cell.choice == "matched" else None

    def set_step(self, cell: Cell) -> Step:
        """The simulated recordings of a set."""
        plan = self.plan
        settings = self.settings(cell, threshold=self.threshold(cell))
        config = {
            "settings": settings_tables(settings),
            "is_random": cell.choice == "random",
            "numbers": [plan.pairs + 1, plan.digits, plan.held_out],
            "mnist": self.mnist,
        }
        return Step(plan.work, "sets", config)

    def training_step(self, training: Training) -> Step:
        """The predictions of a network."""
        plan = self.plan
        config: dict[str, Any] = {
            "set": self.set_step(training.cell).digest if training.cell else None,
            "recorded": self.recorded,
            "representation": training.representation,
            "seed": training.seed,
            "shots": training.shots,
            "most_shots": max(plan.shots, default=0) if training.shots else 0,
            "fold": training.fold,
            "folds": plan.folds if training.fold is not None else None,
            "steps": plan.steps,
            "batch_size": plan.schedule.batch_size,
            "learning_rate": plan.schedule.learning_rate,
            "precision": plan.precision,
        }
        if training.cell is None and training.fold is None and not training.shots:
            config["judged"] = [self.set_step(cell).digest for cell in plan.cells]
        return Step(plan.work, "networks", config)


def recorded_step(plan: DigitsPlan, digest: str) -> Step:
    """The images of recordings."""
    config = {"recorded": digest, "representations": sorted(REPRESENTATIONS)}
    return Step(plan.work, "recordings", config)


def settings_tables(settings: Settings) -> Mapping[str, Any]:
    """Options of a run as plain values."""
    tables: Mapping[str, Any] = settings.as_tables()
    return tables

"""Plan of a run: pixel models, the frames that they get, digits, and networks."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_choices, check_range
from texvent.errors import ConfigError, shown
from texvent.extending import suggest
from texvent.settings.resolution import Settings, resolve
from texvent.simulation.model_options import with_contrast_threshold
from texvent_lab.bench.digits.inputs import REPRESENTATIONS
from texvent_lab.bench.digits.sheet import MEASURED, WIDE, Stimulus
from texvent_lab.train.schedule import Schedule

Way: TypeAlias = Literal["exact", "flow", "frames"]
"""Frames of a model: true ones, 1,020 per second; 60 per second and those that the pipeline
interpolates between them; or those 60 alone."""
WAYS: tuple[Way, ...] = get_args(Way)
SCHEDULE = Schedule(epochs=12, batch_size=64, learning_rate=1e-2)
BETWEEN = 16
"""True frames between two of the display."""
WAY_OPTIONS: Mapping[Way, Mapping[str, Any]] = {
    "exact": {"interpolate": "exact", "fixed_count": BETWEEN},
    "flow": {"interpolate": "flow"},
    "frames": {"interpolate": "none"},
}


@dataclass(frozen=True)
class DigitsArm:
    """A pixel model with options."""

    name: str
    options: Mapping[str, Any]
    ways: tuple[Way, ...] = ("exact", "flow")
    stimulus: Stimulus = WIDE
    threshold_range: float = 1.0
    """Highest threshold over the lowest: each part of a set draws its own about the fitted one,
    evenly on a logarithmic scale. 1 is one threshold for all."""
    stream: str = ""
    """Draws of a training stream, by name, for each part of a set in place of the model's."""
    stream_threshold: tuple[float, float] | None = None
    """Thresholds that the stream draws between, log units; None: its own."""

    @property
    def part(self) -> int:
        """Digits that share the draws of their pixels."""
        return SHEET if self.threshold_range == 1.0 and not self.stream else PART

    def settings(self, way: Way, *, threshold: float | None = None) -> Settings:
        """Options of a run.

        Args:
            way: frames of the model.
            threshold: contrast threshold, log units; None leaves the one of the options.
        """
        settings = resolve("simulate", {**self.options, **WAY_OPTIONS[way]})
        if threshold is None:
            return settings
        simulate = with_contrast_threshold(settings.simulate, threshold)
        return dataclasses.replace(settings, simulate=simulate)

    def threshold_of(self, number: int, fitted: float) -> float:
        """Contrast threshold of the part of a set whose first image has this number."""
        if self.threshold_range == 1.0:
            return fitted
        part = np.random.default_rng((THRESHOLD_KEY, number)).random() - 0.5
        return fitted * math.exp(part * math.log(self.threshold_range))


SHEET = 100
"""Digits per sheet."""
PART = 20
"""Digits per sheet where thresholds are drawn."""
THRESHOLD_KEY = 0x7E57
"""Keeps the draws of thresholds apart from those of motion."""
_PAPER = {"simulator": "texvent", "preset": "paper"}
ARMS: tuple[DigitsArm, ...] = (
    DigitsArm("texvent accurate", {"simulator": "texvent", "preset": "accurate"}),
    DigitsArm("texvent paper", _PAPER),
    DigitsArm("physical", {"simulator": "physical"}),
    DigitsArm("esim", {"simulator": "esim"}),
    DigitsArm("v2e", {"simulator": "v2e"}),
    DigitsArm("v2e noisy", {"simulator": "v2e", "preset": "noisy"}),
    DigitsArm("voltmeter", {"simulator": "voltmeter"}),
    DigitsArm("senpi", {"simulator": "senpi"}),
    DigitsArm("E1: no balance", {**_PAPER, "balance": 0.001}),
    DigitsArm("E4: no cache", {**_PAPER, "cache": "none"}),
    DigitsArm("E9: no noise", {**_PAPER, "noise": "none"}),
    DigitsArm("E12: random times", {**_PAPER, "timestamp_rule": "random"}),
    DigitsArm("E6: no interpolation", _PAPER, ways=("frames",)),
    DigitsArm(
        "frame difference",
        {**_PAPER, "cache": "none", "noise": "none", "timestamp_rule": "end"},
        ways=("frames",),
    ),
)
"""E1 .. E12 are the paper's ablations (docs/ablations.md). The frame difference is the simplest
model: an event where ln(30 + I) of two frames differs by the threshold, at the later frame."""
_ACCURATE = {"simulator": "texvent", "preset": "accurate"}
_NOISY = {**_ACCURATE, "noise": "random", "noise_rate_hz": 0.25, "noise_on_fraction": 0.05}
_QUIET = {**_ACCURATE, "noise": "none"}
_FRAME_TIMES = {"timestamp_rule": "end"}
_CIRCUIT = {
    **{"simulator": "physical", "gamma": 1.0, "balance": 1.0, "cutoff_hz": 40.0},
    **{"initial_phase": "random"},
    **{"noise_curve": "0:0.25 255:0.25", "noise_scale": 1.0, "noise_on_fraction": 0.05},
}
ABLATION: tuple[DigitsArm, ...] = (
    DigitsArm("as measured", _NOISY, ("exact",), MEASURED),
    DigitsArm("latency of 40 Hz", _CIRCUIT, ("exact",), replace(MEASURED, lead_ms=4.0)),
    DigitsArm("wide motion", _NOISY, ("exact",), replace(WIDE, black=MEASURED.black, gamma=2.2)),
    DigitsArm("high contrast", _NOISY, ("exact",), replace(MEASURED, black=WIDE.black)),
    DigitsArm("display of gamma 1", _NOISY, ("exact",), replace(MEASURED, gamma=1.0)),
    DigitsArm("no noise", _QUIET, ("exact",), MEASURED),
    DigitsArm("wide thresholds", _NOISY, ("exact",), MEASURED, threshold_range=40.0),
    DigitsArm("frame times", {**_NOISY, **_FRAME_TIMES}, ("frames",), MEASURED),
    DigitsArm(
        "all but latency", {**_QUIET, **_FRAME_TIMES}, ("frames",), WIDE, threshold_range=40.0
    ),
    DigitsArm("recommended", {}, ("exact",), MEASURED, stream="recommended"),
    DigitsArm(
        "recommended about the matched threshold",
        {},
        ("exact",),
        MEASURED,
        stream="recommended",
        stream_threshold=(0.05, 0.15),
    ),
    DigitsArm("stream physical", {}, ("exact",), MEASURED, stream="physical"),
    DigitsArm("v2v", {}, ("exact",), MEASURED, stream="v2v"),
)
"""Display, motion and noise as on the pairs for fitting; then one property changed, then all; then
the training stream's draws, of which no threshold is fitted.
Nearly all noise of N-MNIST's sensor is OFF, .25 events per pixel and second, and its photoreceptors
follow brightness as a low-pass of 40 Hz at white does: both measured on the pairs."""


def find_arm(name: str) -> DigitsArm:
    """The arm called `name`.

    Raises:
        ConfigError: none is.
    """
    arms = {arm.name: arm for arm in (*ARMS, *ABLATION)}
    if name not in arms:
        raise ConfigError(f"unknown arm {shown(name)}; {suggest(name, tuple(arms), longest=600)}")
    return arms[name]


@dataclass(frozen=True)
class Cell:
    """One set of simulated recordings."""

    arm: str
    way: Way


@dataclass(frozen=True)
class DigitsTraining:
    """One network."""

    cell: Cell | None
    """Simulated recordings that it sees; None: recordings, but for those of a fold."""
    representation: str
    seed: int
    fold: int = 0

    @property
    def name(self) -> str:
        """Name in lines of progress."""
        source = f"{self.cell.arm}, {self.cell.way}" if self.cell else f"fold {self.fold + 1}"
        return f"{source}, {self.representation}, seed {self.seed}"


@dataclass(frozen=True, kw_only=True)
class DigitsPlan:
    """Digits that are simulated, networks that are trained on them, recordings that test them.

    Raises:
        ConfigError: an unknown arm or way, or a value out of range.
    """

    mnist: Path
    """Folder of MNIST's test files."""
    nmnist: Path
    """Recordings; see `read_recordings`."""
    work: Path
    """Folder that keeps sets and predictions."""
    arms: tuple[str, ...] = tuple(arm.name for arm in ARMS)
    ways: tuple[str, ...] = WAYS
    digits: int = 2000
    """Simulated for training."""
    recorded: int = 500
    """Recordings that are tested on: numbers 1 and up."""
    pairs: int = 100
    """Recordings 60001 and up, which show MNIST's test images 1 and up: for fitting alone."""
    seeds: int = 3
    """Networks per set, and per fold of recordings."""
    folds: int = 10
    """Folds of the networks that are trained on recordings."""
    schedule: Schedule = SCHEDULE
    """Its learning rate falls to 0 in a straight line."""
    precision: Literal["float32", "bfloat16"] = "float32"
    """Number type of the networks' computation."""

    def __post_init__(self) -> None:
        check_choices(self)
        for way in self.ways:
            if way not in WAYS:
                raise ConfigError(f"unknown way {shown(way)}; {suggest(way, WAYS)}")
        check_range("pairs", self.pairs, 1, 9990)
        check_range("digits", self.digits, 10, 10_000 - self.pairs)
        check_range("recorded", self.recorded, 1, 60_000)
        check_range("folds", self.folds, 2, self.recorded)
        check_range("seeds", self.seeds, 1, 1000)
        if not self.cells:
            raise ConfigError("there is nothing to simulate; name an arm and a way that it has")

    @property
    def cells(self) -> list[Cell]:
        """The sets."""
        return [
            Cell(name, way)
            for way in WAYS
            for name in self.arms
            if way in self.ways and way in find_arm(name).ways
        ]

    @property
    def steps(self) -> int:
        """Batches of every training."""
        return self.schedule.epochs * -(-self.digits // self.schedule.batch_size)

    @property
    def numbers(self) -> NDArray[np.int64]:
        """Images that are simulated for training, from 1."""
        return self.pairs + 1 + np.arange(self.digits)

    def trainings(self, cell: Cell, representation: str) -> list[DigitsTraining]:
        """Networks of a set."""
        return [DigitsTraining(cell, representation, seed) for seed in range(self.seeds)]

    def folds_of(self, representation: str, seed: int) -> list[DigitsTraining]:
        """Networks of a seed that are trained on recordings."""
        return [DigitsTraining(None, representation, seed, fold) for fold in range(self.folds)]

    @property
    def every_training(self) -> list[DigitsTraining]:
        """All networks."""
        return [
            training
            for kind in REPRESENTATIONS
            for trainings in (
                *(self.trainings(cell, kind) for cell in self.cells),
                *(self.folds_of(kind, seed) for seed in range(self.seeds)),
            )
            for training in trainings
        ]

"""What a training file may say for classification."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from texvent.config import check_choices, check_range
from texvent.train.schedule import Schedule

if TYPE_CHECKING:
    from texvent.train.task import Task


@dataclass(frozen=True, kw_only=True)
class ClassData:
    """Labelled samples of a data set that texvent dataset made."""

    folder: Path = Path()
    """Of the data set."""
    variant: str | None = None
    """None: the only one."""
    split: str = "train"
    """Trained on."""
    validation_split: str = "test"
    """Scored after every epoch."""
    slice_events: int | None = None
    """A random run of so many events of each sample, drawn anew in every epoch; None: all."""

    def __post_init__(self) -> None:
        check_range("slice_events", self.slice_events, 1)


@dataclass(frozen=True, kw_only=True)
class ClassNetwork:
    """The network and what it is shown."""

    name: Literal["small-cnn"] = "small-cnn"
    representation: str = "histogram-2d"
    """See docs/representations.md."""
    representation_options: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        check_choices(self)


@dataclass(frozen=True, kw_only=True)
class Augmentation:
    """Changes of training samples, drawn anew in every epoch."""

    shift: int = 2
    """Largest shift along each axis, px; what leaves the sensor is dropped."""
    flip_x: bool = False
    """Mirror half of the samples."""
    flip_time: bool = False
    """Reverse half of the samples in time, with opposite polarity."""

    def __post_init__(self) -> None:
        check_range("shift", self.shift, 0, 10_000)


@dataclass(frozen=True, kw_only=True)
class ClassificationConfig:
    """A classifier of recordings."""

    seed: int = 0
    """Of the initial weights, the order of samples and their augmentation."""
    data: ClassData = field(default_factory=ClassData)
    network: ClassNetwork = field(default_factory=ClassNetwork)
    augmentation: Augmentation = field(default_factory=Augmentation)
    schedule: Schedule = field(default_factory=Schedule)

    def __post_init__(self) -> None:
        check_range("seed", self.seed, 0, 2**63 - 1)

    def make_task(self) -> Task:
        """The task; this imports torch."""
        from texvent.train.classification.task import ClassificationTask

        return ClassificationTask(self)

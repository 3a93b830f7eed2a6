"""Options of a training file for classification."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

from texvent.config import check_range
from texvent.errors import ConfigError, shown
from texvent.extending import suggest
from texvent.sensor import as_size
from texvent_lab.train.schedule import TrainingConfig

OWN_NETWORKS = ("small-cnn", "resnet34")
PREFIX = "torchvision:"
"""Prefix of the names of torchvision's classifiers."""


@dataclass(frozen=True, kw_only=True)
class LabelledSource:
    """Labelled samples: a data set, or folders of recordings."""

    folder: Path | None = None
    """A data set that texvent dataset made."""
    recordings: Path | None = None
    """Recordings of any format that texvent reads: a folder of splits, each a folder of classes,
    each a folder of files."""
    split: str = "train"
    """Trained on."""
    variant: str | None = None
    """Variant of a data set; None: all of them, mixed."""
    sensor: str | None = None
    """Sensor of recordings whose files do not state it, such as "34x34"."""
    flip_polarity: bool = False
    """Exchange ON and OFF of recordings; those of N-MNIST need it to match a camera's."""
    per_class: int | None = None
    """Train on so many samples of each class, drawn by `seed`; None: on all."""

    def __post_init__(self) -> None:
        check_range("per_class", self.per_class, 1)
        if self.folder is not None and self.recordings is not None:
            raise ConfigError("folder and recordings are given; give one of them")
        if self.folder is not None and (self.sensor or self.flip_polarity):
            raise ConfigError("sensor and flip_polarity belong to recordings, not to folder")
        if self.recordings is not None and self.variant is not None:
            raise ConfigError("variant belongs to folder, not to recordings")
        if self.sensor is not None:
            as_size(self.sensor)

    @property
    def is_given(self) -> bool:
        """True if there are samples."""
        return self.folder is not None or self.recordings is not None


@dataclass(frozen=True, kw_only=True)
class ClassData(LabelledSource):
    """Labelled samples, and what is made of them."""

    validation_split: str = "test"
    """Scored after every epoch."""
    classes: int | None = None
    """Only the first so many classes in the order of their names; None: all."""
    slice_events: int | None = None
    """A random run of so many events of each sample, drawn anew in every epoch; None: all."""
    image_size: str | None = None
    """Size that coordinates are scaled to, rounded down, such as "224x224"; None: the sensor's."""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_range("classes", self.classes, 2)
        check_range("slice_events", self.slice_events, 1)
        if self.image_size is not None:
            as_size(self.image_size)


@dataclass(frozen=True, kw_only=True)
class ClassNetwork:
    """The network and what it is shown."""

    name: str = "small-cnn"
    """small-cnn; resnet34, N-ImageNet's; or a classifier of torchvision, such as
    torchvision:vit_b_16 (the extra detect)."""
    width: int | None = None
    """Channels of its first layer; None: 16 of small-cnn, 64 of resnet34."""
    representation: str = "histogram-2d"
    """See docs/representations.md."""
    representation_options: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.name not in OWN_NETWORKS and not self.name.startswith(PREFIX):
            raise ConfigError(
                f"unknown network {shown(self.name)}; {suggest(self.name, OWN_NETWORKS)}, or "
                f"{PREFIX}NAME of a classifier of torchvision"
            )
        if self.width is not None and self.name not in OWN_NETWORKS:
            raise ConfigError(f"width belongs to {' and '.join(OWN_NETWORKS)}, not to {self.name}")
        check_range("width", self.width, 1, 4096)


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
class ClassificationConfig(TrainingConfig):
    """A classifier of recordings."""

    task: ClassVar[str] = "texvent_lab.train.classification.task:ClassificationTask"

    start_from: Path | None = None
    """Weights that training begins with, of the same network; its last layer begins anew where
    they are of other classes. None: random ones."""
    data: ClassData = field(default_factory=ClassData)
    extra: LabelledSource = field(default_factory=LabelledSource)
    """More samples to train on, of the same classes."""
    network: ClassNetwork = field(default_factory=ClassNetwork)
    augmentation: Augmentation = field(default_factory=Augmentation)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.extra != LabelledSource() and not self.extra.is_given:
            raise ConfigError(
                "[extra] has no samples; give folder or recordings in it, or leave it out"
            )

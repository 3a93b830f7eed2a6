"""Layouts, and the parts of a sample that they are given."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.layouts.boxes import Boxes
from texvent.events import EventStream
from texvent.frames import FrameStream
from texvent.sensor import SensorSize

USUAL_SPLITS = MappingProxyType({"valid": "val", "validation": "val", "testing": "test"})
"""Split → its name in layouts with train, val and test."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LayoutSample:
    """One sample; events and frames are read when they are asked for."""

    key: str
    split: str
    """The layout's name of it."""
    place: str
    """Path in the exported folder."""
    size: SensorSize
    start_us: int
    """Time of the first frame, µs."""
    stop_us: int
    """Time of the last frame, µs."""
    boxes: Boxes
    """Inside the sensor, in time order; `class_id` is the place in the layout's list of classes."""
    instants_us: NDArray[np.int64]
    """Instants at which boxes are known, µs."""
    made_of: str
    """SHA-256 of the shard that it is in."""
    read_events: Callable[[], EventStream]
    read_frames: Callable[[], AbstractContextManager[FrameStream]] | None
    """None where the data set stores no frames."""


Write = Callable[[LayoutSample, Path], bool]
"""Writes a sample to a path, which appears when it is complete; False if the layout cannot hold it
without a box."""
Finish = Callable[[Path, Iterable[LayoutSample], tuple[str, ...]], None]
"""Writes what belongs to all samples into the folder; given are those written, and the classes."""


def nothing_more(folder: Path, samples: Iterable[LayoutSample], classes: tuple[str, ...]) -> None:
    """A `Finish` for layouts that are complete with their samples."""


@dataclass(frozen=True, kw_only=True)
class Layout:
    """Layout of an exported data set."""

    place: str
    """Path of a sample in the exported folder, of its {split}, {folder}, {label} and {key}; or of
    the {number} of its label."""
    write: Write
    beside: Callable[[Path], Path] | None = None
    """Path of the second file of a sample, if there is one."""
    finish: Finish = nothing_more
    splits: Mapping[str, str] = field(default_factory=dict)
    """Split → the layout's name, where it has another."""
    folders: Mapping[str, str] = field(default_factory=dict)
    """Split of the layout → its {folder}, where that has another name."""
    size: tuple[int, int] | None = None
    """Width and height that its readers take for granted, pixels."""
    lost: str = ""
    """Content that the layout cannot hold."""
    has_boxes: bool = False
    takes_frames: bool = False
    has_frames: bool = False
    """Whether it cannot do without them."""
    keeps_noise_labels: bool = False
    classes: str = ""
    """Its classes of boxes, as `ClassList.parse` reads them; "": those of the data set."""
    first_class: int = 0
    """Number of the first class of boxes in its files."""
    most_classes: int | None = None
    """Most classes of samples that its readers tell apart, where these have numbers."""
    shortest_us: int = 0
    """Least duration of a sample, µs."""

    @property
    def needs_classes(self) -> bool:
        """True if each class has a folder, or a number."""
        return self.names_classes or self.numbers_classes

    @property
    def names_classes(self) -> bool:
        """True if each class has a folder."""
        return "{label}" in self.place

    @property
    def numbers_classes(self) -> bool:
        """True if classes have numbers."""
        return "{number}" in self.place

    def files_of(self, path: Path) -> list[Path]:
        """The files, or the folder, of a sample at a path."""
        return [path] if self.beside is None else [path, self.beside(path)]

    def split_of(self, split: str) -> str:
        """The layout's name of a split."""
        return self.splits.get(split, split)

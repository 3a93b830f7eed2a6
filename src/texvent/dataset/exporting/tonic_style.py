"""Samples of a data set by the conventions of tonic's data sets, without tonic.

`sensor_size`, `dtype`, `ordering`, `classes`, and `dataset[i]` → (structured events, target), so
that tonic's transforms and slicers, and code written for its data sets, take it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.dataset.contents.made_set import MadeSet
from texvent.dataset.contents.stored_events import read_events
from texvent.dataset.generation.records import SampleRecord
from texvent.errors import InputError, shown
from texvent.events import EventStream

Transform = Callable[[Any], Any]


class EventClips:
    """A split of a variant; the target is the number of the class, or the caption without classes.

    Example:
        clips = EventClips("cars", split="train", transform=tonic.transforms.ToFrame(
            sensor_size=(346, 260, 2), n_time_bins=10))
    """

    dtype = np.dtype([("x", np.int16), ("y", np.int16), ("t", np.int64), ("p", np.int8)])
    ordering = dtype.names

    def __init__(
        self,
        folder: str | Path,
        *,
        variant: str | None = None,
        split: str = "train",
        transform: Transform | None = None,
        target_transform: Transform | None = None,
        transforms: Callable[[Any, Any], tuple[Any, Any]] | None = None,
    ) -> None:
        """Read the records; events are read when they are asked for.

        Args:
            folder: of the data set.
            variant: which; None: the only one.
            split: which.
            transform: applied to the events.
            target_transform: applied to the target.
            transforms: applied to both, instead.

        Raises:
            InputError: no such variant or split, or sensors of several sizes.
        """
        made = MadeSet.open(Path(folder))
        if split not in made.splits:
            raise InputError(f"no split {shown(split)}; {suggest(split, made.splits)}")
        self.classes = list(made.labels)
        self.transform, self.target_transform = transform, target_transform
        self.transforms = transforms
        self._samples: list[tuple[Path, SampleRecord]] = [
            (shard.path, sample)
            for shard in made.shards(made.check_variant(variant))
            if shard.record.split == split
            for sample in shard.samples
        ]
        sizes = sorted({(one.width, one.height) for _, one in self._samples})
        if len(sizes) != 1:
            has = ", ".join(f"{width}x{height}" for width, height in sizes) or "no samples"
            raise InputError(
                f"split {split} has {has}; tonic's conventions need one sensor for all samples"
            )
        self.sensor_size = (*sizes[0], 2)
        self._numbers = {label: number for number, label in enumerate(self.classes)}

    def __len__(self) -> int:
        """Number of samples."""
        return len(self._samples)

    def __getitem__(self, index: int) -> tuple[Any, Any]:
        """Events and target of a sample, transformed.

        Raises:
            IndexError: there is no such sample.
            FileFormatError: it is damaged.
        """
        path, sample = self._samples[index]
        events: Any = structured(read_events(path, sample))
        target: Any = sample.prompt if sample.label is None else self._numbers[sample.label]
        if self.transform is not None:
            events = self.transform(events)
        if self.target_transform is not None:
            target = self.target_transform(target)
        if self.transforms is not None:
            events, target = self.transforms(events, target)
        return events, target

    def __iter__(self) -> Iterator[tuple[Any, Any]]:
        """All of them in order."""
        return (self[index] for index in range(len(self)))


def structured(events: EventStream) -> NDArray[Any]:
    """Events as one array with the fields of `EventClips.dtype`."""
    array = np.empty(len(events), dtype=EventClips.dtype)
    for name in EventClips.ordering or ():
        array[name] = getattr(events, name)
    return array

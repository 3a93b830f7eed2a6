"""Stored samples by the conventions of tonic's data sets, without tonic.

Its data sets have `sensor_size`, `dtype`, `ordering` and `classes`, and give (structured events,
target). Its transforms and slicers, and code written for its data sets, take these too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.loading.open_samples import open
from texvent.errors import InputError
from texvent.events import EventStream

EVENT = np.dtype([("x", np.int16), ("y", np.int16), ("t", np.int64), ("p", np.int8)])


class EventClips:
    """A split of a variant; the target is the number of the class, or the caption without classes.

    Example: `EventClips("cars", split="train", transform=ToFrame(sensor_size=(346, 260, 2),
    n_time_bins=10))`.
    """

    dtype = EVENT
    ordering = EVENT.names

    def __init__(
        self,
        folder: str | Path,
        *,
        variant: str | None = None,
        split: str = "train",
        transform: Callable[[Any], Any] | None = None,
        target_transform: Callable[[Any], Any] | None = None,
        transforms: Callable[[Any, Any], tuple[Any, Any]] | None = None,
    ) -> None:
        """Read what is there; events are read when they are asked for.

        Args:
            folder: of the data set.
            variant: which; None: the only one.
            split: which.
            transform: applied to the events.
            target_transform: applied to the target.
            transforms: applied to both, after these.

        Raises:
            InputError: several variants and none named, or sensors of several sizes.
            ConfigError, FileFormatError: as `texvent.dataset.open`.
        """
        self._samples = open(folder, variant=variant, split=split)
        index = self._samples.index
        variants = sorted(set(index.variants))
        if len(variants) > 1:
            raise InputError(f"{folder} has variants {', '.join(variants)}; give variant")
        sizes = np.unique(index.size, axis=0).tolist()
        if len(sizes) > 1:
            has = ", ".join(f"{width}x{height}" for width, height in sizes)
            raise InputError(
                f"split {split} has sensors of {has}; tonic's conventions need one for all samples"
            )
        self.sensor_size = (*map(int, sizes[0]), 2)
        self.classes = list(self._samples.labels)
        self.transform, self.target_transform = transform, target_transform
        self.transforms = transforms

    def __len__(self) -> int:
        """Number of samples."""
        return len(self._samples)

    def __getitem__(self, index: int) -> tuple[Any, Any]:
        """Events and target of a sample, transformed.

        Raises:
            IndexError: there is no such sample.
            FileFormatError: it is damaged.
        """
        sample = self._samples[index]
        events: Any = structured(sample.events)
        target: Any = sample.caption if sample.label is None else sample.class_number
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
    """Events as one array with the fields of `EVENT`."""
    array = np.empty(len(events), dtype=EVENT)
    for name in EVENT.names or ():
        array[name] = getattr(events, name)
    return array

"""Samples of a data set as a layout takes them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from texvent.dataset.generation.recipe import Recipe, Shard
from texvent.dataset.generation.shards import SampleRecord
from texvent.dataset.layouts.boxes import ClassList
from texvent.dataset.layouts.frames import clip_frames
from texvent.dataset.layouts.layout import Layout, LayoutSample
from texvent.dataset.reading.stored_dataset import StoredDataset, StoredShard
from texvent.dataset.reading.stored_events import read_events, sample_truth
from texvent.errors import InputError, shown
from texvent.runtime.file_names import MAX_NAME_BYTES
from texvent.sensor import SensorSize
from texvent.truth.boxes import BOX_RECORD


def folder_name(label: str) -> str:
    """A class as the name of a folder.

    Raises:
        InputError: nothing of it can be one.

    Example:
        >>> folder_name("fire truck/red")
        'fire_truck_red'
    """
    name = re.sub(r"[^\w.-]+", "_", label).strip("._")
    if not name or len(name.encode()) > MAX_NAME_BYTES:
        raise InputError(f"class {shown(label)} cannot name a folder; give it another name")
    return name


@dataclass(frozen=True, eq=False)
class Samples:
    """The samples of a variant as a layout takes them, each time anew."""

    dataset: StoredDataset
    layout: Layout
    variant: str
    classes: ClassList
    recipe: Recipe | None

    def __iter__(self) -> Iterator[LayoutSample]:
        for shard in self.dataset.shards(self.variant):
            yield from (self._sample(shard, sample) for sample in shard.samples)

    def _sample(self, shard: StoredShard, sample: SampleRecord) -> LayoutSample:
        layout, record = self.layout, shard.record
        split, label = layout.split_of(record.split), ""
        if layout.needs_classes:
            label = folder_name(sample.label or "")
        place = layout.place.format(
            split=split, folder=layout.folders.get(split, split), label=label, key=sample.key
        )
        size = SensorSize(sample.width, sample.height)
        boxes, instants = np.empty(0, BOX_RECORD), np.empty(0, np.int64)
        if layout.has_boxes:
            truth = sample_truth(shard.path, sample.key, sample.members)
            boxes, instants = truth.boxes, truth.box_times_us
            boxes = self.classes.renumbered(boxes, truth.classes)
        frames = None
        if self.recipe is not None:
            place_of = Shard(record.variant, record.split, int(record.name.rpartition("-")[2]))
            folder = self.dataset.folder
            frames = partial(clip_frames, self.recipe, folder, place_of, record, sample)
        return LayoutSample(
            key=sample.key,
            split=split,
            place=place,
            size=size,
            start_us=sample.start_us,
            stop_us=sample.start_us + sample.duration_us,
            boxes=boxes,
            instants_us=instants,
            made_of=record.sha256,
            read_events=partial(read_events, shard.path, sample),
            read_frames=frames,
        )

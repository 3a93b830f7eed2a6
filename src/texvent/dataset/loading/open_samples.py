"""A data set opened: its samples, or some of them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from texvent.dataset.contents.made_set import MadeSet
from texvent.dataset.loading.index import Choice, choose, read_index
from texvent.dataset.loading.shard_files import ShardFiles
from texvent.dataset.loading.stored_samples import StoredSamples
from texvent.errors import InputError, shown


def open(
    folder: str | Path,
    *,
    variant: Choice = None,
    split: Choice = None,
    label: Choice = None,
    representation: str | None = None,
    representation_options: Mapping[str, Any] | None = None,
    slice_us: int | None = None,
    slice_events: int | None = None,
) -> StoredSamples:
    """A data set that `texvent dataset make` made, or as much of it as is made.

    Args:
        folder: of the data set.
        variant: only this one, or these; None: all.
        split: only this one, or these; None: all.
        label: only this class, or these; None: all.
        representation: what `make` gives; see `StoredSamples`.
        representation_options: its options, such as `{"bins": 10}`.
        slice_us: length of a slice, µs.
        slice_events: or its number of events.

    Raises:
        InputError: no such folder, it holds no sample, or a sample is shorter than a slice.
        FileFormatError: a shard is missing, has another size, or its record is damaged.
        ConfigError: no such variant, split or label; an unknown representation or option.

    Example: `samples = open("cars", split="train"); samples[0].events`.
    """
    folder = Path(folder)
    index = read_index(folder, variant=variant, split=split)
    # Of the whole set, so that the numbers of classes do not depend on what is chosen of it.
    labels = MadeSet.open(folder).labels
    if label is not None:
        chosen = choose("label", label, labels)
        places = [place for place, one in enumerate(index.labels) if one in chosen]
        index = index.select(np.flatnonzero(np.isin(index.label, places)))
        if not len(index):
            raise InputError(f"{folder} holds no sample of {shown(label)} in what was chosen of it")
    return StoredSamples(
        folder=folder,
        index=index,
        labels=labels,
        files=ShardFiles(folder, index.shards),
        representation=representation,
        representation_options=representation_options or {},
        slice_us=slice_us,
        slice_events=slice_events,
    )

"""Index of a data set: which samples it has and where their members are, as columns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.dataset.stored.folder import StoredDataset, StoredShard
from texvent.errors import ConfigError, FileFormatError, InputError, shown
from texvent.truth.layout import CLIP_FILES

TRUTH_MEMBERS = tuple(name for names in CLIP_FILES.values() for name in names)
MEMBERS = ("x.npy", "y.npy", "t.npy", "p.npy", "label.npy", "json", "txt", "cls", "png",
           *TRUTH_MEMBERS)  # fmt: skip
ABSENT = (-1, 0)
FACTS = ("seed", "events", "duration_us", "start_us")
"""Fields of a `SampleRecord`, which are columns."""
Choice = str | Sequence[str] | None
"""A name, several, or None for all."""


@dataclass(frozen=True, eq=False)
class Index:
    """The samples of a data set in order: by variant, split, shard and place."""

    shards: tuple[str, ...]
    """Paths relative to the folder."""
    variants: tuple[str, ...]
    """One for each shard."""
    splits: tuple[str, ...]
    """One for each shard."""
    digests: tuple[str, ...]
    """SHA-256 of each shard, as its record says."""
    captions: tuple[str | None, ...]
    """All different captions."""
    labels: tuple[str | None, ...]
    """All different labels."""
    shard: NDArray[np.int64]
    """[n] of `shards`."""
    caption: NDArray[np.int64]
    """[n] of `captions`."""
    label: NDArray[np.int64]
    """[n] of `labels`."""
    key: NDArray[np.str_]
    """[n]."""
    seed: NDArray[np.int64]
    """[n] of the simulation."""
    events: NDArray[np.int64]
    """[n] number of events."""
    duration_us: NDArray[np.int64]
    """[n] from the first frame to the last."""
    start_us: NDArray[np.int64]
    """[n] time of the first frame; 0, but for clips cut from a longer video."""
    size: NDArray[np.int64]
    """[n, 2] width, height."""
    members: NDArray[np.int64]
    """[n, len(MEMBERS), 2] position in the shard and bytes; −1 where there is none."""

    def __len__(self) -> int:
        return len(self.shard)

    def select(self, numbers: NDArray[Any]) -> Index:
        """Those samples, in that order."""
        columns = {
            one.name: value[numbers]
            for one in fields(self)
            if isinstance(value := getattr(self, one.name), np.ndarray)
        }
        return replace(self, **columns)


def read_index(dataset: StoredDataset, *, variant: Choice = None, split: Choice = None) -> Index:
    """The samples of the complete shards of a data set.

    Args:
        dataset: which.
        variant: only these.
        split: only these.

    Raises:
        InputError: no sample of these is made.
        FileFormatError: a record is damaged, or its shard is missing, has another size, or is of
            another data set.
        ConfigError: no such variant or split.
    """
    splits = choose("split", split, dataset.splits)
    captions, labels = dict[str | None, int](), dict[str | None, int]()
    shards: list[tuple[str, str, str, str]] = []
    keys, rows, members = list[str](), list[tuple[int, ...]](), list[list[tuple[int, int]]]()
    for path, record in dataset.records(*choose("variant", variant, dataset.variants)):
        if record.split not in splits:
            continue
        problem = dataset.find_problem(path, record)
        if problem is not None:
            raise FileFormatError(f"{problem}; run texvent dataset verify")
        shard = StoredShard(path, record)
        for one in shard.samples:
            caption = captions.setdefault(one.prompt, len(captions))
            label = labels.setdefault(one.label, len(labels))
            keys.append(one.key)
            facts = (getattr(one, name) for name in FACTS)
            rows.append((one.width, one.height, len(shards), caption, label, *facts))
            members.append([one.members.get(name, ABSENT) for name in MEMBERS])
        shards.append((shard.place, record.variant, record.split, record.sha256))
    if not keys:
        raise InputError(f"{dataset.folder} holds no such sample yet; see texvent dataset stats")
    numbers = np.array(rows, np.int64)
    columns = dict(zip(("shard", "caption", "label", *FACTS), numbers.T[2:], strict=True))
    places, variants, splits_of, digests = zip(*shards, strict=True)
    return Index(
        shards=places,
        variants=variants,
        splits=splits_of,
        digests=digests,
        captions=tuple(captions),
        labels=tuple(labels),
        key=np.array(keys),
        size=numbers[:, :2],
        members=np.array(members, np.int64),
        **columns,
    )


def choose(what: str, choice: Choice, known: Sequence[str]) -> list[str]:
    """The names that are asked for, in the order of `known`.

    Raises:
        ConfigError: one is not known, or none is named.
    """
    if choice is None:
        return list(known)
    names = [choice] if isinstance(choice, str) else list(choice)
    for name in names:
        if name not in known:
            raise ConfigError(f"unknown {what} {shown(name)}; {suggest(name, tuple(known))}")
    if not names:
        raise ConfigError(f"{what} names nothing; there is: {', '.join(known)}")
    return [name for name in known if name in names]

"""Index of a data set: which samples it has and where their members are, as columns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.dataset.generation.shards import MADE, ShardRecord, read_record
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.errors import ConfigError, FileFormatError, InputError, one_line, shown
from texvent.truth.layout import CLIP_FILES

TRUTH_MEMBERS = tuple(name for names in CLIP_FILES.values() for name in names)
MEMBERS = ("x.npy", "y.npy", "t.npy", "p.npy", "label.npy", "json", "txt", "cls", "png",
           *TRUTH_MEMBERS)  # fmt: skip
ABSENT = (-1, 0)
Choice = str | Sequence[str] | None
"""A name, several, or None for all."""


@dataclass(frozen=True, eq=False)
class Index:
    """The samples of a data set in order: by variant, split, shard and place."""

    shards: tuple[str, ...]
    """Paths relative to the folder."""
    variants: tuple[str, ...]
    """Of each shard."""
    splits: tuple[str, ...]
    """Of each shard."""
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


def read_index(folder: Path, *, variant: Choice = None, split: Choice = None) -> Index:
    """The samples of the complete shards of a folder.

    Args:
        folder: of the data set.
        variant: only these.
        split: only these.

    Raises:
        InputError: it is no data set, or no sample of these is made.
        FileFormatError: a record is damaged, or its shard is missing, has another size, or is of
            another data set.
        ConfigError: no such variant or split.
    """
    dataset = StoredDataset.open(folder)
    variants = choose("variant", variant, tuple(dataset.variants))
    splits = choose("split", split, dataset.splits)
    rows = _Rows(folder)
    for name in variants:
        for path in dataset.shard_files(name):
            record = read_record(path)
            if record is None or record.split not in splits:
                continue  # still being made, or not asked for
            _check_shard(dataset, path, record)
            rows.add(path, record)
    if not rows.keys:
        raise InputError(f"{folder} holds no such sample yet; see texvent dataset stats")
    return rows.index()


def _check_shard(dataset: StoredDataset, path: Path, record: ShardRecord) -> None:
    """Refuse a shard that is not as it was made.

    Raises:
        FileFormatError: see above.
    """
    remedy = "run texvent dataset verify"
    if not dataset.is_own(record, path):
        raise FileFormatError(f"{path} belongs to another data set; {remedy}")
    try:
        size = path.stat().st_size
    except OSError as error:
        raise FileFormatError(
            f"cannot read {path} ({one_line(error)}), and its record is there; {remedy}"
        ) from error
    if size != record.bytes:
        raise FileFormatError(
            f"{path} has {size:,} bytes and its record says {record.bytes:,}; {remedy}"
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


class _Rows:
    """The columns of an index while records are read."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._shards: list[tuple[str, str, str, str]] = []
        self._captions: dict[str | None, int] = {}
        self._labels: dict[str | None, int] = {}
        self.keys: list[str] = []
        self._numbers: list[tuple[int, ...]] = []
        self._members: list[list[tuple[int, int]]] = []

    def add(self, path: Path, record: ShardRecord) -> None:
        """The samples of a shard."""
        shard = len(self._shards)
        place = str(path.relative_to(self._folder))
        self._shards.append((place, record.variant, record.split, record.sha256))
        for sample in record.samples:
            if sample.status == MADE:
                self.keys.append(sample.key)
                caption = self._captions.setdefault(sample.prompt, len(self._captions))
                label = self._labels.setdefault(sample.label, len(self._labels))
                self._numbers.append(
                    (shard, caption, label, sample.seed, sample.events, sample.duration_us,
                     sample.width, sample.height, sample.start_us)
                )  # fmt: skip
                self._members.append([sample.members.get(name, ABSENT) for name in MEMBERS])

    def index(self) -> Index:
        """The index."""
        numbers = np.array(self._numbers, np.int64)
        shards, variants, splits, digests = zip(*self._shards, strict=True)
        return Index(
            shards=shards,
            variants=variants,
            splits=splits,
            digests=digests,
            captions=tuple(self._captions),
            labels=tuple(self._labels),
            shard=numbers[:, 0],
            caption=numbers[:, 1],
            label=numbers[:, 2],
            key=np.array(self.keys),
            seed=numbers[:, 3],
            events=numbers[:, 4],
            duration_us=numbers[:, 5],
            start_us=numbers[:, 8],
            size=numbers[:, 6:8],
            members=np.array(self._members, np.int64),
        )

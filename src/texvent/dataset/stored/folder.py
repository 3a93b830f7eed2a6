"""Folder of a stored data set: its shards and records, made here or by others, and their index.

The index has as columns which samples there are and where their members are.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.dataset.generation.recipe import ITEMS_FILE, VIDEOS, read_facts, read_recipe
from texvent.dataset.generation.shard_files import (
    EXTENSION,
    MADE,
    SampleRecord,
    ShardRecord,
    read_record,
)
from texvent.dataset.specification.specification import check_name
from texvent.dataset.stored.sample_files import SampleFiles
from texvent.errors import ConfigError, FileFormatError, InputError, one_line, shown
from texvent.sensor import SensorSize
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


SHARD_FILE = re.compile(r"(?P<split>[A-Za-z0-9][A-Za-z0-9_-]*)-(?P<number>[0-9]{6,})\.(tar|json)")

LONGEST_GAP = 1000
"""Missing shards in a row that are named one by one."""


@dataclass(frozen=True)
class StoredShard:
    """A complete shard."""

    path: Path
    """The tar."""
    record: ShardRecord

    @property
    def place(self) -> str:
        """Its path in the folder of the data set."""
        return f"{self.path.parent.name}/{self.path.name}"

    @property
    def samples(self) -> Iterator[SampleRecord]:
        """Samples that are in it."""
        return (sample for sample in self.record.samples if sample.status == MADE)

    def files(self, sample: SampleRecord) -> SampleFiles:
        """The files of one of its samples."""
        size = SensorSize(sample.width, sample.height)
        return SampleFiles(self.path, sample.key, sample.members, size)


@dataclass(frozen=True)
class StoredDataset:
    """A data set, whole or in part; records are read when they are asked for."""

    folder: Path
    name: str
    identity: str
    """Identity that its records name."""
    variants: tuple[str, ...]
    """Their names."""
    splits: tuple[str, ...]
    """Their names."""
    labels: tuple[str, ...]
    """Names of the classes in the order of their numbers."""
    box_classes: tuple[str, ...]
    """Classes of boxes that its specification names, in the order of their numbers."""
    is_shared_out: bool
    """True if every class belongs in every split: no source names its split."""

    @classmethod
    def open(cls, folder: Path) -> StoredDataset:
        """The data set in a folder.

        Raises:
            InputError: there is none.
            FileFormatError: its specification is damaged.
        """
        facts = read_facts(folder)
        try:
            tables = facts["specification"]
            dataset = cls(
                folder,
                name=str(tables["name"]),
                identity=str(facts["identity"]),
                variants=tuple(dict.fromkeys(str(one["name"]) for one in tables["variants"])),
                splits=tuple(tables["splits"]),
                labels=tuple(map(str, facts.get("labels", ()))),
                box_classes=tuple(dict.fromkeys(str(one) for _, one in tables.get("classes", ()))),
                is_shared_out=not any(one.get("split") for one in tables.get("sources", ())),
            )
            for name in (*dataset.variants, *dataset.splits):
                check_name("a variant or split", name)
        except (KeyError, TypeError, AttributeError, ValueError) as error:
            raise FileFormatError(
                f"{folder / 'specification.json'} is damaged ({one_line(error)})"
            ) from error
        return dataset

    @property
    def has_videos(self) -> bool:
        """True if its videos are stored."""
        return (self.folder / VIDEOS).is_dir()

    def shards(self, *variants: str) -> Iterator[StoredShard]:
        """The complete shards of some variants (default: all but the videos), in order.

        Raises:
            FileFormatError: a record is damaged.
        """
        for path, record in self.records(*variants):
            if self.find_problem(path, record) is None:
                yield StoredShard(path, record)

    def records(self, *variants: str) -> Iterator[tuple[Path, ShardRecord]]:
        """As `shards`, whether or not the tars are there: their paths, and the records."""
        for variant in variants or self.variants:
            for path in self.shard_files(variant):
                record = read_record(path)
                if record is not None:
                    yield path, record

    def find_problem(self, path: Path, record: ShardRecord) -> str | None:
        """Reason why the tar at a path is not the one of a record; None: it is."""
        place = (self.identity, path.parent.name, path.stem)
        if (record.identity, record.variant, record.name) != place:
            return f"{path} belongs to another data set"
        try:
            size = path.stat().st_size
        except OSError as error:
            return f"cannot read {path} ({one_line(error)}), and its record is there"
        if size != record.bytes:
            return f"{path} has {size:,} bytes and its record says {record.bytes:,}"
        return None

    def shard_files(self, variant: str) -> list[Path]:
        """Tars of a variant that are there or have a record, in the order of the splits."""
        folder = self.folder / variant
        found = {}
        for path in folder.iterdir() if folder.is_dir() else ():
            match = SHARD_FILE.fullmatch(path.name)
            if match and match["split"] in self.splits:
                place = self.splits.index(match["split"]), int(match["number"])
                found[place] = path.with_suffix(EXTENSION)
        return [found[place] for place in sorted(found)]

    def expected(self) -> set[str] | None:
        """Places of all shards that belong to it, or None where the folder does not state them."""
        if not (self.folder / ITEMS_FILE).is_file():
            return None
        recipe = read_recipe(self.folder)
        return {str(shard.path) for stage in recipe.stages for shard in recipe.shards(stage)}

    def missing(self, *variants: str) -> list[str]:
        """Places of shards of some variants (default: all but the videos) that are not complete.

        A copy without items.jsonl is judged by the numbers alone: the last shards are not missed.
        """
        variants = variants or self.variants
        there = {shard.place for shard in self.shards(*variants)}
        expected = self.expected()
        if expected is None:
            return _gaps(there)
        return sorted(one for one in expected - there if one.partition("/")[0] in variants)

    def check_variant(self, name: str | None) -> str:
        """The variant of that name, or the only one.

        Raises:
            InputError: there is no such, or several and none is named.
        """
        names = self.variants
        if name is None:
            if len(names) > 1:
                raise InputError(
                    f"{self.folder} has {len(names)} variants ({', '.join(names)}); choose one "
                    "with --variant"
                )
            return names[0]
        if name not in names:
            raise InputError(f"{self.folder} has no variant {shown(name)}; {suggest(name, names)}")
        return name


def _gaps(places: set[str]) -> list[str]:
    """Places with a lower number than one that is there; of a long gap, its first and its last."""
    numbers: dict[str, list[int]] = {}
    for place in places:
        stem, _, number = place.removesuffix(EXTENSION).rpartition("-")
        numbers.setdefault(stem, [-1]).append(int(number))
    found = []
    for stem, there in numbers.items():
        for before, after in itertools.pairwise(sorted(there)):
            ends = (before + 1, after - 1) if after - before > LONGEST_GAP else ()
            listed = [f"{stem}-{n:06d}{EXTENSION}" for n in ends or range(before + 1, after)]
            found += [" to ".join(listed)] if ends else listed
    return sorted(found)

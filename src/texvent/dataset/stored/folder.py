"""Folder of a stored data set: its shards and records, made here or by others."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

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
from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.sensor import SensorSize

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

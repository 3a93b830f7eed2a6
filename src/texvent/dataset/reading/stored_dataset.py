"""Stored data set: its folder, shards and records, made here or by others."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, TypeGuard

from texvent._registry import suggest
from texvent.dataset.generation.recipe import ITEMS_FILE, VIDEOS, read_facts, read_recipe
from texvent.dataset.generation.shards import (
    EXTENSION,
    MADE,
    SampleRecord,
    ShardRecord,
    read_record,
)
from texvent.dataset.specification.specification import check_name
from texvent.errors import FileFormatError, InputError, one_line, shown

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


@dataclass(frozen=True)
class StoredDataset:
    """A data set, whole or in part; records are read when they are asked for."""

    folder: Path
    facts: Mapping[str, Any]
    """Content of its specification.json."""

    @classmethod
    def open(cls, folder: Path) -> StoredDataset:
        """The data set in a folder.

        Raises:
            InputError: there is none.
            FileFormatError: its specification is damaged.
        """
        dataset = cls(folder, read_facts(folder))
        try:
            dataset.name, dataset.identity, dataset.labels, dataset.box_classes  # noqa: B018
            for name in (*dataset.variants, *dataset.splits):
                check_name("a variant or split", name)
        except (KeyError, TypeError, AttributeError, ValueError) as error:
            raise FileFormatError(
                f"{folder / 'specification.json'} is damaged ({one_line(error)})"
            ) from error
        return dataset

    @property
    def specification(self) -> Mapping[str, Any]:
        """Its specification as plain values."""
        tables: Mapping[str, Any] = self.facts["specification"]
        return tables

    @property
    def name(self) -> str:
        """Name of the data set."""
        return str(self.specification["name"])

    @property
    def identity(self) -> str:
        """Identity that its records name."""
        return str(self.facts["identity"])

    @property
    def labels(self) -> tuple[str, ...]:
        """Names of the classes in the order of their numbers."""
        return tuple(map(str, self.facts.get("labels", ())))

    @property
    def box_classes(self) -> tuple[str, ...]:
        """Classes of boxes that its specification names, in the order of their numbers."""
        return tuple(dict.fromkeys(str(one) for _, one in self.specification.get("classes", ())))

    @property
    def splits(self) -> tuple[str, ...]:
        """Names of the splits."""
        return tuple(self.specification["splits"])

    @cached_property
    def variants(self) -> Mapping[str, Mapping[str, Any]]:
        """Name → what the specification says of it."""
        return {str(one["name"]): one for one in self.specification["variants"]}

    @property
    def has_videos(self) -> bool:
        """True if its videos are stored."""
        return (self.folder / VIDEOS).is_dir()

    def shards(self, *variants: str) -> Iterator[StoredShard]:
        """The complete shards of some variants (default: all but the videos), in order.

        Raises:
            FileFormatError: a record is damaged.
        """
        for variant in variants or self.variants:
            for path in self.shard_files(variant):
                record = read_record(path)
                if (
                    self.is_own(record, path)
                    and path.is_file()
                    and path.stat().st_size == record.bytes
                ):
                    yield StoredShard(path, record)

    def is_own(self, record: ShardRecord | None, path: Path) -> TypeGuard[ShardRecord]:
        """True if a record is there, of this data set, and of the shard at `path`."""
        return (
            record is not None
            and record.identity == self.identity
            and (record.variant, record.name) == (path.parent.name, path.stem)
        )

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
        variants = variants or tuple(self.variants)
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
        names = tuple(self.variants)
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

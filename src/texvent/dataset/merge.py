"""Merge of data sets: shards are linked; shards and classes get new numbers."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from texvent._version import full_version
from texvent.dataset.generation.recipe import SPECIFICATION_FILE
from texvent.dataset.generation.shards import (
    EXTENSION,
    ShardRecord,
    TarShardWriter,
    read_members,
    write_record,
)
from texvent.dataset.reading.stored_dataset import SHARDS, StoredDataset, StoredShard
from texvent.dataset.statistics import in_several_splits
from texvent.errors import InputError, shown, warn
from texvent.io.atomic import atomic_folder

CLASS = "cls"


@dataclass(frozen=True)
class Merged:
    """Counts of a merge."""

    samples: int
    shards: int
    rewritten: int
    """Shards whose class numbers changed; the others are links or copies."""


def merge(sources: Sequence[StoredDataset], folder: Path, *, name: str | None = None) -> Merged:
    """Put data sets together in a new folder; the sources stay as they are.

    Samples, records and their versions are kept. Videos are left out: nothing further can be made
    of a merged set. Versions of texvent and settings may differ, each sample says its own.

    Args:
        sources: two or more complete data sets.
        folder: of the new one, which must not exist.
        name: of the new one; default: that of the folder.

    Raises:
        InputError: shards are missing, a sample is in two of them, or only some have classes.
        OutputError: the folder exists or cannot be written.
    """
    _refuse_incomplete(sources)
    _refuse_shared_samples(sources)
    labels = _labels(sources)
    identity = hashlib.sha256(json.dumps([one.identity for one in sources]).encode()).hexdigest()
    numbers: Counter[tuple[str, str]] = Counter()
    samples: Counter[str] = Counter()
    rewritten = 0
    with atomic_folder(folder, overwrite=False, is_own=lambda path: False) as part:
        for source in sources:
            keeps_numbers = source.labels == labels[: len(source.labels)]
            for shard in source.shards():
                place = shard.record.variant, shard.record.split
                new = f"{place[1]}-{numbers[place]:06d}"
                numbers[place] += 1
                samples[place[1]] += sum(1 for _ in shard.samples)
                target = part / place[0] / f"{new}{EXTENSION}"
                target.parent.mkdir(exist_ok=True)
                record = replace(shard.record, name=new, identity=identity)
                if keeps_numbers:
                    _link(shard.path, target)
                else:
                    record = _with_classes(shard, record, target, labels)
                    rewritten += 1
                write_record(target, record)
        facts = _facts(sources, name or folder.name, identity, labels, numbers, samples)
        text = json.dumps(facts, indent=1) + "\n"
        (part / SPECIFICATION_FILE).write_text(text, encoding="utf-8")
    _warn_of_differences(sources)
    return Merged(samples.total(), numbers.total(), rewritten)


def _refuse_incomplete(sources: Sequence[StoredDataset]) -> None:
    if len(sources) < 2:
        raise InputError("merging takes two data sets or more; name their folders")
    for source in sources:
        missing = source.missing()
        if missing:
            raise InputError(
                f"{source.folder} lacks {len(missing)} shards, such as {missing[0]}; make them "
                "first (texvent dataset make)"
            )


def _refuse_shared_samples(sources: Sequence[StoredDataset]) -> None:
    """A sample's key says its prompt, repeat, variant and seed number: no two may share one."""
    owner: dict[str, StoredDataset] = {}
    for source in sources:
        for shard in source.shards():
            for sample in shard.record.samples:
                other = owner.setdefault(sample.key, source)
                if other is not source:
                    raise InputError(
                        f"sample {sample.key} ({shown(sample.prompt)}, variant "
                        f"{shard.record.variant}) is in {other.folder} and in {source.folder}: "
                        "both show the same prompt in a variant of the same name; make one of "
                        "them with another name of the variant, or both in one with repeats or "
                        "seeds"
                    )


def _labels(sources: Sequence[StoredDataset]) -> tuple[str, ...]:
    labelled = [source.folder for source in sources if source.labels]
    if 0 < len(labelled) < len(sources):
        without = next(source.folder for source in sources if not source.labels)
        raise InputError(f"{labelled[0]} has classes and {without} has none; give all, or none")
    return tuple(sorted({label for source in sources for label in source.labels}))


def _link(path: Path, target: Path) -> None:
    """A second name for a shard, or a copy on another disk; shards are replaced, never changed."""
    try:
        os.link(path, target)
    except OSError:
        shutil.copyfile(path, target)


def _with_classes(
    shard: StoredShard, record: ShardRecord, target: Path, labels: tuple[str, ...]
) -> ShardRecord:
    """Copy a shard with the class numbers of the merged set."""
    numbers = {label: number for number, label in enumerate(labels)}
    samples = []
    with target.open("wb") as file:
        writer = TarShardWriter(file)
        for sample in record.samples:
            if sample.members and sample.label is not None:
                members = read_members(shard.path, sample.members)
                members[CLASS] = str(numbers[sample.label]).encode()
                sample = replace(sample, members=writer.add(sample.key, members))
            samples.append(sample)
        writer.close()
    with target.open("rb") as file:
        sha256 = hashlib.file_digest(file, "sha256").hexdigest()
    return replace(record, samples=tuple(samples), sha256=sha256, bytes=target.stat().st_size)


def _facts(
    sources: Sequence[StoredDataset],
    name: str,
    identity: str,
    labels: tuple[str, ...],
    numbers: Mapping[tuple[str, str], int],
    samples: Mapping[str, int],
) -> dict[str, Any]:
    counts: dict[str, dict[str, int]] = {}
    for (variant, split), count in numbers.items():
        counts.setdefault(variant, {})[split] = count
    whole = sum(samples.values()) or 1
    licenses = {str(source.specification.get("license") or "") for source in sources}
    return {
        "texvent_version": full_version(),
        "identity": identity,
        "labels": [*labels],
        SHARDS: counts,
        "specification": {
            "name": name,
            "description": " ".join(
                str(source.specification.get("description") or "") for source in sources
            ).strip(),
            "license": licenses.pop() if len(licenses) == 1 else "",
            "splits": {split: round(count / whole, 4) for split, count in samples.items()},
            "variants": [
                {"name": variant, "options": {"simulator": _simulator(sources, variant)}}
                for variant in counts
            ],
        },
        "merged": [dict(source.facts) for source in sources],
    }


def _simulator(sources: Sequence[StoredDataset], variant: str) -> str | dict[str, list[str | None]]:
    """The one of all sources, else a choice of them."""
    names = {source.simulator_of(variant) for source in sources if variant in source.variants}
    (first, *others) = sorted(names, key=str)
    return first if first is not None and not others else {"choice": [first, *others]}


def _warn_of_differences(sources: Sequence[StoredDataset]) -> None:
    shared = in_several_splits(shard for source in sources for shard in source.shards())
    if shared:
        warn(
            f"{len(shared)} prompts or videos are now in several splits, such as "
            f"{shown(min(shared))}: tests would see what was trained on"
        )
    licenses = {str(source.specification.get("license") or "none") for source in sources}
    if len(licenses) > 1:
        warn(
            f"the licences differ ({', '.join(sorted(licenses))}); state one that fits all with "
            "texvent dataset publish --license"
        )

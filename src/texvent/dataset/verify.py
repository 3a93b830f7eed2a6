"""Verification of a data set: files complete, unchanged and its own; samples sound."""

from __future__ import annotations

import hashlib
import itertools
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import partial

from texvent.dataset.generation.make_sample import COLUMNS, count_boxes
from texvent.dataset.generation.recipe import VIDEOS
from texvent.dataset.generation.shard_files import (
    EXTENSION,
    FAILED,
    FILTERED,
    MADE,
    SampleRecord,
    ShardRecord,
    read_record,
)
from texvent.dataset.statistics import in_several_splits
from texvent.dataset.stored.folder import SHARD_FILE, StoredDataset, StoredShard
from texvent.dataset.stored.sample_files import SampleFiles
from texvent.errors import FileFormatError, one_line, shown
from texvent.runtime.files.hidden_parts import is_hidden_part


@dataclass
class Findings:
    """Problems and notes."""

    missing: list[str] = field(default_factory=list)
    """Shards that belong to the set and are not complete."""
    changed: list[str] = field(default_factory=list)
    """Shards that differ from their records, and the difference."""
    foreign: list[str] = field(default_factory=list)
    """Files among the shards that are not of this data set; loaders would read them."""
    unsound: list[str] = field(default_factory=list)
    """Samples that cannot be used, and why."""
    notes: list[str] = field(default_factory=list)
    """Harmless findings."""
    shards: int = 0
    samples: int = 0
    events: int = 0
    filtered: int = 0
    failed: int = 0

    @property
    def is_sound(self) -> bool:
        """True if nothing is wrong."""
        return not any(problems for _, problems in self.problems())

    def problems(self) -> Iterator[tuple[str, list[str]]]:
        """Kind → problems of that kind."""
        for kind in ("missing", "changed", "foreign", "unsound"):
            yield kind, getattr(self, kind)

    def count(self, record: ShardRecord) -> None:
        """Add the counts of a shard."""
        self.shards += 1
        if record.variant != VIDEOS:
            self.samples += record.count(MADE)
            self.events += record.events
            self.filtered += record.count(FILTERED)
            self.failed += record.count(FAILED)


def verify(dataset: StoredDataset, *, workers: int = 1, contents: bool = True) -> Findings:
    """Check a data set, as it was made or as a copy of it was published.

    Args:
        dataset: the data set.
        workers: threads that read.
        contents: whether the samples are read, beside the digests of their shards.

    Raises:
        FileFormatError: the specification is damaged.
    """
    findings = Findings()
    kinds = [*dataset.variants, *([VIDEOS] if dataset.has_videos else [])]
    findings.changed = list(_damaged_records(dataset, kinds))
    if findings.changed:
        findings.notes.append("nothing else was checked, because records are damaged")
        return findings
    findings.missing = dataset.missing(*kinds)
    shards = dataset.shards(*kinds)
    with ThreadPoolExecutor(workers) as pool:
        # Some shards at once: the records of millions of samples would not fit into memory.
        while some := list(itertools.islice(shards, 4 * workers)):
            problems = pool.map(partial(_check_shard, contents=contents), some)
            for shard, (changed, unsound) in zip(some, problems, strict=True):
                findings.changed += [f"{shard.place}: {one}" for one in changed]
                findings.unsound += [f"{shard.place}: {one}" for one in unsound]
                findings.count(shard.record)
    findings.foreign = _foreign_files(dataset, kinds, set(findings.missing))
    findings.notes = list(_notes(dataset))
    return findings


def _damaged_records(dataset: StoredDataset, kinds: Iterable[str]) -> Iterator[str]:
    for kind in kinds:
        for path in dataset.shard_files(kind):
            try:
                read_record(path)
            except FileFormatError as error:
                yield str(error)


def _check_shard(shard: StoredShard, *, contents: bool) -> tuple[list[str], list[str]]:
    """Problems of the file, and of its samples."""
    changed = []
    try:
        with shard.path.open("rb") as file:
            if hashlib.file_digest(file, "sha256").hexdigest() != shard.record.sha256:
                changed.append("its sha256 is not that of its record")
    except OSError as error:
        changed.append(f"cannot be read ({one_line(error)})")
    is_video = shard.record.variant == VIDEOS
    return changed, list(_unsound(shard)) if contents and not is_video else []


def _unsound(shard: StoredShard) -> Iterator[str]:
    for sample in shard.samples:
        try:
            _check_sample(shard.files(sample), sample)
        except FileFormatError as error:
            yield str(error).removeprefix(f"{shard.path}: ")


def _check_sample(files: SampleFiles, sample: SampleRecord) -> None:
    """Refuse unsound events and ground truth, and facts that are of another sample.

    Raises:
        FileFormatError: see above.
    """
    lacking = [f"{name}.npy" for name in COLUMNS if f"{name}.npy" not in sample.members]
    if lacking:
        raise FileFormatError(f"sample {sample.key} has no {lacking[0]}")
    events, facts = files.columns(), files.facts()
    if len(events) != sample.events:
        raise FileFormatError(
            f"sample {sample.key} has {len(events)} events, and its record says {sample.events}"
        )
    for name in ("key", "clip", "seed", "width", "height", "label"):
        if facts.get(name) != getattr(sample, name):
            raise FileFormatError(
                f"sample {sample.key}: {name} is {shown(facts.get(name))} in the shard, and "
                f"{shown(getattr(sample, name))} in its record"
            )
    truth = files.truth()
    truth.check(events.size)
    counted = count_boxes(truth)
    if (counted.get("boxes"), counted.get("tracks", 0)) != (sample.boxes, sample.tracks):
        raise FileFormatError(f"sample {sample.key}: its record counts other boxes than it has")
    caption = files.read(("txt",)).get("txt", b"")
    if caption.decode("utf-8", errors="replace") != (sample.prompt or ""):
        raise FileFormatError(f"sample {sample.key}: its caption is not that of its record")


def _foreign_files(dataset: StoredDataset, kinds: Iterable[str], missing: set[str]) -> list[str]:
    """Files among the shards that are not of complete shards of this data set."""
    own, expected = {shard.place for shard in dataset.shards(*kinds)}, dataset.expected()
    if expected is not None:
        own &= expected
    found = []
    for kind in kinds:
        folder = dataset.folder / kind
        for path in sorted(folder.iterdir()) if folder.is_dir() else ():
            is_shard = SHARD_FILE.fullmatch(path.name) is not None
            place = f"{kind}/{path.with_suffix(EXTENSION).name}"
            if not (is_shard and place in own | missing) and not is_hidden_part(path):
                found.append(f"{kind}/{path.name}")
    return found


def _notes(dataset: StoredDataset) -> Iterator[str]:
    shared = in_several_splits(dataset.shards())
    if shared:
        yield (
            f"{len(shared)} prompts or videos are in several splits, such as "
            f"{shown(min(shared))}: tests would see what was trained on"
        )
    expected = dataset.expected()
    if not dataset.has_videos and any(one.startswith(f"{VIDEOS}/") for one in expected or ()):
        yield "its videos are not here; no loader needs them"
    if expected is None:
        yield "there is no items.jsonl, so shards missing at the end of a split are not noticed"

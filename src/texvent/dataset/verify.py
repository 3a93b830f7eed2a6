"""Every file of a data set checked: there, unchanged, of it, each sample sound and there once."""

from __future__ import annotations

import hashlib
import itertools
import json
from collections import Counter
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from texvent.dataset.contents.made_set import SHARD_FILE, MadeSet, MadeShard
from texvent.dataset.contents.statistics import in_several_splits
from texvent.dataset.contents.stored_events import read_events, read_sample_facts
from texvent.dataset.generation.recipe import ITEMS_FILE, SPECIFICATION_FILE, VIDEOS
from texvent.dataset.generation.records import (
    FAILED,
    FILTERED,
    SampleRecord,
    read_record,
    record_path,
)
from texvent.dataset.generation.sample import COLUMNS
from texvent.dataset.generation.shard_log import LOGS
from texvent.dataset.generation.tar_shard import EXTENSION, read_members
from texvent.dataset.publishing.card import CARD_FILE
from texvent.dataset.publishing.croissant import CROISSANT_FILE
from texvent.dataset.publishing.index import INDEX_FILE
from texvent.errors import FileFormatError, one_line, shown
from texvent.io.atomic import is_hidden_part

OWN = (SPECIFICATION_FILE, ITEMS_FILE, CARD_FILE, CROISSANT_FILE, INDEX_FILE, LOGS, "samples.png",
       "samples.html", "stats.html", ".git", ".gitattributes", ".cache")  # fmt: skip
"""What may lie in the folder of a data set besides its shards."""


@dataclass
class Findings:
    """What is wrong, and what is worth knowing."""

    missing: list[str] = field(default_factory=list)
    """Shards that belong to the set and are not complete."""
    changed: list[str] = field(default_factory=list)
    """Shards that are not what their record says, and what says so."""
    foreign: list[str] = field(default_factory=list)
    """Files among the shards that are not of this data set; loaders would read them."""
    twice: list[str] = field(default_factory=list)
    """Keys of several samples."""
    unsound: list[str] = field(default_factory=list)
    """Samples that cannot be used, and why."""
    notes: list[str] = field(default_factory=list)
    """What does no harm."""
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
        """Kind → what is wrong."""
        for kind in ("missing", "changed", "foreign", "twice", "unsound"):
            yield kind, getattr(self, kind)


@dataclass(frozen=True)
class _ShardFindings:
    shard: MadeShard
    changed: str | None
    unsound: tuple[str, ...]


def verify(made: MadeSet, *, workers: int = 1, contents: bool = True) -> Findings:
    """Check a data set, as it was made or as a copy of it was published.

    Args:
        made: the data set.
        workers: threads that read.
        contents: whether the samples are read, beside the digests of their shards.

    Raises:
        FileFormatError: the specification is damaged.
    """
    findings = Findings()
    kinds = [*made.variants, *([VIDEOS] if made.has_videos else [])]
    findings.changed = list(_damaged_records(made, kinds))
    if findings.changed:
        findings.notes.append("nothing else was checked, because records are damaged")
        return findings
    findings.missing = made.missing(*kinds)
    keys: Counter[str] = Counter()
    for found in _checked(made.shards(*kinds), workers, contents=contents):
        record = found.shard.record
        if found.changed:
            findings.changed.append(f"{found.shard.place}: {found.changed}")
        findings.unsound += [f"{found.shard.place}: {one}" for one in found.unsound]
        findings.shards += 1
        # A sample may have the key of its video.
        prefix = f"{VIDEOS}/" if record.variant == VIDEOS else ""
        keys.update(prefix + sample.key for sample in record.samples)
        if not prefix:
            findings.samples += sum(1 for _ in found.shard.samples)
            findings.events += record.events
            findings.filtered += record.count(FILTERED)
            findings.failed += record.count(FAILED)
    findings.twice = sorted(key for key, count in keys.items() if count > 1)
    findings.foreign = _foreign_shards(made, kinds, set(findings.missing))
    findings.notes = [*_other_files(made), *_notes(made)]
    findings.changed += _differing_description(made)
    return findings


def _damaged_records(made: MadeSet, kinds: Iterable[str]) -> Iterator[str]:
    for kind in kinds:
        for path in made.shard_files(kind):
            try:
                read_record(path)
            except FileFormatError as error:
                yield str(error)


def _checked(
    shards: Iterator[MadeShard], workers: int, *, contents: bool
) -> Iterator[_ShardFindings]:
    """Some shards at once: the records of millions of samples would not fit into memory."""
    check = partial(_check_shard, contents=contents)
    with ThreadPoolExecutor(workers) as pool:
        while some := list(itertools.islice(shards, 4 * workers)):
            yield from pool.map(check, some)


def _check_shard(shard: MadeShard, *, contents: bool) -> _ShardFindings:
    changed = None
    try:
        with shard.path.open("rb") as file:
            if hashlib.file_digest(file, "sha256").hexdigest() != shard.record.sha256:
                changed = "its sha256 is not that of its record"
    except OSError as error:
        changed = f"cannot be read ({one_line(error)})"
    is_video = shard.record.variant == VIDEOS
    found = _unsound(shard) if contents and not is_video else ()
    return _ShardFindings(shard, changed, tuple(found))


def _unsound(shard: MadeShard) -> Iterator[str]:
    for sample in shard.samples:
        try:
            _check_sample(shard.path, sample)
        except FileFormatError as error:
            yield str(error).removeprefix(f"{shard.path}: ")


def _check_sample(path: Path, sample: SampleRecord) -> None:
    """Refuse events out of order or outside of the sensor, and facts that are of another sample.

    Raises:
        FileFormatError: see above.
    """
    lacking = [f"{name}.npy" for name in COLUMNS if f"{name}.npy" not in sample.members]
    if lacking:
        raise FileFormatError(f"sample {sample.key} has no {lacking[0]}")
    events = read_events(path, sample)
    if len(events) != sample.events:
        raise FileFormatError(
            f"sample {sample.key} has {len(events)} events, and its record says {sample.events}"
        )
    facts = read_sample_facts(path, sample)
    for name in ("key", "clip", "seed", "width", "height", "label"):
        if facts.get(name) != getattr(sample, name):
            raise FileFormatError(
                f"sample {sample.key}: {name} is {shown(facts.get(name))} in the shard, and "
                f"{shown(getattr(sample, name))} in its record"
            )
    caption = read_members(path, sample.members, ("txt",)).get("txt", b"")
    if caption.decode("utf-8", errors="replace") != (sample.prompt or ""):
        raise FileFormatError(f"sample {sample.key}: its caption is not that of its record")


def _foreign_shards(made: MadeSet, kinds: Iterable[str], missing: set[str]) -> list[str]:
    """Tars and records among the shards that are not complete shards of this data set."""
    own, expected = {shard.path for shard in made.shards(*kinds)}, made.expected()
    if expected is not None:
        own = {path for path in own if f"{path.parent.name}/{path.name}" in expected}
    found = []
    for kind in kinds:
        folder = made.folder / kind
        for path in sorted(folder.iterdir()) if folder.is_dir() else ():
            place = f"{kind}/{path.name}"
            tar = path.with_suffix(EXTENSION)
            if tar in own and path in (tar, record_path(tar)):
                continue
            if SHARD_FILE.fullmatch(path.name) and f"{kind}/{tar.name}" in missing:
                continue  # said already: it is not complete
            if not is_hidden_part(path):
                found.append(f"{place}: {_why_foreign(made, tar)}")
    return found


def _why_foreign(made: MadeSet, tar: Path) -> str:
    record = read_record(tar) if SHARD_FILE.fullmatch(tar.name) else None
    if record is None:
        return "no shard of this data set"
    is_own = made.is_own(record, tar)
    return "more than the specification asks for" if is_own else "another shard, or of another set"


def _other_files(made: MadeSet) -> Iterator[str]:
    for path in sorted(made.folder.iterdir()):
        if path.name in OWN or path.name in made.variants or path.name == VIDEOS:
            continue
        if is_hidden_part(path):
            yield f"{path.name} is what a killed process left; it may be deleted"
        else:
            yield f"{path.name} is not of texvent"


def _notes(made: MadeSet) -> Iterator[str]:
    shared = in_several_splits(made.shards())
    if shared:
        yield (
            f"{len(shared)} prompts or videos are in several splits, such as "
            f"{shown(min(shared))}: tests would see what was trained on"
        )
    expected = made.expected()
    if expected is not None and not made.has_videos and any(map(_is_video, expected)):
        yield "its videos are not here; no loader needs them"
    if expected is None and not (made.folder / CROISSANT_FILE).is_file():
        yield (
            "there is neither items.jsonl nor croissant.json, so shards missing at the end of a "
            "split are not noticed"
        )


def _is_video(place: str) -> bool:
    return place.startswith(f"{VIDEOS}/")


def _differing_description(made: MadeSet) -> Iterator[str]:
    """Whether the description that was published is of these shards."""
    path = made.folder / CROISSANT_FILE
    if not path.is_file():
        return
    try:
        files = json.loads(path.read_text("utf-8"))["distribution"]
        said = {one["@id"]: one["sha256"] for one in files if one["@id"].endswith(EXTENSION)}
    except (ValueError, KeyError, TypeError, OSError, AttributeError):
        yield f"{path.name}: no description that texvent dataset publish wrote"
        return
    found = {shard.place: shard.record.sha256 for shard in made.shards()}
    differing = sorted(place for place in said | found if said.get(place) != found.get(place))
    if differing:
        yield (
            f"{path.name}: it describes other shards (such as {differing[0]}); run texvent dataset "
            "publish again"
        )

"""One shard made: its clips turned into samples, the file written, then its record."""

from __future__ import annotations

import hashlib
import tempfile
import time
from collections.abc import Collection, Generator, Sequence
from contextlib import ExitStack, closing
from dataclasses import replace
from itertools import groupby, zip_longest
from pathlib import Path

import numpy as np

from texvent._version import full_version
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard
from texvent.dataset.generation.shard_files import (
    FAILED,
    SampleRecord,
    ShardRecord,
    TarShardWriter,
    read_members,
    read_record,
    record_path,
    write_record,
)
from texvent.dataset.generation.shard_samples import Make, Making, ShardSamples
from texvent.errors import TexventError, warnings_to
from texvent.generation.kept_frames import KeptFrames
from texvent.generation.subjects import scenes
from texvent.io.atomic import atomic_file
from texvent.runtime.devices import AUTO
from texvent.runtime.files.file_names import inside
from texvent.runtime.work.engines import ENDING_ALL
from texvent.runtime.work.side_work import finishing_side_work
from texvent.settings.provenance import describe_state, is_replaced


def make_together(
    recipe: Recipe,
    folder: Path,
    shards: Sequence[Shard],
    *,
    retry_failed: bool = False,
    device: str = AUTO,
) -> list[ShardRecord]:
    """Make the shards of one place in several variants, whatever is left of an earlier attempt.

    A scene is rendered once for all of them. The bytes of a shard depend on the recipe and the
    shard alone, so that making it again, with others or without, replaces equal bytes.

    Args:
        recipe: of the data set.
        folder: of the data set.
        shards: which; they differ in their variants.
        retry_failed: keep the samples of the shards that are there, and make only failed ones.
        device: of the pixel model and networks, see `texvent.config.RunConfig`; "auto": that of the
            specification.

    Returns:
        Their records, in the same order.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all samples would meet.
    """
    frames, records = KeptFrames(), list[ShardRecord]()
    seeds = sum(recipe.variants[one.variant].seeds for one in shards if one.variant != VIDEOS)
    shared = frames if seeds > 1 and recipe.renders else None
    with ExitStack() as stack:
        runs = (
            _make_shard(recipe, folder, one, records, Making(shared, retry_failed, device))
            for one in shards
        )
        for _ in zip_longest(*(stack.enter_context(closing(run)) for run in runs)):
            frames.clear()
    return records


def _make_shard(
    recipe: Recipe, folder: Path, shard: Shard, records: list[ShardRecord], making: Making
) -> Generator[None]:
    """Make a shard and add its record to `records`; pauses after every clip."""
    path, seconds = inside(folder, shard.path.as_posix()), 0.0
    old = is_complete(recipe, folder, shard) if making.retry_failed else None
    kept = {one.key: one for one in old.samples if one.status != FAILED} if old else {}
    path.parent.mkdir(parents=True, exist_ok=True)
    samples: list[SampleRecord] = []
    inputs = {name: describe_state(name) for name in _inputs_of(recipe, shard)}
    with atomic_file(path, overwrite=True) as part:
        with part.open("wb") as file, tempfile.TemporaryDirectory() as scratch:
            writer = TarShardWriter(file)
            makers = ShardSamples(recipe, folder, shard, Path(scratch), making, kept)
            for _, of_clip in groupby(makers, lambda one: one[0].clip):
                started = time.perf_counter()
                for planned, make in of_clip:
                    old_sample = kept.get(planned.key)
                    if old_sample is None:
                        sample = _made(planned, make, writer)
                    else:
                        sample = _keep(path, old_sample, writer)
                    samples.append(sample)
                seconds += time.perf_counter() - started
                yield
            writer.close()
        with part.open("rb") as file:
            sha256, size = hashlib.file_digest(file, "sha256").hexdigest(), part.stat().st_size
        # Killed after the next line, the shard counts as not made; the record of other samples must
        # not stand beside a new file, which may be as long.
        record_path(path).unlink(missing_ok=True)
    record = ShardRecord(
        inputs=inputs,
        name=shard.name,
        split=shard.split,
        variant=shard.variant,
        identity=recipe.identity,
        sha256=sha256,
        bytes=size,
        samples=tuple(samples),
        seconds=round(seconds, 3),
        versions={"texvent": full_version(), "numpy": np.__version__},
    )
    write_record(path, record)
    records.append(record)


def is_complete(recipe: Recipe, folder: Path, shard: Shard) -> ShardRecord | None:
    """The record of a shard whose file is there, as large as it was; else None.

    Raises:
        FileFormatError: the record is damaged.
    """
    path = inside(folder, shard.path.as_posix())
    record = read_record(path)
    if record is None or record.identity != recipe.identity or not path.is_file():
        return None
    return record if path.stat().st_size == record.bytes else None


def find_replaced(recipe: Recipe, shard: Shard, record: ShardRecord) -> str | None:
    """A file that samples which did not fail depend on, replaced since; None: there is none."""
    names = _inputs_of(recipe, shard, {one.clip for one in record.samples if one.status == FAILED})
    return next((name for name in names if is_replaced(name, record.inputs.get(name))), None)


def _inputs_of(recipe: Recipe, shard: Shard, without: Collection[str] = ()) -> list[str]:
    """Files that the samples of a shard, but for those of some clips, depend on."""
    found = [*recipe.files_named[shard.variant]]
    items = [clip.item for clip in recipe.clips_of(shard) if clip.key not in without]
    for item in items:
        found += [name for name in (item.video, item.boxes) if name]
        found += scenes().files_of(item.subject) if item.scene is not None else ()
    return list(dict.fromkeys(found))


def _keep(path: Path, record: SampleRecord, writer: TarShardWriter) -> SampleRecord:
    """Copy a sample of the shard that is there."""
    if not record.members:
        return record
    members = read_members(path, record.members)
    return replace(record, members=writer.add(record.key, members))


def _made(record: SampleRecord, make: Make, writer: TarShardWriter) -> SampleRecord:
    """Make a sample and add it; one that fails is noted."""
    found: list[str] = []
    try:
        with warnings_to(found.append), finishing_side_work():
            members, facts = make()
    except ENDING_ALL:
        raise
    except (TexventError, MemoryError) as error:
        reason = str(error) or "memory ran out"
        return replace(record, status=FAILED, reason=reason, warnings=tuple(found))
    places = writer.add(record.key, members)
    return replace(record, **facts, members=places, warnings=tuple(found))

"""One shard made: its clips turned into samples, the file written, then its record."""

from __future__ import annotations

import hashlib
import tempfile
import time
from collections.abc import Callable, Collection, Generator, Iterator, Mapping, Sequence
from contextlib import ExitStack, closing
from dataclasses import replace
from functools import partial
from itertools import groupby, zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from texvent._version import full_version
from texvent.dataset.generation.make_sample import (
    count_boxes,
    prepare_clip,
    record_truth,
    sample_members,
    simulate_sample,
)
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard
from texvent.dataset.generation.shard_files import (
    FAILED,
    FILTERED,
    MADE,
    SampleRecord,
    ShardRecord,
    TarShardWriter,
    read_members,
    read_record,
    record_path,
    write_record,
)
from texvent.dataset.specification.clips import Clip, simulation_seed, with_seed
from texvent.dataset.specification.items import KEY_DIGITS
from texvent.errors import InputError, TexventError, warnings_to
from texvent.frames import FrameStream
from texvent.generation.kept_frames import KeptFrames
from texvent.generation.subjects import scenes
from texvent.generation.videos.stored_video import EXTENSION, reopen, write_stream
from texvent.io.atomic import atomic_file
from texvent.pipeline import fit_to_sensor
from texvent.prompt_report import REPORT_KEY
from texvent.run.prepare import make_video, prepare_video
from texvent.runtime.engines import ENDING_ALL
from texvent.runtime.file_names import inside
from texvent.runtime.identity import digest
from texvent.settings.provenance import describe_state, is_replaced
from texvent.settings.resolution import Settings
from texvent.truth.clip import ClipTruth

Members = Mapping[str, bytes]
Make = Callable[[], tuple[Members, dict[str, Any]]]
"""Gives the members of a sample, none of one that is left out, and further facts for its record."""


def make_together(
    recipe: Recipe, folder: Path, shards: Sequence[Shard], *, retry_failed: bool = False
) -> list[ShardRecord]:
    """Make the shards of one place in several variants, whatever is left of an earlier attempt.

    A scene is rendered once for all of them. The bytes of a shard depend on the recipe and the
    shard alone, so that making it again, with others or without, replaces equal bytes.

    Args:
        recipe: of the data set.
        folder: of the data set.
        shards: which; they differ in their variants.
        retry_failed: keep the samples of the shards that are there, and make only failed ones.

    Returns:
        Their records, in the same order.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all samples would meet.
    """
    frames, records = KeptFrames(), list[ShardRecord]()
    seeds = sum(recipe.variants[one.variant].seeds for one in shards if one.variant != VIDEOS)
    shared = frames if seeds > 1 else None
    with ExitStack() as stack:
        runs = (_make_shard(recipe, folder, one, shared, records, retry_failed) for one in shards)
        for _ in zip_longest(*(stack.enter_context(closing(run)) for run in runs)):
            frames.clear()
    return records


def _make_shard(
    recipe: Recipe,
    folder: Path,
    shard: Shard,
    frames: KeptFrames | None,
    records: list[ShardRecord],
    retry_failed: bool,
) -> Generator[None]:
    """Make a shard and add its record to `records`; pauses after every clip."""
    path, seconds = inside(folder, shard.path.as_posix()), 0.0
    old = is_complete(recipe, folder, shard) if retry_failed else None
    kept = {one.key: one for one in old.samples if one.status != FAILED} if old else {}
    path.parent.mkdir(parents=True, exist_ok=True)
    samples: list[SampleRecord] = []
    inputs = {name: describe_state(name) for name in _inputs_of(recipe, shard)}
    with atomic_file(path, overwrite=True) as part:
        with part.open("wb") as file, tempfile.TemporaryDirectory() as scratch:
            writer = TarShardWriter(file)
            makers = _ShardSamples(recipe, folder, shard, Path(scratch), frames)
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
        with warnings_to(found.append):
            members, facts = make()
    except ENDING_ALL:
        raise
    except (TexventError, MemoryError) as error:
        reason = str(error) or "memory ran out"
        return replace(record, status=FAILED, reason=reason, warnings=tuple(found))
    places = writer.add(record.key, members)
    return replace(record, **facts, members=places, warnings=tuple(found))


class _ShardSamples:
    """The samples of a shard: a record that lacks its results, and a `Make`, for each."""

    def __init__(
        self, recipe: Recipe, folder: Path, shard: Shard, scratch: Path, frames: KeptFrames | None
    ) -> None:
        self._recipe, self._shard, self._scratch, self._frames = recipe, shard, scratch, frames
        self._labels = {label: number for number, label in enumerate(recipe.items.labels)}
        self._stored: StoredVideos | None = None
        if recipe.stores_videos and shard.variant != VIDEOS:
            self._stored = StoredVideos(folder, replace(shard, variant=VIDEOS), scratch)

    def __iter__(self) -> Iterator[tuple[SampleRecord, Make]]:
        for clip in self._recipe.clips_of(self._shard):
            if self._shard.variant == VIDEOS:
                yield _record(clip.key, clip, clip.seed), partial(self._make_video, clip)
                continue
            variant = self._recipe.variants[self._shard.variant]
            settings = self._recipe.settings[variant.name].of(clip)
            for number in range(variant.seeds):
                key = digest([clip.key, variant.name, number])[:KEY_DIGITS]
                seed = simulation_seed(clip, number)
                make = partial(self._make_events, key, clip, with_seed(settings, seed))
                yield _record(key, clip, seed), make

    def _make_video(self, clip: Clip) -> tuple[Members, dict[str, Any]]:
        settings = self._recipe.settings[VIDEOS].of(clip)
        settings = replace(settings, run=replace(settings.run, sensor=None))  # its generator's size
        path = self._scratch / f"{clip.key}{EXTENSION}"
        stored = write_stream(make_video(clip.item.subject, settings), path, overwrite=True)
        content = path.read_bytes()
        path.unlink()
        width, height = stored.size
        report = stored.metadata.get(REPORT_KEY)
        return (
            {EXTENSION[1:]: content, "txt": (clip.item.prompt or "").encode()},
            {"width": width, "height": height, REPORT_KEY: report},
        )

    def _make_events(
        self, key: str, clip: Clip, settings: Settings
    ) -> tuple[Members, dict[str, Any]]:
        item, specification = clip.item, self._recipe.specification
        if self._stored is None:
            simulation = prepare_clip(self._recipe, clip, settings, self._frames)
        else:
            video = fit_to_sensor(self._stored.open(clip), settings)
            simulation = prepare_video(video, settings, prompt=item.prompt)
        recorder = record_truth(specification, item, simulation) if specification.truth else None
        on_frame = None if recorder is None else recorder.append
        simulated = simulate_sample(simulation, specification.filters, on_frame)
        known = {
            "signal_events": simulated.signal_events,
            REPORT_KEY: simulation.provenance.get(REPORT_KEY),
        }
        if simulated.left_out is not None:
            return {}, {"status": FILTERED, "reason": simulated.left_out, **known}
        width, height = simulation.video.size
        known |= {
            "events": len(simulated.events),
            "start_us": simulated.start_us,
            "duration_us": simulated.duration_us,
            "width": width,
            "height": height,
        }
        truth = None if recorder is None else recorder.finish()
        facts = {
            **simulation.provenance,
            **known,
            "key": key,
            "clip": clip.key,
            "split": clip.split,
            "variant": self._shard.variant,
            "label": item.label,
            **({} if truth is None else {"truth": truth.facts}),
        }
        members = sample_members(
            simulated,
            facts,
            class_number=None if item.label is None else self._labels[item.label],
            preview=specification.previews,
            truth={} if truth is None else truth.members,
        )
        return members, {**known, **count_boxes(ClipTruth(members.__getitem__, key))}


def _record(key: str, clip: Clip, seed: int) -> SampleRecord:
    item = clip.item
    return SampleRecord(
        key=key,
        clip=clip.key,
        status=MADE,
        seed=seed,
        prompt=item.prompt,
        label=item.label,
        is_scene=item.scene is not None,
    )


class StoredVideos:
    """The videos of a shard of the first stage."""

    def __init__(self, folder: Path, shard: Shard, scratch: Path) -> None:
        self._shard, self._scratch = shard, scratch
        self._path = inside(folder, shard.path.as_posix())
        record = read_record(self._path)
        if record is None:
            raise InputError(f"{self._path} is not made yet; make the shards of videos first")
        self._samples = {sample.key: sample for sample in record.samples}

    def open(self, clip: Clip) -> FrameStream:
        """The video of a clip.

        Raises:
            InputError: it could not be made.
        """
        sample = self._samples[clip.key]
        if sample.status != MADE:
            raise InputError(f"its video was not made: {sample.reason}")
        place = self._scratch / f"video{EXTENSION}"
        place.write_bytes(read_members(self._path, sample.members, (EXTENSION[1:],))["avi"])
        video = reopen(place)
        if video is None:
            raise InputError(f"{self._path} holds no video for {clip.key}")
        return video.with_metadata(stored=str(self._shard.path))

"""One shard made: its clips turned into samples, the file written, then its record."""

from __future__ import annotations

import hashlib
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from texvent._version import full_version
from texvent.batch.engines import ENDING_ALL
from texvent.batch.identity import digest
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard
from texvent.dataset.generation.sample import (
    prepare_clip,
    sample_members,
    simulate_sample,
    with_seed,
)
from texvent.dataset.generation.shards import (
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
from texvent.dataset.specification.clips import Clip, clip_settings, simulation_seed, video_settings
from texvent.dataset.specification.items import KEY_DIGITS
from texvent.dataset.specification.specification import Variant
from texvent.errors import InputError, TexventError, warnings_to
from texvent.generate.videos.stored_video import EXTENSION, reopen, write_stream
from texvent.io.atomic import atomic_file
from texvent.pipeline import Simulation, fit_to_sensor
from texvent.run.prepare import make_video, prepare_video
from texvent.scenes.report import REPORT_KEY
from texvent.settings.resolution import Settings
from texvent.video import FrameStream

OnSample = Callable[[SampleRecord], None]
Members = Mapping[str, bytes]


@dataclass(frozen=True)
class _Job:
    """A sample to make."""

    record: SampleRecord
    """All but its status."""
    make: Callable[[], tuple[Members, dict[str, Any]]]
    """Its members, none of one that is left out, and further facts for its record."""


def make_shard(
    recipe: Recipe,
    folder: Path,
    shard: Shard,
    *,
    retry_failed: bool = False,
    on_sample: OnSample | None = None,
) -> ShardRecord:
    """Make a shard, whatever is left of an earlier attempt.

    Its bytes depend on the recipe and the shard alone, so that making it twice replaces equal
    bytes.

    Args:
        recipe: of the data set.
        folder: of the data set.
        shard: which.
        retry_failed: keep the samples of the shard that is there, and make only failed ones.
        on_sample: given every sample as it ends.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all samples would meet.
    """
    path, started = folder / shard.path, time.perf_counter()
    old = read_record(path) if retry_failed else None
    kept = {one.key: one for one in old.samples if one.status != FAILED} if old else {}
    path.parent.mkdir(parents=True, exist_ok=True)
    samples: list[SampleRecord] = []
    with atomic_file(path, overwrite=True) as part:
        with part.open("wb") as file, tempfile.TemporaryDirectory() as scratch:
            writer = TarShardWriter(file)
            for job in _jobs(recipe, folder, shard, Path(scratch)):
                old_sample = kept.get(job.record.key)
                sample = (
                    _made(job, writer) if old_sample is None else _keep(path, old_sample, writer)
                )
                samples.append(sample)
                if on_sample is not None:
                    on_sample(sample)
            writer.close()
        with part.open("rb") as file:
            sha256, size = hashlib.file_digest(file, "sha256").hexdigest(), part.stat().st_size
        # Killed after the next line, the shard counts as not made; the record of other samples must
        # not stand beside a new file, which may be as long.
        record_path(path).unlink(missing_ok=True)
    record = ShardRecord(
        name=shard.name,
        split=shard.split,
        variant=shard.variant,
        identity=recipe.identity,
        sha256=sha256,
        bytes=size,
        samples=tuple(samples),
        seconds=round(time.perf_counter() - started, 3),
        versions={"texvent": full_version(), "numpy": np.__version__},
    )
    write_record(path, record)
    return record


def is_complete(recipe: Recipe, folder: Path, shard: Shard) -> ShardRecord | None:
    """The record of a shard whose file is there, as large as it was; else None.

    Raises:
        FileFormatError: the record is damaged.
    """
    path = folder / shard.path
    record = read_record(path)
    if record is None or record.identity != recipe.identity or not path.is_file():
        return None
    return record if path.stat().st_size == record.bytes else None


def _keep(path: Path, record: SampleRecord, writer: TarShardWriter) -> SampleRecord:
    """Copy a sample of the shard that is there."""
    if not record.members:
        return record
    members = read_members(path, record.members)
    return replace(record, members=writer.add(record.key, members))


def _made(job: _Job, writer: TarShardWriter) -> SampleRecord:
    """Make a sample and add it; one that fails is noted."""
    found: list[str] = []
    try:
        with warnings_to(found.append):
            members, facts = job.make()
    except ENDING_ALL:
        raise
    except (TexventError, MemoryError) as error:
        reason = str(error) or "memory ran out"
        return replace(job.record, status=FAILED, reason=reason, warnings=tuple(found))
    places = writer.add(job.record.key, members)
    return replace(job.record, **facts, members=places, warnings=tuple(found))


def _jobs(recipe: Recipe, folder: Path, shard: Shard, scratch: Path) -> Iterator[_Job]:
    if shard.variant == VIDEOS:
        for clip in recipe.clips_of(shard):
            yield _video_job(recipe, clip, scratch)
        return
    variant = recipe.variants[shard.variant]
    source = _source(recipe, folder, shard, scratch)
    labels = {label: number for number, label in enumerate(recipe.items.labels)}
    for clip in recipe.clips_of(shard):
        settings = clip_settings(
            recipe.specification,
            variant,
            clip,
            recipe.command,
            is_stored=recipe.stores_videos,
        )
        for number in range(variant.seeds):
            yield _events_job(recipe, variant, clip, number, settings, source, labels)


def _video_job(recipe: Recipe, clip: Clip, scratch: Path) -> _Job:
    settings = video_settings(recipe.specification, clip, recipe.command)

    def make() -> tuple[Members, dict[str, Any]]:
        video = make_video(clip.item.subject, settings)
        path = scratch / f"{clip.key}{EXTENSION}"
        stored = write_stream(video, path, overwrite=True)
        content = path.read_bytes()
        path.unlink()
        width, height = stored.size
        return {EXTENSION[1:]: content, "txt": (clip.item.prompt or "").encode()}, {
            "width": width,
            "height": height,
            REPORT_KEY: stored.metadata.get(REPORT_KEY),
        }

    return _Job(_record(clip.key, clip, clip.seed), make)


Source = Callable[[Clip, Settings], Simulation]


def _events_job(
    recipe: Recipe,
    variant: Variant,
    clip: Clip,
    number: int,
    settings: Settings,
    source: Source,
    labels: Mapping[str, int],
) -> _Job:
    key = digest([clip.key, variant.name, number])[:KEY_DIGITS]
    seed = simulation_seed(clip, number)
    record = _record(key, clip, seed)

    def make() -> tuple[Members, dict[str, Any]]:
        simulation = source(clip, with_seed(settings, seed))
        simulated = simulate_sample(simulation, recipe.specification.filters)
        facts_of_run = {
            "signal_events": simulated.signal_events,
            REPORT_KEY: simulation.provenance.get(REPORT_KEY),
        }
        if simulated.left_out is not None:
            return {}, {"status": FILTERED, "reason": simulated.left_out, **facts_of_run}
        width, height = simulation.video.size
        known = {
            **facts_of_run,
            "events": len(simulated.events),
            "start_us": simulated.start_us,
            "duration_us": simulated.duration_us,
            "width": width,
            "height": height,
        }
        facts = {
            **simulation.provenance,
            **known,
            "key": key,
            "clip": clip.key,
            "split": clip.split,
            "variant": variant.name,
            "label": clip.item.label,
        }
        members = sample_members(
            simulated,
            facts,
            class_number=None if clip.item.label is None else labels[clip.item.label],
            preview=recipe.specification.previews,
        )
        return members, known

    return _Job(record, make)


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


def _source(recipe: Recipe, folder: Path, shard: Shard, scratch: Path) -> Source:
    """Source of the clips of a shard: recorded, stored, or made now."""
    if recipe.stores_videos:
        stored = _StoredVideos(folder, replace(shard, variant=VIDEOS), scratch)
        return lambda clip, settings: prepare_video(
            fit_to_sensor(stored.open(clip), settings), settings, prompt=clip.item.prompt
        )
    return partial(prepare_clip, recipe)


class _StoredVideos:
    """The videos of a shard of the first stage."""

    def __init__(self, folder: Path, shard: Shard, scratch: Path) -> None:
        self._shard, self._path, self._scratch = shard, folder / shard.path, scratch
        record = read_record(self._path)
        if record is None:
            raise InputError(f"{self._path} is not made yet; make the shards of videos first")
        self._samples = {sample.key: sample for sample in record.samples}
        self._open: tuple[str, FrameStream] | None = None

    def open(self, clip: Clip) -> FrameStream:
        """The video of a clip.

        Raises:
            InputError: it could not be made.
        """
        if self._open is not None and self._open[0] == clip.key:
            return self._open[1]
        sample = self._samples[clip.key]
        if sample.status != MADE:
            raise InputError(f"its video was not made: {sample.reason}")
        place = self._scratch / f"video{EXTENSION}"
        place.write_bytes(read_members(self._path, sample.members, (EXTENSION[1:],))["avi"])
        video = reopen(place)
        if video is None:
            raise InputError(f"{self._path} holds no video for {clip.key}")
        self._open = (clip.key, video.with_metadata(stored=str(self._shard.path)))
        return self._open[1]

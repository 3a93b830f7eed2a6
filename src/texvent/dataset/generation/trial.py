"""What a data set will take: measured on a few of its samples, before it is made."""

from __future__ import annotations

import bisect
import contextlib
import dataclasses
import itertools
import math
import random
import statistics
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path

from texvent.batch.processes import interruptible
from texvent.batch.processes import processes as start_processes
from texvent.dataset.generation.make_shard import make_shard
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard, load_recipe_once
from texvent.dataset.generation.records import FAILED, MADE, ShardRecord
from texvent.dataset.generation.tar_shard import size_in_tar
from texvent.errors import TexventError
from texvent.runtime.progress import Progress
from texvent.runtime.threads import count_threads

LIMIT_S = 30.0
"""Each of the two rounds of a stage takes no longer than this, but for the sample at hand."""


@dataclass(frozen=True)
class StageEstimate:
    """The videos, or a variant, as far as a trial can tell."""

    name: str
    samples: int
    """In all, before filters."""
    shards: int
    records: tuple[ShardRecord, ...]
    """Of the trial."""
    events: float = 0.0
    """Mean events of a sample that was made."""
    bytes: float = 0.0
    """Mean bytes per sample in the shards."""
    seconds: float = 0.0
    """Mean working time per sample."""
    seconds_error: float = 0.0
    """Standard error of that mean, from how much samples differ."""

    @property
    def tried(self) -> int:
        """Samples of the trial."""
        return sum(len(record.samples) for record in self.records)

    def share(self, status: str) -> float:
        """Share of the trial with a status, such as `records.FILTERED`."""
        return sum(record.count(status) for record in self.records) / max(self.tried, 1)


def try_samples(
    recipe: Recipe, clips: int, progress: Progress, *, workers: int = 1
) -> list[StageEstimate]:
    """Make a few clips in every variant, in a folder that is removed.

    All are made twice, and the second time counts, when every kernel is compiled. A stage of slow
    samples is tried with fewer of them. Several processes make them as in the whole run, because
    cores that share caches and memory are slower than one of them alone.

    Args:
        recipe: of the data set.
        clips: how many of them, at least one per process.
        progress: told of every process that has ended.
        workers: processes, at most one per core.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all samples would meet.
    """
    processes = min(workers, count_threads())
    # One clip per shard, so that any can be had.
    single = Recipe(dataclasses.replace(recipe.specification, samples_per_shard=1), recipe.items)
    places = _draw_places(single, max(clips, processes))
    stages = [*([VIDEOS] if recipe.stores_videos else []), *recipe.variants]
    results: list[StageEstimate] = []
    with tempfile.TemporaryDirectory() as name, contextlib.ExitStack() as ending:
        folder = Path(name) / "set"
        single.begin(folder)
        pool = ending.enter_context(start_processes(processes)) if processes > 1 else None
        for stage in stages:
            # A learned model is loaded once, as in the whole run.
            count = 1 if stage == VIDEOS else processes
            shards = [Shard(stage, *place) for place in places]
            records: list[ShardRecord] = []
            for part in _try_parts(
                pool, folder, [shards[number::count] for number in range(count)]
            ):
                records += part
                done = len(results) * len(places) + len(records)
                progress.advance("trial", done, len(stages) * len(places))
            if stage == VIDEOS:
                places = places[: len(records)]
            seeds = 1 if stage == VIDEOS else recipe.variants[stage].seeds
            results.append(_estimate(recipe, stage, seeds, records))
    return results


def _try_parts(
    pool: Executor | None, folder: Path, parts: Sequence[Sequence[Shard]]
) -> Iterator[list[ShardRecord]]:
    if pool is None:
        yield from map(_try_shards, itertools.repeat(folder), parts)
        return
    try:
        yield from pool.map(_try_in_process, itertools.repeat(folder), parts)
    except BrokenProcessPool as error:
        raise TexventError(
            "a process of the trial died, perhaps for want of memory; plan with fewer --workers"
        ) from error


def _try_in_process(folder: Path, shards: Sequence[Shard]) -> list[ShardRecord]:
    with interruptible():
        return _try_shards(folder, shards)


def _try_shards(folder: Path, shards: Sequence[Shard]) -> list[ShardRecord]:
    """Make shards twice, in this process; the records of the second time."""
    recipe = load_recipe_once(folder)
    records: list[ShardRecord] = []
    for _ in range(2):
        shards, records = shards[: len(records) or None], []
        for shard in shards:
            records.append(make_shard(recipe, folder, shard))
            if sum(record.seconds for record in records) > LIMIT_S:
                break
    return records


def _draw_places(recipe: Recipe, clips: int) -> list[tuple[str, int]]:
    """Places of clips, drawn by chance and yet the same every time.

    Evenly spaced ones would meet some words of a template only.
    """
    counts = recipe.clips.counts
    ends = list(itertools.accumulate(counts.values()))
    chance = random.Random(recipe.specification.seed)
    chosen = []
    for number in chance.sample(range(ends[-1]), min(clips, ends[-1])):
        place = bisect.bisect_right(ends, number)
        split = list(counts)[place]
        chosen.append((split, number - ends[place] + counts[split]))
    return chosen


def _estimate(recipe: Recipe, stage: str, seeds: int, records: list[ShardRecord]) -> StageEstimate:
    samples = [sample for record in records for sample in record.samples]
    made = [sample for sample in samples if sample.status == MADE]
    failed = [sample for sample in samples if sample.status == FAILED]
    if failed and not made:
        raise TexventError(f"every sample of the trial of {stage} failed: {failed[0].reason}")
    tried = max(len(samples), 1)
    per_sample = [record.seconds / max(len(record.samples), 1) for record in records]
    spread = statistics.stdev(per_sample) if len(per_sample) > 1 else 0.0
    return StageEstimate(
        name=stage,
        samples=sum(recipe.clips.counts.values()) * seeds,
        shards=sum(1 for _ in recipe.shards(stage)),
        records=tuple(records),
        events=sum(one.events for one in made) / max(len(made), 1),
        bytes=sum(size_in_tar(size) for one in made for _, size in one.members.values()) / tried,
        seconds=sum(record.seconds for record in records) / tried,
        seconds_error=spread / math.sqrt(max(len(per_sample), 1)),
    )

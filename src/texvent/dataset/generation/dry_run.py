"""Dry run: cost of a data set, measured on a few of its samples."""

from __future__ import annotations

import bisect
import contextlib
import dataclasses
import itertools
import random
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from texvent.batch.engines import Engine, local_engine
from texvent.dataset.generation.make import ShardTask
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard
from texvent.dataset.generation.shards import FAILED, MADE, ShardRecord, size_in_tar
from texvent.errors import TexventError
from texvent.runtime.progress import Progress
from texvent.runtime.threads import count_threads

LIMIT_S = 30.0
"""From then on, a stage begins no further sample."""


@dataclass(frozen=True)
class StageEstimate:
    """Cost of the videos, or of a variant, estimated by a trial."""

    name: str
    samples: int
    """In all, before filters."""
    records: tuple[ShardRecord, ...]
    """Records of the trial."""
    events: float
    """Mean events of a sample that was made."""
    bytes: float
    """Mean bytes per sample in the shards."""
    seconds: float
    """Mean working time per sample."""

    @property
    def tried(self) -> int:
        """Samples of the trial."""
        return sum(len(record.samples) for record in self.records)

    def share(self, status: str) -> float:
        """Share of the trial with a status, such as `shards.FILTERED`."""
        return sum(record.count(status) for record in self.records) / max(self.tried, 1)


def try_samples(
    recipe: Recipe, clips: int, progress: Progress, *, workers: int = 1
) -> list[StageEstimate]:
    """Make a few clips in every variant, in a folder that is removed.

    Several processes make them as in the whole run, because cores that share caches and memory are
    slower than one of them alone. A stage of slow samples is tried with fewer of them.

    Args:
        recipe: of the data set.
        clips: how many of them, at least one per process.
        progress: receives the number of finished stages.
        workers: processes, at most one per core.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all samples would meet.
    """
    processes = min(workers, count_threads())
    # One clip per shard, so that any can be had.
    single = Recipe(dataclasses.replace(recipe.specification, samples_per_shard=1), recipe.items)
    places = _draw_places(single, max(clips, processes))
    results: list[StageEstimate] = []
    with (
        tempfile.TemporaryDirectory() as name,
        contextlib.closing(local_engine(processes)) as engine,
    ):
        folder = Path(name).absolute() / "set"
        single.begin(folder)
        for stage in recipe.stages:
            tasks = [ShardTask(folder, Shard(stage, *place)) for place in places]
            _make(tasks[:processes], engine)  # compiles the kernels
            records, stop = list[ShardRecord](), time.monotonic() + LIMIT_S
            for begin in range(0, len(tasks), processes):
                records += _make(tasks[begin : begin + processes], engine)
                if time.monotonic() > stop:
                    break
            if stage == VIDEOS:
                places = places[: len(records)]
            results.append(_estimate(recipe, stage, records))
            progress.advance("trial", len(results), len(recipe.stages))
    return results


def _make(tasks: Sequence[ShardTask], engine: Engine) -> list[ShardRecord]:
    """Records of shards that are made at once.

    Raises:
        TexventError: one could not be made.
    """
    for task in tasks:
        engine.submit(task)
    outcomes = [engine.next() for _ in tasks]
    for outcome in outcomes:
        if outcome.failure is not None:
            raise TexventError(f"the trial failed: {outcome.failure}")
    return [outcome.result for outcome in outcomes]


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


def _estimate(recipe: Recipe, stage: str, records: list[ShardRecord]) -> StageEstimate:
    samples = [sample for record in records for sample in record.samples]
    made = [sample for sample in samples if sample.status == MADE]
    failed = [sample for sample in samples if sample.status == FAILED]
    if failed and not made:
        raise TexventError(f"every sample of the trial of {stage} failed: {failed[0].reason}")
    seeds = 1 if stage == VIDEOS else recipe.variants[stage].seeds
    return StageEstimate(
        name=stage,
        samples=sum(recipe.clips.counts.values()) * seeds,
        records=tuple(records),
        events=sum(one.events for one in made) / max(len(made), 1),
        bytes=sum(size_in_tar(size) for one in made for _, size in one.members.values())
        / max(len(samples), 1),
        seconds=sum(record.seconds for record in records) / max(len(samples), 1),
    )

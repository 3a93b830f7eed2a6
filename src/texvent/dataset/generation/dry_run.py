"""Dry run: cost of a data set, measured on a few of its samples."""

from __future__ import annotations

import contextlib
import dataclasses
import random
import tempfile
from dataclasses import dataclass
from pathlib import Path

from texvent.dataset.generation.make import find_work
from texvent.dataset.generation.recipe import VIDEOS, Recipe
from texvent.dataset.generation.shard_files import FAILED, MADE, ShardRecord, size_in_tar
from texvent.dataset.specification.items import Items
from texvent.errors import TexventError
from texvent.runtime.progress import Progress
from texvent.runtime.threads import count_threads
from texvent.runtime.work.engines import Outcome, local_engine


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
    slower than one of them alone.

    Args:
        recipe: of the data set.
        clips: how many of them, at least one per process; drawn by chance and yet the same every
            time.
        progress: receives the number of finished shards.
        workers: processes, at most one per core.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all samples would meet.
        TexventError: a shard could not be made, or every sample of a variant failed.
    """
    processes, items = min(workers, count_threads()), recipe.items.all
    chance = random.Random(recipe.specification.seed)
    drawn = chance.sample(items, min(max(clips, processes), len(items)))
    chosen = tuple(dataclasses.replace(item, split=None) for item in drawn)
    sources = tuple(dataclasses.replace(one, split=None) for one in recipe.specification.sources)
    specification = dataclasses.replace(
        recipe.specification, sources=sources, samples_per_shard=1, repeats=1, splits={"trial": 1.0}
    )
    # The first round compiles the kernels in every process; videos of a model are made once.
    rounds = [chosen] if recipe.stores_videos else [chosen[:processes], chosen]
    records: dict[str, list[ShardRecord]] = {}

    def note(outcome: Outcome) -> None:
        if outcome.failure is not None:
            raise TexventError(f"the trial failed: {outcome.failure}")
        for shard, record in zip(outcome.task.units, outcome.result, strict=True):
            records[shard.variant].append(record)
        progress.advance("trial", sum(map(len, records.values())), len(chosen) * len(records))

    with (
        tempfile.TemporaryDirectory() as name,
        contextlib.closing(local_engine(processes)) as engine,
    ):
        for number, some in enumerate(rounds):
            trial, folder = Recipe(specification, Items(some)), Path(name).absolute() / str(number)
            records.update((stage, []) for stage in recipe.stages)
            trial.begin(folder)
            for outcome in find_work(trial, folder).make(engine):
                note(outcome)
    return [_estimate(recipe, stage, records[stage]) for stage in recipe.stages]


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

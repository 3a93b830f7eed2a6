"""What a data set will take: measured on a few of its samples, before it is made."""

from __future__ import annotations

import dataclasses
import tempfile
from dataclasses import dataclass
from pathlib import Path

from texvent.dataset.generation.make_shard import make_shard
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard
from texvent.dataset.generation.records import FAILED, MADE, ShardRecord
from texvent.dataset.generation.tar_shard import size_in_tar
from texvent.errors import TexventError
from texvent.runtime.background_jit import wait_until_idle
from texvent.runtime.progress import Progress

LIMIT_S = 30.0
"""Each of the two rounds of a stage takes no longer than this, but for the sample at hand."""


@dataclass(frozen=True)
class StageEstimate:
    """The videos, or a variant, as far as a trial can tell."""

    name: str
    samples: int
    """In all, before filters."""
    shards: int
    tried: int
    """Samples of the trial."""
    made: int = 0
    """Of those, how many were neither filtered out nor failed."""
    events: float = 0.0
    """Mean events of a sample that was made."""
    bytes: float = 0.0
    """Mean bytes per sample in the shards."""
    seconds: float = 0.0
    """Mean working time per sample."""
    reasons: tuple[str, ...] = ()
    """Why samples of the trial are not there."""


def try_samples(recipe: Recipe, clips: int, progress: Progress) -> list[StageEstimate]:
    """Make a few clips in every variant, in a folder that is removed.

    All are made twice, and the second time counts, when every kernel is compiled. A stage of slow
    samples is tried with fewer of them.

    Args:
        recipe: of the data set.
        clips: how many of them.
        progress: told of every sample.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all samples would meet.
    """
    # One clip per shard, so that any can be had.
    single = Recipe(dataclasses.replace(recipe.specification, samples_per_shard=1), recipe.items)
    places = _spread(single, clips)
    stages = [*([VIDEOS] if recipe.stores_videos else []), *recipe.variants]
    results: list[StageEstimate] = []
    with tempfile.TemporaryDirectory() as name:
        for stage in stages:
            records: list[ShardRecord] = []
            for again in range(2):
                wait_until_idle()
                done = (2 * len(results) + again) * len(places)
                shards = [Shard(stage, *place) for place in places[: len(records) or None]]
                records = []
                for shard in shards:
                    records.append(make_shard(single, Path(name), shard))
                    progress.advance("trial", done + len(records), 2 * len(stages) * len(places))
                    if sum(record.seconds for record in records) > LIMIT_S:
                        break
            seeds = 1 if stage == VIDEOS else recipe.variants[stage].seeds
            results.append(_estimate(recipe, stage, seeds, records))
    return results


def _spread(recipe: Recipe, clips: int) -> list[tuple[str, int]]:
    """Places of clips, evenly over all."""
    places = [(split, count) for split, count in recipe.clips.counts.items() if count]
    total = sum(count for _, count in places)
    chosen = []
    for index in range(min(clips, total)):
        number = index * total // min(clips, total)
        for split, count in places:
            if number < count:
                chosen.append((split, number))
                break
            number -= count
    return chosen


def _estimate(recipe: Recipe, stage: str, seeds: int, records: list[ShardRecord]) -> StageEstimate:
    samples = [sample for record in records for sample in record.samples]
    made = [sample for sample in samples if sample.status == MADE]
    failed = [sample for sample in samples if sample.status == FAILED]
    if failed and not made:
        raise TexventError(f"every sample of the trial of {stage} failed: {failed[0].reason}")
    tried = max(len(samples), 1)
    return StageEstimate(
        name=stage,
        samples=sum(recipe.clips.counts.values()) * seeds,
        shards=sum(1 for _ in recipe.shards(stage)),
        tried=len(samples),
        made=len(made),
        events=sum(one.events for one in made) / max(len(made), 1),
        bytes=sum(size_in_tar(size) for one in made for _, size in one.members.values()) / tried,
        seconds=sum(record.seconds for record in records) / tried,
        reasons=tuple(dict.fromkeys(one.reason or "" for one in samples if one.status != MADE)),
    )

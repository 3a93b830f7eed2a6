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
from texvent.runtime.progress import Progress

LIMIT_S = 60.0
"""A stage is tried no longer than this, but for the sample at hand."""


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

    The first clip is made once more beforehand, so that compiling is not counted. A stage of slow
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
    numbers = _spread(single, clips)
    stages = [*([VIDEOS] if recipe.stores_videos else []), *recipe.variants]
    total = len(stages) * (len(numbers) + 1)
    results: list[StageEstimate] = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for stage in stages:
            seeds = 1 if stage == VIDEOS else recipe.variants[stage].seeds
            records: list[ShardRecord] = []
            for split, number in [*numbers[:1], *numbers]:
                records.append(make_shard(single, folder, Shard(stage, split, number)))
                progress.advance("trial", len(results) * (len(numbers) + 1) + len(records), total)
                if sum(record.seconds for record in records) > LIMIT_S:
                    break
            results.append(_estimate(recipe, stage, seeds, records[1:] or records))
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

"""Dry run: cost of a data set, measured on a few of its samples, and its prompts read."""

from __future__ import annotations

import bisect
import contextlib
import dataclasses
import itertools
import math
import random
import statistics
import tempfile
import time
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from texvent.dataset.generation.engines import (
    Engine,
    Outcome,
    ProcessEngine,
    Task,
    in_this_process,
)
from texvent.dataset.generation.recipe import (
    SPECIFICATION_FILE,
    VIDEOS,
    Recipe,
    Shard,
)
from texvent.dataset.generation.shards import FAILED, MADE, ShardRecord, size_in_tar
from texvent.dataset.specification.items import Item
from texvent.dataset.specification.option_ranges import is_range
from texvent.errors import InputError, TexventError, shown
from texvent.run.prepare import is_strict, report_prompt
from texvent.runtime.progress import Progress
from texvent.runtime.threads import count_threads
from texvent.scenes.report import PromptReport, ReportTally
from texvent.settings.resolution import Settings, resolve

MOST_READ = 2_000
"""Prompts that a plan reads, drawn by chance from more; 2,000 take a few seconds."""


def tally_prompts(recipe: Recipe) -> ReportTally | None:
    """Counts of understood prompts, of at most `MOST_READ`, read without their scenes.

    Returns:
        The counts; None for videos, and for learned generators, which give no report.
    """
    if recipe.items.are_videos:
        return None
    items: Sequence[Item] = recipe.items.all
    if len(items) > MOST_READ:
        items = random.Random(recipe.specification.seed).sample(items, MOST_READ)
    tally = ReportTally()
    for _, result in _read(items, _settings(recipe)):
        if result is None:
            return None
        tally.add(result if isinstance(result, PromptReport) else None)
    return tally


def refuse_prompts(recipe: Recipe, folder: Path) -> None:
    """Refuse a data set with wrong scenes, or with prompts that `strict` refuses, before any work.

    All prompts are read, about a millisecond for each. Errors that only the built scene shows
    fail its sample later.

    Args:
        recipe: of the data set.
        folder: of the data set; one that was begun is not read again.

    Raises:
        InputError: there are such prompts, or scenes that name files that are not there.
        ConfigError: a field of a scene is wrong.
    """
    if recipe.items.are_videos or (folder / SPECIFICATION_FILE).exists():
        return
    settings = _settings(recipe)
    items = [item for item in recipe.items.all if item.scene is not None or is_strict(settings)]
    refused = {
        item.prompt or "": str(result)
        for item, result in _read(items, settings)
        if isinstance(result, InputError)
    }
    if refused:
        prompt, reason = next(iter(refused.items()))
        raise InputError(
            f"{len(refused):,} of {len(recipe.items.all):,} prompts are refused, such as "
            f"{shown(prompt) if prompt else 'a scene'}: {reason}"
        )


def _read(
    items: Iterable[Item], settings: Settings
) -> Iterator[tuple[Item, PromptReport | InputError | None]]:
    for item in items:
        try:
            yield item, report_prompt(item.subject, settings, is_staged=False)
        except InputError as error:
            yield item, error


def _settings(recipe: Recipe) -> Settings:
    """The settings that all prompts share; ranges are left out."""
    options = recipe.specification.options
    return resolve("generate", {n: value for n, value in options.items() if not is_range(value)})


LIMIT_S = 30.0
"""From then on, a round of a stage begins no further sample."""


@dataclass(frozen=True)
class StageEstimate:
    """Cost of the videos, or of a variant, estimated by a trial."""

    name: str
    samples: int
    """In all, before filters."""
    shards: int
    records: tuple[ShardRecord, ...]
    """Records of the trial."""
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
        progress: receives the number of finished samples.
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
    engine: Engine = in_this_process() if processes == 1 else ProcessEngine(processes)
    with tempfile.TemporaryDirectory() as name, contextlib.closing(engine):
        folder = Path(name).absolute() / "set"
        single.begin(folder)
        for number, stage in enumerate(stages):
            tasks = [Task(folder, Shard(stage, *place)) for place in places]
            tasks = [outcome.task for outcome in _make(tasks, engine)]
            records = [outcome.record for outcome in _make(tasks, engine) if outcome.record]
            if stage == VIDEOS:
                places = [(task.shard.split, task.shard.number) for task in tasks]
            seeds = 1 if stage == VIDEOS else recipe.variants[stage].seeds
            results.append(_estimate(recipe, stage, seeds, records))
            progress.advance("trial", number + 1, len(stages))
    return results


def _make(tasks: Sequence[Task], engine: Engine) -> list[Outcome]:
    """Make shards until `LIMIT_S`; those begun are finished.

    Raises:
        TexventError: one could not be made.
    """
    is_video = tasks[0].shard.variant == VIDEOS
    waiting, running, outcomes = deque(tasks), 0, list[Outcome]()
    stop = time.monotonic() + LIMIT_S
    while waiting or running:
        while waiting and running < engine.capacity(videos=is_video):
            engine.submit(waiting.popleft())
            running += 1
        outcomes.append(engine.next())
        running -= 1
        if outcomes[-1].failure is not None:
            raise TexventError(f"the trial failed: {outcomes[-1].failure}")
        if time.monotonic() > stop:
            waiting.clear()
    return outcomes


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

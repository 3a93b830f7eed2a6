"""A data set made: every incomplete shard, in two stages where videos are stored."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from contextlib import closing
from dataclasses import dataclass, field, replace
from pathlib import Path

from texvent.dataset.generation.dry_run import refuse_prompts
from texvent.dataset.generation.engines import Engine, Outcome, ProcessEngine, Task, in_this_process
from texvent.dataset.generation.make_shard import is_complete
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard
from texvent.dataset.generation.shards import FAILED, ShardSummary
from texvent.dataset.specification.reading import read_specification
from texvent.dataset.specification.specification import Specification
from texvent.errors import ConfigError
from texvent.io.atomic import sweep
from texvent.runtime.progress import ProgressOption, open_progress

OnOutcome = Callable[[Outcome], None]


@dataclass
class Work:
    """Shards to make, complete shards and failures."""

    complete: dict[Shard, ShardSummary] = field(default_factory=dict)
    todo: list[Task] = field(default_factory=list)
    """Shards of events, in order."""
    videos_todo: list[Task] = field(default_factory=list)
    failures: dict[Shard, str] = field(default_factory=dict)
    """Shards that could not be made."""


def find_work(
    recipe: Recipe, folder: Path, *, part: tuple[int, int] = (1, 1), retry_failed: bool = False
) -> Work:
    """Complete shards and those to make.

    Args:
        recipe: of the data set.
        folder: of the data set.
        part: (K, N): of N parts of all shards, the K-th, 1 ≤ K ≤ N.
        retry_failed: whether shards with failed samples are made again.

    Raises:
        ConfigError: there is no such part.
        FileFormatError: the record of a shard is damaged.
    """
    which, parts = part
    if not 1 <= which <= parts:
        raise ConfigError(f"shards is {which}/{parts}; it must be K/N with 1 ≤ K ≤ N")
    work = Work()
    stages = [*([VIDEOS] if recipe.stores_videos else []), *recipe.variants]
    for stage in stages:
        tasks = work.videos_todo if stage == VIDEOS else work.todo
        for number, shard in enumerate(recipe.shards(stage)):
            if number % parts != which - 1:
                continue
            record = is_complete(recipe, folder, shard)
            again = retry_failed and record is not None and record.count(FAILED) > 0
            if record is None or again:
                tasks.append(Task(folder, shard, retry_failed=again))
            else:
                work.complete[shard] = record.summary
    return work


def make_shards(work: Work, engine: Engine, on_outcome: OnOutcome) -> None:
    """Make all that is to do; shards of events follow those of their videos.

    Args:
        work: what is to do; what is done is noted there.
        engine: what makes it.
        on_outcome: called for every shard.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all shards would meet.
    """
    videos, waiting = deque(work.videos_todo), _by_video(work.todo)
    in_work = {_video_of(task.shard) for task in videos}
    ready = deque(task for task in work.todo if _video_of(task.shard) not in in_work)
    running = {True: 0, False: 0}
    while True:
        for is_video, queue in ((True, videos), (False, ready)):
            while queue and running[is_video] < engine.capacity(videos=is_video):
                engine.submit(queue.popleft())
                running[is_video] += 1
        if not any(running.values()):
            return
        outcome = engine.next()
        shard = outcome.task.shard
        is_video = shard.variant == VIDEOS
        running[is_video] -= 1
        if outcome.record is not None:
            work.complete[shard] = outcome.record.summary
            ready.extend(waiting.get(shard, ()) if is_video else ())
        else:
            work.failures[shard] = outcome.failure or "unknown"
        on_outcome(outcome)


def remove_dead_parts(recipe: Recipe, folder: Path) -> None:
    """Remove what processes that were killed left behind; shards at work elsewhere are kept."""
    for stage in (VIDEOS, *recipe.variants):
        sweep(folder / stage)


def _video_of(shard: Shard) -> Shard:
    return replace(shard, variant=VIDEOS)


def _by_video(tasks: Iterable[Task]) -> dict[Shard, list[Task]]:
    waiting: dict[Shard, list[Task]] = {}
    for task in tasks:
        waiting.setdefault(_video_of(task.shard), []).append(task)
    return waiting


def make(
    specification: Specification | str | Path,
    folder: str | Path,
    *,
    workers: int = 1,
    retry_failed: bool = False,
    progress: ProgressOption = None,
) -> Work:
    """Make a data set, or what is missing of it; see docs/datasets.md.

    Args:
        specification: an object, or a TOML or YAML file.
        folder: of the data set.
        workers: processes; 1: this one. A program that uses more needs the usual
            `if __name__ == "__main__":`, because they import its main module.
        retry_failed: make samples that failed again.
        progress: receives every shard.

    Returns:
        The counts of all complete shards, and why others could not be made.

    Raises:
        InputError, ConfigError, OutputError: before any work, what all samples would meet.
    """
    if not isinstance(specification, Specification):
        specification = read_specification(specification)
    recipe, folder = Recipe.of(specification), Path(folder).absolute()
    refuse_prompts(recipe, folder)
    recipe.begin(folder)
    work = find_work(recipe, folder, retry_failed=retry_failed)
    total = len(work.complete) + len(work.todo) + len(work.videos_todo)
    engine: Engine = in_this_process() if workers == 1 else ProcessEngine(workers)
    with open_progress(progress) as shown, closing(engine):
        make_shards(
            work, engine, lambda outcome: shown.advance("shards", len(work.complete), total)
        )
    return work

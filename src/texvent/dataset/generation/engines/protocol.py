"""What makes shards, wherever it runs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from texvent.dataset.generation.make_shard import make_shard
from texvent.dataset.generation.recipe import Shard, load_recipe_once
from texvent.dataset.generation.records import ShardRecord
from texvent.dataset.generation.shard_log import shard_log
from texvent.errors import OutputError, TexventError


@dataclass(frozen=True)
class Task:
    """A shard to make."""

    folder: Path
    shard: Shard
    retry_failed: bool = False


@dataclass(frozen=True)
class Outcome:
    """What became of a task."""

    task: Task
    record: ShardRecord | None = None
    failure: str | None = None
    """Why the whole shard could not be made."""


class Engine(Protocol):
    """Makes several shards at once."""

    def capacity(self, *, videos: bool) -> int:
        """How many shards of videos, or of events, to have at work or waiting."""
        ...

    def submit(self, task: Task) -> None:
        """Have a shard made."""
        ...

    def next(self) -> Outcome:
        """The next outcome of the tasks submitted; waits for it.

        Raises:
            ConfigError, OutputError, MissingDependencyError: what all shards would meet.
        """
        ...

    def close(self) -> None:
        """Drop what is at work and end."""
        ...


def run_task(task: Task) -> ShardRecord:
    """Make a shard in this process, with a log of its samples.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all shards would meet.
    """
    if not task.folder.is_dir():
        raise OutputError(
            f"{task.folder} is not here; all workers need the folder of the data set under the "
            "same path, on a shared file system"
        )
    recipe = load_recipe_once(task.folder)
    with shard_log(task.folder, task.shard) as note:
        return make_shard(
            recipe, task.folder, task.shard, retry_failed=task.retry_failed, on_sample=note
        )


def in_this_process() -> Engine:
    """An engine without further processes."""
    return _Serial(run_task)


class _Serial:
    def __init__(self, run: Callable[[Task], ShardRecord]) -> None:
        self._run, self._tasks = run, list[Task]()

    def capacity(self, *, videos: bool) -> int:
        del videos
        return 1

    def submit(self, task: Task) -> None:
        self._tasks.append(task)

    def next(self) -> Outcome:
        task = self._tasks.pop(0)
        return outcome_of(task, self._run)

    def close(self) -> None:
        self._tasks.clear()


def outcome_of(task: Task, run: Callable[[Task], ShardRecord]) -> Outcome:
    """Run a task; an error that only its shard meets becomes its outcome."""
    from texvent.batch.runner import ENDING_ALL

    try:
        return Outcome(task, record=run(task))
    except ENDING_ALL:
        raise
    except TexventError as error:
        return Outcome(task, failure=str(error))

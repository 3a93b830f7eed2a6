"""Engines that make shards: this process, and processes of this machine."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from texvent.batch.processes import interruptible, start_pool, stop_pools
from texvent.dataset.generation.make_shard import make_shard
from texvent.dataset.generation.recipe import VIDEOS, Shard, load_recipe_once
from texvent.dataset.generation.shards import ShardRecord
from texvent.dataset.generation.status import shard_log
from texvent.errors import OutputError, TexventError


@dataclass(frozen=True)
class Task:
    """A shard to make."""

    folder: Path
    shard: Shard
    retry_failed: bool = False


@dataclass(frozen=True)
class Outcome:
    """Result of a task: a record or a failure."""

    task: Task
    record: ShardRecord | None = None
    failure: str | None = None
    """Reason why the whole shard could not be made."""


class Engine(Protocol):
    """Makes several shards at once."""

    def capacity(self, *, videos: bool) -> int:
        """Number of shards of videos, or of events, to submit at once."""
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


ATTEMPTS = 3
"""Attempts at a shard whose process dies, as by want of memory."""


class ProcessEngine:
    """Processes for events, and one for videos, which loads a model once.

    Each is a pool of one, given one shard at a time: where it dies, only that shard is lost, and
    no other is blamed.
    """

    def __init__(self, workers: int) -> None:
        self._limits = {False: workers, True: 1}
        self._pools: dict[bool, list[ProcessPoolExecutor]] = {False: [], True: []}
        self._idle: dict[bool, list[ProcessPoolExecutor]] = {False: [], True: []}
        self._waiting: dict[bool, deque[Task]] = {False: deque(), True: deque()}
        self._running: dict[Future[Outcome], tuple[Task, ProcessPoolExecutor]] = {}
        self._deaths: Counter[Task] = Counter()

    def capacity(self, *, videos: bool) -> int:
        """One more than there are processes, so that none waits for the next."""
        return self._limits[videos] + 1

    def submit(self, task: Task) -> None:
        """Have a shard made."""
        is_video = task.shard.variant == VIDEOS
        self._waiting[is_video].append(task)
        self._start_waiting(is_video)

    def next(self) -> Outcome:
        """The next outcome; a shard whose process died is made again."""
        while True:
            done, _ = wait(self._running, return_when=FIRST_COMPLETED)
            future = next(iter(done))
            task, pool = self._running.pop(future)
            is_video = task.shard.variant == VIDEOS
            try:
                outcome = future.result()
                self._idle[is_video].append(pool)
            except BrokenProcessPool:
                self._drop(is_video, pool)
                self._deaths[task] += 1
                if self._deaths[task] < ATTEMPTS:
                    self._waiting[is_video].appendleft(task)
                    self._start_waiting(is_video)
                    continue
                outcome = Outcome(
                    task,
                    failure=f"its process died {ATTEMPTS} times, perhaps for want of memory; "
                    "run again with fewer --workers",
                )
            self._start_waiting(is_video)
            return outcome

    def close(self) -> None:
        """End all processes; they drop what they are at and clean up."""
        stop_pools(*(pool for pools in self._pools.values() for pool in pools))

    def _start_waiting(self, is_video: bool) -> None:
        """Give shards that wait to processes that are free or not yet started."""
        waiting, idle = self._waiting[is_video], self._idle[is_video]
        while waiting and (idle or len(self._pools[is_video]) < self._limits[is_video]):
            pool = idle.pop() if idle else self._add(is_video)
            try:
                future = pool.submit(_run_in_process, waiting[0])
            except BrokenProcessPool:  # it died while it was idle
                self._drop(is_video, pool)
                continue
            self._running[future] = (waiting.popleft(), pool)

    def _add(self, is_video: bool) -> ProcessPoolExecutor:
        pool = start_pool(1, of=self._limits[is_video])
        self._pools[is_video].append(pool)
        return pool

    def _drop(self, is_video: bool, pool: ProcessPoolExecutor) -> None:
        self._pools[is_video].remove(pool)
        stop_pools(pool)


def _run_in_process(task: Task) -> Outcome:
    with interruptible():
        return outcome_of(task, _run)


def _run(task: Task) -> ShardRecord:
    return run_task(task)

"""Engines that run tasks: this process, and processes of this machine, started and stopped.

`Work` is what a maker hands them: complete results, and the tasks that make the others.
"""

from __future__ import annotations

import multiprocessing
import os
import threading
import time
from collections import Counter, defaultdict, deque
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import connection
from typing import Any, Protocol

from texvent.errors import ConfigError, MissingDependencyError, OutputError, TexventError
from texvent.runtime.progress import NO_PROGRESS, Progress
from texvent.runtime.threads import THREADS_VARIABLE, count_threads
from texvent.runtime.work.interrupts import clean_up, raise_interrupted
from texvent.runtime.work.side_work import finishing_side_work


@dataclass
class Work:
    """Results that are complete or to be made, and failures.

    Beside what an engine asks of a task, each has `units`, which stand for the results that it
    makes, and `after`, a result that must be complete before, or None; `run` returns a record of
    each result.
    """

    complete: dict[Any, Any] = field(default_factory=dict)
    """Complete results, each with a summary of its record."""
    todo: list[Any] = field(default_factory=list)
    """Tasks, in order."""
    failures: dict[Any, str] = field(default_factory=dict)
    """Results that could not be made."""
    summary: Callable[[Any], Any] = lambda record: None
    """Part of a record that `complete` keeps."""

    @property
    def to_make(self) -> int:
        """Number of results of `todo`."""
        return sum(len(task.units) for task in self.todo)

    def make(
        self, engine: Engine, progress: Progress = NO_PROGRESS, noun: str = "shards"
    ) -> Iterator[Outcome]:
        """Run all tasks; what is done is noted here.

        Args:
            engine: what runs them.
            progress: receives the number of complete results.
            noun: what they are.

        Yields:
            The outcome of every task.

        Raises:
            ConfigError, OutputError, MissingDependencyError: what all tasks would meet.
        """
        to_make = {unit for task in self.todo for unit in task.units}
        waiting = defaultdict[Any, list[Any]](list)
        for task in self.todo:
            waiting[task.after if task.after in to_make else None].append(task)
        ready = waiting.pop(None, [])
        total, running = len(self.complete) + len(to_make), 0
        while True:
            progress.advance(noun, len(self.complete), total)
            for task in ready:
                engine.submit(task)
            running += len(ready)
            if not running:
                return
            outcome = engine.next()
            running -= 1
            units, ready = outcome.task.units, list[Any]()
            if outcome.failure is not None:
                self.failures.update(dict.fromkeys(units, outcome.failure))
            for unit, record in zip(units, outcome.result or (), strict=outcome.failure is None):
                self.complete[unit] = self.summary(record)
                ready += waiting.pop(unit, ())
            yield outcome


ENDING_ALL = (ConfigError, OutputError, MissingDependencyError)
"""Errors that every further task would meet too."""
ATTEMPTS = 3
"""Attempts at a task whose process dies, as by want of memory."""


class Task(Protocol):
    """A sample or a shard to make; hashable, and pickled on its way to another process."""

    @property
    def is_video(self) -> bool:
        """True if it makes videos alone: such tasks have a process that loads a model once."""
        ...

    def run(self) -> Any:
        """Make it.

        Raises:
            TexventError: it cannot be made.
        """
        ...


@dataclass(frozen=True)
class Outcome:
    """Result of a task: what it returned, or a failure."""

    task: Any
    result: Any = None
    failure: str | None = None
    """Reason why it could not be made."""


class Engine(Protocol):
    """Runs any number of tasks, several at once."""

    def submit(self, task: Task) -> None:
        """Have a task run."""
        ...

    def next(self) -> Outcome:
        """The next outcome of the tasks submitted; waits for it.

        Raises:
            ConfigError, OutputError, MissingDependencyError: what all tasks would meet.
        """
        ...

    def close(self) -> None:
        """Drop what is at work and end."""
        ...


def attempt(task: Task) -> Outcome:
    """Run a task; an error that only this one meets becomes its outcome.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all tasks would meet.
    """
    try:
        with finishing_side_work():  # an idle process of a pool is ended without a word
            return Outcome(task, task.run())
    except ENDING_ALL:
        raise
    except TexventError as error:
        return Outcome(task, failure=" ".join(str(error).split()))


class SerialEngine:
    """This process, one task after the other."""

    def __init__(self) -> None:
        self._tasks = deque[Task]()

    def submit(self, task: Task) -> None:
        """Have a task run."""
        self._tasks.append(task)

    def next(self) -> Outcome:
        """The outcome of the next task, run now."""
        return attempt(self._tasks.popleft())

    def close(self) -> None:
        """Forget the tasks."""
        self._tasks.clear()


class ProcessEngine:
    """Processes of this machine, and one for videos, which loads a model once.

    Each is a pool of one, given one task at a time: where it dies, only that task is lost, and no
    other is blamed.
    """

    def __init__(self, workers: int) -> None:
        self._limits = {False: workers, True: 1}
        self._pools: dict[bool, list[ProcessPoolExecutor]] = {False: [], True: []}
        self._idle: dict[bool, list[ProcessPoolExecutor]] = {False: [], True: []}
        self._waiting: dict[bool, deque[Task]] = {False: deque(), True: deque()}
        self._running: dict[Future[Outcome], tuple[Task, ProcessPoolExecutor]] = {}
        self._deaths: Counter[Task] = Counter()

    def submit(self, task: Task) -> None:
        """Have a task run."""
        self._waiting[task.is_video].append(task)
        self._start_waiting(task.is_video)

    def next(self) -> Outcome:
        """The next outcome; a task whose process died is run again."""
        while True:
            done, _ = wait(self._running, return_when=FIRST_COMPLETED)
            future = next(iter(done))
            task, pool = self._running.pop(future)
            try:
                outcome = future.result()
                self._idle[task.is_video].append(pool)
            except BrokenProcessPool:
                self._drop(task.is_video, pool)
                self._deaths[task] += 1
                if self._deaths[task] < ATTEMPTS:
                    self._waiting[task.is_video].appendleft(task)
                    self._start_waiting(task.is_video)
                    continue
                outcome = Outcome(
                    task,
                    failure=f"its process died {ATTEMPTS} times, perhaps for want of memory; "
                    "run again with fewer processes",
                )
            self._start_waiting(task.is_video)
            return outcome

    def close(self) -> None:
        """End all processes; they drop what they are at and clean up."""
        stop_pools(*(pool for pools in self._pools.values() for pool in pools))

    def _start_waiting(self, is_video: bool) -> None:
        """Give waiting tasks to processes that are free or not yet started."""
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


def local_engine(workers: int) -> Engine:
    """An engine of this machine: this process for one worker, or processes."""
    return SerialEngine() if workers == 1 else ProcessEngine(workers)


def _run_in_process(task: Task) -> Outcome:
    with interruptible():
        return attempt(task)


ORPHAN_EXIT, INTERRUPTED_EXIT = 3, 130
PATIENCE_S = 10.0
"""Time that processes have to clean up when they are ended."""


def start_pool(processes: int, *, of: int | None = None) -> ProcessPoolExecutor:
    """A pool whose processes share the cores, and end when this process does, however it ends.

    Args:
        processes: of the pool.
        of: how many share the cores, if there are further pools.
    """
    return ProcessPoolExecutor(
        processes,
        mp_context=multiprocessing.get_context("spawn"),
        initializer=_start_process,
        initargs=(max(1, count_threads() // (of or processes)),),
    )


def stop_pools(*pools: ProcessPoolExecutor) -> None:
    """End the processes of pools at once; they clean up what they are at.

    One that the signal does not end is killed: Python drops an interrupt that meets it in the
    callback of a weak reference, and may then hold the lock of its imports for ever.
    """
    ending = [process for pool in pools for process in list((pool._processes or {}).values())]
    for process in ending:
        process.terminate()
    last_s = time.monotonic() + PATIENCE_S
    for process in ending:
        if not connection.wait([process.sentinel], max(0.0, last_s - time.monotonic())):
            process.kill()
    for pool in pools:
        pool.shutdown(cancel_futures=True)


@contextmanager
def processes(count: int) -> Iterator[ProcessPoolExecutor]:
    """A pool, whose processes end with the block and clean up what they are at."""
    pool = start_pool(count)
    try:
        yield pool
    finally:
        stop_pools(pool)


@contextmanager
def interruptible() -> Iterator[None]:
    """Inside a process of the pool: a signal ends the block, then the process, cleanly.

    The process must not wait for another task: one that was killed while it waited may hold the
    lock of their queue for ever.
    """
    try:
        with raise_interrupted():
            yield
    except KeyboardInterrupt:
        clean_up()
        os._exit(INTERRUPTED_EXIT)


def _start_process(threads: int) -> None:
    os.environ[THREADS_VARIABLE] = str(threads)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """End with the parent: without it the queue of tasks never ends."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        connection.wait([parent.sentinel])
        os._exit(ORPHAN_EXIT)

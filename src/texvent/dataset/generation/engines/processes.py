"""Shards made by processes of this machine."""

from __future__ import annotations

from collections import Counter
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool

from texvent.batch.processes import interruptible, start_pool, stop_pool
from texvent.dataset.generation.engines.protocol import Outcome, Task, outcome_of, run_task
from texvent.dataset.generation.recipe import VIDEOS
from texvent.dataset.generation.records import ShardRecord

ATTEMPTS = 3
"""How often a shard may take its process down, as by want of memory, before it is given up."""


class ProcessEngine:
    """A pool of processes for events, and one process for videos, which loads a model once."""

    def __init__(self, workers: int) -> None:
        self._workers = workers
        self._pools: dict[bool, ProcessPoolExecutor] = {}
        self._running: dict[Future[Outcome], Task] = {}
        self._deaths: Counter[Task] = Counter()

    def capacity(self, *, videos: bool) -> int:
        """One more than there are processes, so that none waits for the next."""
        return 2 if videos else self._workers + 1

    def submit(self, task: Task) -> None:
        """Have a shard made."""
        is_video = task.shard.variant == VIDEOS
        if is_video not in self._pools:
            self._pools[is_video] = start_pool(1 if is_video else self._workers)
        try:
            future = self._pools[is_video].submit(_run_in_process, task)
        except BrokenProcessPool:
            self._restart(is_video)
            future = self._pools[is_video].submit(_run_in_process, task)
        self._running[future] = task

    def next(self) -> Outcome:
        """The next outcome; a shard whose process died is made again."""
        while True:
            done, _ = wait(self._running, return_when=FIRST_COMPLETED)
            future = next(iter(done))
            task = self._running.pop(future)
            try:
                return future.result()
            except BrokenProcessPool:
                # All that the pool was at fails alike; which of them was guilty is not said.
                self._deaths[task] += 1
                if self._deaths[task] >= ATTEMPTS:
                    return Outcome(
                        task,
                        failure=f"its process died {ATTEMPTS} times, perhaps for want of memory; "
                        "run again with fewer --workers",
                    )
                self.submit(task)

    def close(self) -> None:
        """End all processes; they drop what they are at and clean up."""
        for pool in self._pools.values():
            stop_pool(pool)

    def _restart(self, is_video: bool) -> None:
        stop_pool(self._pools[is_video])
        self._pools[is_video] = start_pool(1 if is_video else self._workers)


def _run_in_process(task: Task) -> Outcome:
    with interruptible():
        return outcome_of(task, _run)


def _run(task: Task) -> ShardRecord:
    return run_task(task)

"""Shards made by processes of this machine."""

from __future__ import annotations

from collections import Counter, deque
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool

from texvent.batch.processes import interruptible, start_pool, stop_pools
from texvent.dataset.generation.engines.protocol import Outcome, Task, outcome_of, run_task
from texvent.dataset.generation.recipe import VIDEOS
from texvent.dataset.generation.records import ShardRecord

ATTEMPTS = 3
"""How often a shard may take its process down, as by want of memory, before it is given up."""


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

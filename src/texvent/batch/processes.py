"""Processes of this machine that share its cores."""

from __future__ import annotations

import multiprocessing
import os
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing.connection import wait

from texvent.io.atomic import remove_own_parts
from texvent.runtime.interrupts import raise_interrupted
from texvent.runtime.threads import THREADS_VARIABLE, count_threads

ORPHAN_EXIT, INTERRUPTED_EXIT = 3, 130
PATIENCE_S = 10.0
"""How long processes that are ended may take to clean up."""


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
        if not wait([process.sentinel], max(0.0, last_s - time.monotonic())):
            process.kill()
    for pool in pools:
        pool.shutdown(cancel_futures=True)


@contextmanager
def processes(count: int) -> Iterator[ProcessPoolExecutor]:
    """A pool; if the block fails, its processes are ended and clean up."""
    pool = start_pool(count)
    try:
        yield pool
    except BaseException:
        stop_pools(pool)
        raise
    finally:
        pool.shutdown(cancel_futures=True)


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
        remove_own_parts()
        os._exit(INTERRUPTED_EXIT)


def _start_process(threads: int) -> None:
    os.environ[THREADS_VARIABLE] = str(threads)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """End with the parent: without it the queue of tasks never ends."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(ORPHAN_EXIT)

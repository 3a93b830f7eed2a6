"""Threads that share the work on a frame: how many there are, and how to split it.

Compiled kernels and NumPy release the interpreter lock, so threads run in parallel. To hand a part
to a thread and wait for it takes about 20 µs, so it pays for parts of several hundred µs: several
frames at once, or a model that computes much per pixel. Clips that run in a thread each need none
of this.
"""

from __future__ import annotations

import functools
import os
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from texvent.errors import ConfigError, shown

Part = TypeVar("Part")
Result = TypeVar("Result")

THREADS_VARIABLE = "TEXVENT_NUM_THREADS"
_VARIABLES = (THREADS_VARIABLE, "NUMBA_NUM_THREADS")


def count_threads() -> int:
    """Number of threads that may work: $TEXVENT_NUM_THREADS, $NUMBA_NUM_THREADS, or one per core.

    Raises:
        ConfigError: a variable is not a number of at least 1.
    """
    for name in _VARIABLES:
        value = os.environ.get(name)
        if value:
            if not value.isdecimal() or int(value) < 1:
                raise ConfigError(
                    f"${name} is {shown(value)}; it must be a whole number, at least 1"
                )
            return int(value)
    return _count_cores()


def split(size: int, parts: int, *, unit: int = 1) -> list[slice]:
    """At most `parts` slices of about equal length that make up `size`.

    Args:
        size: how many items there are.
        parts: how many slices are wanted, at least 1.
        unit: all slices but the last are a multiple of it long.

    Example:
        >>> split(10, 2, unit=4)
        [slice(0, 8, None), slice(8, 10, None)]
    """
    units = -(-size // unit)
    length = max(1, -(-units // parts)) * unit
    return [slice(first, min(first + length, size)) for first in range(0, size, length)]


def run_parts(work: Callable[[Part], Result], parts: Sequence[Part]) -> list[Result]:
    """The result of `work` for each part, in order; this thread and others take part after part.

    Returns when no part is being worked on, also if one raises. Results must not depend on the
    order of work.
    """
    results: dict[int, Result] = {}
    waiting = deque(enumerate(parts))

    def take_parts() -> None:
        while waiting:
            try:
                number, part = waiting.popleft()
            except IndexError:  # another thread took the last one
                return
            results[number] = work(part)

    others = [_workers().submit(take_parts) for _ in range(min(len(parts), count_threads()) - 1)]
    try:
        take_parts()
    finally:
        # What has not begun has nothing left to do, but may have to wait for other callers' parts.
        errors = [other.exception() for other in others if not other.cancel()]
    for error in errors:
        if error is not None:
            raise error
    return [results[number] for number in range(len(parts))]


def _count_cores() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@functools.cache
def _workers() -> ThreadPoolExecutor:
    # Threads start with the first work, and then wait for more at no cost.
    return ThreadPoolExecutor(max(1, count_threads() - 1), "texvent-kernels")


if hasattr(os, "register_at_fork"):
    # A forked child has none of its parent's threads.
    os.register_at_fork(after_in_child=_workers.cache_clear)

"""Run a function over many arguments, here or in several processes."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeAlias

from texvent.runtime.work.engines import interruptible, processes


def run_jobs(
    function: Callable[..., Any], arguments: Sequence[tuple[Any, ...]], jobs: int
) -> Iterator[Any]:
    """Results in the order of the arguments.

    Processes end with the iterator, whatever they are at.

    Args:
        function: called once per tuple of arguments; with several processes it, they and its
            results are pickled.
        arguments: one tuple per call.
        jobs: processes to use, which share the cores; 1 stays in this one.
    """
    if jobs == 1:
        yield from itertools.starmap(function, arguments)
        return
    with processes(jobs) as pool:
        for future in [pool.submit(_call, function, one) for one in arguments]:
            yield future.result()


def _call(function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
    with interruptible():
        return function(*arguments)


Progress: TypeAlias = Callable[[str], None]
"""Called with one line per step."""


def no_progress(line: str) -> None:
    """Report no progress."""
    del line

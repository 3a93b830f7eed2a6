"""Run a function over many arguments, here or in several processes."""

from __future__ import annotations

import itertools
import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from typing import Any


def run_jobs(
    function: Callable[..., Any], arguments: Sequence[tuple[Any, ...]], jobs: int
) -> Iterator[Any]:
    """Results in the order of the arguments.

    Args:
        function: called once per tuple of arguments; with several processes it, they and its
            results are pickled.
        arguments: one tuple per call.
        jobs: processes to use; 1 stays in this one.
    """
    if jobs == 1:
        yield from itertools.starmap(function, arguments)
        return
    # Spawned, because compiled kernels and OpenCV keep threads that a fork would break.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=context) as pool:
        futures = [pool.submit(function, *one) for one in arguments]
        try:
            for future in futures:
                yield future.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)

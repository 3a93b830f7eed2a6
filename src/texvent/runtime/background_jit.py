"""Compile kernels in a background thread, while slower forms of them work.

Compiling takes seconds the first time; loading compiled code takes a third of a second. A run need
not wait for either: it checks at every frame whether the kernel is ready. All backends give equal
events, so the moment of the change does not show in the output.
"""

from __future__ import annotations

import functools
import importlib
import logging
import os
from concurrent.futures import Future, ThreadPoolExecutor

from texvent._require import require
from texvent.errors import MissingDependencyError

_logger = logging.getLogger(__name__)


def is_ready(module: str, *variant: str) -> bool:
    """Whether the kernels of a module are compiled; the first call starts to compile them.

    Args:
        module: name of a module with a function `warm_up(*variant)` that compiles its kernels.
        variant: what to compile, such as the type of the frames.

    Returns:
        False until they are compiled, and always where they cannot be.
    """
    work = _prepare(module, variant)
    return work.done() and work.exception() is None


def wait_until_ready(module: str, *variant: str) -> None:
    """Return when the kernels of a module are compiled, or cannot be."""
    _prepare(module, variant).exception()


def wait_until_idle(timeout_s: float | None = None) -> bool:
    """Return when no kernel is being compiled any more, so that timings measure compiled code.

    Args:
        timeout_s: how long to wait at most; default: no limit.

    Returns:
        False if the time was over before.
    """
    if _compiler.cache_info().currsize == 0:
        return True
    try:
        _compiler().submit(int).result(timeout_s)
    except TimeoutError:
        return False
    return True


def _warm_up(module: str, variant: tuple[str, ...]) -> None:
    require("numba")
    importlib.import_module(module).warm_up(*variant)


@functools.cache
def _prepare(module: str, variant: tuple[str, ...]) -> Future[None]:
    work = _compiler().submit(_warm_up, module, variant)
    work.add_done_callback(_report)
    return work


@functools.cache
def _compiler() -> ThreadPoolExecutor:
    # One thread, because Numba compiles under a lock. The process waits for it at exit, so even a
    # short run leaves compiled kernels for the next one.
    return ThreadPoolExecutor(1, "texvent-compile")


def _report(work: Future[None]) -> None:
    error = work.exception()
    if error is not None and not isinstance(error, MissingDependencyError):
        _logger.warning("kernels stay uncompiled, events are the same: %s", error)


def _forget() -> None:
    """Start anew in a forked child, which has none of its parent's threads."""
    _prepare.cache_clear()
    _compiler.cache_clear()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)

"""Kernels that are compiled by a thread, while slower twins work or whoever needs them waits.

Compiling takes seconds the first time, and loading what was compiled a third of a second. Neither
holds up a run: a thread does it, and the caller asks at every frame whether it is done. Since all
backends give equal events, nobody can see when the change comes.
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
_ready: set[tuple[str, tuple[str, ...]]] = set()


def is_ready(module: str, *variant: str) -> bool:
    """Whether a compiled module can be used at once; the first call starts to prepare it.

    Args:
        module: name of a module with a function `warm_up(*variant)` that compiles what it has.
        variant: what to compile, such as the type of the frames.

    Returns:
        False while it is being prepared, and for good where it cannot be.
    """
    if (module, variant) in _ready:
        return True
    work = _prepare(module, variant)
    if work.done() and work.exception() is None:
        _ready.add((module, variant))
    return (module, variant) in _ready


def wait_until_ready(module: str, *variant: str) -> None:
    """Return when the module is compiled, or cannot be."""
    _prepare(module, variant).exception()


def wait_until_idle(timeout_s: float | None = None) -> bool:
    """Return when nothing is being prepared any more: what is measured from here on is compiled.

    Args:
        timeout_s: how long to wait at most; default: as long as it takes.

    Returns:
        False if there still was something to prepare then.
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
    # One thread: compilers take turns anyway. It ends its work before the process does, so that
    # even a short run leaves the next one a compiled kernel.
    return ThreadPoolExecutor(1, "texvent-compile")


def _report(work: Future[None]) -> None:
    error = work.exception()
    if error is not None and not isinstance(error, MissingDependencyError):
        _logger.warning("kernels stay uncompiled, events are the same: %s", error)


def _forget() -> None:
    """A forked child has none of its parent's threads."""
    _prepare.cache_clear()
    _compiler.cache_clear()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)

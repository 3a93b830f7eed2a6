"""Progress as callers ask for it: a bar, a function of their own, or none."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import TypeAlias

from texvent.runtime.notebooks import NotebookProgress, is_notebook
from texvent.runtime.progress import NoProgress, Progress

ProgressCallback: TypeAlias = Callable[[int, int | None, str], object]
"""Called with steps done, steps in all (None where that is unknown) and what is being done."""
ProgressOption: TypeAlias = bool | ProgressCallback | None
"""True: a bar, in a notebook's output or on stderr. False: nothing. None: a bar in a notebook or a
terminal. A function is called at every step; an exception that it raises stops the work."""


class CallbackProgress:
    """Progress that goes to a function; a line to show comes with the latest step."""

    def __init__(self, callback: ProgressCallback) -> None:
        self._callback = callback
        self._latest: tuple[int, int | None] = (0, None)

    def announce(self, line: str) -> None:
        """Pass on a line."""
        self._callback(*self._latest, line)

    def advance(self, stage: str, done: int, total: int | None) -> None:
        """Pass on a step."""
        self._latest = (done, total)
        self._callback(done, total, stage)


@contextmanager
def open_progress(option: ProgressOption) -> Iterator[Progress]:
    """The progress that an option asks for; a bar disappears with the `with` block."""
    if callable(option):
        yield CallbackProgress(option)
    elif option or (option is None and _is_interactive()):
        with _open_bar(is_forced=option is True) as progress:
            yield progress
    else:
        yield NoProgress()


def _open_bar(*, is_forced: bool) -> AbstractContextManager[Progress]:
    """The bar of a notebook, or else of a terminal."""
    if is_notebook():
        return NotebookProgress(is_forced=is_forced)
    from texvent.runtime.console_progress import (
        ConsoleProgress,  # rich takes 50 ms to import
    )

    return ConsoleProgress(is_forced=is_forced)


def _is_interactive() -> bool:
    """Whether this process is the kernel of a notebook, or stderr is a terminal."""
    return is_notebook() or (sys.stderr is not None and sys.stderr.isatty())

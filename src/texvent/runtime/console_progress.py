"""Progress in a terminal."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable
from typing import ClassVar, Self

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TaskID,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from texvent.errors import visible
from texvent.runtime.progress import TERMINALS

PATIENCE_SECONDS = 0.5
"""Work that ends sooner shows no bar."""


class ConsoleProgress:
    """Lines, and one bar per stage of longer work, on stderr.

    The bar shows where stderr is a terminal. A full or closed stderr loses them and stops no work.

    Args:
        is_quiet: show nothing.
        is_forced: show the bar at once, and wherever stderr leads.
    """

    listener: ClassVar[Callable[[str, int, int | None], None] | None] = None
    """Told every step, where another program shows them; then there is no bar."""

    def __init__(self, *, is_quiet: bool = False, is_forced: bool = False) -> None:
        self._console = Console(
            stderr=True, quiet=is_quiet, highlight=False, force_terminal=is_forced or None
        )
        self._has_bar = not is_quiet and (is_forced or self._console.is_terminal)
        self._patience = 0.0 if is_forced else PATIENCE_SECONDS
        self._bar = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            TimeRemainingColumn(),
            console=self._console,
            transient=True,
        )
        self._tasks: dict[str, TaskID] = {}
        self._started = time.monotonic()
        self._is_shown = False

    def __enter__(self) -> Self:
        self._started = time.monotonic()
        if self._has_bar or type(self).listener is not None:
            TERMINALS.append(self)
        return self

    def __exit__(self, *error: object) -> None:
        if self in TERMINALS:
            TERMINALS.remove(self)
        with contextlib.suppress(OSError):
            if self._is_shown:
                self._bar.stop()

    def announce(self, line: str) -> None:
        """Print a line."""
        with contextlib.suppress(OSError):
            self._console.print(visible(line), markup=False, soft_wrap=True)

    def advance(self, stage: str, done: int, total: int | None) -> None:
        """Move the bar of a stage."""
        listener = type(self).listener
        if listener is not None:
            listener(stage, done, total)
        if not self._has_bar or time.monotonic() - self._started < self._patience:
            return
        with contextlib.suppress(OSError):
            if not self._is_shown:
                self._bar.start()
                self._is_shown = True
            if stage not in self._tasks:
                self._tasks[stage] = self._bar.add_task(stage, total=total)
            self._bar.update(self._tasks[stage], completed=done, total=total)

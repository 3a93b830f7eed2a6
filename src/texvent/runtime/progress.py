"""Progress of slow work: its interface, and the bars that are open now."""

from __future__ import annotations

from functools import cache
from typing import Protocol


class Progress(Protocol):
    """Receives the progress of slow work. Either method may raise to stop it cleanly."""

    def announce(self, line: str) -> None:
        """Receive one line to show, such as the licence before a download."""
        ...

    def advance(self, stage: str, done: int, total: int | None) -> None:
        """Receive a step: `done` of `total` steps of a stage, such as "denoise"."""
        ...


class NoProgress:
    """Progress that is shown nowhere."""

    def announce(self, line: str) -> None:
        """Ignore a line."""

    def advance(self, stage: str, done: int, total: int | None) -> None:
        """Ignore a step."""


NO_PROGRESS = NoProgress()
TERMINALS: list[Progress] = []
"""Bars in terminals that are open now."""


def tell_of_compilation() -> None:
    """Tell a terminal, once in a process, why nothing moves in the first run on a machine."""
    if TERMINALS:
        _tell_terminal()


@cache
def _tell_terminal() -> None:
    TERMINALS[-1].announce("note     compiling (once): later runs read what this one needs")

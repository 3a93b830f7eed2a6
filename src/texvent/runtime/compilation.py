"""Word that kernels are being compiled: the first run on a machine waits, and is told what for."""

from collections.abc import Callable
from functools import cache

LISTENERS: list[Callable[[str], object]] = []
"""Displays that can show a line now; the last one is told."""


def tell_of_compilation() -> None:
    """Tell a display, once in a process, that kernels which are not on disk are compiled."""
    if LISTENERS:
        _tell_last()


@cache
def _tell_last() -> None:
    LISTENERS[-1]("note     compiling (once): later runs on this machine read it from disk")

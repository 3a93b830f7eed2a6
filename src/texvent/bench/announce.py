"""How a long run says what it is doing."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

Announce: TypeAlias = Callable[[str], None]
"""Told of every step, in one line."""


def stay_silent(line: str) -> None:
    """For a run that nobody watches."""
    del line

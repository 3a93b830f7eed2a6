"""Progress of a long run, one line per step."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

Progress: TypeAlias = Callable[[str], None]
"""Called with one line per step."""


def no_progress(line: str) -> None:
    """Report no progress."""
    del line

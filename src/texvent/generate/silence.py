"""A watch that shows nothing, for callers that do not want to be told."""

from __future__ import annotations


class Silence:
    """Takes progress and drops it."""

    def announce(self, line: str) -> None:
        """Drop a line."""

    def advance(self, stage: str, done: int, total: int) -> None:
        """Drop progress."""

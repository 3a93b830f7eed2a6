"""What can become of a damaged input."""

from __future__ import annotations

from dataclasses import dataclass

MAX_SECONDS = 10.0
KILL_SECONDS = 20.0
MAX_GROWTH_BYTES = 10**9
LONGEST_ERROR = 300
"""Characters of an error, its path left out."""

GOOD = ("same", "changed", "refused")
"""Read as it was; read, with other content; one line of error."""
BAD = ("several lines", "too long", "traceback", "hang", "blow-up", "signal", "code ran")
"""What must never happen."""


@dataclass(frozen=True)
class Outcome:
    """What became of one input."""

    reader: str
    number: int
    kind: str
    """One of `GOOD` or `BAD`, or "not run" where a package is missing."""
    damage: str
    detail: str

    def __str__(self) -> str:
        return f"{self.reader} {self.number} ({self.damage}): {self.kind}: {self.detail}"

"""What can become of a damaged input, and the table of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

MAX_SECONDS = 10.0
KILL_SECONDS = 20.0
MAX_GROWTH_BYTES = 10**9
LONGEST_ERROR = 300
"""Characters of an error, its path left out."""

GOOD = ("same", "changed", "refused")
"""Read as it was; read, with other content; one line of error."""
BAD = (
    "several lines",
    "too long",
    "traceback",
    "hang",
    "blow-up",
    "signal",
    "code ran",
)
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
    seconds: float = 0.0

    def __str__(self) -> str:
        return f"{self.reader} {self.number} ({self.damage}): {self.kind}: {self.detail}"


def table(outcomes: list[Outcome]) -> str:
    """Figures by reader, as Markdown."""
    by_reader: dict[str, Counter[str]] = {}
    for one in outcomes:
        by_reader.setdefault(one.reader, Counter())[one.kind] += 1
    missing = [name for name, counts in by_reader.items() if counts["not run"]]
    rows = {name: counts for name, counts in by_reader.items() if name not in missing}
    shown = ("files", *GOOD, *BAD)
    lines = [f"| reader | {' | '.join(shown)} |", f"|---|{'--:|' * len(shown)}"]
    lines += [_row(name, counts) for name, counts in rows.items()]
    lines.append(_row("**all**", sum(rows.values(), Counter())))
    if missing:
        lines += ["", f"Not run, a package is missing: {', '.join(missing)}."]
    return "\n".join(lines) + "\n"


def _row(name: str, counts: Mapping[str, int]) -> str:
    figures = [sum(counts.values()), *(counts.get(kind, 0) for kind in (*GOOD, *BAD))]
    return f"| {name} | {' | '.join(str(one) for one in figures)} |"

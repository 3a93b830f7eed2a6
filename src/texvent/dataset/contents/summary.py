"""How many samples are there, which are not, and what clips show: what plan, make and stats say."""

from __future__ import annotations

from texvent.dataset.contents.statistics import MOST_REASONS, Statistics
from texvent.errors import shown
from texvent.scenes.report import ranked

MOST_NAMED = 10
"""Samples that the summary names of those left out for one reason."""


def summary_lines(statistics: Statistics) -> list[str]:
    """The counts of a data set, of a part of it, or of the trial of a plan, for people.

    Example:
        >>> summary_lines(Statistics())
        ['samples  0 made, 0 left out, 0 failed']
    """
    left_out = sorted(statistics.left_out)
    lines = [
        f"samples  {statistics.samples:,} made, {len(left_out):,} left out, "
        f"{statistics.failed:,} failed"
    ]
    for reason, count in ranked(statistics.reasons)[:MOST_REASONS]:
        kind, _, why = reason.partition(": ")
        lines.append(f"{kind:8} {count:,}: {why}")
        named = [one for one in left_out if reason == f"left out: {one.reason}"]
        lines += [
            f"         {one.variant}/{one.key} {shown(one.shows)}: {one.signal_events:,}"
            for one in named[:MOST_NAMED]
        ]
        if len(named) > MOST_NAMED:
            lines.append(
                f"         and {len(named) - MOST_NAMED:,} more: texvent dataset stats --json "
                "names all"
            )
    if statistics.prompts is not None:
        lines.append(f"prompts  {statistics.prompts.line('clips')}")
    return lines

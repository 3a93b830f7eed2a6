"""`texvent dataset stats DIR`: what a data set holds, counted."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.dataset.contents.made_set import MadeSet
from texvent.dataset.contents.statistics import COUNTS, MICROSECONDS, SetStatistics, counts_rows
from texvent.dataset.contents.summary import summary_lines

MOST_CLASSES = 12
WIDTH = 110
"""Of the table, which has ten columns, also where there is no terminal."""
DESCRIPTION = """Count what a data set holds: samples, events, rates, durations, classes, and why
samples are not there. The records beside the shards are read, not the samples.

  texvent dataset stats cars
  texvent dataset stats cars -o cars/stats.html     with plots"""


@dataclass(frozen=True, kw_only=True)
class StatsOptions:
    """What to count."""

    positional: ClassVar[tuple[str, ...]] = ("folder",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o"}
    outputs: ClassVar[tuple[str, ...]] = ("folder", "out")

    folder: Path = REQUIRED
    """Folder of the data set."""
    out: Path | None = None
    """A page (HTML) with plots."""
    json: bool = False
    """Print JSON."""
    overwrite: bool = False
    """Replace the page if it exists."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments,
        {"data set": StatsOptions()},
        prog="texvent dataset stats",
        description=DESCRIPTION,
    )
    made = MadeSet.open(options.folder)
    statistics = SetStatistics.of(made)
    if options.out is not None:
        from texvent.dataset.looking.statistics_page import write_statistics_page

        write_statistics_page(made, statistics, options.out, overwrite=options.overwrite)
    if options.json:
        write_out(json.dumps(statistics.tables, indent=1, ensure_ascii=False) + "\n")
    else:
        _print(made, statistics)
    return 0


def _print(made: MadeSet, statistics: SetStatistics) -> None:
    console = Console(file=sys.stdout, highlight=False, soft_wrap=True, width=WIDTH)
    table = Table(box=None, pad_edge=False)
    for number, title in enumerate(COUNTS):
        table.add_column(title, justify="left" if number < 2 else "right")
    for row in counts_rows(statistics):
        table.add_row(*map(escape, row))
    console.print(table)
    total = statistics.total
    _print_counts(console, "classes", total.classes)
    _print_counts(console, "sensors", total.sensors)
    _print_counts(console, "warnings", total.warnings)
    for line in summary_lines(total):
        console.print(escape(line))
    console.print(
        f"{escape(made.name)}: {total.samples:,} samples of {len(total.clips):,} videos, "
        f"{sum(total.events):,} events in {sum(total.durations_us) / MICROSECONDS:,.1f} s, "
        f"{total.bytes / 1e6:,.1f} MB in {total.shards:,} shards, made in "
        f"{total.seconds / 3600:,.2f} hours of one process"
    )


def _print_counts(console: Console, title: str, counts: Mapping[str, int]) -> None:
    ranked = sorted(counts.items(), key=lambda pair: (-pair[1], pair[0]))
    if ranked:
        shown = "; ".join(f"{name} {count:,}" for name, count in ranked[:MOST_CLASSES])
        more = len(ranked) - MOST_CLASSES
        console.print(escape(f"{title}: {shown}{f' ... {more:,} more' if more > 0 else ''}"))

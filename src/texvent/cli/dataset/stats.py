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
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.statistics import (
    COUNTS,
    MICROSECONDS,
    DatasetStatistics,
    counts_rows,
    summary_lines,
)

MOST_CLASSES = 12
WIDTH = 110
"""Of the table, which has ten columns, also where there is no terminal."""
DESCRIPTION = """Count what a data set holds: samples, events, rates, durations, classes, and why
samples are not there. The records beside the shards are read, not the samples."""


@dataclass(frozen=True, kw_only=True)
class StatsOptions:
    """What to count."""

    positional: ClassVar[tuple[str, ...]] = ("folder",)
    outputs: ClassVar[tuple[str, ...]] = ("folder",)

    folder: Path = REQUIRED
    """Folder of the data set."""
    json: bool = False
    """Print JSON."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments,
        {"data set": StatsOptions()},
        prog="texvent dataset stats",
        description=DESCRIPTION,
    )
    dataset = StoredDataset.open(options.folder)
    statistics = DatasetStatistics.of(dataset)
    if options.json:
        write_out(json.dumps(statistics.tables, indent=1, ensure_ascii=False) + "\n")
    else:
        _print(dataset, statistics)
    return 0


def _print(dataset: StoredDataset, statistics: DatasetStatistics) -> None:
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
        f"{escape(dataset.name)}: {total.samples:,} samples of {len(total.clips):,} videos, "
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

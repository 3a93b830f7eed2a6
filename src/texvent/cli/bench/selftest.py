"""`texvent bench selftest`: which perturbations does each metric see?"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from rich.console import Console

from texvent.bench.document import write_document
from texvent.bench.selftest.chart import selftest_chart
from texvent.bench.selftest.run import SelftestRow, run_selftest
from texvent.bench.selftest.table import read_selftest, selftest_document, selftest_table
from texvent.cli.options import parse_options
from texvent.errors import ConfigError
from texvent.io.atomic import atomic_file, check_output


@dataclass(frozen=True, kw_only=True)
class SelftestOptions:
    """What to test, and where to keep the result."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    metrics: str | None = None
    """Names of metrics, separated by commas; default: all whose weights are here."""
    result: Path | None = None
    """Show the table of this JSON file, which --out wrote, instead of testing. Alone or with
    --chart."""
    out: Path | None = None
    """JSON file with every value and z-score."""
    chart: Path | None = None
    """SVG image of the z-scores of every metric and perturbation."""
    overwrite: bool = False
    """Replace a file that exists already."""
    quiet: bool = False
    """No progress; only the table."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    values = parse_options(
        arguments,
        {"options": SelftestOptions()},
        prog="texvent bench selftest",
        description="Which of 20 perturbations of a recording does each metric see? "
        "docs/metrics.md explains the table.",
    )
    options = SelftestOptions(**values)
    if options.result is not None and (options.out or options.metrics):
        raise ConfigError("result shows a file as it is: leave out out and metrics, or test anew")
    for path in (options.out, options.chart):
        if path is not None:
            check_output(path, overwrite=options.overwrite)
    rows = _run_selftest(options) if options.result is None else read_selftest(options.result)
    if options.chart is not None:
        with atomic_file(options.chart, overwrite=options.overwrite) as part:
            part.write_text(selftest_chart(rows), encoding="utf-8")
    sys.stdout.write(selftest_table(rows))


def _run_selftest(options: SelftestOptions) -> list[SelftestRow]:
    console = Console(stderr=True, quiet=options.quiet, highlight=False)
    rows = run_selftest(
        options.metrics.split(",") if options.metrics else None,
        progress=lambda line: console.print(line, style="dim"),
    )
    if options.out is not None:
        write_document(options.out, selftest_document(rows), overwrite=options.overwrite)
    return rows

"""`texvent bench selftest`: which perturbations does each metric see?"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from rich.console import Console

from texvent.bench.document import write_document
from texvent.bench.selftest import run_selftest
from texvent.bench.selftest_table import read_selftest, selftest_document, selftest_table
from texvent.cli.options import parse_options
from texvent.io.atomic import check_output


@dataclass(frozen=True, kw_only=True)
class SelftestOptions:
    """What to test, and where to keep the result."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    metrics: str | None = None
    """Names of metrics, separated by commas; default: all whose weights are here."""
    result: Path | None = None
    """Show the table of this JSON file, which --out wrote, instead of testing."""
    out: Path | None = None
    """JSON file with every value and z-score."""
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
    if options.result is not None:
        sys.stdout.write(selftest_table(read_selftest(options.result)))
        return
    console = Console(stderr=True, quiet=options.quiet, highlight=False)
    if options.out is not None:
        check_output(options.out, overwrite=options.overwrite)
    rows = run_selftest(
        options.metrics.split(",") if options.metrics else None,
        announce=lambda line: console.print(line, style="dim"),
    )
    if options.out is not None:
        write_document(options.out, selftest_document(rows), overwrite=options.overwrite)
    sys.stdout.write(selftest_table(rows))

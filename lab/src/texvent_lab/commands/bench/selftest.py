"""`texvent bench selftest`: which perturbations does each metric see?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.errors import ConfigError
from texvent.io.atomic import atomic_file
from texvent_lab.bench.selftest.run import SelftestRow, run_selftest
from texvent_lab.bench.selftest.table import (
    read_selftest,
    selftest_chart,
    selftest_document,
    selftest_table,
)
from texvent_lab.commands.bench.bench import ResultOptions


@dataclass(frozen=True, kw_only=True)
class SelftestOptions:
    """What to test."""

    metrics: str | None = None
    """Names of metrics, separated by commas; default: all whose weights are here."""
    result: Path | None = None
    """Show the table of this JSON file, which --out wrote, instead of testing. Alone or with
    --chart."""
    chart: Path | None = None
    """SVG image of the z-scores of every metric and perturbation."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, output = parse_configs(
        arguments,
        {"options": SelftestOptions(), "output": ResultOptions()},
        prog="texvent bench selftest",
        description="Which of 20 perturbations of a recording does each metric see? "
        "docs/metrics.md explains the table.",
    )
    if options.result is not None and (output.out or options.metrics):
        raise ConfigError("result shows a file as it is: leave out out and metrics, or test anew")
    output.check(options.chart)
    rows = (
        _run_selftest(options, output) if options.result is None else read_selftest(options.result)
    )
    if options.chart is not None:
        with atomic_file(options.chart, overwrite=output.overwrite) as part:
            part.write_bytes(selftest_chart(rows))
    write_out(selftest_table(rows))


def _run_selftest(options: SelftestOptions, output: ResultOptions) -> list[SelftestRow]:
    rows = run_selftest(
        options.metrics.split(",") if options.metrics else None,
        progress=output.progress,
    )
    output.write(lambda: selftest_document(rows))
    return rows

"""`texvent bench selftest`: which perturbations does each metric see?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent_lab.bench.selftest import run_selftest, selftest_document, selftest_table
from texvent_lab.commands.bench.bench import ResultOptions


@dataclass(frozen=True, kw_only=True)
class SelftestOptions:
    """Metrics to test."""

    metrics: str | None = None
    """Names of metrics, separated by commas; default: all whose weights are here."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, output = parse_configs(
        arguments,
        {"options": SelftestOptions(), "output": ResultOptions()},
        prog="texvent bench selftest",
        description="Which of 20 perturbations of a recording does each metric see? "
        "docs/metrics.md explains the table.",
    )
    output.check()
    names = options.metrics.split(",") if options.metrics else None
    rows = run_selftest(names, progress=output.progress)
    output.write(lambda: selftest_document(rows))
    write_out(selftest_table(rows))

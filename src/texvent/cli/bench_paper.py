"""`texvent bench paper`: the tables of the paper, with our figures beside its own."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

from rich.console import Console

from texvent.bench.ablation import read_ablations
from texvent.bench.document import write_document
from texvent.bench.fidelity import FidelityPlan, run_fidelity
from texvent.bench.fidelity_table import fidelity_tables
from texvent.cli.options import parse_options
from texvent.io.atomic import check_output


@dataclass(frozen=True, kw_only=True)
class PaperOptions:
    """What to run, and where to keep the result."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    configs: Path = Path("configs/paper")
    """Folder with one TOML file per row."""
    baseline: str = "Texvent"
    """Row that the others are compared with, pair by pair."""
    match_rate: bool = False
    """Fit each row's contrast threshold to the number of true events, instead of keeping it."""
    scenes: str | None = None
    """Names of scenes, separated by commas; default: those of bench fidelity."""
    jobs: int = 2
    """Processes to use."""
    out: Path | None = None
    """JSON file with every value; docs/benchmark.md describes it."""
    overwrite: bool = False
    """Replace a file that exists already."""
    quiet: bool = False
    """No progress; only the tables."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    values = parse_options(
        arguments,
        {"options": PaperOptions()},
        prog="texvent bench paper",
        description="The paper's ablations (Tables 4 and 5), judged by the events that truly "
        "happened. docs/ablations.md explains the tables.",
    )
    options = PaperOptions(**values)
    if options.out is not None:
        check_output(options.out, overwrite=options.overwrite)
    plan = FidelityPlan(entries=read_ablations(options.configs, is_rate_matched=options.match_rate))
    if options.scenes:
        plan = replace(plan, scenes=tuple(options.scenes.split(",")))
    console = Console(stderr=True, quiet=options.quiet, highlight=False)
    report = run_fidelity(
        plan, jobs=options.jobs, announce=lambda line: console.print(line, style="dim")
    )
    if options.out is not None:
        write_document(options.out, report.document(), overwrite=options.overwrite)
    sys.stdout.write(fidelity_tables(report, baseline=options.baseline))

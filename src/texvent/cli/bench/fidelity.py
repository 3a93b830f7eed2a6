"""`texvent bench fidelity`: simulators against the true events of exact scenes."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

from rich.console import Console

from texvent.bench.document import write_document
from texvent.bench.fidelity.entries import choose_entries
from texvent.bench.fidelity.run import FULL, FidelityPlan, run_fidelity
from texvent.bench.fidelity.table import fidelity_tables
from texvent.cli.options import parse_options
from texvent.io.atomic import check_output


@dataclass(frozen=True, kw_only=True)
class FidelityOptions:
    """What to run, and where to keep the result."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    full: bool = False
    """Every scene, ideal and noisy pixels, five seeds: an hour instead of minutes."""
    scenes: str | None = None
    """Names of scenes, separated by commas: mixed, slow, fast, translate, static, flicker, hdr,
    prompt-car, prompt-dog, prompt-bird; default: mixed,translate,fast,slow."""
    simulators: str | None = None
    """Names of simulators, separated by commas, a preset after a colon (physical:davis346);
    default: all that are registered, and texvent:accurate."""
    interpolations: str | None = None
    """Names of interpolators, separated by commas; default: none,blend,flow,exact (the true
    frames). Others, such as rife, need their weights."""
    jobs: int = 2
    """Processes to use."""
    out: Path | None = None
    """JSON file with every value; `texvent bench page` makes a page of it."""
    overwrite: bool = False
    """Replace a file that exists already."""
    quiet: bool = False
    """No progress; only the tables."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    values = parse_options(
        arguments,
        {"options": FidelityOptions()},
        prog="texvent bench fidelity",
        description="Simulators get a video of 24 frames per second in 8 bits, and are scored by "
        "the events that truly happened. docs/benchmark.md explains the tables.",
    )
    options = FidelityOptions(**values)
    if options.out is not None:
        check_output(options.out, overwrite=options.overwrite)
    plan = FULL if options.full else FidelityPlan()
    if options.scenes:
        plan = replace(plan, scenes=tuple(options.scenes.split(",")))
    plan = replace(plan, entries=choose_entries(options.simulators, options.interpolations))
    console = Console(stderr=True, quiet=options.quiet, highlight=False)
    report = run_fidelity(
        plan, jobs=options.jobs, progress=lambda line: console.print(line, style="dim")
    )
    if options.out is not None:
        write_document(options.out, report.document(), overwrite=options.overwrite)
    sys.stdout.write(fidelity_tables(report))

"""`texvent bench`: the self-test of the metrics, and the benchmark of simulators."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, ClassVar

from rich.console import Console

from texvent._registry import SIMULATORS, suggest
from texvent.bench.ablation import read_ablations
from texvent.bench.bar_chart import bar_chart
from texvent.bench.entries import INTERPOLATIONS, Entry
from texvent.bench.fidelity import FULL, FidelityPlan, run_fidelity
from texvent.bench.fidelity_table import fidelity_tables
from texvent.bench.picture_grid import picture_grid
from texvent.bench.selftest import run_selftest, selftest_document, selftest_table
from texvent.cli.options import parse_options
from texvent.errors import ConfigError
from texvent.io.atomic import atomic_file, check_output

USAGE = """usage: texvent bench fidelity [OPTIONS]
       texvent bench paper [OPTIONS]
       texvent bench selftest [OPTIONS]

  fidelity  which simulator comes closest to the true events of exact scenes?
  paper     the paper's ablations E1-E12, or any folder of config files, on the same scenes
  selftest  20 perturbations of a recording: which of them does each metric see?

Help: texvent bench NAME --help
"""


@dataclass(frozen=True, kw_only=True)
class SelftestOptions:
    """What to test, and where to keep the result."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    metrics: str | None = None
    """Names of metrics, separated by commas; default: all of them."""
    out: Path | None = None
    """JSON file with every value and z-score."""
    overwrite: bool = False
    """Replace a file that exists already."""
    quiet: bool = False
    """No progress; only the table."""


@dataclass(frozen=True, kw_only=True)
class FidelityOptions:
    """What to run, and where to keep the result."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    full: bool = False
    """Every scene, ideal and noisy pixels, five seeds: hours instead of minutes."""
    scenes: str | None = None
    """Names of scenes, separated by commas: mixed, slow, fast, translate, static, flicker, hdr."""
    simulators: str | None = None
    """Names of simulators, separated by commas; default: all that are registered."""
    interpolations: str | None = None
    """Names of interpolators, separated by commas: none, blend, flow, exact (true frames);
    default: all of them."""
    jobs: int = 2
    """Processes to use."""
    out: Path | None = None
    """JSON file with every value; docs/benchmark.md describes it."""
    picture: Path | None = None
    """PNG file with the true events of the first scene beside those of every entry."""
    chart: Path | None = None
    """SVG file with STPP of every entry as bars with standard errors."""
    overwrite: bool = False
    """Replace a file that exists already."""
    quiet: bool = False
    """No progress; only the tables."""


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


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    if not arguments or arguments[0] in ("-h", "--help"):
        sys.stdout.write(USAGE)
        return 0 if arguments else 2
    if arguments[0] not in BENCHMARKS:
        raise ConfigError(
            f"unknown benchmark {arguments[0]!r}; {suggest(arguments[0], tuple(BENCHMARKS))}"
        )
    BENCHMARKS[arguments[0]](arguments[1:])
    return 0


def _selftest(arguments: Sequence[str]) -> None:
    values = parse_options(
        arguments,
        {"options": SelftestOptions()},
        prog="texvent bench selftest",
        description="Which of 20 perturbations of a recording does each metric see? "
        "docs/metrics.md explains the table.",
    )
    options = SelftestOptions(**values)
    console = Console(stderr=True, quiet=options.quiet, highlight=False)
    if options.out is not None:
        check_output(options.out, overwrite=options.overwrite)
    rows = run_selftest(
        options.metrics.split(",") if options.metrics else None,
        announce=lambda line: console.print(line, style="dim"),
    )
    if options.out is not None:
        _write_json(options.out, selftest_document(rows), overwrite=options.overwrite)
    sys.stdout.write(selftest_table(rows))


def _fidelity(arguments: Sequence[str]) -> None:
    values = parse_options(
        arguments,
        {"options": FidelityOptions()},
        prog="texvent bench fidelity",
        description="Simulators get a film at 24 frames per second in 8 bits, and are judged by "
        "the events that truly happened. docs/benchmark.md explains the tables.",
    )
    options = FidelityOptions(**values)
    for path in (options.out, options.picture, options.chart):
        if path is not None:
            check_output(path, overwrite=options.overwrite)
    plan = FULL if options.full else FidelityPlan()
    if options.scenes:
        plan = replace(plan, scenes=tuple(options.scenes.split(",")))
    plan = replace(plan, entries=_choose_entries(options))
    console = Console(stderr=True, quiet=options.quiet, highlight=False)
    report = run_fidelity(
        plan, jobs=options.jobs, announce=lambda line: console.print(line, style="dim")
    )
    if options.out is not None:
        _write_json(options.out, report.document(), overwrite=options.overwrite)
    if options.picture is not None:
        png = picture_grid(report, plan.scenes[0], list(plan.entries))
        with atomic_file(options.picture, overwrite=options.overwrite) as part:
            part.write_bytes(png)
    if options.chart is not None:
        with atomic_file(options.chart, overwrite=options.overwrite) as part:
            part.write_text(bar_chart(report), encoding="utf-8")
    sys.stdout.write(fidelity_tables(report))


def _paper(arguments: Sequence[str]) -> None:
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
        _write_json(options.out, report.document(), overwrite=options.overwrite)
    sys.stdout.write(fidelity_tables(report, baseline=options.baseline))


def _choose_entries(options: FidelityOptions) -> list[Entry]:
    chosen = [
        Entry(simulator=simulator, interpolate=interpolate)
        for simulator in _split(options.simulators, SIMULATORS.names())
        for interpolate in _split(options.interpolations, tuple(INTERPOLATIONS))
    ]
    for entry in chosen:
        if entry.interpolate not in INTERPOLATIONS:
            raise ConfigError(
                f"unknown interpolation {entry.interpolate!r}; "
                f"{suggest(entry.interpolate, tuple(INTERPOLATIONS))}"
            )
    return chosen


def _split(text: str | None, default: Sequence[str]) -> Sequence[str]:
    return text.split(",") if text else default


def _write_json(path: Path, document: Any, *, overwrite: bool) -> None:
    with atomic_file(path, overwrite=overwrite) as part:
        text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)
        part.write_text(text + "\n", encoding="utf-8")


BENCHMARKS = {"fidelity": _fidelity, "paper": _paper, "selftest": _selftest}
"""Name → what runs it."""

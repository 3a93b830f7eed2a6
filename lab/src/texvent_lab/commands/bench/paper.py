"""`texvent bench paper`: the tables of the paper, with our values and its own."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from typing import Any

from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.errors import ConfigError, InputError
from texvent.io.atomic import atomic_file
from texvent_lab.bench.document import describe_environment
from texvent_lab.bench.fidelity.entries import ConfigEntry, Entry, read_ablations
from texvent_lab.bench.fidelity.oracle_run import FidelityPlan, run_fidelity
from texvent_lab.bench.fidelity.table import check_baseline, fidelity_tables
from texvent_lab.bench.jobs import Progress
from texvent_lab.bench.paper.ablations import (
    choose_e8,
    leave_out_other_tables,
    measure_ablations,
)
from texvent_lab.bench.paper.config import ABLATIONS, BASELINE, CONFIGS, PaperConfig
from texvent_lab.bench.paper.figures import ABLATED, ABLATION_FIGURE, draw_figure
from texvent_lab.bench.paper.published_tables import (
    SCHEMA,
    TABLES,
    compare_with_paper,
    join_measured,
)
from texvent_lab.bench.paper.run import find_columns, interpolation, measure_table
from texvent_lab.bench.real.recording import open_scene
from texvent_lab.bench.real.run import run_real
from texvent_lab.commands.bench.bench import ResultOptions


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    config, output = parse_configs(
        arguments,
        {"options": PaperConfig(), "output": ResultOptions()},
        prog="texvent bench paper",
        description="The paper's tables: what can be measured here, next to the paper's values, "
        "and what input is missing for the rest. docs/ablations.md explains tables 4 and 5, "
        "docs/benchmark.md the others.",
    )
    output.check()
    if config.figure is not None:
        return _run_figure(config, output)
    found: dict[str, Any] = {}
    tables = [one for one in TABLES if one not in ABLATIONS] if config.all else [config.table]
    for number in tables:
        if number is not None and number not in ABLATIONS:
            found |= _run_table(config.of_table(number) if config.all else config, output.progress)
    if config.all or config.table is None or config.table in ABLATIONS:
        found |= _run_ablations(config, output.progress)
    facts = {"schema": SCHEMA, "environment": describe_environment()}
    output.write(lambda: {**facts, "is_rate_matched": config.match_rate, **found})


def _run_table(config: PaperConfig, progress: Progress) -> dict[str, Any]:
    """One table but 4 and 5, with the time that it took."""
    number, started = config.table or 0, time.perf_counter()
    measured = measure_table(config, progress)
    write_out(f"{compare_with_paper(TABLES[number], measured)}\n")
    return {f"table {number}": asdict(measured), f"seconds {number}": time.perf_counter() - started}


def _run_figure(config: PaperConfig, output: ResultOptions) -> None:
    """Draw a figure of the first recording, and say what it leaves out."""
    if output.out is None or output.out.suffix != ".png":
        raise ConfigError(f"out is {output.out}; a figure needs -o FILE.png")
    if not config.sources:
        raise InputError("there is no recording; texvent data pull slider_depth, or --recordings")
    entries: Mapping[str, Entry | ConfigEntry] = find_columns(config)
    if config.figure == ABLATION_FIGURE:
        entries = {one.name: one for one in _read_ablations(config) if one.name in ABLATED}
    scene = open_scene(config.sources[0])
    png, notes = draw_figure(config.figure or 0, scene, entries, config, output.progress)
    with atomic_file(output.out, overwrite=output.overwrite) as part:
        part.write_bytes(png)
    write_out("".join(f"- {note}\n" for note in notes))


def _read_ablations(config: PaperConfig) -> list[ConfigEntry]:
    folder = config.configs or CONFIGS
    return read_ablations(folder, is_rate_matched=config.match_rate, rife=config.rife)


def _run_ablations(config: PaperConfig, progress: Progress) -> dict[str, Any]:
    """Tables 4 and 5, or one of them, on scenes and recordings, with the time of the one run."""
    started = time.perf_counter()
    entries = _read_ablations(config)
    if config.table is not None:
        entries = leave_out_other_tables(config.table, entries)
    entries, e8 = choose_e8(entries, config.slomo_weights)
    check_baseline(config.baseline, [one.name for one in entries], default=BASELINE)
    recordings = [open_scene(source) for source in config.named_recordings]
    reports = []
    if config.oracle:
        plan = FidelityPlan(entries=entries)
        if config.scenes:
            plan = replace(plan, scenes=tuple(config.scenes.split(",")))
        reports.append(run_fidelity(plan, jobs=config.jobs, progress=progress))
    if recordings:
        reports.append(run_real(recordings, entries, jobs=config.jobs, progress=progress))
    tables: dict[str, Any] = {}
    for number in ABLATIONS if config.table is None else (config.table,):
        parts = [interpolation(config), *(measure_ablations(number, one) for one in reports)]
        measured = join_measured([*parts, e8] if number == 4 else parts)
        write_out(f"{compare_with_paper(TABLES[number], measured)}\n")
        tables[f"table {number}"] = asdict(measured)
        tables[f"seconds {number}"] = time.perf_counter() - started
    for report in reports:
        write_out(f"{fidelity_tables(report, baseline=config.baseline)}\n")
    return {**tables, "reports": [report.document() for report in reports]}

"""`texvent bench fidelity`: simulators against the true events of exact scenes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent_lab.bench.fidelity.entries import choose_entries
from texvent_lab.bench.fidelity.oracle_run import FULL, FidelityPlan, run_fidelity
from texvent_lab.bench.fidelity.table import fidelity_tables
from texvent_lab.commands.bench.bench import ResultOptions


@dataclass(frozen=True, kw_only=True)
class FidelityOptions:
    """Scenes and simulators."""

    full: bool = False
    """Every scene, ideal and noisy pixels, eight seeds: an hour instead of minutes."""
    scenes: str | None = None
    """Names of scenes, separated by commas: mixed, slow, fast, translate, static, flicker, hdr,
    prompt-car, prompt-dog, prompt-bird; default: mixed,translate,fast,slow."""
    simulators: str | None = None
    """Names of simulators, separated by commas, a preset after a colon (physical:davis346);
    default: all that are registered, texvent:paper, and physical:calibrated, which knows the
    sensor that makes the true events."""
    interpolations: str | None = None
    """Names of interpolators, separated by commas; default: none,blend,flow,exact (the true
    frames). Others, such as rife, need their weights."""
    jobs: int = 2
    """Processes to use."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, output = parse_configs(
        arguments,
        {"options": FidelityOptions(), "output": ResultOptions()},
        prog="texvent bench fidelity",
        description="Simulators get a video of 24 frames per second in 8 bits, and are scored by "
        "the events that truly happened. docs/benchmark.md explains the tables.",
    )
    output.check()
    plan = FULL if options.full else FidelityPlan()
    if options.scenes:
        plan = replace(plan, scenes=tuple(options.scenes.split(",")))
    plan = replace(plan, entries=choose_entries(options.simulators, options.interpolations))
    report = run_fidelity(plan, jobs=options.jobs, progress=output.progress)
    output.write(report.document)
    write_out(fidelity_tables(report))

"""`texvent bench paper`: the tables of the paper, with our figures and its own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, ClassVar

from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.errors import ConfigError
from texvent_lab.bench.document import describe_environment
from texvent_lab.bench.fidelity.run import FidelityPlan, run_fidelity
from texvent_lab.bench.fidelity.table import check_baseline, fidelity_tables
from texvent_lab.bench.jobs import Progress
from texvent_lab.bench.paper.config_entry import read_ablations
from texvent_lab.bench.paper.published_tables import TABLES, compare_with_paper, join_figures
from texvent_lab.bench.paper.run import PaperInputs, measure_table
from texvent_lab.bench.paper.tables import (
    BASELINE,
    TABLES_HERE,
    ablation_figures,
    leave_out_other_tables,
)
from texvent_lab.bench.real.recording import open_scene
from texvent_lab.bench.real.run import RealPlan, run_real
from texvent_lab.commands.bench.bench import ResultOptions

SCHEMA = "texvent-paper-1"


@dataclass(frozen=True, kw_only=True)
class PaperOptions:
    """Which table, from what."""

    main_options: ClassVar[tuple[str, ...]] = (
        "table", "scenes", "recordings", "configs", "weights", "match_rate", "seed", "out",
        "overwrite", "quiet",
    )  # fmt: skip

    table: int | None = None
    """Table of the paper: 1, 2, 4, 5, 7, 8 or 9; default: the ablations of both 4 and 5."""
    scenes: str | None = None
    """Tables 4 and 5: names of scenes of bench fidelity, separated by commas; default: its own."""
    oracle: bool = True
    """Tables 4 and 5: run on scenes with true events; --no-oracle leaves recordings alone."""
    recordings: str | None = None
    """Names of pulled data sets, or paths of recordings, separated by commas; default: slider_depth
    and davis346 where they are pulled, for tables 4 and 5 none."""
    match_rate: bool = True
    """Fit each contrast threshold to the number of true events. With --no-match-rate every row
    keeps its own, as in the paper: then the number of events decides."""
    configs: Path = Path("configs/paper")
    """Tables 4 and 5: folder with one TOML file per row."""
    baseline: str = BASELINE
    """Tables 4 and 5: row that the others are compared with, pair by pair."""
    weights: Path | None = None
    """Tables 1, 7, 8: published weights of the network; table 9: those of the classifier."""
    network: str | None = None
    """Tables 1, 7, 8: network that reconstructs images; default: the paper's (e2vid, for table 8
    et-net). firenet is the smallest."""
    rvt_weights: Path | None = None
    """Table 2: RVT's published weights, for EQS."""
    folder: Path | None = None
    """Table 9: folder with a sub-folder per column (original, texvent ...), each with a sub-folder
    of event files per class."""
    classes: Path | None = None
    """Table 9: names of the classes in the classifier's order, one per line."""
    jobs: int = 2
    """Processes for simulating on recordings and scenes."""

    def __post_init__(self) -> None:
        if self.table is not None and self.table not in TABLES:
            raise ConfigError(
                f"table is {self.table}; the tables are {', '.join(map(str, TABLES))}"
            )
        check_range("jobs", self.jobs, 1)
        if not self.oracle and not self.recordings and self.table in (None, *TABLES_HERE):
            raise ConfigError("--no-oracle leaves nothing to run; name --recordings")

    @property
    def inputs(self) -> PaperInputs:
        """What the user has."""
        return PaperInputs(
            recordings=tuple(self.recordings.split(",")) if self.recordings else (),
            is_rate_matched=self.match_rate,
            weights=self.weights,
            network=self.network,
            rvt_weights=self.rvt_weights,
            folder=self.folder,
            classes=self.classes,
            jobs=self.jobs,
        )


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, output = parse_configs(
        arguments,
        {"options": PaperOptions(), "output": ResultOptions()},
        prog="texvent bench paper",
        description="The paper's tables: what can be measured here, next to the paper's figures, "
        "and what input is missing for the rest. docs/ablations.md explains tables 4 and 5, "
        "docs/benchmark.md the others.",
    )
    output.check()

    if options.table is None or options.table in TABLES_HERE:
        found = _run_ablations(options, output.progress)
    else:
        figures = measure_table(options.table, options.inputs, output.progress)
        write_out(compare_with_paper(TABLES[options.table], figures))
        found = {f"table {options.table}": asdict(figures)}
    output.write(
        lambda: {
            "schema": SCHEMA,
            "environment": describe_environment(),
            "is_rate_matched": options.match_rate,
            **found,
        }
    )


def _run_ablations(options: PaperOptions, progress: Progress) -> dict[str, Any]:
    """Tables 4 and 5, or one of them, on scenes and recordings."""
    entries = read_ablations(options.configs, is_rate_matched=options.match_rate)
    if options.table is not None:
        entries = leave_out_other_tables(options.table, entries)
    check_baseline(options.baseline, [one.name for one in entries], default=BASELINE)
    recordings = [open_scene(source) for source in options.inputs.recordings]
    reports = []
    if options.oracle:
        plan = FidelityPlan(entries=entries)
        if options.scenes:
            plan = replace(plan, scenes=tuple(options.scenes.split(",")))
        reports.append(run_fidelity(plan, jobs=options.jobs, progress=progress))
    if recordings:
        real = RealPlan(entries=entries)
        reports.append(run_real(recordings, real, jobs=options.jobs, progress=progress))
    tables: dict[str, Any] = {}
    for number in TABLES_HERE if options.table is None else (options.table,):
        figures = join_figures([ablation_figures(number, report) for report in reports])
        write_out(f"{compare_with_paper(TABLES[number], figures)}\n")
        tables[f"table {number}"] = asdict(figures)
    for report in reports:
        write_out(f"{fidelity_tables(report, baseline=options.baseline)}\n")
    return {**tables, "reports": [report.document() for report in reports]}

"""`texvent bench page`: a result of `bench fidelity`, `real` or `digits` as a page with plots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.io.atomic import atomic_file, check_output
from texvent_lab.bench.digits import page as digits_page
from texvent_lab.bench.digits import results as digits_results
from texvent_lab.bench.document import read_document, result_name
from texvent_lab.bench.fidelity.page import page_files
from texvent_lab.bench.fidelity.results import read_report
from texvent_lab.bench.fidelity.table import BASELINE, check_baseline


@dataclass(frozen=True, kw_only=True)
class PageOptions:
    """Which result, and where the page goes."""

    positional: ClassVar[tuple[str, ...]] = ("result",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o"}

    result: Path = REQUIRED
    """JSON file that --out of `texvent bench fidelity`, `real` or `digits` wrote, as it is or
    compressed (.json.gz)."""
    baseline: str = BASELINE
    """Row that the others are compared with, pair by pair; of fidelity and real."""
    out: Path | None = None
    """Folder of the page and its charts; default: that of the result."""
    charts: bool = True
    """Draw the charts; --no-charts writes the tables alone."""
    overwrite: bool = False
    """Replace files that exist already."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    (options,) = parse_configs(
        arguments,
        {"options": PageOptions()},
        prog="texvent bench page",
        description="A result of bench fidelity, real or digits as a Markdown page with its tables "
        "and charts, named after the result.",
    )
    folder = options.out or options.result.parent
    name = result_name(options.result.name)
    check_output(folder / f"{name}.md", overwrite=options.overwrite)
    files = _page_files(options)
    for file, content in files.items():
        with atomic_file(folder / file, overwrite=options.overwrite) as part:
            part.write_bytes(content)
    write_out("".join(f"{folder / file}\n" for file in files))


def _page_files(options: PageOptions) -> dict[str, bytes]:
    document = read_document(options.result)
    if document.get("schema") == digits_results.SCHEMA:
        return digits_page.page_files(
            digits_results.read_report(document), options.result.name, has_charts=options.charts
        )
    report = read_report(document)
    check_baseline(options.baseline, [score.entry for score in report.scores])
    return page_files(
        report, options.result.name, baseline=options.baseline, has_charts=options.charts
    )

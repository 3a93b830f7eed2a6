"""A stored result as a Markdown page with a chart."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from texvent.errors import FileFormatError, one_line
from texvent_lab.bench.digits import results as digits
from texvent_lab.bench.document import (
    COMPRESSED,
    options_as_code,
    read_records,
    without_tags,
)
from texvent_lab.bench.fidelity.results import FidelityReport, read_report
from texvent_lab.bench.fidelity.table import BASELINE, check_baseline, fidelity_tables
from texvent_lab.bench.objects import results as objects
from texvent_lab.bench.paper.published_tables import SCHEMA as PAPER_SCHEMA
from texvent_lab.bench.paper.published_tables import TABLES, Measured, compare_with_paper
from texvent_lab.bench.reconstruction import factors
from texvent_lab.bench.selftest import SCHEMA as SELFTEST_SCHEMA
from texvent_lab.bench.selftest import SelftestRow, selftest_chart, selftest_table
from texvent_lab.bench.summary import summarise
from texvent_lab.charts import COLOURS, Dot, DotPanel, dot_chart

TRACK_COLOURS = {
    "frames": "#4c78a8",
    "true frames": "#59a14f",
    "frames, sensor known": "#9ab8dc",
    "true frames, sensor known": "#a8d3a2",
    "recorded": "#8c8c96",
}
"""Track → colour of its entries."""


def page_name(file_name: str) -> str:
    """Name of a result's page and chart: that of its file without .json or .json.gz."""
    return file_name.removesuffix(COMPRESSED).removesuffix(".json")


def page_files(
    document: Mapping[str, Any], file_name: str, *, baseline: str = BASELINE
) -> dict[str, bytes]:
    """The page of a result and its chart, with file names after the result's.

    Args:
        document: result of `bench fidelity`, `real`, `digits`, `objects`, `selftest` or `paper`, or
            of `measure.reconstruction_factors`.
        file_name: of the result.
        baseline: of fidelity and real, entry that the others are compared with, pair by pair.

    Raises:
        FileFormatError: it is another document.
        ConfigError: the baseline is no entry.
    """
    try:
        title, described, chart, tables = _content(document, baseline)
        facts = _facts(document)
    except (AttributeError, IndexError, KeyError, StopIteration, TypeError, ValueError) as error:
        raise FileFormatError(f"{file_name} is no result ({one_line(error)})") from error
    name = page_name(file_name)
    link = f"[{described}](../{described}) describes the measurement."
    drawing = [f"![Chart of the scores]({name}.svg)"] if chart else []
    which = name.partition("-")[2]  # several results of a kind: fidelity-programs
    heading = f"# {title} ({which})" if which else f"# {title}"
    parts = [heading, link, facts, *drawing, tables]
    page = options_as_code(without_tags("\n\n".join(part.rstrip() for part in parts) + "\n"))
    return {f"{name}.md": page.encode(), **({f"{name}.svg": chart} if chart else {})}


def _content(document: Mapping[str, Any], baseline: str) -> tuple[str, str, bytes, str]:
    """Title, page of the documentation, chart and tables."""
    if document.get("schema") == SELFTEST_SCHEMA:
        rows = read_records(SelftestRow, document["rows"])
        title = "Self-test of the metrics"
        return title, "metrics.md", selftest_chart(rows), selftest_table(rows)
    if document.get("schema") == digits.SCHEMA:
        found = digits.read_report(document)
        title = "Trained on simulated events, tested on recorded ones"
        return title, "digits.md", digits_chart(found), digits.digits_table(found)
    if document.get("schema") == objects.SCHEMA:
        scored = objects.read_report(document)
        title, tables = "Simulated objects, recorded tests", objects.objects_tables(scored)
        return title, "objects.md", objects_chart(scored), tables
    if document.get("schema") == factors.SCHEMA:
        learned = read_records(factors.FactorScore, document["rows"])
        title, table = "Images by simulated training", factors.factors_table(learned)
        return title, "teaching.md", factors.factors_chart(learned), table
    if document.get("schema") == PAPER_SCHEMA:
        return "The paper's tables", "benchmark.md", b"", paper_tables(document)
    report = read_report(document)
    check_baseline(baseline, [score.entry for score in report.scores])
    kind, described = (
        ("true", "benchmark.md") if report.score_seeds else ("recorded", "real-data.md")
    )
    tables = fidelity_tables(report, baseline=baseline)
    return f"Simulators against {kind} events", described, score_chart(report), tables


def paper_tables(document: Mapping[str, Any]) -> str:
    """All tables beside the paper's, with the seconds that each took; 4 and 5 are one run."""
    parts = []
    for number, table in TABLES.items():
        found = document.get(f"table {number}")
        if found is not None:
            measured, seconds = Measured(**found), document.get(f"seconds {number}")
            is_timed = measured.rows and seconds is not None
            took = f"- Measured in {seconds:.0f} s" if is_timed else ""
            parts.append(compare_with_paper(table, measured) + took)
    return "\n\n".join(parts)


def score_chart(report: FidelityReport) -> bytes:
    """STPP of every entry with its standard error, between null and floor: a panel per scene."""
    panels = []
    for one in report.references:
        dots = []
        for score in report.ranked(one.scene, one.target):
            found = score.summary("stpp")
            dots.append(Dot(score.entry, score.track, found.mean, found.standard_error))
        bounds = {"null": one.null["stpp"], "floor": one.floor["stpp"]}
        lines = {name: summarise(values).mean for name, values in bounds.items()}
        panels.append(DotPanel(f"{one.title}: STPP", dots, lines))
    return dot_chart(panels, TRACK_COLOURS, least=0)


def digits_chart(report: digits.DigitsReport) -> bytes:
    """Accuracy on recordings: a panel per representation, a row per arm, a colour per frames."""
    panels = []
    for kind, ceiling in report.ceiling.items():
        dots = []
        for one in report.scores:
            if one.representation == kind:
                found = summarise(one.accuracy)
                way = digits.WAY_TITLES[one.way]
                dots.append(Dot(one.arm, way, found.mean, found.standard_error))
        lines = {"trained on recordings": summarise(ceiling).mean}
        panels.append(DotPanel(digits.REPRESENTATION_TITLES[kind], dots, lines))
    colours = dict(zip(digits.WAY_TITLES.values(), COLOURS, strict=False))
    return dot_chart(panels, colours)


def objects_chart(report: objects.ObjectsReport) -> bytes:
    """First score of each arm on both tests: a panel each, with the recorded ceiling as a line."""
    panels = []
    for title, rows in (("table", report.table), ("turntable", report.turntable)):
        first = next(iter(rows[0].scores))
        found = {one.arm: summarise(one.scores[first]) for one in rows}
        ceiling = {"trained on recordings": found.pop(objects.RECORDED).mean}
        dots = [Dot(arm, first, one.mean, one.standard_error) for arm, one in found.items()]
        panels.append(DotPanel(f"{title}: {first}", dots, ceiling))
    colours = {panel.dots[0].series: COLOURS[n] for n, panel in enumerate(panels)}
    return dot_chart(panels, colours, least=0)


def _facts(document: Mapping[str, Any]) -> str:
    """Machine, protocol and seeds of a result, a line each."""
    facts = {**document["environment"], **document.get("protocol", {})}
    for name in ("fit_seeds", "score_seeds", "texture_seed", "recording_seeds", "seconds"):
        facts |= {name.replace("_", " "): document[name]} if document.get(name) else {}
    lines = []
    for name, value in facts.items():
        if isinstance(value, Mapping):
            value = ", ".join(f"{key} {one}" for key, one in value.items())
        elif isinstance(value, list):
            value = ", ".join(map(str, value))
        elif isinstance(value, float):
            value = f"{value:.6g}"
        lines.append(f"- {name}: {value}")
    return "\n".join(lines)

"""The results as a Markdown page with charts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.metrics.summary import summarise
from texvent_lab.bench.digits.results import RECORDINGS, DigitsReport
from texvent_lab.bench.digits.tables import (
    REPRESENTATION_TITLES,
    WAY_TITLES,
    accuracy_table,
    binomial_text,
    comparison_table,
    count_table,
    few_shot_table,
    mark_note,
)
from texvent_lab.bench.document import result_name, without_tags
from texvent_lab.charts import COLOURS, Dot, DotPanel, curve_chart, dot_chart

WAY_COLOURS = dict(zip(WAY_TITLES.values(), COLOURS, strict=False))


def accuracy_chart(report: DigitsReport) -> bytes:
    """Accuracy on recordings: a panel per representation, a row per arm, a colour per way.

    Of each arm it shows the first choice of a threshold that the run covers.
    """
    choice = report.scores[0].choice
    panels = []
    for kind, ceiling in report.ceiling.items():
        dots = []
        for one in report.scores:
            if (one.representation, one.choice) == (kind, choice):
                found = summarise(one.accuracy)
                dots.append(Dot(one.arm, WAY_TITLES[one.way], found.mean, found.standard_error))
        lines = {"trained on recordings": summarise(ceiling).mean}
        panels.append(DotPanel(f"{REPRESENTATION_TITLES[kind]}, δ {choice}", dots, lines))
    return dot_chart(panels, WAY_COLOURS)


def few_shot_chart(report: DigitsReport) -> bytes:
    """Accuracy by recordings per class, a curve per arm whose simulated events are added."""
    shots = sorted({one.shots for one in report.few_shot})
    found = {(one.arm, one.shots): summarise(one.accuracy) for one in report.few_shot}
    curves = {}
    for arm in dict.fromkeys(one.arm for one in report.few_shot):
        name = "recordings alone" if arm == RECORDINGS else f"with {arm}"
        curves[name] = [
            (one.mean, one.standard_error) if (one := found.get((arm, shot))) else (math.nan, 0)
            for shot in shots
        ]
    words = "recordings per class that the network sees"
    return curve_chart(curves, [*map(str, shots)], title="Accuracy on recordings", xlabel=words)


CHARTS = ACCURACY, FEW_SHOT = "-accuracy.svg", "-few-shot.svg"
"""Ends of the names of charts."""


def page_files(report: DigitsReport, result: str, *, has_charts: bool = True) -> dict[str, bytes]:
    """The page and its charts.

    Args:
        report: what a run found.
        result: name of its file, such as "digits.json.gz"; the page and charts are named after it.
        has_charts: False leaves the charts out.

    Returns:
        File name → content: `NAME.md`, `NAME-accuracy.svg` and, where networks saw a few
        recordings, `NAME-few-shot.svg`.
    """
    name = result_name(result)
    charts = _chart_files(report, name) if has_charts else {}
    parts = [
        "# Trained on simulated events, tested on recorded ones: the tables",
        "Written by `texvent bench digits`; [digits.md](../digits.md) says how to read it and what "
        "follows from it.",
        _facts({**report.environment, **report.protocol, "seconds": f"{report.seconds:.0f}"}),
        *([f"![Accuracy of every arm]({name}{ACCURACY})"] if has_charts else ()),
        "## Accuracy on recordings",
        "Mean ± standard error over networks of different seeds. "
        + binomial_text(report, int(report.protocol["recordings"])),
        mark_note(),
        *accuracy_sections(report),
        "## Thresholds and counts",
        count_table(report),
        *_few_shot_sections(report, f"{name}{FEW_SHOT}" if has_charts else None),
        "## Differences",
        "McNemar's exact test on the votes of all networks of an arm, as it is and by Holm's "
        "correction for the table; difference of the votes' accuracies with its 95 % interval by "
        "Agresti and Min.",
        *_comparison_sections(report),
    ]
    page = without_tags("\n\n".join(part.rstrip() for part in parts) + "\n")
    return {f"{name}.md": page.encode(), **charts}


def page_paths(result: Path | None) -> list[Path]:
    """All files that `page_files` may name, beside a result."""
    if result is None:
        return []
    name = result_name(result.name)
    return [result.parent / f"{name}{end}" for end in (".md", *CHARTS)]


def _chart_files(report: DigitsReport, name: str) -> dict[str, bytes]:
    charts = {f"{name}{ACCURACY}": accuracy_chart(report)}
    if report.few_shot:
        charts[f"{name}{FEW_SHOT}"] = few_shot_chart(report)
    return charts


def accuracy_sections(report: DigitsReport) -> list[str]:
    """A heading and a table for each representation."""
    return [
        part
        for kind in report.ceiling
        for part in (f"### {REPRESENTATION_TITLES[kind]}", accuracy_table(report, kind))
    ]


def _few_shot_sections(report: DigitsReport, chart: str | None) -> list[str]:
    if not report.few_shot:
        return []
    return [
        "## A few recordings",
        f"Tested on the {report.few_shot_tested} recordings that no network of the curve sees.",
        *([f"![Accuracy by recordings per class]({chart})"] if chart else ()),
        few_shot_table(report),
    ]


def _comparison_sections(report: DigitsReport) -> list[str]:
    kinds = dict.fromkeys((one.representation, one.way, one.choice) for one in report.comparisons)
    return [
        part
        for kind, way, choice in kinds
        if (table := comparison_table(report, kind, way, choice)).count("\n") > 2
        for part in (
            f"### {REPRESENTATION_TITLES[kind]}, {WAY_TITLES[way]}, δ {choice}",
            table,
        )
    ]


def _facts(facts: Mapping[str, Any]) -> str:
    lines = []
    for name, value in facts.items():
        if isinstance(value, Mapping):
            value = ", ".join(f"{key} {one}" for key, one in value.items())
        lines.append(f"- {name.replace('_', ' ')}: {value}")
    return "\n".join(lines)

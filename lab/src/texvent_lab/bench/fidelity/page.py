"""A result of the oracle benchmark as a Markdown page with charts."""

from __future__ import annotations

from collections.abc import Mapping

from texvent_lab.bench.document import result_name
from texvent_lab.bench.fidelity.bar_chart import bar_chart
from texvent_lab.bench.fidelity.detail_charts import level_chart, time_chart
from texvent_lab.bench.fidelity.event_image_grid import event_image_grid
from texvent_lab.bench.fidelity.results import FidelityReport
from texvent_lab.bench.fidelity.table import BASELINE, fidelity_tables, motion_table
from texvent_lab.bench.markdown import without_tags


def page_files(
    report: FidelityReport, result: str, *, baseline: str = BASELINE, has_charts: bool = True
) -> dict[str, bytes]:
    """The page and its charts.

    Args:
        report: a run that measured STPP.
        result: name of its file, such as "fidelity.json.gz"; the page and charts are named after
            it.
        baseline: entry that the others are compared with, pair by pair.
        has_charts: False leaves the charts out.

    Returns:
        File name → content: `NAME.md` and, with charts, `NAME-bars.svg`, `NAME-levels.svg`,
        `NAME-times.svg`, and `NAME-events.png` of scenes of the oracle, whose entries are simulated
        again.
    """
    name = result_name(result)
    charts = _chart_files(report, name) if has_charts else {}
    compared = "" if baseline == BASELINE else f' --baseline "{baseline}"'
    command = f"texvent bench page {result}{compared}{'' if has_charts else ' --no-charts'}"
    parts = [
        f"# Simulators against {'true' if report.score_seeds else 'recorded'} events: the tables",
        f"Written by `{command}`; [benchmark.md](../benchmark.md) and "
        "[real-data.md](../real-data.md) say how to read it and what follows from it.",
        _facts(report),
        *(_chart_sections(report, name) if has_charts else ()),
        "## Motion",
        "Sharpness: variance of the image of events moved along the known flow, over that of "
        "unmoved ones, in windows of 60 ms. Flow error: what contrast maximisation finds in the "
        "events against the known flow of the scene or, patch by patch, against what it finds in "
        "the recorded events; px/s.",
        motion_table(report),
        "## Scores",
        fidelity_tables(report, baseline=baseline),
    ]
    page = without_tags("\n\n".join(part.rstrip() for part in parts) + "\n")
    return {f"{name}.md": page.encode(), **charts}


def _chart_files(report: FidelityReport, name: str) -> dict[str, bytes]:
    first = report.references[0]
    charts = {
        f"{name}-bars.svg": bar_chart(report).encode(),
        f"{name}-levels.svg": level_chart(report, first.scene, first.target).encode(),
        f"{name}-times.svg": time_chart(report, first.scene, first.target).encode(),
    }
    if report.score_seeds:  # scenes of the oracle, which can be shown again
        charts[f"{name}-events.png"] = event_image_grid(report, first.scene)
    return charts


def _chart_sections(report: FidelityReport, name: str) -> list[str]:
    title = report.references[0].title
    events = [
        f"## The same 10 ms of {title}",
        f"![True and simulated events side by side]({name}-events.png)",
    ]
    return [
        f"![STPP of every entry with standard errors]({name}-bars.svg)",
        *(events if report.score_seeds else ()),
        f"## Levels: {title}",
        "STPP per level of the pyramid: shorter time cells downwards, smaller space cells (share "
        "of the sensor's side) to the right.",
        f"![STPP per level]({name}-levels.svg)",
        f"## Time errors: {title}",
        "For every true or recorded event, how much later the nearest simulated event of its pixel "
        "and polarity comes.",
        f"![Histograms of time errors]({name}-times.svg)",
    ]


def _facts(report: FidelityReport) -> str:
    facts = {
        **{name.replace("_", " "): value for name, value in report.environment.items()},
        "textures for δ": report.fit_seeds or None,
        "textures scored": report.score_seeds or None,
        **{f"{name}, µs": value for name, value in report.protocol.items()},
        "seconds": f"{report.seconds:.0f}",
    }
    lines = []
    for name, value in facts.items():
        if value is None:
            continue
        if isinstance(value, Mapping):
            value = ", ".join(f"{key} {one}" for key, one in value.items())
        elif isinstance(value, (list, tuple)):
            value = ", ".join(map(str, value))
        lines.append(f"- {name}: {value}")
    return "\n".join(lines)

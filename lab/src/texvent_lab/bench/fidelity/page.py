"""A result of the oracle benchmark as a Markdown page with charts and images."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.colors import to_rgba

from texvent.events import EventStream
from texvent.metrics.stpp import SPACE_CELLS, TIME_CELLS
from texvent.metrics.summary import summarise
from texvent.represent.event_frame import event_frame
from texvent.video import MICROSECONDS
from texvent.view.drawing.canvas import Image, blank, draw_text, enlarge, png_bytes, tile
from texvent.view.drawing.event_image import count_ceiling, draw_events
from texvent.view.drawing.palettes import get_palette
from texvent_lab.bench.document import result_name, without_tags
from texvent_lab.bench.fidelity.comparison import BIN_US, BINS, CAP_US, Details
from texvent_lab.bench.fidelity.entries import Entry
from texvent_lab.bench.fidelity.results import FidelityReport
from texvent_lab.bench.fidelity.table import BASELINE, fidelity_tables, motion_table
from texvent_lab.bench.oracle.pixel import FLOOR_SEED, REFERENCE_SEED, TARGETS
from texvent_lab.bench.oracle.recording import oracle_scene, record
from texvent_lab.bench.oracle.scenes import camera_level
from texvent_lab.charts import (
    Dot,
    DotPanel,
    Matrix,
    dot_chart,
    histogram_chart,
    matrix_chart,
)

COLOURS = {
    "frames": "#4c78a8",
    "true frames": "#59a14f",
    "frames, sensor known": "#9ab8dc",
    "true frames, sensor known": "#a8d3a2",
    "recorded": "#8c8c96",
}
"""Track → colour of its entries."""


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
    return dot_chart(panels, COLOURS, least=0)


def level_chart(report: FidelityReport, scene: str, target: str) -> bytes:
    """STPP on each level of the pyramid: time downwards, space to the right, fine at the end."""
    rows = [f"{50 / parts:g} ms" for parts in TIME_CELLS]
    columns = [f"1/{parts}" for parts in SPACE_CELLS]
    panels = []
    for title, (details, colour) in _entries(report, scene, target).items():
        colours = [[to_rgba(colour, share) for share in shares] for shares in details.levels]
        texts = [[f"{share:.2f}"[1:] for share in shares] for shares in details.levels]
        panels.append(Matrix(title, rows, columns, colours, texts))
    return matrix_chart(panels)


def time_chart(report: FidelityReport, scene: str, target: str) -> bytes:
    """Time from each true event to the nearest simulated one, -10 to +10 ms."""
    near = 1_000 // BIN_US
    panels = {}
    for title, (details, colour) in _entries(report, scene, target).items():
        shares = details.time_error
        within = sum(shares[BINS // 2 - near : BINS // 2 + near])
        alone = max(1 - sum(shares), 0)
        note = f"{100 * within:.0f} % in 1 ms, {100 * alone:.0f} % alone"
        panels[f"{title}\n{note}"] = (shares, colour)
    edges = [(number * BIN_US - CAP_US) / 1000 for number in range(BINS + 1)]
    return histogram_chart(panels, edges, unit="ms")


def _entries(report: FidelityReport, scene: str, target: str) -> dict[str, tuple[Details, str]]:
    """Title → details and colour: the floor, then the entries, the best first."""
    floor = report.reference(scene, target).details
    shown = {f"floor: {report.floor_name}": (floor, COLOURS["recorded"])}
    for score in report.ranked(scene, target):
        title = f"{score.entry}  {score.summary('stpp').mean:.3f}"
        shown[title] = (score.details, COLOURS[score.track])
    return shown


START_US, STOP_US = 250_000, 260_000
"""The 10 ms that are shown."""
ENLARGE = 3
COLUMNS = 4
TEXT_PX, MARGIN_PX = 10, 6
PAPER = (236, 238, 242)


def event_image_grid(report: FidelityReport, scene: str) -> bytes:
    """A PNG file: a video frame, the truth, a second recording, and each entry at its fitted δ.

    Args:
        report: a run that scored the scene.
        scene: which scene to show, on the first scoring seed, with the best entry first.
    """
    seed = report.score_seeds[0]
    shown = oracle_scene(scene, seed)
    target = next(one.target for one in report.references if one.scene == scene)
    model = TARGETS[target]
    streams = record(
        shown, {"truth": (model, REFERENCE_SEED), "second recording": (model, FLOOR_SEED)}
    )
    for score in report.ranked(scene, target):
        if score.track == "recorded":
            continue
        title = f"{score.entry}  {score.summary('stpp').mean:.2f}"
        streams[title] = Entry.parse(score.entry).simulate(shown, seed, score.threshold)
    level = camera_level(shown(START_US / MICROSECONDS))
    grey = np.repeat(np.rint(level).astype(np.uint8)[..., None], 3, axis=2)
    ceiling = count_ceiling(event_frame(_cut(streams["truth"]), "count"))
    panels = [_panel("scene", grey)]
    for title, events in streams.items():
        counts = event_frame(_cut(events), "count")
        panels.append(_panel(title, draw_events(counts, get_palette("paper"), ceiling=ceiling)))
    return png_bytes(tile(panels, COLUMNS, PAPER), level=9)


def _cut(events: EventStream) -> EventStream:
    return events.cut(START_US, STOP_US)


def _panel(title: str, image: Image) -> Image:
    large = enlarge(image, ENLARGE, how="blocks")
    height, width = large.shape[:2]
    panel = blank(width + 2 * MARGIN_PX, height + TEXT_PX + 3 * MARGIN_PX, PAPER)
    baseline = MARGIN_PX + TEXT_PX
    draw_text(panel, title, MARGIN_PX, baseline, height=TEXT_PX, colour=(38, 42, 50))
    top = TEXT_PX + 2 * MARGIN_PX
    panel[top : top + height, MARGIN_PX : MARGIN_PX + width] = large
    return panel


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
        f"{name}-bars.svg": score_chart(report),
        f"{name}-levels.svg": level_chart(report, first.scene, first.target),
        f"{name}-times.svg": time_chart(report, first.scene, first.target),
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

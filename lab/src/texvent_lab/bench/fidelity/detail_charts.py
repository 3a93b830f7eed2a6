"""Charts of what lies behind a score: level matrices and time errors, a panel per entry."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from texvent.metrics.stpp import SPACE_CELLS, TIME_CELLS
from texvent_lab.bench.fidelity.details import BIN_US, BINS, CAP_US, Details
from texvent_lab.bench.fidelity.results import FidelityReport, Score
from texvent_lab.bench.svg import COLOURS, placed, svg_document, svg_text

COLUMNS = 4
PANEL_WIDTH, PANEL_HEIGHT = 224, 150
HEAD_PX, LEFT_PX = 24, 38
CELL_WIDTH, CELL_HEIGHT = 28, 18
TIME_WIDTH, TIME_HEIGHT = 170, 80
SMALL = "font-size='9'"


def level_chart(report: FidelityReport, scene: str, target: str) -> str:
    """STPP on each level of the pyramid: time downwards, space to the right, fine at the end.

    Args:
        report: a run that scored the scene.
        scene: which scene.
        target: kind of pixels, "noisy" or "ideal".
    """
    return _chart(report, scene, target, _level_panel)


def time_chart(report: FidelityReport, scene: str, target: str) -> str:
    """How late the nearest simulated event is, for every true event, −10 to +10 ms.

    Args:
        report: a run that scored the scene.
        scene: which scene.
        target: kind of pixels, "noisy" or "ideal".
    """
    shown = [report.reference(scene, target).details]
    shown += [score.details for score in report.ranked(scene, target)]
    highest = max(share for details in shown for share in details.time_error)
    return _chart(report, scene, target, partial(_time_panel, highest=highest or 1.0))


def _chart(
    report: FidelityReport, scene: str, target: str, draw: Callable[[Details, str], str]
) -> str:
    reference = report.reference(scene, target)
    panels = [_panel(f"floor: {report.floor_name}", draw(reference.details, "#8c8c96"))]
    panels += [
        _panel(f"{score.entry}  {score.summary('stpp').mean:.3f}", _drawn(score, draw))
        for score in report.ranked(scene, target)
    ]
    rows = -(-len(panels) // COLUMNS)
    parts = [
        placed(panel, number % COLUMNS * PANEL_WIDTH, number // COLUMNS * PANEL_HEIGHT)
        for number, panel in enumerate(panels)
    ]
    return svg_document(COLUMNS * PANEL_WIDTH, rows * PANEL_HEIGHT, parts)


def _drawn(score: Score, draw: Callable[[Details, str], str]) -> str:
    return draw(score.details, COLOURS[score.track])


def _panel(title: str, body: str) -> str:
    return svg_text(title, 6, 15, "font-weight='bold'") + body


def _level_panel(details: Details, colour: str) -> str:
    """A coloured cell per level, its value in it; white on cells above 0.6."""
    cells, values, labels = [], [], []
    for row, (parts, shares) in enumerate(zip(TIME_CELLS, details.levels, strict=True)):
        y = HEAD_PX + row * CELL_HEIGHT
        labels.append(svg_text(f"{50 / parts:g} ms", LEFT_PX + 4, y + 13, "text-anchor='end'"))
        for column, share in enumerate(shares):
            x = LEFT_PX + 8 + column * CELL_WIDTH
            cells.append(
                f"<rect x='{x}' y='{y}' width='{CELL_WIDTH}' height='{CELL_HEIGHT}' "
                f"fill-opacity='{share:.3f}'/>"
            )
            ink = "fill='#ffffff'" if share > 0.6 else ""
            values.append(svg_text(f"{share:.2f}"[1:], x + CELL_WIDTH / 2, y + 13, ink))
    bottom = HEAD_PX + len(TIME_CELLS) * CELL_HEIGHT + 11
    for column, parts in enumerate(SPACE_CELLS):
        values.append(svg_text(f"1/{parts}", LEFT_PX + 8 + (column + 0.5) * CELL_WIDTH, bottom))
    return (
        f"<g fill='{colour}' stroke='#ffffff'>{''.join(cells)}</g>"
        f"<g {SMALL}>{''.join(labels)}<g text-anchor='middle'>{''.join(values)}</g></g>"
    )


def _time_panel(details: Details, colour: str, *, highest: float) -> str:
    left, bottom = 14, HEAD_PX + TIME_HEIGHT
    width = TIME_WIDTH / BINS
    steps = "".join(
        f"V{bottom - TIME_HEIGHT * share / highest:.2f}h{width:g}" for share in details.time_error
    )
    middle = left + TIME_WIDTH / 2
    near = 1_000 // BIN_US
    within = sum(details.time_error[BINS // 2 - near : BINS // 2 + near])
    cap = CAP_US // 1000
    note = f"text-anchor='middle' {SMALL}"
    return "".join(
        [
            f"<path d='M{left} {bottom}{steps}V{bottom}' fill='{colour}'/>",
            f"<line x1='{left}' y1='{bottom}' x2='{left + TIME_WIDTH}' y2='{bottom}' "
            "stroke='#26262e'/>",
            f"<line x1='{middle}' y1='{HEAD_PX}' x2='{middle}' y2='{bottom}' stroke='#b04a4a' "
            "stroke-dasharray='2 3'/>",
            svg_text(f"−{cap}", left, bottom + 11, note),
            svg_text("0", middle, bottom + 11, note),
            svg_text(f"+{cap} ms", left + TIME_WIDTH, bottom + 11, note),
            svg_text(
                f"within 1 ms {100 * within:.0f} %, no partner "
                f"{100 * max(1 - sum(details.time_error), 0):.0f} %",
                left,
                bottom + 24,
                SMALL,
            ),
        ]
    )

"""STPP of every entry as bars with error bars, between null and floor: one panel per scene."""

from __future__ import annotations

import math
from html import escape

from texvent.metrics.summary import summarise
from texvent_lab.bench.fidelity.results import FidelityReport, Reference, Score
from texvent_lab.bench.svg import COLOURS, placed, svg_document

LABEL_PX, BAR_PX, ROW_PX, HEAD_PX, GAP_PX = 200, 250, 16, 34, 24
"""Widths of the labels and of an STPP of 1; heights of a row and of a panel's head."""
LETTER_PX = 6.2
"""Mean width of a letter."""
PANELS_PER_ROW = 2


def bar_chart(report: FidelityReport) -> str:
    """An SVG document.

    Args:
        report: a run that measured STPP.
    """
    panels = [_panel(report, reference) for reference in report.references]
    width = LABEL_PX + BAR_PX + 60 + GAP_PX
    height = max(
        (len(report.ranked(one.scene, one.target)) for one in report.references), default=0
    )
    height = HEAD_PX + height * ROW_PX + GAP_PX
    columns = min(PANELS_PER_ROW, max(len(panels), 1))
    rows = -(-len(panels) // columns)
    parts = [
        placed(panel, number % columns * width, number // columns * height)
        for number, panel in enumerate(panels)
    ]
    parts.append(_legend({score.track for score in report.scores}, rows * height + GAP_PX // 2))
    return svg_document(columns * width, rows * height + GAP_PX, parts)


def _panel(report: FidelityReport, reference: Reference) -> str:
    scores = report.ranked(reference.scene, reference.target)
    bottom = HEAD_PX + len(scores) * ROW_PX
    parts = [
        f"<text x='{LABEL_PX}' y='16' font-weight='bold'>"
        f"{escape(f'{reference.title}: STPP')}</text>"
    ]
    bounds = (("null", "end", reference.null), ("floor", "start", reference.floor))
    for name, anchor, values in bounds:
        x = LABEL_PX + BAR_PX * _finite(summarise(values["stpp"]).mean)
        parts.append(
            f"<line x1='{x:.1f}' y1='{HEAD_PX - 4}' x2='{x:.1f}' y2='{bottom}' "
            f"stroke='#b04a4a' stroke-dasharray='3 2'/>"
            f"<text x='{x:.1f}' y='{HEAD_PX - 6}' text-anchor='{anchor}' fill='#b04a4a' "
            f"font-size='9'>{name}</text>"
        )
    parts += [_bar(score, HEAD_PX + row * ROW_PX) for row, score in enumerate(scores)]
    return "".join(parts)


def _bar(score: Score, top: float) -> str:
    summary = score.summary("stpp")
    mean, error = _finite(summary.mean), _finite(summary.standard_error)
    middle = top + ROW_PX / 2
    left, right = (LABEL_PX + BAR_PX * (mean + sign * error) for sign in (-1, 1))
    end = LABEL_PX + BAR_PX * mean
    shown = f"{mean:.3f}" if summary.defined else "undefined"
    return (
        f"<text x='{LABEL_PX - 6}' y='{middle + 4}' text-anchor='end'>{escape(score.entry)}</text>"
        f"<rect x='{LABEL_PX}' y='{top + 2}' width='{end - LABEL_PX:.1f}' height='{ROW_PX - 4}' "
        f"fill='{COLOURS[score.track]}'/>"
        f"<line x1='{left:.1f}' y1='{middle}' x2='{right:.1f}' y2='{middle}' stroke='#000000'/>"
        f"<text x='{LABEL_PX + BAR_PX + 8}' y='{middle + 4}' font-size='9'>{shown}</text>"
    )


def _legend(tracks: set[str], y: float) -> str:
    parts, x = [], 10.0
    for name, colour in COLOURS.items():
        if name in tracks:
            parts.append(
                f"<rect x='{x:g}' y='{y - 9}' width='10' height='10' fill='{colour}'/>"
                f"<text x='{x + 15:g}' y='{y}'>{name}</text>"
            )
            x += 30 + LETTER_PX * len(name)
    return "".join(parts)


def _finite(value: float) -> float:
    return value if math.isfinite(value) else 0.0

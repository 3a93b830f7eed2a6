"""The self-test as a chart: every metric against every perturbation."""

from __future__ import annotations

import math
from collections.abc import Sequence

from texvent_lab.bench.selftest.perturbations import PERTURBATIONS
from texvent_lab.bench.selftest.run import DETECTED, SelftestRow, ranked_rows
from texvent_lab.bench.svg import svg_document, svg_text

CELL_WIDTH, CELL_HEIGHT = 34, 18
LEFT_PX, TOP_PX, FOOT_PX, RIGHT_PX = 104, 104, 24, 50
FOUND, REWARDED = "#4c78a8", "#e45756"
"""Colours of what was found, and of damage that scores better than a second recording."""
FULL = 1000.0
"""Standard deviations that are drawn in full colour."""
SMALL = "font-size='9'"
LEGEND = (
    "Standard deviations worse than the floor. Blue: found (above 3). White: missed. "
    "Red: damage that the metric rewards."
)


def selftest_chart(rows: Sequence[SelftestRow]) -> str:
    """An SVG image of z-scores, the metrics that found most on top.

    Args:
        rows: what `run_selftest` or `read_selftest` gave.
    """
    parts = []
    for column, name in enumerate(PERTURBATIONS):
        x = LEFT_PX + (column + 0.6) * CELL_WIDTH
        parts.append(
            svg_text(name, x, TOP_PX - 6, f"transform='rotate(-45,{x:.1f},{TOP_PX - 6})' {SMALL}")
        )
    for number, row in enumerate(ranked_rows(rows)):
        y = TOP_PX + number * CELL_HEIGHT
        parts.append(svg_text(row.metric, LEFT_PX - 6, y + 13, "text-anchor='end'"))
        parts += [
            _cell(row.z[name], LEFT_PX + column * CELL_WIDTH, y)
            for column, name in enumerate(PERTURBATIONS)
        ]
    bottom = TOP_PX + len(rows) * CELL_HEIGHT
    parts.append(svg_text(LEGEND, LEFT_PX, bottom + 16, SMALL))
    width = LEFT_PX + len(PERTURBATIONS) * CELL_WIDTH + RIGHT_PX
    return svg_document(width, bottom + FOOT_PX, parts)


def _cell(z: float, x: float, y: float) -> str:
    """A rectangle as strong as the damage was seen, and its number."""
    colour, strength = "#ffffff", 1.0
    if abs(z) > DETECTED:
        colour = FOUND if z > 0 else REWARDED
        strength = 0.15 + 0.85 * min(math.log(abs(z) / DETECTED) / math.log(FULL / DETECTED), 1.0)
    ink = "#ffffff" if strength > 0.6 and abs(z) > DETECTED else "#26262e"
    middle = f"text-anchor='middle' {SMALL} style='fill:{ink}'"
    return (
        f"<rect x='{x}' y='{y}' width='{CELL_WIDTH}' height='{CELL_HEIGHT}' fill='{colour}' "
        f"fill-opacity='{strength:.3f}' stroke='#d8d8de'/>"
        + svg_text(_short(z), x + CELL_WIDTH / 2, y + 13, middle)
    )


def _short(z: float) -> str:
    """A number in at most five characters."""
    if math.isnan(z):
        return "–"
    if abs(z) == math.inf:
        return "∞" if z > 0 else "−∞"
    text = f"{z:.0f}" if abs(z) < 10_000 else f"{z / 1000:.0f}k"
    return text.replace("-0", "0").replace("-", "−")

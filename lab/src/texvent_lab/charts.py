"""Charts of results, drawn by matplotlib and returned as SVG.

Equal results give equal bytes with the same matplotlib. Text stays text.
"""

from __future__ import annotations

import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

COLOURS = (
    *("#4c78a8", "#f58518", "#59a14f", "#b279a2", "#8c8c96"),
    *("#e45756", "#72b7b2", "#9c755f", "#d4a600", "#26262e"),
)
"""Colours of series, in order."""
REFERENCE = "#b04a4a"
"""Colour of lines that others are compared with."""
LONGEST_LABEL = 40
GRID, INK = "#d8d8de", "#26262e"
STYLE: Any = {
    "svg.fonttype": "none",
    "svg.hashsalt": "texvent",
    "font.size": 8,
    "axes.titlesize": 9,
    "text.color": INK,
    "text.parse_math": False,
}


@dataclass(frozen=True)
class Dot:
    """A mean with its standard error; NaN draws nothing."""

    row: str
    series: str
    mean: float
    error: float


@dataclass(frozen=True)
class DotPanel:
    """Dots of several rows beside each other, with vertical lines of reference."""

    title: str
    dots: Sequence[Dot]
    lines: Mapping[str, float] = field(default_factory=dict)


def dot_chart(
    panels: Sequence[DotPanel], colours: Mapping[str, str], *, least: float | None = None
) -> bytes:
    """A panel each: a row per name, its means with standard errors, a colour per series.

    Args:
        panels: at least one.
        colours: series → colour; those that occur are listed below the panels.
        least: left end of the axis; None: the tenth below the lowest error bar.
    """
    rows = max(len({dot.row for dot in panel.dots}) for panel in panels)
    figure, axes = _figure(len(panels), min(len(panels), 2), 5.2, 0.9 + 0.2 * rows)
    for ax, panel in zip(axes, panels, strict=True):
        names = list(dict.fromkeys(dot.row for dot in panel.dots))
        for dot in panel.dots:
            series = list(dict.fromkeys(one.series for one in panel.dots if one.row == dot.row))
            shift = 0.16 * (series.index(dot.series) - (len(series) - 1) / 2)
            error = dot.error if math.isfinite(dot.error) else 0.0
            colour = colours[dot.series]
            ax.errorbar(dot.mean, names.index(dot.row) + shift, xerr=error, fmt="o", color=colour)
        for name, x in panel.lines.items():
            ax.axvline(x, color=REFERENCE, linestyle="--", linewidth=1)
            ax.annotate(name, (x, 1), xycoords=("data", "axes fraction"), color=REFERENCE)
        lowest = min((d.mean - (d.error or 0) for d in panel.dots if d.mean == d.mean), default=0)
        ax.set_xlim(least if least is not None else max(math.floor(lowest * 10), 0) / 10, 1)
        ax.set_yticks(range(len(names)), [_label(name) for name in names])
        ax.set_ylim(len(names) - 0.5, -0.5)
        ax.set_title(_label(panel.title), loc="left", pad=12, weight="bold")
        ax.grid(axis="x", color=GRID)
    used = {dot.series for panel in panels for dot in panel.dots}
    for name, colour in colours.items():
        if name in used:
            axes[0].plot([], [], "o", color=colour, label=name)
    figure.legend(loc="outside lower left", ncols=len(used), frameon=False)
    return _svg(figure)


def matrix_chart(
    rows: Sequence[str],
    columns: Sequence[str],
    colours: Any,
    texts: Sequence[Sequence[str]],
    *,
    note: str = "",
) -> bytes:
    """Coloured cells with a text each.

    Args:
        rows: names, from the top.
        columns: names, from the left.
        colours: [rows, columns, 4] RGBA, 0..1.
        texts: of each cell, row by row.
        note: below the cells.
    """
    figure, (ax,) = _figure(1, 1, 1.0 + 0.34 * len(columns), 0.9 + 0.2 * len(rows))
    colours = np.asarray(colours, float)
    ax.imshow(colours, aspect="auto", interpolation="nearest")
    for row, column in np.ndindex(len(rows), len(columns)):
        rgba = colours[row, column]
        ink = "white" if rgba[3] * (1 - rgba[:3].mean()) > 0.35 else INK
        ax.text(column, row, texts[row][column], ha="center", va="center", fontsize=6, color=ink)
    ax.set_xticks(range(len(columns)), columns, rotation=45, ha="right", rotation_mode="anchor")
    ax.set_yticks(range(len(rows)), rows)
    ax.tick_params(length=0)
    figure.supxlabel(note, fontsize=7)
    return _svg(figure)


def _label(text: str) -> str:
    """A name that leaves room for what it names."""
    one_line = " ".join(text.split())
    return one_line if len(one_line) <= LONGEST_LABEL else f"{one_line[: LONGEST_LABEL - 1]}…"


def _figure(count: int, columns: int, width: float, height: float) -> tuple[Any, list[Any]]:
    """A figure with so many axes, each of a width and height in inches."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    rows = -(-count // columns)
    with mpl.rc_context(STYLE):
        size = (columns * width, rows * height + 0.3)
        figure = Figure(figsize=size, layout="constrained", facecolor="white")
        axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for ax in axes[count:]:
        ax.remove()
    for ax in axes[:count]:
        ax.set_axisbelow(True)
        ax.spines[["top", "right"]].set_visible(False)
    return figure, list(axes[:count])


def _svg(figure: Any) -> bytes:
    import matplotlib as mpl

    content = io.BytesIO()
    with mpl.rc_context(STYLE):
        figure.savefig(content, format="svg", metadata={"Date": None})
    return content.getvalue()

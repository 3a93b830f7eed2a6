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
class Matrix:
    """Cells with a colour and a text each."""

    title: str
    rows: Sequence[str]
    columns: Sequence[str]
    colours: Any
    """[rows, columns, 4] RGBA, 0..1."""
    texts: Sequence[Sequence[str]]


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


def matrix_chart(panels: Sequence[Matrix], *, columns: int = 4, note: str = "") -> bytes:
    """A panel each: coloured cells with their texts."""
    high, wide = np.asarray(panels[0].colours).shape[:2]
    columns = min(columns, len(panels))
    figure, axes = _figure(len(panels), columns, 1.0 + 0.34 * wide, 0.9 + 0.2 * high)
    for ax, panel in zip(axes, panels, strict=True):
        colours = np.asarray(panel.colours, float)
        ax.imshow(colours, aspect="auto", interpolation="nearest")
        for (row, column), rgba in zip(np.ndindex(high, wide), colours.reshape(-1, 4), strict=True):
            is_dark = rgba[3] * (1 - rgba[:3].mean()) > 0.35
            ink = "white" if is_dark else INK
            text = panel.texts[row][column]
            ax.text(column, row, text, ha="center", va="center", fontsize=6, color=ink)
        turned = {"rotation": 45, "ha": "right", "rotation_mode": "anchor"} if wide > 8 else {}
        ax.set_xticks(range(wide), panel.columns, **turned)
        ax.set_yticks(range(high), panel.rows)
        ax.tick_params(length=0)
        ax.set_title(_label(panel.title), loc="left", weight="bold", fontsize=7)
    if note:
        figure.supxlabel(note, fontsize=7)
    return _svg(figure)


def histogram_chart(
    panels: Mapping[str, tuple[Sequence[float], str]], edges: Sequence[float], *, unit: str
) -> bytes:
    """A panel each, with equal axes: title → (share per bin, colour)."""
    figure, axes = _figure(len(panels), 4, 2.3, 1.3)
    highest = max((max(shares) for shares, _ in panels.values()), default=1.0) or 1.0
    for ax, (title, (shares, colour)) in zip(axes, panels.items(), strict=True):
        ax.stairs(shares, edges, fill=True, color=colour)
        ax.axvline(0, color=REFERENCE, linestyle=":", linewidth=1)
        ax.set_ylim(0, highest)
        ax.set_yticks([])
        ax.set_title("\n".join(map(_label, title.split("\n"))), loc="left", fontsize=7)
        ax.set_xlabel(unit, fontsize=6)
    return _svg(figure)


def curve_chart(
    curves: Mapping[str, Sequence[tuple[float, float]]],
    ticks: Sequence[str],
    *,
    title: str,
    xlabel: str,
) -> bytes:
    """Curves over the same ticks: name → (mean, standard error) at each; NaN leaves a gap."""
    figure, (ax,) = _figure(1, 1, 7.5, 3.6)
    for number, (name, points) in enumerate(curves.items()):
        means, errors = np.array(points, float).T
        colour = COLOURS[number % len(COLOURS)]
        ax.errorbar(range(len(ticks)), means, np.nan_to_num(errors), fmt="-o", color=colour,
                    label=name)  # fmt: skip
    ax.set_xticks(range(len(ticks)), ticks)
    ax.set_xlabel(xlabel)
    ax.set_title(title, loc="left", weight="bold")
    ax.grid(axis="y", color=GRID)
    figure.legend(loc="outside right upper", frameon=False)
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

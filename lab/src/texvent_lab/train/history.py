"""What was scored after every epoch, as a JSON file and as curves."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from texvent.extending import require
from texvent.io.atomic import atomic_file
from texvent_lab.train.schedule import EXTRA

HISTORY_FILE, CURVES_FILE = "history.json", "curves.png"
Row = Mapping[str, float]
"""Name → value of one epoch; "epoch" counts from 1."""
HIDDEN = ("epoch", "seconds")
"""What gets no curve of its own."""
LOSSES = "loss"
"""End of the names of losses, which share a plot."""
MOST_COLUMNS, WIDTH_INCHES, HEIGHT_INCHES = 3, 4.5, 3.4
COLOURS = ("#1f77b4", "#d95f02", "#2ca02c", "#7b3294")
STANDARD_ERROR = " standard error"
"""End of the names of standard errors; they are drawn around what they belong to."""


def write_history(folder: Path, facts: Mapping[str, Any], rows: Sequence[Row]) -> None:
    """Write both files, over those of the epoch before.

    Args:
        folder: of the training.
        facts: what else the JSON says: how it was trained, and which epoch is the best.
        rows: of all epochs so far.

    Raises:
        MissingDependencyError: matplotlib is not installed.
    """
    text = json.dumps({**facts, "epochs": [*rows]}, indent=1)
    with atomic_file(folder / HISTORY_FILE, overwrite=True) as part:
        part.write_text(text + "\n", encoding="utf-8")
    figure = draw_curves(rows, best=facts.get("best_epoch"))
    with atomic_file(folder / CURVES_FILE, overwrite=True) as part:
        figure.savefig(part, format="png", dpi=120)


def draw_curves(rows: Sequence[Row], *, best: int | None = None) -> Any:
    """A matplotlib figure: all losses in one plot, then a plot per score.

    Args:
        rows: of all epochs so far, at least one.
        best: the epoch to mark.
    """
    figure_module = require("matplotlib.figure", extra=EXTRA)
    plots: dict[str, list[str]] = {}
    for name in rows[0]:
        if name not in HIDDEN and not name.endswith(STANDARD_ERROR):
            plots.setdefault(LOSSES if name.endswith(LOSSES) else name, []).append(name)
    columns = min(len(plots), MOST_COLUMNS)
    lines = -(-len(plots) // columns)
    size = (WIDTH_INCHES * columns, HEIGHT_INCHES * lines)
    figure = figure_module.Figure(figsize=size, layout="constrained", facecolor="white")
    places = figure.subplots(lines, columns, squeeze=False).ravel()
    for axes, (title, names) in zip(places, plots.items(), strict=False):
        _draw_plot(axes, rows, names, best)
        axes.set_title(title)
    for axes in places[len(plots) :]:
        axes.remove()
    return figure


def _draw_plot(axes: Any, rows: Sequence[Row], names: Sequence[str], best: int | None) -> None:
    """Scores over epochs, with their standard errors if they are known."""
    epochs = [row["epoch"] for row in rows]
    if best is not None:
        axes.axvline(best, color="0.6", linestyle="--", linewidth=1, label=f"best epoch {best}")
    for name, colour in zip(names, COLOURS, strict=False):
        values = np.array([row[name] for row in rows])
        axes.plot(epochs, values, color=colour, marker=".", label=name)
        if name + STANDARD_ERROR in rows[0]:
            error = np.array([row[name + STANDARD_ERROR] for row in rows])
            axes.fill_between(
                epochs, values - error, values + error, color=colour, alpha=0.2, linewidth=0,
                label="± standard error",
            )  # fmt: skip
    axes.set_facecolor("white")
    axes.set_xlabel("epoch")
    axes.set_xlim(0.5, max(epochs[-1], 2) + 0.5)
    axes.xaxis.get_major_locator().set_params(integer=True)
    axes.grid(color="0.9")
    axes.set_axisbelow(True)
    axes.legend(fontsize="small", framealpha=0.8)

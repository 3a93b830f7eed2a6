"""What was scored after every epoch, as a JSON file and as curves."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.io.atomic import atomic_file
from texvent.train.schedule import EXTRA

HISTORY_FILE, CURVES_FILE = "history.json", "curves.png"
Row = Mapping[str, float]
"""Name → value of one epoch; "epoch" counts from 1."""
HIDDEN = ("epoch", "seconds")
"""What gets no curve of its own."""


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
    """A matplotlib figure: one plot per score, the loss of training first.

    Args:
        rows: of all epochs so far, at least one.
        best: the epoch to mark.
    """
    figure_module = require("matplotlib.figure", extra=EXTRA)
    names = [name for name in rows[0] if name not in HIDDEN]
    figure = figure_module.Figure(figsize=(4 * len(names), 3), layout="constrained")
    epochs = [row["epoch"] for row in rows]
    for axes, name in zip(figure.subplots(1, len(names), squeeze=False)[0], names, strict=True):
        axes.plot(epochs, [row[name] for row in rows], marker="o", markersize=3)
        if best is not None:
            axes.axvline(best, color="0.7", linewidth=1, zorder=0)
        axes.set_title(name)
        axes.set_xlabel("epoch")
        axes.xaxis.get_major_locator().set_params(integer=True)
        axes.grid(alpha=0.3)
    return figure

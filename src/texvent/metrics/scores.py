"""Scores by name, which show themselves as a table in notebooks."""

from __future__ import annotations

import html
import math
from collections.abc import Collection, Mapping, Sequence

from texvent.metrics.protocol import Metric

GOOD = {"lower": "low", "higher": "high", "one": "near 1"}
"""`Metric.better` in words."""
TITLES = ("metric", "value", "unit", "good", "does not see")


class Scores(dict[str, float]):
    """Name → value, NaN where a metric is undefined; a dict in every other way."""

    def __init__(self, values: Mapping[str, float], metrics: Sequence[Metric]) -> None:
        """Keep the values.

        Args:
            values: one for each metric.
            metrics: the metrics, which know their units and what is good.
        """
        super().__init__(values)
        self._metrics = tuple(metrics)

    def __reduce__(self) -> tuple[type[Scores], tuple[dict[str, float], tuple[Metric, ...]]]:
        return Scores, (dict(self), self._metrics)

    def _repr_mimebundle_(
        self, include: Collection[str] | None = None, exclude: Collection[str] | None = None
    ) -> dict[str, str]:
        """What a notebook shows: a table with units and what is good."""
        head = "".join(f'<th style="text-align:left">{title}</th>' for title in TITLES)
        known = {metric.name: metric for metric in self._metrics}
        rows = [_row(name, value, known.get(name)) for name, value in self.items()]
        table = f"<thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody>"
        return {"text/plain": repr(self), "text/html": f"<table>{table}</table>"}


def _row(name: str, value: float, metric: Metric | None) -> str:
    cells = [name, score_text(value)]
    if metric is not None:
        cells += [metric.unit, GOOD[metric.better], metric.blind_to]
    aligned = (
        f'<td style="text-align:{"right" if place == 1 else "left"}">{html.escape(cell)}</td>'
        for place, cell in enumerate(cells)
    )
    return f"<tr>{''.join(aligned)}</tr>"


def score_text(value: float) -> str:
    """A value with four digits after the point, or "undefined"."""
    return "undefined" if math.isnan(value) else f"{value:.4f}"

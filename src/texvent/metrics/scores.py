"""Scores by name, which show themselves as a table in notebooks."""

from __future__ import annotations

import html
import math
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from texvent.metrics.protocol import Metric

GOOD = {"lower": "low", "higher": "high", "one": "near 1"}
"""`Metric.better` in words."""
TITLES = ("metric", "value", "good", "does not see")


class Scores(dict[str, float]):
    """Name → value, NaN where a metric is undefined; a dict in every other way."""

    def __init__(self, values: Mapping[str, float], metrics: Sequence[Metric]) -> None:
        """Keep the values.

        Args:
            values: one for each metric.
            metrics: the metrics, which know their units and what is good.
        """
        super().__init__(values)
        # Not the metrics: some hold networks, which would stay in memory and be pickled.
        self._facts = {
            metric.name: (
                getattr(metric, "unit", ""),
                GOOD.get(getattr(metric, "better", ""), ""),
                getattr(metric, "blind_to", ""),
            )
            for metric in metrics
        }

    def _repr_mimebundle_(
        self, include: Collection[str] | None = None, exclude: Collection[str] | None = None
    ) -> dict[str, str]:
        """What a notebook shows: a table with units and what is good."""
        nothing = ("", "", "")
        rows = [
            _cells(name, value, *self._facts.get(name, nothing)) for name, value in self.items()
        ]
        head = f"<thead>{_row('th', TITLES)}</thead>"
        body = "".join(_row("td", row) for row in rows)
        table = f'<table style="font-size:13px">{head}<tbody>{body}</tbody></table>'
        return {"text/plain": repr(self), "text/html": table}


def _cells(
    name: str, value: float, unit: str, good: str, blind_to: str
) -> tuple[str, str, str, str]:
    return name, f"{score_text(value)} {unit}".strip(), good, blind_to


def _row(tag: str, cells: Sequence[str]) -> str:
    style = "text-align:left; vertical-align:top; padding:2px 8px 2px 0"
    row = "".join(f'<{tag} style="{style}">{html.escape(cell)}</{tag}>' for cell in cells)
    return f"<tr>{row}</tr>"


def score_text(value: float) -> str:
    """A value with four digits after the point, or "undefined"."""
    return "undefined" if math.isnan(value) else f"{value:.4f}"


def plain_values(value: Any, *, digits: int | None = None) -> Any:
    """Values as JSON holds them: None for what is NaN or infinite.

    Args:
        value: numbers, texts, and mappings and sequences of them.
        digits: significant digits that numbers keep; None keeps all.
    """
    if isinstance(value, Mapping):
        return {key: plain_values(item, digits=digits) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain_values(item, digits=digits) for item in value]
    if not isinstance(value, float):
        return value
    if not math.isfinite(value):
        return None
    return float(value) if digits is None else float(f"{value:.{digits}g}")

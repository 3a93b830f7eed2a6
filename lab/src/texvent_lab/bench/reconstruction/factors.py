"""Scores of networks for images that were trained on clips which differ in one property."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from texvent_lab.bench.document import markdown_table
from texvent_lab.bench.summary import mean_text, summarise
from texvent_lab.charts import COLOURS, Dot, DotPanel, dot_chart

SCHEMA = "texvent-reconstruction-factors-1"
DRAWN = ("lpips", "ssim", "mse")
"""Measures of the chart, all of which are 0 to 1."""


@dataclass(frozen=True)
class FactorScore:
    """Networks of one factor, a seed each."""

    factor: str
    scores: Mapping[str, Sequence[float]]
    """Measure → a value per seed."""


def factors_table(rows: Sequence[FactorScore]) -> str:
    """A row per factor, means ± standard errors over seeds."""
    measures = list(rows[0].scores)
    cells = [[one.factor, *(mean_text(one.scores[name]) for name in measures)] for one in rows]
    return markdown_table(["trained on", *measures], cells)


def factors_chart(rows: Sequence[FactorScore]) -> bytes:
    """A panel per measure of `DRAWN`; the first factor, from which others differ, is a line."""
    panels = []
    for measure in (one for one in DRAWN if one in rows[0].scores):
        found = {one.factor: summarise(one.scores[measure]) for one in rows}
        dots = [Dot(name, "image", one.mean, one.standard_error) for name, one in found.items()]
        panels.append(DotPanel(measure, dots, {rows[0].factor: dots[0].mean}))
    return dot_chart(panels, {"image": COLOURS[0]}, least=0)

"""Plots of a data set as HTML and SVG without a script, in the colours of the page."""

from __future__ import annotations

import html
import math
from collections.abc import Mapping, Sequence

import numpy as np

from texvent.view.page.html_parts import count_text

BINS = 40
WIDTH, HEIGHT = 400, 140
MOST_BARS = 30


def histogram(title: str, values: Sequence[float], *, unit: str, is_log: bool) -> str:
    """How often each size occurs, as a figure.

    Args:
        title: what is counted.
        values: one per sample.
        unit: of the values.
        is_log: whether bins grow by a factor; zeros then count as the least of the others.
    """
    heading = f"<figcaption>{html.escape(title)}</figcaption>"
    positive = [value for value in values if value > 0]
    if not values or (is_log and not positive):
        return f'<figure class="chart">{heading}<p class="note">No values.</p></figure>'
    low, high = (min(positive), max(positive)) if is_log else (min(values), max(values))
    edges = _edges(low, high, is_log=is_log)
    counts, _ = np.histogram(np.clip(values, edges[0], edges[-1]), bins=edges)
    full, step = max(1, int(counts.max())), WIDTH / len(counts)
    bars = "".join(
        f'<rect x="{number * step:.1f}" y="{HEIGHT * (1 - count / full):.1f}" '
        f'width="{step - 1:.1f}" height="{HEIGHT * count / full:.1f}"/>'
        for number, count in enumerate(counts.tolist())
        if count
    )
    middle = "logarithmic, " if is_log else ""
    label = html.escape(f"{title}: {_short(low)} to {_short(high)} {unit}")
    return (
        f'<figure class="chart">{heading}<svg viewBox="0 0 {WIDTH} {HEIGHT}" '
        f'preserveAspectRatio="none" role="img" aria-label="{label}">{bars}</svg>'
        f'<div class="scale"><span>{_short(low)}</span>'
        f"<span>{html.escape(unit)}, {middle}at most {full:,} per bar</span>"
        f"<span>{_short(high)}</span></div></figure>"
    )


def bars(counts: Mapping[str, int]) -> str:
    """Names with bars, the most frequent first; of many, the first and the last."""
    ranked = sorted(counts.items(), key=lambda pair: (-pair[1], pair[0]))
    left_out = len(ranked) - MOST_BARS
    if left_out > 0:
        half = MOST_BARS // 2
        ranked = [*ranked[:half], *ranked[-half:]]
    most = max((count for _, count in ranked), default=1)
    rows = [
        f'<span>{html.escape(name)}</span><i style="width: {100 * count / most:.1f}%"></i>'
        f"<span>{count:,}</span>"
        for name, count in ranked
    ]
    if left_out > 0:
        rows.insert(
            MOST_BARS // 2, f"<span>… {left_out:,} between</span><span></span><span></span>"
        )
    return f'<div class="chart bars">{"".join(rows)}</div>'


def _edges(low: float, high: float, *, is_log: bool) -> list[float]:
    if math.isclose(low, high):
        return [low * 0.9 - 0.5, high * 1.1 + 0.5]
    if is_log:
        return [float(one) for one in np.geomspace(low, high, BINS + 1)]
    return [float(one) for one in np.linspace(low, high, BINS + 1)]


def _short(value: float) -> str:
    return count_text(value) if value >= 1000 else f"{value:.3g}"

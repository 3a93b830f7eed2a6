"""The self-test's result: a document with a schema, and the table in docs/metrics.md."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from texvent.metrics.compare import plain_values
from texvent_lab.bench.document import describe_environment, markdown_table
from texvent_lab.bench.selftest.run import (
    DETECTED,
    PERTURBATIONS,
    RECORDING_SEEDS,
    SCENE,
    SERIES,
    TEXTURE_SEED,
    SelftestRow,
    ranked_rows,
)
from texvent_lab.charts import matrix_chart

SCHEMA = "texvent-selftest-1"
"""Name of the document's layout: one entry of `rows` per `SelftestRow`."""
MOST_NAMES = 8
"""Missed perturbations that a row of the table names; of more, one less and dots."""
FOUND, REWARDED = (0.298, 0.471, 0.659), (0.894, 0.341, 0.337)
"""Colours of what was found, and of damage that scores better than a second recording."""
FULL = 1000.0
"""Standard deviations that are drawn in full colour."""
LEGEND = (
    "Standard deviations worse than the floor. Blue: found (above 3). White: missed. "
    "Red: damage that the metric rewards."
)


def selftest_table(rows: Sequence[SelftestRow]) -> str:
    """The result as a Markdown table, best metrics first."""
    lines = []
    for row in ranked_rows(rows):
        missed = row.missed
        if len(missed) > MOST_NAMES:
            missed = (*missed[: MOST_NAMES - 1], "...")
        floor = f"{row.floor:.4g} ± {row.floor_sd:.1g}"
        counts = (str(len(row.found)), str(sum(row.monotone.values())))
        lines.append((row.metric, floor, *counts, ", ".join(missed) or "–"))
    totals = (f"found /{len(PERTURBATIONS)}", f"monotone /{len(SERIES)}")
    return markdown_table(("metric", "floor", *totals, "missed"), lines)


def selftest_document(rows: Sequence[SelftestRow]) -> dict[str, Any]:
    """The result as plain values, ready for JSON; NaN becomes None."""
    return {
        "schema": SCHEMA,
        "environment": describe_environment(),
        "scene": SCENE,
        "texture_seed": TEXTURE_SEED,
        "recording_seeds": list(RECORDING_SEEDS),
        "series": {name: list(steps) for name, steps in SERIES.items()},
        "rows": [plain_values(asdict(row)) for row in rows],
    }


def selftest_chart(rows: Sequence[SelftestRow]) -> bytes:
    """An SVG image of z-scores, the metrics that found most on top.

    Args:
        rows: result of `run_selftest`.
    """
    ranked = ranked_rows(rows)
    return matrix_chart(
        rows=[row.metric for row in ranked],
        columns=[*PERTURBATIONS],
        colours=[[_colour(row.z[name]) for name in PERTURBATIONS] for row in ranked],
        texts=[[_short(row.z[name]) for name in PERTURBATIONS] for row in ranked],
        note=LEGEND,
    )


def _colour(z: float) -> tuple[float, float, float, float]:
    """As strong as the damage was seen; white where it was not."""
    if not abs(z) > DETECTED:
        return (1.0, 1.0, 1.0, 1.0)
    share = min(math.log(abs(z) / DETECTED) / math.log(FULL / DETECTED), 1.0)
    return (*(FOUND if z > 0 else REWARDED), 0.15 + 0.85 * share)


def _short(z: float) -> str:
    """A number in at most five characters."""
    if math.isnan(z):
        return "–"
    if abs(z) == math.inf:
        return "∞" if z > 0 else "−∞"
    text = f"{z:.0f}" if abs(z) < 10_000 else f"{z / 1000:.0f}k"
    return text.replace("-0", "0").replace("-", "−")

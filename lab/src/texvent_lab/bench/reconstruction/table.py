"""Scores of reconstruction as Markdown tables, and as a document."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from texvent.metrics.compare import plain_values
from texvent_lab.bench.document import describe_environment, markdown_table, without_tags
from texvent_lab.bench.fidelity.comparison import Comparison
from texvent_lab.bench.reconstruction.run import RECORDED, ReconstructionReport, ReconstructionRow
from texvent_lab.bench.reconstruction.scores import ImageScores, pool_scores

SCHEMA = "texvent-reconstruction-3"
"""Name of the document's layout; docs/reconstruction.md describes it."""
COLUMNS = {"mse": "MSE ↓", "psnr": "PSNR, dB ↑", "ssim": "SSIM ↑", "lpips": "LPIPS ↓"}
DIGITS = {"mse": 4, "psnr": 2, "ssim": 3, "lpips": 3}
ALL = "all recordings"
MARK_NOTE = (
    "(best): of the simulated events, on average. (≈): no significant difference from it (the "
    "intervals of a column hold together). (?): too few independent frames. Neighbouring frames "
    "are alike and count by blocks.\n"
)


def reconstruction_tables(report: ReconstructionReport) -> str:
    """All tables of a run, with what could not be measured."""
    parts = []
    recordings = list(dict.fromkeys(row.recording for row in report.rows))
    for recording in recordings:
        rows = [row for row in report.rows if row.recording == recording]
        parts.append(f"## {recording}, {report.network} ({len(rows[0].scores.t_us)} images)\n")
        parts.append(_table(rows))
    if len(recordings) > 1:
        parts.append(f"## {ALL}, {report.network} (each image counts the same)\n")
        parts.append(_table([_pooled(report.rows_of(source)) for source in report.sources()]))
    if len(report.sources()) > 2:
        parts.append(MARK_NOTE)
    missing = {**report.absent, **report.skipped}
    parts += [f"not measured: {name}: {why}\n" for name, why in missing.items()]
    return without_tags("\n".join(parts))


def reconstruction_document(report: ReconstructionReport) -> dict[str, Any]:
    """The result as plain values, ready for JSON; undefined and infinite ones are None."""
    plan = report.plan
    comparisons = {
        recording: _compare([row for row in report.rows if row.recording == recording])
        for recording in dict.fromkeys(row.recording for row in report.rows)
    }
    document = {
        "schema": SCHEMA,
        "environment": describe_environment(),
        "network": {"name": report.network, "sha256": report.sha256},
        "start_s": plan.start_s,
        "seconds": plan.seconds,
        "skip": plan.skip,
        "is_rate_matched": plan.is_rate_matched,
        "frames_gamma": plan.frames_gamma,
        "seed": plan.seed,
        "rows": [
            {
                "recording": row.recording,
                "source": row.source,
                "events": row.events,
                "threshold": row.threshold,
                "seconds": round(row.seconds, 1),
                **_score_values(row.scores),
                "behind_best": {
                    name: compared.document(row.source)
                    for name, compared in comparisons[row.recording].items()
                },
            }
            for row in report.rows
        ],
        "absent": report.absent,
        "skipped": report.skipped,
    }
    plain: dict[str, Any] = plain_values(document)
    return plain


def _score_values(scores: ImageScores) -> dict[str, Any]:
    return {
        "mean": {name: scores.mean(name) for name in scores.values},
        "t_us": list(scores.t_us),
        "values": {name: list(values) for name, values in scores.values.items()},
    }


def _compare(rows: Sequence[ReconstructionRow]) -> dict[str, Comparison]:
    """Measure → simulated sources on the same frames, larger values closer.

    A source that did not run on every recording has fewer frames and is not compared.
    """
    every = list(rows[0].scores.t_us)
    simulated = [row for row in rows if row.source != RECORDED and list(row.scores.t_us) == every]
    sources = {row.source: "simulated" for row in simulated}
    return {
        name: Comparison(
            {row.source: _finite(row.scores.values[name], _sign(name)) for row in simulated},
            sources,
            is_in_sequence=True,
        )
        for name in rows[0].scores.values
    }


def _sign(measure: str) -> int:
    return -1 if COLUMNS[measure].endswith("↓") else 1


def _finite(values: Sequence[float], sign: int) -> list[float]:
    """Values with NaN where they are infinite, as the PSNR of equal images is."""
    return [sign * one if math.isfinite(one) else math.nan for one in values]


def _table(rows: Sequence[ReconstructionRow]) -> str:
    measures = list(rows[0].scores.values)
    recorded = next(row.events for row in rows if row.source == RECORDED)
    compared = _compare(rows)
    lines = []
    for row in rows:
        ratio = f"×{row.events / recorded:.2f}" if recorded else "–"
        number = f"{row.events:,}" if row.source == RECORDED else ratio
        threshold = "–" if row.threshold is None else f"{row.threshold:.3g}"
        marks = [compared[name].mark(row.source) for name in measures]
        means = [" ".join(cell).rstrip() for cell in zip(_means(row.scores), marks, strict=True)]
        lines.append([row.source, number, threshold, *means])
    return markdown_table(["events", "number", "δ", *(COLUMNS[one] for one in measures)], lines)


def _means(scores: ImageScores) -> list[str]:
    return [_number(scores.mean(name), DIGITS[name]) for name in scores.values]


def _pooled(rows: Sequence[ReconstructionRow]) -> ReconstructionRow:
    thresholds = {row.threshold for row in rows}
    return ReconstructionRow(
        recording=ALL,
        source=rows[0].source,
        scores=pool_scores(row.scores for row in rows),
        events=sum(row.events for row in rows),
        threshold=thresholds.pop() if len(thresholds) == 1 else None,
    )


def _number(value: float, digits: int) -> str:
    return f"{value:.{digits}f}" if math.isfinite(value) else "undefined"

"""The benchmark's result as Markdown tables: one over all scenes, one per scene."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from texvent.errors import ConfigError, shown
from texvent.extending import suggest
from texvent_lab.bench.document import markdown_table
from texvent_lab.bench.fidelity.comparison import Comparison, comparison_note, difference_text
from texvent_lab.bench.fidelity.results import FidelityReport, Reference, Score
from texvent_lab.bench.oracle.pixel import TARGETS
from texvent_lab.bench.summary import normalise, summarise

BASELINE = "texvent paper, blend"
"""The paper's own method: what the others are compared with, pair by pair."""
COLUMNS = {
    "ef_mse": "EF MSE",
    "ef_ssim": "EF SSIM ↑",
    "nearest": "NN ms",
    "van_rossum": "vR",
    "stpp": "STPP ↑",
}
"""Metric → title; those that were not measured are left out."""
BEHIND = "behind the best"


def check_baseline(baseline: str, entries: Iterable[str], *, default: str = BASELINE) -> None:
    """Refuse a baseline that does not run.

    Args:
        baseline: what the user named.
        entries: names of what runs.
        default: may be absent; then nothing is compared.

    Raises:
        ConfigError: it is not among them.
    """
    names = tuple(dict.fromkeys(entries))
    if baseline != default and baseline not in names:
        raise ConfigError(f"baseline {shown(baseline)} does not run; {suggest(baseline, names)}")


def fidelity_tables(report: FidelityReport, *, baseline: str = BASELINE) -> str:
    """All tables of a run, with the entries that could not run.

    Args:
        report: what was found.
        baseline: entry that the others are compared with, pair by pair; if it did not run, the
            column is left out.
    """
    parts = [_overview(report)]
    for reference in report.references:
        parts += [_scene_heading(reference), _scene_table(report, reference, baseline)]
    reasons: dict[str, list[str]] = {}
    for name, why in report.skipped.items():
        reasons.setdefault(why, []).append(name)
    if reasons:
        parts.append("Not run:\n")
        parts += [f"- {'; '.join(names)}: {why}\n" for why, names in reasons.items()]
    return "\n".join(parts)


def _overview(report: FidelityReport) -> str:
    """S* of STPP per scene, and its mean over scenes: 0 is the null, 1 a second recording."""
    titles = ["entry", *(f"{one.scene}, {one.target}" for one in report.references), "mean S*"]
    comparison = report.overall_comparison()
    normalised: dict[str, list[str]] = {}
    for reference in report.references:
        found = {one.entry: one for one in report.ranked(reference.scene, reference.target)}
        for entry in dict.fromkeys(score.entry for score in report.scores):
            score = found.get(entry)
            value = None if score is None else score.normalised("stpp", reference)
            normalised.setdefault(entry, []).append(_number(value, 2))
    means = {entry: comparison.mean(entry) for entry in normalised}
    ranked = sorted(means, key=lambda one: math.inf if math.isnan(means[one]) else -means[one])
    rows = [[entry, *normalised[entry], _number(means[entry], 2)] for entry in ranked]
    if comparison.windows < 2:
        return markdown_table(titles, rows)
    if comparison.is_enough:
        titles.append(BEHIND)
        rows = [[*row, comparison.behind_text(row[0])] for row in rows]
    note = comparison_note(comparison.windows, "scenes")
    return f"{markdown_table(titles, rows)}\n{note}"


def _scene_heading(reference: Reference) -> str:
    mean = sum(reference.events) / len(reference.events)
    kind = "true" if reference.target in TARGETS else "recorded"
    return f"## {reference.title} ({mean:,.0f} {kind} events)\n"


def _scene_table(report: FidelityReport, reference: Reference, baseline: str) -> str:
    metrics = [metric for metric in COLUMNS if metric in reference.floor]
    titles = ["entry", "δ", "n at default δ", *(COLUMNS[metric] for metric in metrics), "S*"]
    scores = report.ranked(reference.scene, reference.target)
    rows = [
        [f"floor: {report.floor_name}", *_bound_cells(reference, metrics, is_floor=True)],
        *(_score_cells(score, reference, metrics) for score in scores),
        ["null: times shuffled", *_bound_cells(reference, metrics, is_floor=False)],
    ]
    comparison = report.comparison(reference)
    compared = next((score for score in scores if score.entry == baseline), None)
    if compared is not None:
        titles.append(f"STPP − {baseline}")
        differences = ["", *_paired(scores, compared, comparison), ""]
        rows = [[*cells, last] for cells, last in zip(rows, differences, strict=True)]
    if comparison.is_enough:
        titles.append(BEHIND)
        behind = ["", *(comparison.behind_text(score.entry) for score in scores), ""]
        rows = [[*cells, last] for cells, last in zip(rows, behind, strict=True)]
    kind = "textures" if report.score_seeds else "spans of time"
    note = comparison_note(comparison.windows, kind)
    return f"{markdown_table(titles, rows)}\n{note}"


def _score_cells(score: Score, reference: Reference, metrics: Sequence[str]) -> list[str]:
    is_lost = score.threshold is not None and not score.is_matched and any(reference.events)
    mark = " (count not reached)" if is_lost else ""
    return [
        score.entry,
        _number(score.threshold, 3) + mark,
        _number(score.default_ratio, 3),
        *(_mean_and_error(score.values[metric]) for metric in metrics),
        _number(score.normalised("stpp", reference), 2),
    ]


def _bound_cells(reference: Reference, metrics: Sequence[str], *, is_floor: bool) -> list[str]:
    values = reference.floor if is_floor else reference.null
    cells = [_mean_and_error(values[metric]) for metric in metrics]
    floor, null = (summarise(one["stpp"]).mean for one in (reference.floor, reference.null))
    mine = floor if is_floor else null
    bound = normalise(mine, floor=floor, null=null, better="higher")
    return ["", "", *cells, _number(bound, 2)]


def _paired(scores: Sequence[Score], baseline: Score, comparison: Comparison) -> Iterator[str]:
    """A cell per score: its difference to the baseline."""
    against = comparison.differences(baseline.entry) if comparison.is_enough else None
    for score in scores:
        if score is baseline:
            yield "–"
        elif against is not None:
            yield difference_text(against[score.entry], sign="+")
        else:
            difference = score.difference("stpp", baseline)
            error = _number(difference.standard_error, 3)
            yield f"{difference.mean:+.3f} ± {error}" if difference.defined else "undefined"


def _mean_and_error(values: Sequence[float], digits: int = 3) -> str:
    summary = summarise(values)
    if not summary.defined:
        return "undefined"
    if math.isnan(summary.standard_error):
        return f"{summary.mean:.{digits}f}"
    return f"{summary.mean:.{digits}f} ± {summary.standard_error:.{digits}f}"


def _number(value: float | None, digits: int) -> str:
    if value is None:
        return "–"
    return "undefined" if math.isnan(value) else f"{value:.{digits}f}"

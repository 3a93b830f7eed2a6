"""Output of `texvent compare`: tables, sentences, JSON."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from texvent.cli.notices import result_console
from texvent.metrics.compare import GOOD, plain_values, score_text
from texvent.metrics.protocol import Metric
from texvent.metrics.stpp import SPACE_CELLS, TIME_CELLS
from texvent.metrics.uncertainty import LEAST_WINDOWS, Verdict, WindowScores
from texvent.video import MICROSECONDS

WINDOW_TITLE = "mean of windows"
_LONGEST_ROW = 10_000
"""Columns of a row that nothing folds."""


@dataclass(frozen=True)
class Candidate:
    """A file that is judged."""

    path: Path
    events: int
    scores: Mapping[str, float]
    levels: list[list[float]] | None
    """Of STPP, [time cells, space cells]."""


@dataclass(frozen=True, kw_only=True)
class Findings:
    """Everything that is shown of a comparison."""

    candidates: Mapping[str, Candidate]
    reference: Path
    reference_events: int
    span_us: tuple[int, int] | None
    metrics: Sequence[Metric]
    controls: Mapping[str, Mapping[str, float]]
    """Metric → control → value, of the metrics that are not shown without."""
    windows: WindowScores | None
    left_out: Mapping[str, str]
    """Metric → what it lacks."""

    @cached_property
    def verdicts(self) -> list[Verdict]:
        """Every two candidates by every metric; none without windows."""
        return [] if self.windows is None else self.windows.verdicts()

    def document(self) -> dict[str, Any]:
        """Document for `--json`: for one candidate its scores, for several a list of them."""
        every = [self._candidate_document(name) for name in self.candidates]
        judged = every[0] if len(every) == 1 else {"candidates": every}
        document = {
            **judged,
            "reference": {"path": str(self.reference), "events": self.reference_events},
            "span_us": self.span_us,
            "controls": self.controls,
            "windows": None
            if self.windows is None
            else {"window_us": self.windows.window_us, "starts_us": self.windows.starts_us},
            "left_out": self.left_out,
        }
        if len(every) > 1:
            document["differences"] = [one.document() for one in self.verdicts]
        plain: dict[str, Any] = plain_values(document)
        return plain

    def _candidate_document(self, name: str) -> dict[str, Any]:
        one = self.candidates[name]
        document: dict[str, Any] = {
            "predicted": {"path": str(one.path), "events": one.events},
            "scores": dict(one.scores),
        }
        if self.windows is not None:
            document["window_means"] = {
                metric.name: {
                    **self.windows.mean(metric.name, name).document(),
                    "values": self.windows.values[metric.name, name].tolist(),
                }
                for metric in self.metrics
            }
        if one.levels is not None:
            document["stpp_levels"] = one.levels
        return document


def show(findings: Findings) -> None:
    """Print everything."""
    with result_console() as console:
        _show(console, findings)


def _show(console: Console, findings: Findings) -> None:
    if len(findings.candidates) == 1:
        _show_one(console, findings)
    else:
        _show_several(console, findings)
    for name, values in findings.controls.items():
        console.print()
        controls = _table(("of the reference", "value"), title=f"{name}, controls")
        for control, value in values.items():
            controls.add_row(control, score_text(value))
        console.print(controls)
    for name, candidate in findings.candidates.items():
        if candidate.levels is not None:
            console.print()
            title = (
                "STPP levels" if len(findings.candidates) == 1 else f"STPP levels of {escape(name)}"
            )
            console.print(_level_table(candidate.levels, title))
    for name, missing in findings.left_out.items():
        console.print(f"\n{name} was left out: {missing}", style="dim", markup=False)


def _show_one(console: Console, findings: Findings) -> None:
    titles = ["metric", "value", WINDOW_TITLE, "unit", "good", "does not see"]
    ((name, candidate),) = findings.candidates.items()
    rows = [
        [
            metric.name,
            score_text(candidate.scores[metric.name]),
            _mean_text(findings.windows, metric.name, name),
            metric.unit,
            GOOD[metric.better],
            metric.blind_to,
        ]
        for metric in findings.metrics
    ]
    if not any(row[2] for row in rows):
        titles.pop(2)
        rows = [[*row[:2], *row[3:]] for row in rows]
    table = _filled_table(titles, rows)
    unbounded = console.options.update(width=_LONGEST_ROW)
    if console.measure(table, options=unbounded).maximum <= console.width:
        console.print(table)
    else:  # Long texts in a narrow column are hard to read: they get a table of their own.
        console.print(_filled_table(titles[:-1], [row[:-1] for row in rows]))
        console.print()
        console.print(_filled_table([titles[0], titles[-1]], [[row[0], row[-1]] for row in rows]))
    _show_window_note(console, findings.windows)


def _filled_table(titles: Sequence[str], rows: Iterable[Sequence[str]]) -> Table:
    table = _table(titles)
    for row in rows:
        table.add_row(*row)
    return table


def _show_several(console: Console, findings: Findings) -> None:
    """Values of all candidates, then which of two is closer, metric by metric."""
    names = list(map(escape, findings.candidates))
    table = _table(("metric", *names, "unit", "good"), values=names)
    for metric in findings.metrics:
        values = (score_text(one.scores[metric.name]) for one in findings.candidates.values())
        table.add_row(metric.name, *values, metric.unit, GOOD[metric.better])
    console.print(table)
    _show_window_note(console, findings.windows)
    if findings.verdicts:
        console.print()
    for verdict in findings.verdicts:
        console.print(f"{verdict.metric}: {verdict.sentence}", markup=False)


def _show_window_note(console: Console, windows: WindowScores | None) -> None:
    if windows is None:
        return
    count, seconds = len(windows.starts_us), windows.window_us / MICROSECONDS
    text = f"intervals and differences: of the means of {count} windows of {seconds:g} s"
    if count < LEAST_WINDOWS:
        text = (
            f"no intervals: {count} whole windows of {seconds:g} s are too few, "
            f"{LEAST_WINDOWS} are needed; --window makes them shorter"
        )
    console.print(f"\n{text}", style="dim", markup=False)


def _mean_text(windows: WindowScores | None, metric: str, candidate: str) -> str:
    """A mean of windows and its interval; empty where there is none."""
    if windows is None or len(windows.starts_us) < LEAST_WINDOWS:
        return ""
    mean = windows.mean(metric, candidate)
    if math.isnan(mean.mean):
        return "undefined"
    if not mean.is_enough:
        return f"{mean.mean:.4f} (too few)"
    return f"{mean.mean:.4f} [{mean.interval.low:.4f}, {mean.interval.high:.4f}]"


def _level_table(levels: list[list[float]], title: str) -> Table:
    cells = ("cells in time \\ space", *map(str, SPACE_CELLS))
    matrix = _table(cells, title=title)
    for count, shares in zip(TIME_CELLS, levels, strict=True):
        matrix.add_row(str(count), *(f"{value:.3f}" for value in shares))
    return matrix


def _table(
    titles: Sequence[str], *, title: str | None = None, values: Collection[str] = ()
) -> Table:
    """A table without lines; columns of numbers are flush right."""
    table = Table(box=None, pad_edge=False, header_style="bold", title=title, title_justify="left")
    for one in titles:
        is_number = one == "value" or one.isdigit() or one in values
        is_whole = one == WINDOW_TITLE
        table.add_column(one, justify="right" if is_number else "left", no_wrap=is_whole)
    return table

"""`texvent bench closer`: which of some event files is closer to the true one, and how surely."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from texvent.cli.event_files.compare import (
    CompareOptions,
    candidate_names,
    choose_metrics,
    read_streams,
)
from texvent.cli.notices import result_console, write_out
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.metrics.compare import plain_values
from texvent.runtime.displays.console_progress import ConsoleProgress
from texvent.video import MICROSECONDS
from texvent_lab.bench.uncertainty import (
    LEAST_WINDOWS,
    Mean,
    WindowScores,
    check_window,
    score_windows,
)

DESCRIPTION = """Score event files window by window against the true one, which comes last: means
with 95 % intervals, and which of several is closer. docs/metrics.md explains how."""


@dataclass(frozen=True, kw_only=True)
class CloserOptions(CompareOptions):
    """Which files, by which metrics, and in which windows."""

    window: float | None = None
    """Windows of this length, in seconds; default: 0.1, longer above 50 windows."""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_range("window", self.window, 1e-6, 1e6)
        check_window(self.window_us)

    @property
    def window_us(self) -> int | None:
        """Length of the windows, µs; None: as long as suits the recording."""
        return None if self.window is None else round(self.window * MICROSECONDS)


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    (options,) = parse_configs(
        arguments, {"input": CloserOptions()}, prog="texvent bench closer", description=DESCRIPTION
    )
    metrics, _ = choose_metrics(options)
    names = candidate_names(options.files[:-1])
    *judged, reference = read_streams(options)
    predicted = dict(zip(names, judged, strict=True))
    with ConsoleProgress() as progress:
        scores = score_windows(
            predicted, reference, metrics, window_us=options.window_us, progress=progress
        )
    if options.json:
        text = json.dumps(plain_values(_document(scores, names)), indent=2, ensure_ascii=False)
        write_out(f"{text}\n")
        return
    with result_console() as console:
        _show(console, scores, names)


def _document(scores: WindowScores, names: Sequence[str]) -> dict[str, Any]:
    return {
        "windows": {"window_us": scores.window_us, "starts_us": scores.starts_us},
        "means": {
            name: {
                metric.name: {
                    **scores.mean(metric.name, name).document(),
                    "values": scores.values[metric.name, name].tolist(),
                }
                for metric in scores.metrics
            }
            for name in names
        },
        "differences": [one.document() for one in scores.verdicts()],
    }


def _show(console: Console, scores: WindowScores, names: Sequence[str]) -> None:
    """Means with intervals, then which of each two is closer."""
    table = Table("mean of windows", *map(escape, names), "unit", box=None, pad_edge=False)
    for metric in scores.metrics:
        means = (_mean_text(scores.mean(metric.name, name)) for name in names)
        table.add_row(metric.name, *means, metric.unit)
    console.print(table)
    for line in _notes(scores):
        console.print(line, markup=False)


def _notes(scores: WindowScores) -> Iterator[str]:
    count, seconds = len(scores.starts_us), scores.window_us / MICROSECONDS
    yield f"\n{count} windows of {seconds:g} s"
    if count < LEAST_WINDOWS:
        yield f"too few for intervals: {LEAST_WINDOWS} are needed; --window makes them shorter"
    yield from (f"{one.metric}: {one.sentence}" for one in scores.verdicts())


def _mean_text(mean: Mean) -> str:
    """A mean of windows and its interval."""
    if math.isnan(mean.mean):
        return "undefined"
    if not mean.is_enough:
        return f"{mean.mean:.4f} (too few)"
    return f"{mean.mean:.4f} [{mean.interval.low:.4f}, {mean.interval.high:.4f}]"

"""`texvent compare PREDICTED REFERENCE`: how close two event files are."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from rich.console import Console
from rich.table import Table

from texvent._registry import METRICS
from texvent.cli.options import REQUIRED, parse_options
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.io.files import load
from texvent.metrics.compare import compare, describe_metrics
from texvent.metrics.stpp import SPACE_CELLS, TIME_CELLS, Stpp
from texvent.video import MICROSECONDS

DESCRIPTION = """Compare two event files of one sensor: the one to judge, then the true one. Each
metric says what it does not see; docs/metrics.md gives definitions and the self-test."""


@dataclass(frozen=True, kw_only=True)
class CompareOptions:
    """Which files, and by which metrics."""

    positional: ClassVar[tuple[str, ...]] = ("predicted", "reference")

    predicted: Path = REQUIRED
    """Event file to judge."""
    reference: Path = REQUIRED
    """Event file with the truth, or another recording of the same scene."""
    metrics: str | None = None
    """Names of metrics, separated by commas; default: all of them."""
    start: float | None = None
    """Compare from this time on, in seconds."""
    stop: float | None = None
    """Compare up to this time, in seconds."""
    levels: bool = False
    """Show the level matrix of STPP too: how far apart in time and space the events are."""
    json: bool = False
    """Print JSON instead of a table; undefined values are null."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    values = parse_options(
        arguments, {"input": CompareOptions()}, prog="texvent compare", description=DESCRIPTION
    )
    options = CompareOptions(**values)
    names = options.metrics.split(",") if options.metrics else list(METRICS.names())
    for name in names:
        METRICS.load(name)
    span_us = _span(options)
    predicted, reference = (_load(path) for path in (options.predicted, options.reference))
    scores = compare(predicted, reference, names, span_us=span_us)
    levels = None
    if options.levels:
        cut = [one.between(*span_us) if span_us else one for one in (predicted, reference)]
        levels = Stpp().levels(*cut).tolist()
    if options.json:
        document: dict[str, Any] = {
            "predicted": {"path": str(options.predicted), "events": len(predicted)},
            "reference": {"path": str(options.reference), "events": len(reference)},
            "span_us": span_us,
            "scores": {name: _plain(value) for name, value in scores.items()},
        }
        if levels is not None:
            document["stpp_levels"] = levels
        sys.stdout.write(json.dumps(document, indent=2, ensure_ascii=False) + "\n")
    else:
        _show(scores, levels)
    return 0


def _load(path: Path) -> EventStream:
    if not path.exists():
        raise InputError(f"no such file: {path}")
    return load(path)


def _span(options: CompareOptions) -> tuple[int, int] | None:
    if options.start is None and options.stop is None:
        return None
    start = round((options.start or 0.0) * MICROSECONDS)
    stop = 2**62 if options.stop is None else round(options.stop * MICROSECONDS)
    if start >= stop:
        raise ConfigError(
            f"stop is {options.stop:g} s; it must come after start ({start / MICROSECONDS:g} s)"
        )
    return start, stop


def _show(scores: Mapping[str, float], levels: list[list[float]] | None) -> None:
    console = Console(highlight=False)
    table = Table(box=None, pad_edge=False, header_style="bold")
    for title in ("metric", "value", "unit", "good", "does not see"):
        table.add_column(title, justify="right" if title == "value" else "left")
    good = {"lower": "low", "higher": "high", "one": "near 1"}
    described = describe_metrics()
    for name, value in scores.items():
        metric = described[name]
        shown = "undefined" if math.isnan(value) else f"{value:.4f}"
        table.add_row(name, shown, metric.unit, good[metric.better], metric.blind_to)
    console.print(table)
    if levels is None:
        return
    matrix = Table(box=None, pad_edge=False, header_style="bold", title="STPP levels")
    matrix.add_column("cells in time \\ space")
    for cells in SPACE_CELLS:
        matrix.add_column(str(cells), justify="right")
    for cells, row in zip(TIME_CELLS, levels, strict=True):
        matrix.add_row(str(cells), *(f"{value:.3f}" for value in row))
    console.print(matrix)


def _plain(value: float) -> float | None:
    return value if math.isfinite(value) else None

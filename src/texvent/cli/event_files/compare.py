"""`texvent compare PREDICTED REFERENCE`: how close two event files are."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from rich.console import Console
from rich.table import Table

from texvent.bench.selftest.controls import CONTROLLED, run_controls
from texvent.cli.notices import say, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.io.atomic import check_output
from texvent.io.files import load
from texvent.metrics.compare import compare, describe_metrics, load_metric
from texvent.metrics.protocol import Metric
from texvent.metrics.rvt.eqs import EventQualityScore, load_eqs
from texvent.metrics.scores import GOOD, score_text
from texvent.metrics.stpp import SPACE_CELLS, TIME_CELLS, Stpp
from texvent.runtime.console_progress import ConsoleProgress
from texvent.sensor import SensorSize, parse_sensor
from texvent.video import MICROSECONDS
from texvent.view.page.comparison import MetricRow, write_comparison

DESCRIPTION = """Compare two event files of one sensor: the one to judge, then the true one. Each
metric says what it does not see; docs/metrics.md gives definitions and the self-test."""


@dataclass(frozen=True, kw_only=True)
class CompareOptions:
    """Which files, and by which metrics."""

    positional: ClassVar[tuple[str, ...]] = ("predicted", "reference")
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o"}

    predicted: Path = REQUIRED
    """Event file to judge."""
    reference: Path = REQUIRED
    """Event file with the truth, or another recording of the same scene."""
    metrics: str | None = None
    """Names of metrics, separated by commas; default: all whose weights are here."""
    start: float | None = None
    """Compare from this time on, in seconds."""
    stop: float | None = None
    """Compare up to this time, in seconds."""
    sensor: str | None = None
    """Sensor size, for event formats that do not store it."""
    rvt_weights: Path | None = None
    """RVT's published checkpoint (rvt-t.ckpt, rvt-s.ckpt or rvt-b.ckpt): adds the metric eqs."""
    levels: bool = False
    """Show the level matrix of STPP too: how far apart in time and space the events are."""
    json: bool = False
    """Print JSON instead of a table; undefined values are null."""
    out: Path | None = None
    """Write a page too (.html): the same window of both, their event rates and the metrics."""
    overwrite: bool = False
    """Replace the page if it exists already."""

    def __post_init__(self) -> None:
        if self.out is not None and self.out.suffix.lower() != ".html":
            raise ConfigError(f"the page of a comparison must end in .html; got {self.out}")


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments, {"input": CompareOptions()}, prog="texvent compare", description=DESCRIPTION
    )
    if options.out is not None:
        check_output(options.out, overwrite=options.overwrite)
    metrics, left_out = _choose_metrics(options)
    span_us = _span(options)
    size = parse_sensor(options.sensor) if options.sensor else None
    predicted, reference = (_load(path, size) for path in (options.predicted, options.reference))
    whole = (predicted, reference)
    if span_us is not None:
        predicted, reference = (one.cut(*span_us) for one in whole)
        _refuse_empty_span(options, (predicted, reference), whole)
    with ConsoleProgress() as progress:
        scores = compare(*whole, metrics, span_us=span_us, progress=progress)
    findings = Findings(
        scores,
        {one.name: run_controls(one, reference) for one in metrics if one.name in CONTROLLED},
        Stpp().levels(predicted, reference).tolist() if options.levels else None,
        left_out,
    )
    if options.json:
        events = {"predicted": len(predicted), "reference": len(reference)}
        document = _document(options, events, span_us, findings)
        write_out(json.dumps(document, indent=2, ensure_ascii=False) + "\n")
    else:
        _show(metrics, findings)
    if options.out is not None:
        names = (options.predicted.name, f"{options.reference.name} (reference)")
        pair = tuple(zip(names, (predicted, reference), strict=True))
        write_comparison(options.out, pair, _rows(metrics, findings), overwrite=options.overwrite)
        # Not among the JSON.
        (say if options.json else write_out)(f"{options.out}\n")
    return 0


@dataclass(frozen=True)
class Findings:
    """Everything that is shown of a comparison."""

    scores: Mapping[str, float]
    controls: Mapping[str, Mapping[str, float]]
    """Metric → control → value, of the metrics that are not shown without."""
    levels: list[list[float]] | None
    """Of STPP, [time cells, space cells]."""
    left_out: Mapping[str, str]
    """Metric → what it lacks."""


def _choose_metrics(options: CompareOptions) -> tuple[list[Metric], dict[str, str]]:
    """The metrics asked for, or all; and what those missing that are left out, by name."""
    known = dict(describe_metrics())
    if options.rvt_weights is not None:
        known[EventQualityScore.name] = load_eqs(options.rvt_weights)
    names = options.metrics.split(",") if options.metrics else list(known)
    chosen, left_out = [], {}
    for name in names:
        metric = known[name] if name in known else load_metric(name)  # refuses what is not known
        missing = metric.missing()
        if missing is None:
            chosen.append(metric)
        elif options.metrics:
            raise ConfigError(f"metric {name} cannot be computed: {missing}")
        else:
            left_out[name] = missing
    return chosen, left_out


def _refuse_empty_span(
    options: CompareOptions, cut: tuple[EventStream, ...], whole: tuple[EventStream, ...]
) -> None:
    """Two streams without events would be alike: rather a wrong span than a perfect score."""
    if any(map(len, cut)):
        return
    paths = (options.predicted, options.reference)
    clocks = [
        f"{path} from {one.t[0] / MICROSECONDS:.3f} to {one.t[-1] / MICROSECONDS:.3f} s"
        for path, one in zip(paths, whole, strict=True)
        if len(one)
    ]
    raise InputError(
        "neither file has events between --start and --stop; "
        f"{' and '.join(clocks) or 'both are empty'}"
    )


def _document(
    options: CompareOptions,
    events: Mapping[str, int],
    span_us: tuple[int, int] | None,
    findings: Findings,
) -> dict[str, Any]:
    """What `--json` prints."""
    document: dict[str, Any] = {
        "predicted": {"path": str(options.predicted), "events": events["predicted"]},
        "reference": {"path": str(options.reference), "events": events["reference"]},
        "span_us": span_us,
        "scores": {name: _plain(value) for name, value in findings.scores.items()},
        "controls": {
            metric: {name: _plain(value) for name, value in values.items()}
            for metric, values in findings.controls.items()
        },
        "left_out": dict(findings.left_out),
    }
    if findings.levels is not None:
        document["stpp_levels"] = findings.levels
    return document


def _load(path: Path, size: SensorSize | None) -> EventStream:
    if not path.exists():
        raise InputError(f"no such file: {path}")
    return load(path, size=size)


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


def _rows(metrics: Sequence[Metric], findings: Findings) -> list[MetricRow]:
    return [
        MetricRow(
            name=metric.name,
            value=score_text(findings.scores[metric.name]),
            unit=metric.unit,
            good=GOOD[metric.better],
            blind_to=metric.blind_to,
        )
        for metric in metrics
    ]


def _show(metrics: Sequence[Metric], findings: Findings) -> None:
    console = Console(highlight=False)
    table = _table(("metric", "value", "unit", "good", "does not see"))
    for row in _rows(metrics, findings):
        table.add_row(row.name, row.value, row.unit, row.good, row.blind_to)
    console.print(table)
    for name, values in findings.controls.items():
        console.print()
        controls = _table(("of the reference", "value"), title=f"{name}, controls")
        for control, value in values.items():
            controls.add_row(control, score_text(value))
        console.print(controls)
    if findings.levels is not None:
        console.print()
        cells = ("cells in time \\ space", *map(str, SPACE_CELLS))
        matrix = _table(cells, title="STPP levels")
        for count, shares in zip(TIME_CELLS, findings.levels, strict=True):
            matrix.add_row(str(count), *(f"{value:.3f}" for value in shares))
        console.print(matrix)
    for name, missing in findings.left_out.items():
        console.print(f"\n{name} was left out: {missing}", style="dim", markup=False)


def _table(titles: Sequence[str], *, title: str | None = None) -> Table:
    """A table without lines; columns of numbers are flush right."""
    table = Table(box=None, pad_edge=False, header_style="bold", title=title, title_justify="left")
    for one in titles:
        table.add_column(one, justify="right" if one == "value" or one.isdigit() else "left")
    return table


def _plain(value: float) -> float | None:
    return value if math.isfinite(value) else None

"""`texvent compare PREDICTED... REFERENCE`: how close event files are to a true one."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from texvent.cli.event_files.event_file_options import FileFactOptions, parse_time_range
from texvent.cli.notices import result_console, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.metrics.compare import (
    GOOD,
    compare,
    describe_metrics,
    load_metric,
    plain_values,
    score_text,
)
from texvent.metrics.controls import CONTROLLED, run_controls
from texvent.metrics.latent_similarity import EventQualityScore, load_eqs
from texvent.metrics.protocol import Metric
from texvent.runtime.console_progress import ConsoleProgress

DESCRIPTION = """Compare event files of one sensor: one or several to judge, then the true one. Each
metric says what it does not see. docs/metrics.md gives definitions and the self-test."""


@dataclass(frozen=True, kw_only=True)
class CompareOptions(FileFactOptions):
    """Files to compare, and metrics."""

    positional: ClassVar[tuple[str, ...]] = ("files",)

    files: tuple[Path, ...] = REQUIRED
    """Event files to judge, one or several; last, the one with the truth, or another recording of
    the same scene."""
    metrics: str | None = None
    """Names of metrics, separated by commas; default: all whose weights are here."""
    time: str | None = None
    """Compare START,STOP only, in seconds; either may be left out."""
    sensor: str | None = None
    """Sensor size, for event formats that do not store it."""
    rvt_weights: Path | None = None
    """RVT's published checkpoint (rvt-t.ckpt, rvt-s.ckpt or rvt-b.ckpt): adds the metric eqs; or
    weights.pt of texvent train detection: adds eqs (own RVT)."""
    json: bool = False
    """Print JSON instead of a table; undefined values are null."""

    def __post_init__(self) -> None:
        if self.files != REQUIRED and len(self.files) < 2:
            raise ConfigError(
                f"{self.files[0]} is the only file; give one or several to judge, and last the one "
                "with the truth"
            )


@dataclass(frozen=True, kw_only=True)
class ScoredFiles:
    """Recordings and their scores."""

    paths: Sequence[Path]
    """The files to judge, and last the true one."""
    predicted: Mapping[str, EventStream]
    """Label → stream to judge."""
    reference: EventStream
    metrics: Sequence[Metric]
    scores: Mapping[str, Mapping[str, float]]
    """Label → metric → value."""
    controls: Mapping[str, Mapping[str, float]]
    """Metric → control → value, of the metrics that are not shown without."""
    left_out: Mapping[str, str]
    """Metric → what it lacks."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments, {"input": CompareOptions()}, prog="texvent compare", description=DESCRIPTION
    )
    found = _compare(options)
    if options.json:
        write_out(json.dumps(plain_values(_document(found)), indent=2, ensure_ascii=False) + "\n")
    else:
        with result_console() as console:
            _show(console, found)
    return 0


def _compare(options: CompareOptions) -> ScoredFiles:
    metrics, left_out = _choose_metrics(options)
    names = _names(options.files[:-1])
    *judged, reference = _streams(options)
    predicted = dict(zip(names, judged, strict=True))
    with ConsoleProgress() as progress:
        scores = {
            name: compare(events, reference, metrics, progress=progress)
            for name, events in predicted.items()
        }
    return ScoredFiles(
        paths=options.files,
        predicted=predicted,
        reference=reference,
        metrics=metrics,
        scores=scores,
        controls={
            one.name: run_controls(one, reference) for one in metrics if one.name in CONTROLLED
        },
        left_out=left_out,
    )


def _choose_metrics(options: CompareOptions) -> tuple[list[Metric], dict[str, str]]:
    """The chosen metrics, or all; and the requirements of those that are left out, by name."""
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


def _names(paths: Sequence[Path]) -> list[str]:
    """Labels of the files in tables: their names, or paths where names are equal.

    Raises:
        ConfigError: a file is given twice.
    """
    names = [path.name for path in paths]
    if len(set(names)) < len(names):
        names = [str(path) for path in paths]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise ConfigError(f"{twice} is given twice; give each file to judge once")
    return names


def _streams(options: CompareOptions) -> list[EventStream]:
    """The recordings, cut to the time asked for.

    Raises:
        InputError: none has an event there: two empty streams would be alike.
    """
    span_us = None if options.time is None else parse_time_range(options.time)
    whole = [options.open_file(path, None).collect() for path in options.files]
    cut = whole if span_us is None else [one.cut(*span_us) for one in whole]
    if span_us is not None and not any(map(len, cut)):
        clocks = [
            f"{path} from {one.t[0] / MICROSECONDS:.3f} to {one.t[-1] / MICROSECONDS:.3f} s"
            for path, one in zip(options.files, whole, strict=True)
            if len(one)
        ]
        raise InputError(
            f"no file has events in the time {options.time}; "
            f"{' and '.join(clocks) or 'all are empty'}"
        )
    return cut


def _document(found: ScoredFiles) -> dict[str, Any]:
    """Document for `--json`: for one candidate its scores, for several a list of them."""
    *judged, reference = found.paths
    every = [
        {
            "predicted": {"path": str(path), "events": len(found.predicted[name])},
            "scores": dict(found.scores[name]),
        }
        for path, name in zip(judged, found.predicted, strict=True)
    ]
    return {
        **(every[0] if len(every) == 1 else {"candidates": every}),
        "reference": {"path": str(reference), "events": len(found.reference)},
        "controls": found.controls,
        "left_out": found.left_out,
    }


def _show(console: Console, found: ScoredFiles) -> None:
    """Values of all candidates, blind spots, controls, and what was left out."""
    titles = ["value"] if len(found.predicted) == 1 else list(map(escape, found.predicted))
    table = Table("metric", *titles, "unit", "good", box=None, pad_edge=False)
    blind = Table("metric", "does not see", box=None, pad_edge=False)
    for metric in found.metrics:
        values = [score_text(one[metric.name]) for one in found.scores.values()]
        table.add_row(metric.name, *values, metric.unit, GOOD[metric.better])
        blind.add_row(metric.name, metric.blind_to)
    console.print(table, "", blind, sep="\n")
    for name, values_by_control in found.controls.items():
        controls = Table(f"{name}, controls of the reference", "value", box=None, pad_edge=False)
        for control, value in values_by_control.items():
            controls.add_row(control, score_text(value))
        console.print("", controls, sep="\n")
    for name, missing in found.left_out.items():
        console.print(f"\n{name} was left out: {missing}", style="dim", markup=False)

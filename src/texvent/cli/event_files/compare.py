"""`texvent compare PREDICTED... REFERENCE`: how close event files are to a true one."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, NamedTuple

from texvent.cli.event_files.comparison_output import Candidate, Findings, show
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.io.files import load
from texvent.metrics.compare import compare, describe_metrics, load_metric
from texvent.metrics.controls import CONTROLLED, run_controls
from texvent.metrics.latent_similarity import EventQualityScore, load_eqs
from texvent.metrics.protocol import Metric
from texvent.metrics.stpp import Stpp
from texvent.metrics.uncertainty import check_window, score_windows
from texvent.runtime.displays.console_progress import ConsoleProgress
from texvent.sensor import SensorSize, parse_sensor
from texvent.video import MICROSECONDS

DESCRIPTION = """Compare event files of one sensor: one or several to judge, then the true one. Each
metric says what it does not see, and how sure it is over windows of time; of several files, which
is closer. docs/metrics.md gives definitions and the self-test."""

LATEST_S = 1e12
"""Beyond any clock: the seconds since 1970 are below 2e9."""


@dataclass(frozen=True, kw_only=True)
class CompareOptions:
    """Which files, and by which metrics."""

    positional: ClassVar[tuple[str, ...]] = ("files",)

    files: tuple[Path, ...] = REQUIRED
    """Event files to judge, one or several; last, the one with the truth, or another recording of
    the same scene."""
    metrics: str | None = None
    """Names of metrics, separated by commas; default: all whose weights are here."""
    start: float | None = None
    """Compare from this time on, in seconds."""
    stop: float | None = None
    """Compare up to this time, in seconds."""
    window: float | None = None
    """Windows of this length for intervals, in seconds; default: 0.1, longer above 50 windows."""
    intervals: bool = True
    """Score windows too; --no-intervals takes half of the time."""
    sensor: str | None = None
    """Sensor size, for event formats that do not store it."""
    rvt_weights: Path | None = None
    """RVT's published checkpoint (rvt-t.ckpt, rvt-s.ckpt or rvt-b.ckpt): adds the metric eqs."""
    levels: bool = False
    """Show the level matrix of STPP too: how far apart in time and space the events are."""
    json: bool = False
    """Print JSON instead of a table; undefined values are null."""

    def __post_init__(self) -> None:
        if self.files != REQUIRED and len(self.files) < 2:
            raise ConfigError(
                f"{self.files[0]} is the only file; give one or several to judge, and last the one "
                "with the truth"
            )
        for name in ("start", "stop"):
            check_range(name, getattr(self, name), -LATEST_S, LATEST_S)
        check_range("window", self.window, 1e-6, 1e6)
        check_window(self.window_us)

    @property
    def predicted(self) -> tuple[Path, ...]:
        """The files to judge."""
        return self.files[:-1]

    @property
    def reference(self) -> Path:
        """The file with the truth."""
        return self.files[-1]

    @property
    def window_us(self) -> int | None:
        """Length of the windows, µs; None: as long as suits the recording."""
        return None if self.window is None else round(self.window * MICROSECONDS)


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments, {"input": CompareOptions()}, prog="texvent compare", description=DESCRIPTION
    )
    findings = _judge(options, _prepare(options))
    if options.json:
        write_out(json.dumps(findings.document(), indent=2, ensure_ascii=False) + "\n")
    else:
        show(findings)
    return 0


class _Inputs(NamedTuple):
    """Recordings that are compared."""

    predicted: dict[str, EventStream]
    """Name → stream to judge."""
    reference: EventStream
    span_us: tuple[int, int] | None
    """Range that all are cut to, µs."""
    metrics: list[Metric]
    left_out: dict[str, str]
    """Metric → what it lacks."""


def _prepare(options: CompareOptions) -> _Inputs:
    metrics, left_out = _choose_metrics(options)
    span_us = _span(options)
    names = _names(options.predicted)
    size = parse_sensor(options.sensor) if options.sensor else None
    whole = [_load(path, size) for path in options.files]
    cut = whole
    if span_us is not None:
        cut = [one.cut(*span_us) for one in whole]
        _refuse_empty_span(options, cut, whole)
    predicted = dict(zip(names, cut[:-1], strict=True))
    return _Inputs(predicted, cut[-1], span_us, metrics, left_out)


def _judge(options: CompareOptions, inputs: _Inputs) -> Findings:
    """All scores."""
    reference, metrics = inputs.reference, inputs.metrics
    windows = None
    candidates = {}
    with ConsoleProgress() as progress:
        for (name, events), path in zip(inputs.predicted.items(), options.predicted, strict=True):
            scores = compare(events, reference, metrics, progress=progress)
            levels = Stpp().levels(events, reference).tolist() if options.levels else None
            candidates[name] = Candidate(path, len(events), scores, levels)
        if options.intervals:
            windows = score_windows(
                inputs.predicted, reference, metrics, window_us=options.window_us, progress=progress
            )
    controls = {one.name: run_controls(one, reference) for one in metrics if one.name in CONTROLLED}
    return Findings(
        candidates=candidates,
        reference=options.reference,
        reference_events=len(reference),
        span_us=inputs.span_us,
        metrics=metrics,
        controls=controls,
        windows=windows,
        left_out=inputs.left_out,
    )


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
    options: CompareOptions, cut: Sequence[EventStream], whole: Sequence[EventStream]
) -> None:
    """Two streams without events would be alike: rather a wrong span than a perfect score."""
    if any(map(len, cut)):
        return
    clocks = [
        f"{path} from {one.t[0] / MICROSECONDS:.3f} to {one.t[-1] / MICROSECONDS:.3f} s"
        for path, one in zip(options.files, whole, strict=True)
        if len(one)
    ]
    raise InputError(
        f"no file has events between --start and --stop; {' and '.join(clocks) or 'all are empty'}"
    )


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

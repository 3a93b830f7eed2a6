"""The report of a calibration as one HTML file: constants, and the model beside the recording."""

from __future__ import annotations

import dataclasses
import html
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.calibrate.estimates import Estimate, Kept
from texvent.calibrate.events_only.pixel_trains import PixelTrains
from texvent.calibrate.report.charts import compare_values, distribution_chart, rate_chart
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.simulate.physical.config import PhysicalConfig
from texvent.video import MICROSECONDS
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent.view.page.html_parts import fill_template, table_html
from texvent.view.page.sample import rate_counts

RATE_BINS = 120


class Comparison(NamedTuple):
    """Events of the recording and of the fitted model, of the same pixels and span."""

    recorded: EventStream
    simulated: EventStream
    chosen: NDArray[np.bool_]
    """[H, W] pixels that are compared."""
    seconds: float
    caption: str
    """What is compared, in a sentence."""


class Report(NamedTuple):
    """What a page shows."""

    source: str
    start: PhysicalConfig
    found: Sequence[Estimate]
    kept: Sequence[Kept]
    remarks: Sequence[str]
    comparison: Comparison
    charts: Sequence[str]
    """More charts, as HTML."""


def write_report(report: Report, path: Path, *, overwrite: bool) -> Path:
    """Write the page; it opens offline and holds no script.

    Raises:
        OutputError: the file exists already or cannot be written.
    """
    body = [
        _constants(report),
        *(f'<p class="note">{html.escape(remark)}</p>' for remark in report.remarks),
        "<h2>The model beside the recording</h2>",
        f'<p class="note">{html.escape(report.comparison.caption)} <span class="key recorded">'
        'recording</span> <span class="key model">model</span></p>',
        f'<div class="charts">{"".join(comparison_charts(report.comparison))}</div>',
    ]
    if report.charts:
        body += ["<h2>The sensor</h2>", f'<div class="charts">{"".join(report.charts)}</div>']
    page = fill_template(
        "document.html",
        {
            "title": "Calibration",
            "summary": html.escape(report.source),
            "body": "\n".join(body),
        },
        palette=get_palette(DEFAULT_PALETTE),
    )
    with atomic_file(path, overwrite=overwrite) as part:
        part.write_text(page, encoding="utf-8")
    return path


def comparison_charts(comparison: Comparison) -> list[str]:
    """Event rate, counts per pixel and inter-event intervals of recording and model."""
    chosen = comparison.chosen.reshape(-1)
    trains = [PixelTrains.of(one).at(chosen) for one in (comparison.recorded, comparison.simulated)]
    seconds = comparison.seconds
    rates = _rate(comparison.recorded, seconds), _rate(comparison.simulated, seconds)
    charts = [rate_chart(*rates, seconds)]
    counts = [one.counts().sum(0)[chosen].astype(np.float64) for one in trains]
    silent = [float((one == 0).mean()) if one.size else 1.0 for one in counts]
    title = f"Events per pixel; none: {silent[0]:.0%} recorded, {silent[1]:.0%} in the model"
    fired = compare_values(*(one[one > 0] for one in counts))
    charts.append(distribution_chart(title, fired, "events"))
    for name, p in (("ON", True), ("OFF", False)):
        intervals = [_intervals(one, p) for one in trains]
        title = f"Intervals between {name} events of a pixel"
        charts.append(distribution_chart(title, compare_values(*intervals), "s"))
    return charts


def _rate(events: EventStream, seconds: float) -> NDArray[np.int64]:
    first_us = (events.time_range or (0, 0))[0]
    stop_us = first_us + round(seconds * MICROSECONDS)
    return np.asarray(rate_counts(events, (first_us, stop_us), RATE_BINS).sum(axis=0))


def _intervals(trains: PixelTrains, p: bool) -> NDArray[np.float64]:
    """Times between events of one polarity, s."""
    chosen = trains.is_on == p
    one = PixelTrains(trains.size, trains.pixel[chosen], trains.t[chosen], trains.is_on[chosen])
    waits = one.waits_us()
    return np.asarray(np.maximum(waits[np.isfinite(waits)], 1.0) / MICROSECONDS)


def _constants(report: Report) -> str:
    """The table of constants: value, interval, value before; then what stays."""
    before = dataclasses.asdict(report.start)
    rows = [
        (one.name, f"{one.value:.4g} {one.unit}", one.interval, _text(before, one.name))
        for one in report.found
    ]
    table = table_html(
        ("constant", "value", "95 % interval", "start preset"), rows, kind="constants"
    )
    kept = "".join(f"<li>{html.escape(str(one))}</li>" for one in report.kept)
    if not kept:
        return table
    summary = f"{len(report.kept)} constants that this recording does not tell"
    return f"{table}<details><summary>{summary}</summary><ul>{kept}</ul></details>"


def _text(values: dict[str, object], name: str) -> str:
    value = values.get(name, "–")
    return f"{value:.4g}" if isinstance(value, float) else str(value)

"""What a data set holds as one HTML file: counts, plots, classes, reasons."""

from __future__ import annotations

import html
from pathlib import Path

from texvent.dataset.contents.made_set import MadeSet
from texvent.dataset.contents.statistics import (
    COUNTS,
    MICROSECONDS,
    SetStatistics,
    Statistics,
    counts_rows,
)
from texvent.dataset.contents.summary import summary_lines
from texvent.dataset.looking.charts import bars, histogram
from texvent.io.atomic import atomic_file
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent.view.page.html_parts import count_text, fill_template, table_html


def write_statistics_page(
    made: MadeSet, statistics: SetStatistics, path: Path, *, overwrite: bool
) -> Path:
    """Write the page; it opens offline and holds no script.

    Raises:
        OutputError: the file exists already or cannot be written.
    """
    total = statistics.total
    body = [
        table_html(COUNTS, counts_rows(statistics)),
        f"<p>{'<br>'.join(map(html.escape, summary_lines(total)))}</p>",
        "<h2>Samples</h2>",
        f'<div class="charts">{_charts(total)}</div>',
    ]
    if total.classes:
        body += [f"<h2>Classes: {len(total.classes):,}</h2>", bars(total.classes)]
    if len(total.sensors) > 1:
        body += ["<h2>Sensors</h2>", bars(total.sensors)]
    if total.reasons:
        body += ["<h2>Why samples are not there</h2>", bars(total.reasons)]
    if total.warnings:
        body += ["<h2>Warnings</h2>", bars(total.warnings)]
    summary = (
        f"{total.samples:,} samples of {len(total.clips):,} videos, "
        f"{count_text(sum(total.events))} events in {sum(total.durations_us) / MICROSECONDS:,.1f} s"
    )
    page = fill_template(
        "document.html",
        {"title": html.escape(made.name), "summary": summary, "body": "\n".join(body)},
        palette=get_palette(DEFAULT_PALETTE),
    )
    with atomic_file(path, overwrite=overwrite) as part:
        part.write_text(page, encoding="utf-8")
    return path


def _charts(total: Statistics) -> str:
    seconds = [us / MICROSECONDS for us in total.durations_us]
    return "".join(
        (
            histogram("Events per sample", total.events, unit="events", is_log=True),
            histogram("Events per second", total.rates, unit="events/s", is_log=True),
            histogram("Duration", seconds, unit="s", is_log=False),
        )
    )

"""Simulated events beside the recorded stream of the same caption: scores, id by id.

The paper scores such pairs by EQS (Table 2) and does not say which part of a simulated clip, which
is longer than a stream, is compared. Here parts of the stream's length, evenly spread, are averaged.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping, Sequence
from io import StringIO
from typing import Any

import numpy as np

from texvent.events import EventStream
from texvent.metrics.compare import compare
from texvent.metrics.protocol import Metric
from texvent_lab.alignment.recordings import Recording
from texvent_lab.bench.document import markdown_table
from texvent_lab.bench.uncertainty import Mean

PARTS = 4
"""Parts of a clip, at most."""
OTHER = " with another stream"
"""Column of the control: the score with the stream of another caption."""

Row = dict[str, Any]


def score_pairs(
    samples: Mapping[str, Sequence[Recording]],
    streams: Sequence[Recording],
    metrics: Sequence[Metric],
    progress: Callable[[str, int, int], None] = lambda stage, done, total: None,
) -> list[Row]:
    """A row per sample: its scores against the stream of its id, and against that of another.

    Args:
        samples: variant → simulated recordings.
        streams: recorded, each of another id; the next one in this order is the control.
        metrics: to compute.
        progress: told of (variant, done, total).

    Raises:
        InputError: the sensors differ in size.
    """
    place = {stream.id: number for number, stream in enumerate(streams)}
    rows: list[Row] = []
    for variant, recordings in samples.items():
        for done, sample in enumerate(recordings):
            progress(variant, done, len(recordings))
            own, events = streams[place[sample.id]].load(), sample.load()
            row = {"variant": variant, "id": sample.id, "sample": sample.key}
            row |= {"recorded": len(own), "simulated": len(events), **_scores(events, own, metrics)}
            if len(streams) > 1:
                other = streams[(place[sample.id] + 1) % len(streams)].load()
                scores = _scores(events, other, metrics)
                row |= {name + OTHER: value for name, value in scores.items()}
            rows.append(row)
    return rows


def _scores(
    events: EventStream, recorded: EventStream, metrics: Sequence[Metric]
) -> dict[str, float]:
    """Means over parts of the events as long as the recording; clocks begin at 0."""
    first, stop = recorded.time_range or (0, 1)
    truth = _part(recorded, first, stop)
    begin, end = events.time_range or (0, 1)
    starts = np.linspace(begin, max(begin, end - (stop - first)), PARTS).astype(int)
    parts = [_part(events, start, start + stop - first) for start in dict.fromkeys(starts.tolist())]
    found = [compare(part, truth, metrics) for part in parts]
    return {one.name: float(np.mean([each[one.name] for each in found])) for one in metrics}


def _part(events: EventStream, start: int, stop: int) -> EventStream:
    part = events.cut(start, stop)
    return EventStream.from_columns(part.x, part.y, part.t - start, part.p, size=events.size)


def summarise_pairs(rows: Sequence[Row], metrics: Sequence[Metric]) -> dict[str, dict[str, Mean]]:
    """Variant → column → mean over pairs with its interval."""
    columns = [name + kind for name in (one.name for one in metrics) for kind in ("", OTHER)]
    return {
        variant: {
            column: Mean.of(
                [row.get(column, np.nan) for row in rows if row["variant"] == variant],
                is_in_sequence=False,
            )
            for column in columns
        }
        for variant in dict.fromkeys(row["variant"] for row in rows)
    }


def pairs_table(summary: Mapping[str, Mapping[str, Mean]]) -> str:
    """Markdown: a row per variant, means with 95 % intervals."""
    columns = list(next(iter(summary.values())))
    body = [
        [
            name,
            *(f"{m.mean:.4f} [{m.interval.low:.4f}, {m.interval.high:.4f}]" for m in row.values()),
        ]
        for name, row in summary.items()
    ]
    return markdown_table(["events", *columns], body)


def pairs_csv(rows: Sequence[Row]) -> str:
    """Comma-separated values."""
    text = StringIO()
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()

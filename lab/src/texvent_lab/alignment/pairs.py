"""Simulated events beside the recorded stream of the same caption: scores, id by id.

The paper scores such pairs by EQS (Table 2), and does not say which part of a simulated clip it
takes. Here it is the mean over parts as long as the stream, evenly spread.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from texvent.events import EventStream
from texvent.metrics.compare import compare
from texvent.metrics.protocol import Metric
from texvent_lab.alignment.recordings import TextRecording

PARTS = 4
"""Parts of a clip, at most."""
OTHER = ", other stream"
"""After the name of a metric: its control, the score with the stream of another caption."""


def score_pairs(
    samples: Mapping[str, Sequence[TextRecording]],
    streams: Sequence[TextRecording],
    metrics: Sequence[Metric],
    progress: Callable[[str, int, int], None] = lambda stage, done, total: None,
) -> list[dict[str, Any]]:
    """A row per sample: its scores against the stream of its id, and against the next one.

    Args:
        samples: variant → simulated recordings.
        streams: recorded, each of another id, among them those of the samples.
        metrics: to compute.
        progress: told of (variant, done, total).

    Raises:
        InputError: the sensors differ in size.
    """
    place = {stream.id: number for number, stream in enumerate(streams)}
    rows = []
    for variant, recordings in samples.items():
        for done, sample in enumerate(recordings):
            progress(variant, done, len(recordings))
            events, number = sample.load(), place[sample.id]
            row = {"variant": variant, "id": sample.id, "sample": sample.key, "events": len(events)}
            row |= _scores(events, streams[number].load(), metrics, "")
            if len(streams) > 1:
                other = streams[(number + 1) % len(streams)].load()
                row |= _scores(events, other, metrics, OTHER)
            rows.append(row)
    return rows


def _scores(
    events: EventStream, recorded: EventStream, metrics: Sequence[Metric], kind: str
) -> dict[str, float]:
    begin, end = events.time_range or (0, 1)
    first, stop = recorded.time_range or (0, 1)
    starts = np.linspace(begin, max(begin, end - (stop - first)), PARTS).astype(int).tolist()
    truth = _part(recorded, first, stop)
    found = [
        compare(_part(events, start, start + stop - first), truth, metrics)
        for start in dict.fromkeys(starts)
    ]
    return {f"{m.name}{kind}": float(np.mean([one[m.name] for one in found])) for m in metrics}


def _part(events: EventStream, start: int, stop: int) -> EventStream:
    """Events on a clock that begins at `start`."""
    part = events.cut(start, stop)
    return EventStream.from_columns(part.x, part.y, part.t - start, part.p, size=events.size)

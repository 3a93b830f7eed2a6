"""Same-timestamp share: how many events come in batches that share one µs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Better, Needs, check_pair

LEAST_GROUP = 20
"""A real sensor reads out a few pixels per µs; a larger group is an artefact of simulation."""


def same_timestamp_share(events: EventStream, least_group: int = LEAST_GROUP) -> float:
    """Share of events that share their µs with at least `least_group − 1` others.

    Args:
        events: the stream.
        least_group: smallest group that counts.

    Returns:
        0..1, or NaN without events.
    """
    if not len(events):
        return UNDEFINED
    _, sizes = np.unique(events.t, return_counts=True)
    return float(sizes[sizes >= least_group].sum() / len(events))


@dataclass(frozen=True, kw_only=True)
class BatchingDifference:
    """Absolute difference of the same-timestamp shares; NaN if a stream is empty."""

    name: ClassVar[str] = "batching"
    unit: ClassVar[str] = ""
    better: ClassVar[Better] = "lower"
    needs: ClassVar[Needs] = "any scene"
    range: ClassVar[tuple[float, float]] = (0.0, 1.0)
    blind_to: ClassVar[str] = "everything but events that share a µs: a diagnostic"

    def __call__(self, predicted: EventStream, reference: EventStream) -> float:
        """|share of predicted − of reference|; see `metrics.protocol.Metric`."""
        check_pair(predicted, reference)
        return abs(same_timestamp_share(predicted) - same_timestamp_share(reference))

"""Same-timestamp share: how many events come in batches that share one µs."""

from __future__ import annotations

import numpy as np

from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric

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


class BatchingDifference(Metric):
    """Absolute difference of the same-timestamp shares; NaN if a stream is empty."""

    name = "batching"
    needs = "any scene"
    blind_to = "everything but events that share a µs: a diagnostic"

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        return abs(same_timestamp_share(predicted) - same_timestamp_share(reference))

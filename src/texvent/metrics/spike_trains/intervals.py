"""ISI W1: how far the distribution of inter-event intervals lies from the true one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.metrics.spike_trains.trains import Trains


class IntervalDistance(Metric):
    """1-Wasserstein distance between the log10 intervals of same-pixel, same-polarity events.

    Intervals of all pixels are pooled; those below 1 µs count as 1 µs. NaN if a stream has none.
    """

    name = "isi"
    unit = "decades"
    range = (0.0, float("inf"))
    blind_to = "where and when: intervals of all pixels are pooled"

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        a, b = (
            np.log10(np.maximum(Trains.of(events).intervals_us, 1))
            for events in (predicted, reference)
        )
        return wasserstein(a, b) if a.size and b.size else UNDEFINED


def wasserstein(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """1-Wasserstein distance of two samples: the area between their cumulative distributions.

    Args:
        a: [n] values, n at least 1.
        b: [m] values, m at least 1.
    """
    a, b = np.sort(a), np.sort(b)
    edges = np.sort(np.concatenate([a, b]))
    share_a = np.searchsorted(a, edges[:-1], "right") / a.size
    share_b = np.searchsorted(b, edges[:-1], "right") / b.size
    return float((np.abs(share_a - share_b) * np.diff(edges)).sum())

"""Events per bin of time, of any number of events in memory."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream


def rate_counts(events: EventStream, extent: tuple[int, int], bins: int) -> NDArray[np.int64]:
    """OFF and ON events in equal bins of a range of time, [2, bins].

    Event times are ordered, so that only the places of the edges are searched.

    Args:
        events: any number.
        extent: where the first bin begins and the last one ends, µs; what lies outside is left out.
        bins: how many, 1 or more.

    Example:
        >>> from texvent.sensor import SensorSize
        >>> events = EventStream([0, 1, 2], [0, 0, 0], [0, 5, 9], [1, 0, 1], SensorSize(3, 1))
        >>> rate_counts(events, (0, 10), 2).tolist()
        [[0, 1], [1, 1]]
    """
    start_us, stop_us = extent
    edges = start_us - np.arange(bins + 1) * (start_us - stop_us) // bins  # rounded up
    places = np.searchsorted(events.t, edges)
    is_on = events.p.view(np.bool_)
    on = [np.count_nonzero(is_on[first:last]) for first, last in pairwise(places.tolist())]
    on_counts = np.array(on, dtype=np.int64)
    return np.stack([np.diff(places) - on_counts, on_counts])

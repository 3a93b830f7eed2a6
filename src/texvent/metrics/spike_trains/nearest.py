"""Nearest neighbour |Δt|: how far in time the closest event of the same pixel and polarity is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.metrics.spike_trains.trains import Trains

MS_PER_US = 1e-3


@dataclass(frozen=True, kw_only=True)
class NearestTime(Metric):
    """Mean time to the nearest event of the other stream at the same pixel and polarity.

    Averaged over the events of each stream, then over the two directions. One empty stream gives
    the cap, two give NaN.

    Source: V2CE (Zhang et al., 2024), made symmetric: one direction alone rewards extra events.
    """

    name = "nearest"
    unit = "ms"
    range = (0.0, 10.0)
    blind_to = "how many events share a partner; errors beyond the cap"

    cap_us: int = 10_000
    """Longest time that counts, µs; also the time of an event without a partner."""

    def __post_init__(self) -> None:
        check_range("cap_us", self.cap_us, 1, 10**9)

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        if not len(predicted) and not len(reference):
            return UNDEFINED
        if not len(predicted) or not len(reference):
            return self.cap_us * MS_PER_US
        a, b = Trains.of(predicted), Trains.of(reference)
        return (self._mean_us(a, b) + self._mean_us(b, a)) / 2 * MS_PER_US

    def _mean_us(self, events: Trains, others: Trains) -> float:
        """Mean capped time from each of `events` to the nearest of `others`, µs."""
        return float(np.abs(time_to_nearest(events, others, cap_us=self.cap_us)).mean())


def time_to_nearest(events: Trains, others: Trains, *, cap_us: int) -> NDArray[np.int64]:
    """Time from each of `events` to the nearest of `others` in the same train.

    Args:
        events: where the times start; not empty.
        others: where they end; not empty.
        cap_us: longest time that counts, µs.

    Returns:
        [n] µs, in the order of `events`: positive where the nearest comes later; `cap_us` where it
        is further away than that, or there is none.
    """
    # One sorted axis for all trains: they are laid end to end, further apart than the cap.
    start = min(int(events.t.min()), int(others.t.min()))
    stop = max(int(events.t.max()), int(others.t.max()))
    stride = stop - start + cap_us + 1
    here, there = (one.train * stride + (one.t - start) for one in (events, others))
    after = np.searchsorted(there, here)
    to_next = there[np.minimum(after, len(there) - 1)] - here
    to_last = here - there[np.maximum(after - 1, 0)]
    nearest = np.where(np.abs(to_next) < np.abs(to_last), to_next, -to_last)
    return np.where(np.abs(nearest) < cap_us, nearest, cap_us)

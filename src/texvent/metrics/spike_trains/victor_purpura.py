"""Victor-Purpura distance: the cheapest edit of one train into the other, on sampled trains."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.metrics.spike_trains.trains import Trains
from texvent.video import MICROSECONDS


@dataclass(frozen=True, kw_only=True)
class VictorPurpura(Metric):
    """Edit distance per pixel and polarity: insert or delete 1, shift `q |Δt|`.

    Summed over sampled trains, divided by their events: 0 equal, 1 nothing worth shifting. The
    trains are evenly spaced in the list of active ones, so no chance is involved. NaN if both
    streams are empty.

    Source: J. Victor, K. Purpura, "Nature and precision of temporal coding in visual cortex",
        Journal of Neurophysiology 76 (1996).
    """

    name = "victor_purpura"
    blind_to = "trains that were not sampled; errors of one pixel look like misses"

    shift_cost_hz: float = 200.0
    """q: cost of a shift by one second; beyond 2/q (10 ms), deleting and inserting is cheaper."""
    trains: int = 150
    """How many trains are compared, at most."""

    def __post_init__(self) -> None:
        check_range("shift_cost_hz", self.shift_cost_hz, 0.0, 1e6)
        check_range("trains", self.trains, 1, 10**9)

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        a, b = Trains.of(predicted), Trains.of(reference)
        active = np.union1d(a.train, b.train)
        if not active.size:
            return UNDEFINED
        step = max(1.0, active.size / self.trains)
        sampled = active[np.arange(0, active.size, step).astype(np.int64)]
        cost, events = 0.0, 0
        for train in sampled:
            times_a, times_b = a.times_of(int(train)), b.times_of(int(train))
            cost += edit_cost(times_a, times_b, self.shift_cost_hz / MICROSECONDS)
            events += times_a.size + times_b.size
        return cost / events


def edit_cost(a: NDArray[np.int64], b: NDArray[np.int64], shift_cost_per_us: float) -> float:
    """Least cost of turning the times `a` into `b`, exactly, in O(n · m).

    Args:
        a: [n] times, µs, ascending.
        b: [m] times, µs, ascending.
        shift_cost_per_us: cost of moving an event by 1 µs; adding or removing one costs 1.
    """
    position = np.arange(b.size + 1, dtype=np.float64)
    row = position.copy()
    for t in a:
        removed = row + 1
        removed[1:] = np.minimum(removed[1:], row[:-1] + shift_cost_per_us * np.abs(b - t))
        # Adding events: row[j] = min over k ≤ j of removed[k] + (j − k).
        row = np.minimum.accumulate(removed - position) + position
    return float(row[-1])

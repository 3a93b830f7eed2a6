"""How far simulated events are from recorded ones, as one number that a fit can lower."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from texvent.events import EventStream
from texvent.metrics.spike_trains import Trains
from texvent.metrics.stpp import Stpp

NOTHING = 10.0
"""Stands for a distance that an empty simulation leaves undefined: worse than any other."""


class Distance(NamedTuple):
    """The parts of the distance; all are 0 for equal streams."""

    overlap: float
    """1 − STPP: events without a partner in space and time."""
    intervals: float
    """Distance between the distributions of inter-event intervals, decades."""
    log_on: float
    """ln of simulated over recorded ON events."""
    log_off: float
    """ln of simulated over recorded OFF events."""

    @property
    def total(self) -> float:
        """Sum of the absolute parts."""
        return self.overlap + self.intervals + abs(self.log_on) + abs(self.log_off)

    def __str__(self) -> str:
        return (
            f"{self.total:.3f} (1-STPP {self.overlap:.3f}, intervals {self.intervals:.3f}, "
            f"ON x{math.exp(self.log_on):.2f}, OFF x{math.exp(self.log_off):.2f})"
        )


def measure_distance(simulated: EventStream, recorded: EventStream) -> Distance:
    """Distance of simulated events from recorded ones of the same span.

    Args:
        simulated: by the model.
        recorded: by the sensor; it has events of both polarities.
    """
    intervals = interval_distance(simulated, recorded)
    on, off = (_log_ratio(simulated, recorded, p) for p in (1, 0))
    return Distance(
        overlap=1.0 - Stpp()(simulated, recorded),
        intervals=NOTHING if math.isnan(intervals) else intervals,
        log_on=on,
        log_off=off,
    )


def interval_distance(a: EventStream, b: EventStream) -> float:
    """1-Wasserstein distance of the log10 inter-event intervals of two streams, decades.

    Intervals of all pixels and polarities are pooled; those below 1 µs count as 1 µs. NaN if a
    stream has none.
    """
    first, second = (
        np.sort(np.log10(np.maximum(Trains.of(events).intervals_us, 1))) for events in (a, b)
    )
    if not first.size or not second.size:
        return math.nan
    # The area between the cumulative distributions.
    edges = np.sort(np.concatenate([first, second]))
    shares = [np.searchsorted(one, edges[:-1], "right") / one.size for one in (first, second)]
    return float((np.abs(shares[0] - shares[1]) * np.diff(edges)).sum())


def _log_ratio(simulated: EventStream, recorded: EventStream, p: int) -> float:
    # Half an event stands for none, so that the logarithm exists.
    counts = [max(int((events.p == p).sum()), 0.5) for events in (simulated, recorded)]
    return math.log(counts[0] / counts[1])

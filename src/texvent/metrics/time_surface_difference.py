"""Time-surface L1: how recent the last event of every pixel is, at several instants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.metrics.spike_trains.trains import Trains


@dataclass(frozen=True, kw_only=True)
class TimeSurfaceDifference(Metric):
    """Mean |a − b| of `exp(−age / τ)` over pixels, polarities and instants; 0 without an event.

    Instants are evenly spaced from the first event of both streams to the last, the last one
    included. NaN if both streams are empty.
    """

    name = "time_surface"
    blind_to = "every event but the last of a pixel before each instant"

    instants: int = 20
    """How many times the surfaces are compared."""
    tau_us: int = 20_000
    """Decay time τ, µs."""

    def __post_init__(self) -> None:
        check_range("instants", self.instants, 1, 10**6)
        check_range("tau_us", self.tau_us, 1, 10**9)

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        ends = [one.t[[0, -1]] for one in (predicted, reference) if len(one)]
        if not ends:
            return UNDEFINED
        start, stop = int(np.min(ends)), int(np.max(ends))
        trains = [Trains.of(events) for events in (predicted, reference)]
        cells = 2 * predicted.size.width * predicted.size.height
        total = 0.0
        for number in range(1, self.instants + 1):
            instant = start + (stop - start) * number // self.instants
            a, b = (self._surface(one, instant, cells) for one in trains)
            total += float(np.abs(a - b).mean())
        return total / self.instants

    def _surface(self, trains: Trains, instant_us: int, cells: int) -> NDArray[np.float64]:
        """`exp(−age / τ)` of every train at one instant, [cells]."""
        past = trains.t <= instant_us
        surface = np.zeros(cells)
        # Times ascend within a train: the last assignment, the latest event, stays.
        surface[trains.train[past]] = np.exp((trains.t[past] - instant_us) / self.tau_us)
        return surface

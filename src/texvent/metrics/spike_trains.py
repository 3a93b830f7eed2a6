"""Spike-train metrics per pixel and polarity: Van Rossum distance, nearest event in time."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric, flat_index


@dataclass(frozen=True, eq=False)
class Trains:
    """Events ordered by (train, time); a train is one polarity of one pixel."""

    train: NDArray[np.int64]
    """[n] number of each event's train, (p · H + y) · W + x, ascending."""
    t: NDArray[np.int64]
    """[n] time, µs, ascending within a train."""

    @classmethod
    def of(cls, events: EventStream) -> Trains:
        """The trains of a stream."""
        width, height = events.size
        train = flat_index((events.p, 2), (events.y, height), (events.x, width))
        # Stable: a stream is in time order already, and stays so within each train.
        order = np.argsort(train, kind="stable")
        return cls(train[order], events.t[order])

    @cached_property
    def intervals_us(self) -> NDArray[np.int64]:
        """Times between neighbouring events of the same train, µs."""
        together = self.train[1:] == self.train[:-1]
        return np.asarray(np.diff(self.t)[together])


Float64Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class VanRossum(Metric):
    """`∫(s_a − s_b)² / (∫s_a² + ∫s_b²)` over all trains, s the sum of `exp(−(t − t_i)/τ)`, t ≥ t_i.

    The integrals are exact (no bins): each is τ/2 times a sum of `exp(−|t_i − t_j|/τ)` over pairs
    of events of a train. NaN if both streams are empty, 1 if one is.

    Source: M. van Rossum, "A novel spike distance", Neural Computation 13 (2001), normalised.
    """

    name = "van_rossum"
    blind_to = "how far a misplaced event is, beyond about 3 τ or one pixel"

    tau_us: int = 5_000
    """Decay time τ, µs."""

    def __post_init__(self) -> None:
        check_range("tau_us", self.tau_us, 1, 10**9)

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        a, b = Trains.of(predicted), Trains.of(reference)
        energy = self._energy(a, np.ones(len(a.t))) + self._energy(b, np.ones(len(b.t)))
        if not energy:
            return UNDEFINED
        train = np.concatenate([a.train, b.train])
        t = np.concatenate([a.t, b.t])
        weight = np.repeat([1.0, -1.0], [len(a.t), len(b.t)])
        order = np.lexsort((t, train))
        difference = self._energy(Trains(train[order], t[order]), weight[order])
        # Rounding may leave a tiny negative number where the streams are equal.
        return max(0.0, difference / energy)

    def _energy(self, trains: Trains, weight: Float64Array) -> float:
        """`Σ_ij w_i w_j exp(−|t_i − t_j|/τ)` over the pairs within each train."""
        if not len(trains.t):
            return 0.0
        together = trains.train[1:] == trains.train[:-1]
        decay = np.zeros(len(weight))
        decay[1:] = np.where(together, np.exp(-np.diff(trains.t) / self.tau_us), 0.0)
        # Trace of the earlier events of the train as each event finds it.
        inflow = np.zeros(len(weight))
        inflow[1:] = weight[:-1] * decay[1:]
        trace = solve_recurrence(decay, inflow)
        return float((weight * weight).sum() + 2 * (weight * trace).sum())


def solve_recurrence(decay: Float64Array, inflow: Float64Array) -> Float64Array:
    """`m_i = decay_i · m_(i−1) + inflow_i` for all i, in log2(longest run) passes.

    A decay of 0 starts a new run; m before the first is 0.

    Args:
        decay: [n] factors, 0..1.
        inflow: [n] terms.

    Returns:
        [n] float64.

    Source: the parallel prefix of Hillis and Steele, Communications of the ACM 29 (1986).
    """
    factor, value = decay.copy(), inflow.copy()
    stride = 1
    while stride < len(value) and factor[stride:].any():
        value[stride:] += factor[stride:] * value[:-stride].copy()
        # Products of many decays may leave the normal numbers; what is that small adds nothing.
        with np.errstate(under="ignore"):
            factor[stride:] *= factor[:-stride].copy()
        stride *= 2
    return value


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
        return float(time_to_nearest(events, others, cap_us=self.cap_us).mean())


def time_to_nearest(events: Trains, others: Trains, *, cap_us: int) -> NDArray[np.int64]:
    """Time between each of `events` and the nearest of `others` in the same train.

    Args:
        events: where the times start; not empty.
        others: where they end; not empty.
        cap_us: longest time that counts, µs; also where there is none.

    Returns:
        [n] µs, in the order of `events`.
    """
    # One sorted axis for all trains: they are laid end to end, further apart than the cap.
    start = min(int(events.t.min()), int(others.t.min()))
    stop = max(int(events.t.max()), int(others.t.max()))
    stride = stop - start + cap_us + 1
    here, there = (one.train * stride + (one.t - start) for one in (events, others))
    after = np.searchsorted(there, here)
    to_next = np.abs(there[np.minimum(after, len(there) - 1)] - here)
    to_last = np.abs(here - there[np.maximum(after - 1, 0)])
    return np.minimum(np.minimum(to_next, to_last), cap_us)

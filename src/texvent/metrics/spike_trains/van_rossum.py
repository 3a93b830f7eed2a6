"""Van Rossum distance: trains smoothed by a causal exponential, compared pixel by pixel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.metrics.spike_trains.trains import Trains

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

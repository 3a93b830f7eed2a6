"""STPP: spatio-temporal pyramid overlap, events matched in cells from coarse to fine."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.metrics.protocol import (
    Metric,
    check_pair,
    flat_index,
    occupied_windows,
    rate_of_window,
)

TIME_CELLS = (1, 2, 4, 8, 16)
"""τ: cells per window in time, each twice the one before it."""
SPACE_CELLS = (1, 2, 4, 8, 16, 32)
"""σ: cells per side of the sensor."""


@dataclass(frozen=True, kw_only=True)
class Stpp(Metric):
    """Share of events that find a partner in the same cell, mean over 30 pyramid levels.

    Per window, counts over [2 polarities, τ, σ, σ] cells; a level's score is
    `Σ min(a, b) / Σ max(a, b)`, averaged over windows with weight n_a + n_b.

    Source: docs/metrics.md; the paper's section 12 wishes for a spatial-pyramid measure with time.
    """

    name = "stpp"
    better = "higher"
    blind_to = "shifts inside the finest cell: 1/32 of the sensor's side, 3.1 ms"

    window_us: int = 50_000
    """Length of a window, µs; windows start at multiples of it."""

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        return float(self.levels(predicted, reference).mean())

    def levels(self, predicted: EventStream, reference: EventStream) -> NDArray[np.float64]:
        """Score of every level.

        Returns:
            [5, 6] float64: rows are 1, 2, 4, 8, 16 cells in time, columns 1 .. 32 in space.
        """
        check_pair(predicted, reference)
        score = np.zeros((len(TIME_CELLS), len(SPACE_CELLS)))
        weight = 0
        for window in occupied_windows(predicted, reference, rate_of_window(self.window_us)):
            total = len(window.predicted) + len(window.reference)
            matched = _match(self._count(window.predicted), self._count(window.reference))
            # Σ max = n_a + n_b − Σ min.
            score += total * matched / (total - matched)
            weight += total
        return score / weight if weight else np.ones_like(score)

    def _count(self, events: EventStream) -> NDArray[np.int64]:
        """Counts in the finest cells, [2, 16, 32, 32]."""
        width, height = events.size
        fine_t, fine = TIME_CELLS[-1], SPACE_CELLS[-1]
        cell = flat_index(
            (events.p, 2),
            (events.t % self.window_us * fine_t // self.window_us, fine_t),
            (events.y.astype(np.int64) * fine // height, fine),
            (events.x.astype(np.int64) * fine // width, fine),
        )
        return np.bincount(cell, minlength=2 * fine_t * fine * fine).reshape(2, fine_t, fine, fine)


def _match(a: NDArray[np.int64], b: NDArray[np.int64]) -> NDArray[np.int64]:
    """Σ min(a, b) on every level, [5, 6]; cells nest, so a coarse level is a sum of fine ones."""
    matched = np.empty((len(TIME_CELLS), len(SPACE_CELLS)), np.int64)
    both = np.stack([a, b])
    for row in reversed(range(len(TIME_CELLS))):
        level = both
        for column in reversed(range(len(SPACE_CELLS))):
            matched[row, column] = level.min(axis=0).sum()
            if column:
                level = _halve(_halve(level, axis=3), axis=4)
        if row:
            both = _halve(both, axis=2)
    return matched


def _halve(counts: NDArray[np.int64], *, axis: int) -> NDArray[np.int64]:
    """Neighbouring cells along one axis added together."""
    even: list[slice] = [slice(None)] * counts.ndim
    odd = even.copy()
    even[axis], odd[axis] = slice(0, None, 2), slice(1, None, 2)
    return np.asarray(counts[tuple(even)] + counts[tuple(odd)])

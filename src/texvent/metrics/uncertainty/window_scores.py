"""Scores of one or several candidates in windows of time, and which of them is closer."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.metrics.protocol import Better, Metric
from texvent.metrics.uncertainty.difference import Difference, Mean, PairedDifferences, tell
from texvent.runtime.progress import NO_PROGRESS, Progress
from texvent.video import MICROSECONDS

EDGE_US = 50_000
"""Windows begin at multiples of it and are multiples of it long, as the windows of STPP, µs."""
SHORTEST_US = 100_000
"""Length of a window where none is asked for, µs."""
MOST_WINDOWS = 50
"""Longer recordings get longer windows, where no length is asked for."""


class Verdict(NamedTuple):
    """Two candidates by one metric."""

    metric: str
    first: str
    second: str
    difference: Difference
    """First minus second, of values; of metrics that are good near 1, of distances from 1."""
    better: Better
    """Which values are closer: low or high ones."""
    unit: str

    @property
    def closer(self) -> str | None:
        """The candidate that is closer to the reference; None if they cannot be told apart."""
        if not self.difference.is_told:
            return None
        is_first = (self.difference.mean > 0) == (self.better == "higher")
        return self.first if is_first else self.second

    @property
    def sentence(self) -> str:
        """The same in words."""
        return tell(self.first, self.second, self.difference, better=self.better, unit=self.unit)

    def document(self) -> dict[str, Any]:
        """Plain values, NaN where undefined."""
        names = {"metric": self.metric, "first": self.first, "second": self.second}
        verdict = {"closer": self.closer, "sentence": self.sentence}
        return {**names, **self.difference.document(), **verdict}


@dataclass(frozen=True)
class WindowScores:
    """Metrics window by window."""

    window_us: int
    """Length of a window, µs."""
    starts_us: Sequence[int]
    """Where each begins, µs."""
    metrics: Sequence[Metric]
    values: Mapping[tuple[str, str], NDArray[np.float64]]
    """(metric, candidate) → [n], NaN where undefined or infinite."""

    def mean(self, metric: str, candidate: str) -> Mean:
        """Mean over the windows, with its interval."""
        return Mean.of(self.values[metric, candidate], is_in_sequence=True)

    def verdicts(self) -> list[Verdict]:
        """Every two candidates by every metric, tested together."""
        candidates = dict.fromkeys(candidate for _, candidate in self.values)
        keys = [
            (metric.name, *pair) for metric in self.metrics for pair in combinations(candidates, 2)
        ]
        better = {metric.name: metric.better for metric in self.metrics}
        units = {metric.name: metric.unit for metric in self.metrics}
        columns = {
            (metric, first, second): self._distances(metric, first, better[metric])
            - self._distances(metric, second, better[metric])
            for metric, first, second in keys
        }
        tested = PairedDifferences(columns, is_in_sequence=True)
        return [
            Verdict(
                *key,
                tested[key],
                "higher" if better[key[0]] == "higher" else "lower",
                units[key[0]],
            )
            for key in keys
        ]

    def _distances(self, metric: str, candidate: str, better: Better) -> NDArray[np.float64]:
        values = self.values[metric, candidate]
        return np.abs(values - 1) if better == "one" else values


def score_windows(
    candidates: Mapping[str, EventStream],
    reference: EventStream,
    metrics: Sequence[Metric],
    *,
    window_us: int | None = None,
    progress: Progress = NO_PROGRESS,
) -> WindowScores:
    """Score every candidate in every whole window of the reference.

    Args:
        candidates: name → stream to judge, of the reference's sensor.
        reference: the true stream.
        metrics: what to compute.
        window_us: length of a window, a multiple of 50,000 µs; default: 100,000, more where the
            reference has more than 50 of these.
        progress: told of each window.

    Raises:
        ConfigError: the length is no such multiple.
        InputError: the sensors differ in size.
    """
    check_window(window_us)
    extent = reference.time_range or (0, 0)
    if window_us is None:
        steps = -(-(extent[1] - extent[0]) // (MOST_WINDOWS * EDGE_US))
        window_us = max(SHORTEST_US, steps * EDGE_US)
    first = -(-extent[0] // EDGE_US) * EDGE_US
    starts = range(first, extent[1] - window_us + 1, window_us)
    values = {
        (metric.name, name): np.empty(len(starts)) for metric in metrics for name in candidates
    }
    for number, start in enumerate(starts):
        progress.advance("windows", number, len(starts))
        truth = reference.cut(start, start + window_us)
        for name, events in candidates.items():
            part = events.cut(start, start + window_us)
            for metric in metrics:
                value = metric(part, truth)
                # PSNR of equal frames is infinite, which has no mean.
                values[metric.name, name][number] = value if math.isfinite(value) else math.nan
    return WindowScores(window_us, list(starts), list(metrics), values)


def check_window(window_us: int | None) -> None:
    """Refuse a length that no windows can have.

    Raises:
        ConfigError: it is no positive multiple of 50,000 µs.
    """
    if window_us is not None and (window_us <= 0 or window_us % EDGE_US):
        raise ConfigError(
            f"window is {window_us / MICROSECONDS:g} s; it must be a multiple of "
            f"{EDGE_US / MICROSECONDS:g} s, the window of stpp"
        )

"""Search for thresholds, balance and cutoff that lower the distance to a recording."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Collection, Mapping
from typing import NamedTuple

import numpy as np

from texvent.calibrate.recording import TimeSpan, simulate_span
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.metrics.spike_trains import Trains
from texvent.metrics.stpp import Stpp
from texvent.simulation.physical.config import PhysicalConfig

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
    """Distance of simulated events from recorded ones, of both polarities, of the same span."""
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


OFFSETS_US = (-10_000, -5_000, 0, 2_500, 5_000, 10_000, 15_000)
"""Offsets of the frame times that are tried, µs: their stamps are the start of the exposure, and
half of it or more may be missing."""
COORDINATES: Mapping[str, tuple[float, float]] = {
    "balance": (1.0, 200.0),
    "cutoff_hz": (10.0, 3000.0),
}
"""Options that are searched, with their limits."""
STEPS = (2.0, math.sqrt(2.0))
"""Factors by which they are changed, one round each."""
COUNT_ROUNDS = 7
"""Simulations that may be spent on the thresholds of one candidate."""
COUNT_TOLERANCE = 0.002
"""Logarithm of a count ratio at which thresholds are good enough."""
COUNT_GAIN = 0.7
"""Step of the logarithm of a threshold per logarithm of a count ratio: counts fall with its power
-1 to -1.5, so this neither creeps nor overshoots."""
THRESHOLD_LIMITS = (0.02, 2.0)
"""Smallest and largest threshold that is tried, log units."""

Report = Callable[[str], None]


class Candidate(NamedTuple):
    """A model that was tried."""

    config: PhysicalConfig
    distance: Distance


class Search:
    """The search on one part of a recording."""

    def __init__(
        self,
        frames: list[Frame],
        truth: EventStream,
        span: TimeSpan,
        report: Report,
        *,
        keep: Collection[str] = (),
    ) -> None:
        self._frames = frames
        self._truth = truth
        self._span = span
        self._report = report
        self.coordinates = {name: one for name, one in COORDINATES.items() if name not in keep}
        self.offset_us = 0

    def run(self, best: Candidate) -> Candidate:
        """Change one option at a time, in both directions, as long as that helps."""
        for step in STEPS:
            for name, limits in self.coordinates.items():
                for factor in (step, 1 / step):
                    best = self._follow(best, name, factor, limits)
        return best

    def _follow(
        self, best: Candidate, name: str, factor: float, limits: tuple[float, float]
    ) -> Candidate:
        """Multiply an option again and again while the distance falls."""
        while True:
            value = getattr(best.config, name) * factor
            if not limits[0] <= value <= limits[1]:
                return best
            trial = self.match_counts(dataclasses.replace(best.config, **{name: value}))
            self._report(f"{name} {value:.4g}: distance {trial.distance}")
            if trial.distance.total >= best.distance.total:
                return best
            best = trial

    def find_offset(self, config: PhysicalConfig) -> None:
        """Choose the offset of the frame times with the largest overlap."""

        def overlap(offset_us: int) -> float:
            self.offset_us = offset_us
            return self.measure(config).overlap

        self.offset_us = min(OFFSETS_US, key=overlap)
        self._report(f"frame times are moved by {self.offset_us} µs")

    def match_counts(self, config: PhysicalConfig) -> Candidate:
        """Change both thresholds until the counts of ON and OFF events agree."""
        tried: list[Candidate] = []
        for _ in range(COUNT_ROUNDS):
            tried.append(Candidate(config, self.measure(config)))
            log_on, log_off = tried[-1].distance.log_on, tried[-1].distance.log_off
            if max(abs(log_on), abs(log_off)) <= COUNT_TOLERANCE:
                break
            on = _limited(config.contrast_threshold_on * math.exp(COUNT_GAIN * log_on))
            off = _limited(config.contrast_threshold_off * math.exp(COUNT_GAIN * log_off))
            config = dataclasses.replace(
                config, contrast_threshold=math.sqrt(on * off), on_off_ratio=on / off
            )
        return min(tried, key=lambda candidate: candidate.distance.total)

    def measure(self, config: PhysicalConfig) -> Distance:
        """Distance of a model from the recording."""
        return measure_distance(self.simulate(config), self._truth)

    def simulate(self, config: PhysicalConfig) -> EventStream:
        """Events of a model for the frames."""
        return simulate_span(self._frames, self._span, config, offset_us=self.offset_us)


def _limited(threshold: float) -> float:
    low, high = THRESHOLD_LIMITS
    return min(max(threshold, low), high)

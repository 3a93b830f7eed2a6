"""Fit the `physical` model to a recording: thresholds, balance, cutoff and noise curve.

The noise curve is measured directly. For any balance and cutoff, the two thresholds follow from
the counts of ON and OFF events; balance and cutoff are those with the least distance, searched
one at a time with steps that shrink.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

from texvent.calibrate.distance import Distance, measure_distance
from texvent.calibrate.noise import MeasuredNoise, measure_noise
from texvent.calibrate.recording import Recording, TimeSpan, simulate_span
from texvent.events import EventStream
from texvent.simulate.physical.config import PhysicalConfig
from texvent.video import Frame

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
COUNT_ROUNDS = 5
"""Simulations that may be spent on the thresholds of one candidate."""
COUNT_TOLERANCE = 0.01
"""Logarithm of a count ratio at which thresholds are good enough."""
COUNT_GAIN = 0.7
"""Step of the logarithm of a threshold per logarithm of a count ratio: counts fall with its power
-1 to -1.5, so this neither creeps nor overshoots."""
THRESHOLD_LIMITS = (0.02, 2.0)
"""Smallest and largest threshold that is tried, log units."""

Report = Callable[[str], None]


class Fit(NamedTuple):
    """What the fit found."""

    config: PhysicalConfig
    """The fitted model."""
    offset_us: int
    """What was added to the frame times, µs; it belongs to the recording, not to the sensor."""
    has_noise: bool
    """Whether noise and leak were measured (else they are those the fit started with)."""
    span: TimeSpan
    """The part that was fitted."""
    held_out: TimeSpan
    """The part that was not."""
    distances: Mapping[str, tuple[Distance, Distance]]
    """"start" and "fitted" → distance on the fitted and on the held-out part."""


class _Candidate(NamedTuple):
    config: PhysicalConfig
    distance: Distance


def fit_sensor(
    recording: Recording,
    *,
    start: PhysicalConfig,
    seconds: float = 1.0,
    report: Report = lambda line: None,
) -> Fit:
    """Fit the physical model to the first half of a recording and score it on the second.

    Args:
        recording: frames and events.
        start: where the search starts; options that are not searched keep their value.
        seconds: how much of each half is simulated.
        report: told of every step in one line.

    Raises:
        InputError: the recording is too short or has too few events.
    """
    halves = recording.halves()
    span, held_out = (half.first(seconds) for half in halves)
    truth = {part: recording.recorded(part) for part in (span, held_out)}
    noise = measure_noise(recording, halves[0], gamma=start.gamma)
    first = start if noise is None else _with_noise(start, noise)
    report("too few still pixels to measure noise" if noise is None else f"noise {noise.curve}")
    dense = {part: recording.dense_frames(part, start) for part in truth}
    search = _Search(dense[span], truth[span], span, report)
    search.find_offset(search.match_counts(first).config)
    best = search.run(search.match_counts(first))
    distances = {
        name: tuple(
            measure_distance(
                simulate_span(dense[part], part, config, offset_us=search.offset_us), truth[part]
            )
            for part in (span, held_out)
        )
        for name, config in (("start", start), ("fitted", best.config))
    }
    return Fit(
        config=best.config,
        offset_us=search.offset_us,
        has_noise=noise is not None,
        span=span,
        held_out=held_out,
        distances={name: (fitted, held) for name, (fitted, held) in distances.items()},
    )


def _with_noise(config: PhysicalConfig, noise: MeasuredNoise) -> PhysicalConfig:
    return dataclasses.replace(
        config,
        noise_curve=str(noise.curve),
        noise_scale=1.0,
        noise_on_fraction=0.5,
        leak_rate_hz=noise.leak_rate_hz,
    )


class _Search:
    """The search on one part of a recording."""

    def __init__(
        self, frames: list[Frame], truth: EventStream, span: TimeSpan, report: Report
    ) -> None:
        self._frames = frames
        self._truth = truth
        self._span = span
        self._report = report
        self.offset_us = 0

    def run(self, best: _Candidate) -> _Candidate:
        """Change one option at a time, in both directions, as long as that helps."""
        for step in STEPS:
            for name, limits in COORDINATES.items():
                for factor in (step, 1 / step):
                    best = self._follow(best, name, factor, limits)
        return best

    def _follow(
        self, best: _Candidate, name: str, factor: float, limits: tuple[float, float]
    ) -> _Candidate:
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
            return self._measure(config).overlap

        self.offset_us = min(OFFSETS_US, key=overlap)
        self._report(f"frame times are moved by {self.offset_us} µs")

    def match_counts(self, config: PhysicalConfig) -> _Candidate:
        """Change both thresholds until the counts of ON and OFF events agree."""
        tried: list[_Candidate] = []
        for _ in range(COUNT_ROUNDS):
            tried.append(_Candidate(config, self._measure(config)))
            log_on, log_off = tried[-1].distance.log_on, tried[-1].distance.log_off
            if max(abs(log_on), abs(log_off)) <= COUNT_TOLERANCE:
                break
            on = _limited(config.contrast_threshold_on * math.exp(COUNT_GAIN * log_on))
            off = _limited(config.contrast_threshold_off * math.exp(COUNT_GAIN * log_off))
            config = dataclasses.replace(
                config, contrast_threshold=math.sqrt(on * off), on_off_ratio=on / off
            )
        return min(tried, key=lambda candidate: candidate.distance.total)

    def _measure(self, config: PhysicalConfig) -> Distance:
        events = simulate_span(self._frames, self._span, config, offset_us=self.offset_us)
        return measure_distance(events, self._truth)


def _limited(threshold: float) -> float:
    low, high = THRESHOLD_LIMITS
    return min(max(threshold, low), high)

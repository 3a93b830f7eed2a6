"""Search for the contrast threshold that gives a wanted event rate."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Callable
from typing import NamedTuple

from texvent.config import check_range
from texvent.errors import InputError
from texvent.frames import MICROSECONDS
from texvent.pipeline import Simulation
from texvent.runtime.progress import Progress
from texvent.simulation.model_options import contrast_threshold_of, with_contrast_threshold

LOWEST, HIGHEST = 0.01, 1.2
"""Thresholds that are tried, log units."""
TOLERANCE = 0.02
"""A count this close, relatively, is a match."""
MAX_STEPS = 9
"""Thresholds that are tried at most; bisection then knows the threshold to 1 %."""
UNREACHED = 0.1
"""Relative difference from which the rate counts as out of reach."""


def reach_target_rate(simulation: Simulation, *, progress: Progress | None = None) -> Simulation:
    """The run with the contrast threshold that its option `target_rate` asks for, if it is set.

    Raises:
        ConfigError, InputError: as `match_rate`.
    """
    target_hz = simulation.settings.run.target_rate
    if target_hz is None:
        return simulation
    simulation, match = match_rate(simulation, target_hz, progress=progress)
    if progress is not None:
        progress.announce(
            f"rate     {match.ratio * target_hz:,.0f} events per second in the first second, with "
            f"contrast threshold {match.threshold:.4g} ({match.steps} trials)"
        )
    return simulation


def match_rate(
    simulation: Simulation,
    target_hz: float,
    *,
    seconds: float = 1.0,
    progress: Progress | None = None,
) -> tuple[Simulation, ThresholdMatch]:
    """A simulation whose contrast threshold makes its start fire at a wanted rate.

    Args:
        simulation: the run; its frames are read several times.
        target_hz: events per second of the whole sensor, above 0.
        seconds: how much of the clip, from its start, is simulated to measure the rate.
        progress: receives every trial.

    Returns:
        The same run with another threshold (ON and OFF keep their ratio), and what was found.

    Raises:
        ConfigError: the target or the duration is not above 0, or the simulator has no threshold.
        InputError: the source can be read only once, or no threshold gives that rate.
    """
    check_range("target_rate", target_hz, 1e-9)
    check_range("seconds", seconds, 1e-6)
    if simulation.video.is_live:
        raise InputError(
            "target_rate needs frames that can be read again, and this is a live source; "
            "record it first, or set contrast_threshold"
        )
    contrast_threshold_of(simulation.settings.simulate)

    def with_threshold(threshold: float) -> Simulation:
        config = with_contrast_threshold(simulation.settings.simulate, threshold)
        settings = dataclasses.replace(simulation.settings, simulate=config)
        return dataclasses.replace(simulation, settings=settings)

    trials = itertools.count(1)

    def rate_of(threshold: float) -> float:
        if progress is not None:
            progress.advance("target rate", next(trials), MAX_STEPS)
        return measure_rate(with_threshold(threshold), seconds)

    match = find_threshold(rate_of, target_hz)
    if abs(match.ratio - 1) > UNREACHED:
        raise InputError(
            f"no contrast threshold of {LOWEST:g}..{HIGHEST:g} gives {target_hz:,.0f} events per "
            f"second; the nearest is {match.ratio * target_hz:,.0f} at {match.threshold:.3g}. "
            "Choose a rate nearer to that, or change the noise, which no threshold removes"
        )
    return with_threshold(match.threshold), match


def measure_rate(simulation: Simulation, seconds: float) -> float:
    """Events per second over the first `seconds` of a run.

    Raises:
        InputError: there is one frame only, so no time passes.
    """
    events, first_us, last_us = 0, None, 0
    for frame, packet in simulation.steps():
        first_us = frame.t_us if first_us is None else first_us
        events += len(packet)
        last_us = frame.t_us
        if last_us - first_us >= seconds * MICROSECONDS:
            break
    if first_us is None or last_us == first_us:
        raise InputError("target_rate needs at least two frames; this source has fewer")
    return events * MICROSECONDS / (last_us - first_us)


class ThresholdMatch(NamedTuple):
    """The best threshold that was tried."""

    threshold: float
    """Contrast threshold δ, log units."""
    ratio: float
    """Events there over the wanted number."""
    steps: int
    """Thresholds that were tried."""

    @property
    def is_matched(self) -> bool:
        """Whether the number of events is within 2 % of the wanted one."""
        return abs(self.ratio - 1) <= TOLERANCE


def find_threshold(
    count_events: Callable[[float], float], target: float, *, start: float | None = None
) -> ThresholdMatch:
    """Threshold at which a count, or a rate, is within 2 % of a target.

    The count is assumed to fall with the threshold. Without `start` the logarithm of the range
    `LOWEST` .. `HIGHEST` is bisected. From `start`, a step assumes that the count falls as 1/δ
    until both sides are bracketed; then the geometric mean and a straight line in logarithms take
    turns.

    Args:
        count_events: threshold → number of events, or events per second; called at most
            `MAX_STEPS` times.
        target: number or rate wanted, above 0.
        start: threshold that is tried first, log units.

    Returns:
        The threshold whose count is closest to the target, by the ratio of the two.
    """
    threshold = math.sqrt(LOWEST * HIGHEST) if start is None else start
    tried: dict[float, float] = {}
    while threshold not in tried and len(tried) < MAX_STEPS:
        ratio = tried[threshold] = count_events(threshold) / target
        if abs(ratio - 1) <= TOLERANCE:
            return ThresholdMatch(threshold, ratio, len(tried))
        too_many = [one for one, ratio in tried.items() if ratio > 1]
        too_few = [one for one, ratio in tried.items() if ratio <= 1]
        low, high = max(too_many, default=LOWEST), min(too_few, default=HIGHEST)
        if start is None:
            threshold = math.sqrt(low * high)
        elif too_many and too_few:
            threshold = _step_inside(tried, low, high)
        else:
            # Never more than a factor of 4 at once: very low thresholds make very many events.
            threshold = min(max(threshold * min(max(ratio, 0.25), 4.0), LOWEST), HIGHEST)
    best = min(tried, key=lambda one: abs(math.log(tried[one])) if tried[one] else math.inf)
    return ThresholdMatch(best, tried[best], len(tried))


def _step_inside(tried: dict[float, float], low: float, high: float) -> float:
    """The next threshold between one with too many events and one with too few."""
    if len(tried) % 2 or not tried[high]:
        return math.sqrt(low * high)
    slope = math.log(tried[high] / tried[low]) / math.log(high / low)
    return low * math.exp(-math.log(tried[low]) / slope) if slope else math.sqrt(low * high)

"""Search for the contrast threshold that gives a wanted number of events."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

LOWEST, HIGHEST = 0.01, 1.2
"""Thresholds that are tried, log units."""
TOLERANCE = 0.02
"""A count this close, relatively, is a match."""
MAX_STEPS = 9
"""Thresholds that are tried at most; bisection then knows the threshold to 1 %."""


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

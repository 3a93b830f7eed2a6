"""Find the contrast threshold at which a simulator makes as many events as there truly were."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

LOWEST, HIGHEST = 0.01, 1.2
"""Thresholds that are tried, log units."""
TOLERANCE = 0.02
"""A count this close, relatively, is a match."""
MOST_STEPS = 9


class Match(NamedTuple):
    """The threshold found."""

    threshold: float
    """Contrast threshold δ, log units."""
    ratio: float
    """Events there per true event."""
    is_matched: bool
    """False if no threshold comes within 2 %."""


def match_rate(
    count_events: Callable[[float], int], target: int, *, start: float, steps: int = MOST_STEPS
) -> Match:
    """Threshold at which `count_events` gives `target` events, within 2 %.

    The count is taken to fall with the threshold. Until both sides are bracketed a step assumes
    that it falls as 1/δ; then the geometric mean and a straight line in logarithms take turns.

    Args:
        count_events: threshold → number of events; called at most `steps` times.
        target: number of true events; 0 cannot be matched and gives `start`.
        start: threshold that is tried first, log units.
        steps: most thresholds tried.

    Returns:
        The best threshold tried; `start` if no other came closer.
    """
    best = Match(start, math.nan, False)
    if not target:
        return best
    closest = math.inf
    tried: dict[float, float] = {}
    threshold = start
    for step in range(steps):
        ratio = count_events(threshold) / target
        error = abs(math.log(ratio)) if ratio else math.inf
        if error < closest or step == 0:
            closest = error
            best = Match(threshold, ratio, abs(ratio - 1) <= TOLERANCE)
        tried[threshold] = ratio
        following = _next_threshold(tried, threshold, is_even=step % 2 == 0)
        if best.is_matched or following in tried:
            break
        threshold = following
    return best


def _next_threshold(tried: dict[float, float], last: float, *, is_even: bool) -> float:
    too_many = [threshold for threshold, ratio in tried.items() if ratio > 1]
    too_few = [threshold for threshold, ratio in tried.items() if ratio <= 1]
    if too_many and too_few:
        low, high = max(too_many), min(too_few)
        if is_even or not tried[high]:
            return math.sqrt(low * high)
        slope = math.log(tried[high] / tried[low]) / math.log(high / low)
        return low * math.exp(-math.log(tried[low]) / slope) if slope else math.sqrt(low * high)
    # Never more than a factor of 4 at once: very low thresholds make very many events.
    factor = min(max(tried[last], 0.25), 4.0)
    return min(max(last * factor, LOWEST), HIGHEST)

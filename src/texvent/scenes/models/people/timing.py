"""Smooth functions of time that gestures are made of."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence

Key = tuple[float, tuple[float, ...]]
"""A time, s, and the values then."""


def swing(time_s: float, rate_hz: float, phase: float = 0.0) -> float:
    """A sine between -1 and 1; `phase` in cycles."""
    return math.sin(2.0 * math.pi * (rate_hz * time_s + phase))


def pulse(time_s: float, rate_hz: float, phase: float = 0.0) -> float:
    """From 0 up to 1 and back, once per cycle; 0 at the start of each."""
    return 0.5 - 0.5 * math.cos(2.0 * math.pi * (rate_hz * time_s + phase))


def ease(time_s: float, start_s: float, stop_s: float) -> float:
    """0 up to `start_s`, 1 from `stop_s` on, with zero slope at both."""
    share = min(max((time_s - start_s) / (stop_s - start_s), 0.0), 1.0)
    return share * share * (3.0 - 2.0 * share)


def follow_keys(time_s: float, keys: Sequence[Key], period_s: float = 0.0) -> tuple[float, ...]:
    """Values that pass through keys with a continuous slope, and do not overshoot them much.

    Cubic Hermite curves with Catmull-Rom slopes, which are level at the extremes.

    Args:
        time_s: the instant.
        keys: times in rising order with their values.
        period_s: length of one cycle, which starts at the first key; 0 = happens once, and the
            first and last values hold before and after.

    Returns:
        The values at that instant.
    """
    if period_s > 0.0:
        time_s = keys[0][0] + (time_s - keys[0][0]) % period_s
    elif time_s <= keys[0][0]:
        return keys[0][1]
    elif time_s >= keys[-1][0]:
        return keys[-1][1]
    index = bisect_right([key[0] for key in keys], time_s) - 1
    before, here, there, after = (_key(keys, index + step, period_s) for step in (-1, 0, 1, 2))
    span = there[0] - here[0]
    s = (time_s - here[0]) / span
    slopes = zip(_slope(here, before, there), _slope(there, here, after), strict=True)
    return tuple(
        (1.0 + 2.0 * s) * (1.0 - s) ** 2 * b
        + s * (1.0 - s) ** 2 * span * start
        + s * s * (3.0 - 2.0 * s) * c
        + s * s * (s - 1.0) * span * stop
        for b, c, (start, stop) in zip(here[1], there[1], slopes, strict=True)
    )


def _key(keys: Sequence[Key], index: int, period_s: float) -> Key:
    """A key; beyond the ends the cycle's, or a still one at the end's value."""
    count = len(keys)
    if period_s > 0.0:
        time_s, values = keys[index % count]
        return time_s + period_s * (index // count), values
    if index < 0:
        # Mirrored, so that the slope at the end is zero.
        return 2.0 * keys[0][0] - keys[1][0], keys[1][1]
    if index >= count:
        return 2.0 * keys[-1][0] - keys[-2][0], keys[-2][1]
    return keys[index]


def _slope(here: Key, before: Key, after: Key) -> tuple[float, ...]:
    """Slopes of the values at a key: none where a value turns round or stays."""
    span = after[0] - before[0]
    return tuple(
        (c - a) / span if (b - a) * (c - b) > 0.0 else 0.0
        for a, b, c in zip(before[1], here[1], after[1], strict=True)
    )

"""The refractory period as the dead time at the lower end of the inter-event intervals."""

from __future__ import annotations

import numpy as np

from texvent.calibrate.estimates import Estimate
from texvent.calibrate.events_only.pixel_trains import Float64Array

SHORTEST = 50
"""Intervals at the lower end that are looked at."""
PRECISION = 0.2
"""Part of the dead time that the gap above it may be uncertain by."""


def find_dead_time(waits_us: Float64Array) -> Estimate | str:
    """The dead time of pixels that fire at random.

    Random events fill the intervals from the dead time on evenly. With the 50 shortest intervals
    over a range, the next one below the shortest would be 1/49 of the range away.

    Args:
        waits_us: inter-event intervals of pixels, both polarities together, µs; NaN is left out.

    Returns:
        The constant `refractory_period_us`, or why there is none.

    Example:
        >>> str(find_dead_time(300.0 + np.arange(1, 61)))
        'refractory_period_us 300 µs (95 %: 298 to 301)'
    """
    waits = waits_us[np.isfinite(waits_us)]
    if waits.size < SHORTEST:
        return f"{waits.size} intervals; {SHORTEST} are needed"
    shortest = np.sort(np.partition(waits, SHORTEST - 1)[:SHORTEST])
    gap = float(shortest[-1] - shortest[0]) / (SHORTEST - 1)
    low, high = float(shortest[0]) - 3 * gap, float(shortest[0])
    if 3 * gap > PRECISION * high:
        return f"intervals near it are too rare; it is at most {high:.0f} µs"
    return Estimate("refractory_period_us", high - gap, low, high, "µs")

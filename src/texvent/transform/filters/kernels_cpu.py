"""The loops of `reference`, compiled; the results are equal."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.transform.filters.reference import NEVER, Int64Array, UInt16Array


@jit
def find_supported(
    x: UInt16Array,
    y: UInt16Array,
    t: Int64Array,
    plane: NDArray[np.uint8],
    last_us: Int64Array,
    window_us: int,
    support: int,
    radius: int,
) -> NDArray[np.bool_]:
    """As `reference.find_supported`."""
    supported = np.zeros(len(t), np.bool_)
    _, height, width = last_us.shape
    for event in range(len(t)):
        column, row, seen = int(x[event]), int(y[event]), last_us[plane[event]]
        # NEVER is earlier than any time.
        earliest = t[event] - window_us
        found = 0
        for other in range(max(row - radius, 0), min(row + radius + 1, height)):
            for beside in range(max(column - radius, 0), min(column + radius + 1, width)):
                found += seen[other, beside] >= earliest
        found -= seen[row, column] >= earliest
        supported[event] = found >= support
        seen[row, column] = t[event]
    return supported


@jit
def find_rested(
    x: UInt16Array, y: UInt16Array, t: Int64Array, kept_us: Int64Array, period_us: int
) -> NDArray[np.bool_]:
    """As `reference.find_rested`."""
    rested = np.zeros(len(t), np.bool_)
    for event in range(len(t)):
        before = kept_us[y[event], x[event]]
        if before == NEVER or t[event] - before >= period_us:
            rested[event] = True
            kept_us[y[event], x[event]] = t[event]
    return rested

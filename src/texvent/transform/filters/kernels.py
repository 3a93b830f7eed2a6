"""Compiled loops of the event filters."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.transform.filters.apply import NEVER, Int64Array, UInt16Array


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
    """Mask of the events that enough neighbours support, [n].

    Args:
        x: columns, [n].
        y: rows, [n].
        t: times, µs, [n], non-decreasing.
        plane: which plane of `last_us` an event is in, [n].
        last_us: time of the last event of each pixel, [planes, H, W]; changed.
        window_us: how long an event supports its neighbours, µs.
        support: neighbours that must have fired.
        radius: of the neighbourhood, pixels.
    """
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
    """Mask of the events at least a period after the last kept one of their pixel, [n].

    Args:
        x: columns, [n].
        y: rows, [n].
        t: times, µs, [n], non-decreasing.
        kept_us: time of the last event of each pixel that was kept, [H, W]; changed.
        period_us: the refractory period, µs.
    """
    rested = np.zeros(len(t), np.bool_)
    for event in range(len(t)):
        before = kept_us[y[event], x[event]]
        if before == NEVER or t[event] - before >= period_us:
            rested[event] = True
            kept_us[y[event], x[event]] = t[event]
    return rested

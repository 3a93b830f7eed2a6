"""The definitions of the filters that look at one event after the other, in plain Python.

`kernels_cpu` is the compiled form; tests hold both to equal results.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

NEVER = -(2**62)
"""Stands for the time of a pixel that has not fired, µs; no event is that early."""

UInt16Array = NDArray[np.uint16]
Int64Array = NDArray[np.int64]


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
    """Which events enough neighbours support, [n].

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
    for event in range(len(t)):
        column, row, seen = int(x[event]), int(y[event]), last_us[plane[event]]
        around = seen[
            max(row - radius, 0) : row + radius + 1, max(column - radius, 0) : column + radius + 1
        ]
        is_recent = (around != NEVER) & (t[event] - around <= window_us)
        own = seen[row, column]
        is_own_recent = own != NEVER and t[event] - own <= window_us
        supported[event] = is_recent.sum() - is_own_recent >= support
        seen[row, column] = t[event]
    return supported


def find_rested(
    x: UInt16Array, y: UInt16Array, t: Int64Array, kept_us: Int64Array, period_us: int
) -> NDArray[np.bool_]:
    """Which events come at least a period after the one before of their pixel that was kept, [n].

    Args:
        x: columns, [n].
        y: rows, [n].
        t: times, µs, [n], non-decreasing.
        kept_us: time of the last event of each pixel that was kept, [H, W]; changed.
        period_us: the refractory period, µs.
    """
    rested = np.zeros(len(t), np.bool_)
    for event in range(len(t)):
        pixel = int(y[event]), int(x[event])
        if kept_us[pixel] == NEVER or t[event] - kept_us[pixel] >= period_us:
            rested[event] = True
            kept_us[pixel] = t[event]
    return rested

"""The rules of the event filters as plain loops: the compiled kernels must agree with them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.transform.filters.apply import NEVER, Int64Array, UInt16Array


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
    """See the kernel of this name."""
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
    """See the kernel of this name."""
    rested = np.zeros(len(t), np.bool_)
    for event in range(len(t)):
        pixel = int(y[event]), int(x[event])
        if kept_us[pixel] == NEVER or t[event] - kept_us[pixel] >= period_us:
            rested[event] = True
            kept_us[pixel] = t[event]
    return rested

"""Where the flows of both directions confirm each other, compiled by Numba."""

from __future__ import annotations

import numpy as np

from texvent.interpolate.dis_flow.definitions import (
    CHANGED,
    SAME_PX2,
    SAME_RELATIVE,
    Floats,
    Mask,
)
from texvent.interpolate.dis_flow.refine_cpu import change_along
from texvent.runtime.jit import jit

# As float32: Numba computes with float64 where a constant is one.
_HALF = np.float32(0.5)
_CHANGED = np.float32(CHANGED)
_SAME_RELATIVE, _SAME_PX2 = np.float32(SAME_RELATIVE), np.float32(SAME_PX2)


@jit(error_model="numpy")
def unconfirmed(start: Floats, stop: Floats, flow: Floats, back: Floats) -> Mask:
    """Pixels whose flow the other direction contradicts, or along which brightness changes."""
    _, height, width = flow.shape
    change = change_along(start, stop, flow)
    found = np.ones((height, width), np.bool_)
    for y in range(height):
        for x in range(width):
            u, v = flow[0, y, x], flow[1, y, x]
            column = int(np.floor(np.float32(x) + u + _HALF))
            row = int(np.floor(np.float32(y) + v + _HALF))
            if column < 0 or row < 0 or column >= width or row >= height:
                continue
            aside, down = u + back[0, row, column], v + back[1, row, column]
            contradicts = aside * aside + down * down > _SAME_RELATIVE * (u * u + v * v) + _SAME_PX2
            found[y, x] = contradicts or abs(change[y, x]) > _CHANGED
    return found

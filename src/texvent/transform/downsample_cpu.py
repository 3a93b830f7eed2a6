"""Compiled loop of `downsample`: blocks of pixels that fire."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit


@jit
def fire_blocks(
    block: NDArray[np.int64],
    p: NDArray[np.uint8],
    pixels: NDArray[np.int64],
    sums: NDArray[np.int64],
) -> NDArray[np.int8]:
    """Polarity with which each event makes its block fire: 1, 0, or -1 for none, [n].

    Args:
        block: of each event, [n].
        p: polarity of each event, [n].
        pixels: of each block.
        sums: ON less OFF of each block since it fired; changed.
    """
    fired = np.full(len(block), -1, np.int8)
    for event in range(len(block)):
        one = block[event]
        total = sums[one] + (1 if p[event] else -1)
        if total == pixels[one] or total == -pixels[one]:
            fired[event] = 1 if total > 0 else 0
            total = 0
        sums[one] = total
    return fired

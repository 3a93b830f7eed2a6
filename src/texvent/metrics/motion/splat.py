"""An image of events at places between pixels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def splat_events(
    x: NDArray[np.float64], y: NDArray[np.float64], shape: tuple[int, int]
) -> NDArray[np.float64]:
    """Weight 1 per event, shared bilinearly between the four pixels around it.

    Args:
        x: column of each event, px, [n]; 0 <= x < width - 1.
        y: row of each event, px, [n]; 0 <= y < height - 1.
        shape: (height, width) of the image.

    Returns:
        [height, width] float64.
    """
    left, top = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    right_share, lower_share = x - left, y - top
    image = np.zeros(shape[0] * shape[1])
    for down, across in ((0, 0), (0, 1), (1, 0), (1, 1)):
        weight = (lower_share if down else 1 - lower_share) * (
            right_share if across else 1 - right_share
        )
        index = (top + down) * shape[1] + left + across
        image += np.bincount(index, weights=weight, minlength=image.size)
    return image.reshape(shape)

"""The definition of the scan for pixels outside their trigger levels, in NumPy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.levels import MARGIN, Curve, Logs, Luma

MOST_LOG = 80.0
"""Brightness whose intensity float32 still holds; no frame is as bright."""


def find_outside(luma: Luma, low: Luma, high: Luma) -> NDArray[np.int64]:
    """Pixels that may fire: those not between their two levels.

    Args:
        luma: [n].
        low: lowest luma at which each pixel is silent for sure, [n], of the same type.
        high: highest such luma, [n]; below `low` where a pixel always has to be looked at.

    Returns:
        [m] flat index, ascending.
    """
    return np.flatnonzero((luma < low) | (luma > high))


def narrow(pixel: NDArray[np.int64], logs: Logs, curve: Curve, low: Luma, high: Luma) -> None:
    """Say anew between which levels some pixels are silent for sure.

    Args:
        pixel: flat index, [n].
        logs: brightness at which each fires OFF, and at which it fires ON, [n] each.
        curve: the intensity of a brightness v is `scale · e^v + offset`.
        low: lowest silent luma of all pixels; changed in place.
        high: highest silent luma of all pixels; changed in place.
    """
    scale, offset = curve
    off, on = (scale * np.exp(np.minimum(log, MOST_LOG)) + offset for log in logs)
    lowest = off + MARGIN * (1.0 + np.abs(off))
    highest = on - MARGIN * (1.0 + np.abs(on))
    if low.dtype == np.uint8:
        lowest, highest = np.ceil(np.maximum(lowest, 0.0)), np.floor(np.minimum(highest, 255.0))
        is_empty = lowest > highest
        lowest, highest = np.where(is_empty, 255.0, lowest), np.where(is_empty, 0.0, highest)
    low[pixel], high[pixel] = lowest, highest

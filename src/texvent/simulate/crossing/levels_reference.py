"""The definition of the scan for pixels outside their trigger levels, in NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.crossing.levels import (
    MARGIN,
    SLACK,
    Curve,
    Float64Array,
    Luma,
    Outside,
    Thresholds,
)

MOST_LOG = 80.0
"""Brightness whose intensity float32 still holds; no frame is as bright."""


def find_outside(luma: Luma, seen: Luma, low: Luma, high: Luma) -> Outside:
    """Pixels that may fire: those not between their two levels.

    Args:
        luma: [n].
        seen: luma of the frame before, [n], of the same type as `luma`; becomes `luma`.
        low: lowest luma at which each pixel is silent for sure, [n], of the same type.
        high: highest such luma, [n]; below `low` where a pixel always has to be looked at.
    """
    pixel = np.flatnonzero((luma < low) | (luma > high))
    before, now = seen[pixel], luma[pixel]
    seen[:] = luma
    return Outside(pixel, before, now)


def narrow(
    pixel: NDArray[np.int64],
    reference: Float64Array,
    thresholds: Thresholds,
    curve: Curve,
    low: Luma,
    high: Luma,
) -> None:
    """Say anew between which levels some pixels are silent for sure.

    Args:
        pixel: flat index, [n].
        reference: brightness that all pixels compare with, log units.
        thresholds: of the chosen pixels.
        curve: brightness and intensity.
        low: lowest silent luma of all pixels; changed in place.
        high: highest silent luma of all pixels; changed in place.
    """
    centre = reference[pixel]
    ends = centre - thresholds.off, centre + thresholds.on
    off, on = (curve.scale * np.exp(np.minimum(end, MOST_LOG)) + curve.offset for end in ends)
    lowest = off + MARGIN * (1.0 + np.abs(off))
    lowest[ends[0] < curve.darkest - SLACK] = 0.0
    highest = on - MARGIN * (1.0 + np.abs(on))
    if low.dtype == np.uint8:
        lowest, highest = np.ceil(np.maximum(lowest, 0.0)), np.floor(np.minimum(highest, 255.0))
        is_empty = lowest > highest
        lowest, highest = np.where(is_empty, 255.0, lowest), np.where(is_empty, 0.0, highest)
    low[pixel], high[pixel] = lowest, highest


def look_up(table: NDArray[Any], luma: NDArray[np.uint8]) -> NDArray[Any]:
    """What a table has for each pixel.

    Args:
        table: [256] float64 or uint8.
        luma: [n].

    Returns:
        [n] of the table's type.
    """
    return np.asarray(table[luma])

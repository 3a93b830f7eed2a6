"""The definition of how trigger levels are set and scanned, in NumPy; see `trigger_levels`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.crossing.trigger_levels import (
    BRIGHTNESS_SLACK,
    MARGIN,
    BrightnessCurve,
    Float64Array,
    Luma,
    OutsidePixels,
)
from texvent.simulate.random.mismatch import Thresholds

MOST_LOG = 80.0
"""Brightness whose intensity float32 still holds; no frame is as bright."""


def find_outside_levels(luma: Luma, seen: Luma, low: Luma, high: Luma, found: OutsidePixels) -> int:
    """As `crossing.trigger_levels._find_outside_levels`."""
    pixel = np.flatnonzero((luma < low) | (luma > high))
    for column, values in zip(found, (pixel, seen[pixel], luma[pixel]), strict=True):
        column[: pixel.size] = values
    seen[:] = luma
    return pixel.size


def set_levels(
    pixel: NDArray[np.int64],
    reference: Float64Array,
    thresholds: Thresholds,
    curve: BrightnessCurve,
    low: Luma,
    high: Luma,
) -> None:
    """As `crossing.trigger_levels._set_levels`."""
    centre = reference[pixel]
    ends = centre - thresholds.off, centre + thresholds.on
    off, on = (curve.scale * np.exp(np.minimum(end, MOST_LOG)) + curve.offset for end in ends)
    lowest = off + MARGIN * (1.0 + np.abs(off))
    lowest[ends[0] < curve.darkest - BRIGHTNESS_SLACK] = 0.0
    highest = on - MARGIN * (1.0 + np.abs(on))
    if low.dtype == np.uint8:
        lowest, highest = np.ceil(np.maximum(lowest, 0.0)), np.floor(np.minimum(highest, 255.0))
        is_empty = lowest > highest
        lowest, highest = np.where(is_empty, 255.0, lowest), np.where(is_empty, 0.0, highest)
    low[pixel], high[pixel] = lowest, highest

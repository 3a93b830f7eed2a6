"""Stacked histogram: counts per polarity and time bin, the input of RVT detectors."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream


def stacked_histogram(
    events: EventStream, *, bins: int = 10, cutoff: int = 10
) -> NDArray[np.uint8]:
    """Events of one slice as a [2 · bins, H, W] picture.

    Args:
        events: the slice, usually 50 ms.
        bins: time bins; they span the first event to the last, not the slice.
        cutoff: counts above it are set to it, 1..255.

    Returns:
        uint8; channel `p · bins + bin`.

    Source: M. Gehrig, D. Scaramuzza, "Recurrent vision transformers for object detection with
        event cameras", CVPR 2023, and its code.
    Deviation: counts are clipped; the code's fast mode lets them wrap around at 256.
    """
    width, height = events.size
    shape = (2 * bins, height, width)
    if not len(events):
        return np.zeros(shape, np.uint8)
    since = events.t - events.t[0]
    time_bin = np.minimum(since * bins // max(int(since[-1]), 1), bins - 1)
    channel = events.p.astype(np.int64) * bins + time_bin
    flat = (channel * height + events.y) * width + events.x
    counts = np.bincount(flat, minlength=shape[0] * height * width)
    return np.minimum(counts, cutoff).reshape(shape).astype(np.uint8)

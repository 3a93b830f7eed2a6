"""Stacked histogram: counts per polarity and time bin, the input of RVT detectors."""

from __future__ import annotations

from texvent.config import check_range
from texvent.represent.array_ops import Array, EventColumns, Events, columns_of
from texvent.represent.voxel_grid import MAX_BINS

BINS = CUTOFF = 10
"""Time bins, and the largest count of one, that RVT uses."""


def stacked_histogram(events: Events, *, bins: int = BINS, cutoff: int = CUTOFF) -> Array:
    """Events of one slice as a [2 · bins, H, W] image.

    Args:
        events: the slice, usually 50 ms.
        bins: time bins, 1..4096; they span the first event to the last, not the slice.
        cutoff: counts above it are set to it, 1..255.

    Returns:
        uint8; channel `p · bins + bin`.

    Raises:
        ConfigError: bins or cutoff out of range.

    Source: M. Gehrig, D. Scaramuzza, "Recurrent vision transformers for object detection with
        event cameras", CVPR 2023, and its code.
    Deviation: counts are clipped; the code's fast mode lets them wrap around at 256. Bins are
        exact; the code divides in float32, which can move an event that lies on an edge.
    """
    check_range("bins", bins, 1, MAX_BINS)
    check_range("cutoff", cutoff, 1, 255)
    columns = columns_of(events)
    height, width = columns.size.shape
    ops = columns.ops
    counts = columns.count((columns.p, 2), (time_bins(columns, bins), bins), *columns.pixel_axes)
    return ops.cast(ops.xp.clip(counts, 0, cutoff).reshape(2 * bins, height, width), "uint8")


def time_bins(columns: EventColumns, bins: int) -> Array:
    """The bin of each event; the bins span the first event to the last."""
    since = columns.t - columns.t[:1]
    span = max(int(since[-1]), 1) if len(columns) else 1
    return columns.ops.xp.clip(since * bins // span, 0, bins - 1)

"""DiST: a timestamp image whose pixels age with the rate of events around them, as ranks.

Source: J. Kim et al., "N-ImageNet: towards robust, fine-grained object recognition with event
cameras", ICCV 2021, section 4.2, and its program (`reshape_then_acc_adj_sort`), which says how
counts are clipped and what a pixel without neighbours gets.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np

from texvent.represent.array_ops import Array, ArrayOps, Events, columns_of, flat_index
from texvent.represent.time_surface import NEVER, latest_events

DISCOUNT = 3
"""α of the paper."""
REACH = 2
"""Reach of the neighbourhood, pixels: 5×5."""
UNCLIPPED_SHARE = (99, 100)
"""Counts are clipped at the number that this share of all pixels stays below."""


def dist(events: Events) -> Array:
    """Discounted sorted timestamp image.

    For each polarity, with t the time of a pixel's last event since the start of the slice, and
    over its 5×5 neighbours n the number of events, b their first and e their last time:

        discounted = max(0, t − 3 (e − b) / n)    0 where n = 1
        DiST       = rank of `discounted` among all its different values / their number

    Counts are clipped, so that a few flickering pixels do not decide: at the number of different
    counts that together cover less than 99 % of all pixels.

    Args:
        events: the slice.

    Returns:
        [2, H, W] float32, 0 (oldest, or no event) to less than 1; index 0 is ON, 1 is OFF.

    Deviation: values are compared exactly; the program rounds them to float32 first, so it gives
        one rank to values that differ by less.

    Example:
        >>> from texvent.events import EventStream
        >>> from texvent.sensor import SensorSize
        >>> events = EventStream([9, 0, 1], [0] * 3, [0, 90, 100], [1] * 3, SensorSize(10, 1))
        >>> (dist(events)[0, 0] * 3).tolist()  # 90 − 15 and 100 − 15; one pixel is alone
        [1.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    """
    columns = columns_of(events)
    ops, (height, width) = columns.ops, columns.size.shape
    latest = latest_events(columns)
    span = int(columns.t[-1] - columns.t[0]) if len(columns) else 0
    axes = ((1 - columns.p, 2), *columns.pixel_axes)
    # The first event is the latest counted from the end.
    from_end = ops.latest_at(flat_index(*axes), columns.t[-1:] - columns.t, 2 * height * width, 0)
    first, counts = span - from_end.reshape(2, height, width), columns.count(*axes)
    ranks = [_ranks(latest[lane], first[lane], counts[lane], span, ops) for lane in range(2)]
    return ops.cast(ops.xp.stack(ranks), "float32")


def _ranks(latest: Array, first: Array, counts: Array, span: int, ops: ArrayOps) -> Array:
    """DiST of one polarity, [H, W] float64.

    Args:
        latest: time of the last event of each pixel, µs, `NEVER` without one, [H, W] int64.
        first: time of the first event, `span` without one, [H, W] int64.
        counts: events, [H, W] int64.
        span: time of the last event of the slice, µs.
        ops: of the arrays.
    """
    xp = ops.xp
    counts = _clipped(counts, ops)
    around = _over_neighbours(counts, 0, lambda one, two: one + two, ops)
    begin = _over_neighbours(first, span, xp.minimum, ops)
    end = _over_neighbours(latest, NEVER, xp.maximum, ops)
    # Quotients of whole numbers are rounded correctly, so equal values are equal on every device.
    divisor = xp.clip(around, 1, None)
    discounted = ops.cast(latest * divisor - DISCOUNT * (end - begin), "float64") / divisor
    values = xp.where(counts > 0, discounted, ops.cast(latest, "float64"))
    values = xp.where((values > 0) & (around != 1), values, values * 0.0)
    different, rank = xp.unique(values.reshape(-1), return_inverse=True)
    return ops.cast(rank, "float64").reshape(values.shape) / len(different)


def _clipped(counts: Array, ops: ArrayOps) -> Array:
    """Counts, at most as many as there are different counts below the share of all pixels."""
    _, pixels = ops.xp.unique(counts, return_counts=True)
    share, whole = UNCLIPPED_SHARE
    is_below = pixels.cumsum(0) * whole < math.prod(counts.shape) * share
    return ops.xp.clip(counts, 0, int(is_below.sum()))


def _over_neighbours(
    values: Array, outside: int, combine: Callable[[Array, Array], Array], ops: ArrayOps
) -> Array:
    """Each pixel's neighbours combined, [H, W]; `outside` is the value around the sensor."""
    height, width = values.shape
    padded = ops.from_numpy(np.full((height + 2 * REACH, width + 2 * REACH), outside))
    padded[REACH:-REACH, REACH:-REACH] = values
    shifts = range(2 * REACH + 1)
    rows = functools.reduce(combine, [padded[shift : shift + height] for shift in shifts])
    return functools.reduce(combine, [rows[:, shift : shift + width] for shift in shifts])

"""Time surfaces, timestamp images and DiST: the last event of each pixel, and its rank."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Literal, get_args

import numpy as np

from texvent._registry import suggest
from texvent.config import check_range
from texvent.errors import ConfigError, shown
from texvent.represent.array_ops import (
    Array,
    ArrayOps,
    EventColumns,
    Events,
    columns_of,
    flat_index,
)

Decay = Literal["exponential", "linear"]
MAX_TAU_US = 10**12
"""About 12 days."""


def time_surface(
    events: Events,
    *,
    tau_us: int = 30_000,
    decay: Decay = "exponential",
    at_us: int | None = None,
) -> Array:
    """Recency of the last event per polarity and pixel, as seen at one instant.

    With `age` the time since the last event of that polarity at that pixel, in µs:

        exponential   exp(−age / τ)
        linear        max(0, 1 − age / τ)

    Args:
        events: the slice; events after `at_us` do not count.
        tau_us: decay time τ, µs, 1..10¹².
        decay: how recency fades.
        at_us: the instant, µs; None: the time of the last event.

    Returns:
        [2, H, W] float32, 0 (long ago or never) .. 1 (now); index 0 is OFF, 1 is ON. Their
        maximum over the first axis is the surface that ignores polarity.

    Raises:
        ConfigError: tau_us out of range, or an unknown decay.

    Source: X. Lagorce et al., "HOTS: a hierarchy of event-based time-surfaces for pattern
        recognition", TPAMI 2017, eqs. 1-3. The surface of HOTS around an event is this one, with
        `at_us` that event's time, cut out around it.
    Deviation: tonic's linear surface reaches 0 after 3 τ; this one after τ.

    Example:
        >>> from texvent.events import EventStream
        >>> from texvent.sensor import SensorSize
        >>> events = EventStream([0, 0, 1], [0, 0, 0], [0, 50, 100], [1, 1, 0], SensorSize(2, 1))
        >>> time_surface(events, tau_us=200, decay="linear").tolist()
        [[[0.0, 1.0]], [[0.75, 0.0]]]
    """
    check_range("tau_us", tau_us, 1, MAX_TAU_US)
    if decay not in get_args(Decay):
        raise ConfigError(f"unknown decay {shown(decay)}; {suggest(decay, get_args(Decay))}")
    columns = columns_of(events)
    ops, (height, width) = columns.ops, columns.size.shape
    instant = at_us if at_us is not None else int(columns.t[-1]) if len(columns) else 0
    # Ages instead of times: −1 can then stand for "never", and nothing else is negative.
    first = int(columns.t[0]) if len(columns) else instant
    since = ops.xp.where(columns.t <= instant, columns.t - first, -1)
    index = flat_index((columns.p, 2), *columns.pixel_axes)
    latest = ops.latest_at(index, since, 2 * height * width, -1).reshape(2, height, width)
    age = ops.cast(instant - first - latest, "float64") / tau_us
    recency = ops.xp.exp(-age) if decay == "exponential" else ops.xp.clip(1 - age, 0, 1)
    return ops.cast(ops.xp.where(latest >= 0, recency, recency * 0.0), "float32")


NEVER = -1


def timestamp_image(events: Events) -> Array:
    """Time of the last event per polarity and pixel, as a share of the slice.

    Args:
        events: the slice.

    Returns:
        [2, H, W] float32; index 0 is ON, 1 is OFF. (t − t₁) / (t_N − t₁), so 1 at the last event;
        0 at the first, where no event fell, and where all events have one time.

    Source: P. K. J. Park et al., "Performance improvement of deep learning based gesture
        recognition using spatiotemporal demosaicing technique", ICIP 2016, as J. Kim et al.,
        "N-ImageNet", ICCV 2021, and its program (`reshape_then_acc_time_pol`) define it.
    Deviation: the program divides by zero where all events have one time.

    Example:
        >>> from texvent.events import EventStream
        >>> from texvent.sensor import SensorSize
        >>> events = EventStream([0, 1, 0], [0, 0, 0], [10, 15, 20], [1, 0, 1], SensorSize(2, 1))
        >>> timestamp_image(events).tolist()
        [[[1.0, 0.0]], [[0.0, 0.5]]]
    """
    columns = columns_of(events)
    return columns.ops.cast(_shares(columns), "float32")


def event_image(events: Events) -> Array:
    """Counts and times of the last event, per polarity.

    Args:
        events: the slice.

    Returns:
        [4, H, W] float32: ON events as a share of the pixel with most, their `timestamp_image`,
        and both of OFF events.

    Source: A. Z. Zhu et al., "EV-FlowNet", RSS 2018, with counts divided by the largest as in
        N-ImageNet's program (`reshape_then_acc`; its `reshape_then_acc_count` leaves them whole).
    """
    columns = columns_of(events)
    ops, shares = columns.ops, _shares(columns)
    counts = ops.cast(columns.count((1 - columns.p, 2), *columns.pixel_axes), "float64")
    layers = []
    for lane in range(2):
        layers += [counts[lane] / max(float(counts[lane].max()), 1.0), shares[lane]]
    return ops.cast(ops.xp.stack(layers), "float32")


def sorted_time_surface(events: Events) -> Array:
    """Rank of the last event per polarity and pixel: later events are brighter.

    Last events of one time share a rank. Ranks of each polarity are scaled to 0 (the first of
    them, and where no event fell) to 1 (the last of them).

    Args:
        events: the slice.

    Returns:
        [2, H, W] float32; index 0 is ON, 1 is OFF.

    Source: I. Alzugaray, M. Chli, "ACE: an efficient asynchronous corner tracker for event
        cameras", 3DV 2018, with the ranks of N-ImageNet's program (`reshape_then_acc_sort`
        with strict ranks and without its binary image).

    Example:
        >>> from texvent.events import EventStream
        >>> from texvent.sensor import SensorSize
        >>> events = EventStream([0, 1, 2], [0, 0, 0], [10, 11, 900], [1, 1, 1], SensorSize(3, 1))
        >>> sorted_time_surface(events).tolist()
        [[[0.0, 0.5, 1.0]], [[0.0, 0.0, 0.0]]]
    """
    columns = columns_of(events)
    ops, latest = columns.ops, latest_events(columns)
    ranks = ops.cast(latest * 0, "float64")
    for lane in range(2):
        is_there = latest[lane] != NEVER
        times, rank = ops.xp.unique(latest[lane][is_there], return_inverse=True)
        ranks[lane][is_there] = ops.cast(rank, "float64") / max(len(times) - 1, 1)
    return ops.cast(ranks, "float32")


def latest_events(columns: EventColumns) -> Array:
    """Time of the last event since the first of the slice, µs, [2, H, W] int64, ON first.

    `NEVER` where there is none.
    """
    height, width = columns.size.shape
    index = flat_index((1 - columns.p, 2), *columns.pixel_axes)
    since = columns.t - columns.t[:1]
    latest = columns.ops.latest_at(index, since, 2 * height * width, NEVER)
    return latest.reshape(2, height, width)


def _shares(columns: EventColumns) -> Array:
    """`timestamp_image` in float64."""
    span = max(int(columns.t[-1] - columns.t[0]), 1) if len(columns) else 1
    latest = columns.ops.xp.clip(latest_events(columns), 0, None)
    return columns.ops.cast(latest, "float64") / span


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

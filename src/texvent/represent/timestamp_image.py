"""Images of the last event per pixel: timestamp image, event image, sorted time surface.

All have ON before OFF, as N-ImageNet's program, which is the source of what the papers leave open.
"""

from __future__ import annotations

from texvent.represent.array_ops import Array, EventColumns, Events, columns_of, flat_index

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
    """Rank of the last event per polarity and pixel: what came later is brighter.

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

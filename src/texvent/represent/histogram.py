"""Histograms of events over pixels and time."""

from __future__ import annotations

from texvent.config import check_range
from texvent.errors import InputError
from texvent.represent.array_ops import Array, Axis, EventColumns, Events, columns_of
from texvent.represent.voxel_grid import MAX_BINS


def histogram_2d(events: Events, *, shape: tuple[int, int] | None = None) -> Array:
    """Events per polarity and cell of the sensor; time does not matter.

    Args:
        events: the slice.
        shape: rows and columns of equal cells, each at most the sensor's; None: one per pixel.

    Returns:
        [2, rows, columns] float32, events; index 0 is OFF, 1 is ON.

    Raises:
        ConfigError: more cells than pixels, or none.

    Source: A. I. Maqueda et al., "Event-based vision meets deep learning on steering prediction
        for self-driving cars", CVPR 2018: one histogram of positive, one of negative events.

    Example:
        >>> from texvent.events import EventStream
        >>> from texvent.sensor import SensorSize
        >>> events = EventStream([0, 1, 3], [0, 0, 0], [1, 2, 3], [1, 1, 0], SensorSize(4, 1))
        >>> histogram_2d(events, shape=(1, 2)).tolist()
        [[[0.0, 1.0]], [[2.0, 0.0]]]
    """
    columns = columns_of(events)
    counts = columns.count((columns.p, 2), *_cell_axes(columns, shape))
    return columns.ops.cast(counts, "float32")


def histogram_3d(
    events: Events,
    *,
    bins: int = 9,
    start_us: int | None = None,
    stop_us: int | None = None,
    shape: tuple[int, int] | None = None,
) -> Array:
    """Events per polarity, equal bin of time and cell of the sensor.

    Bins are those of the window, wherever in it the events are. `stacked_histogram` instead scales
    its bins to the first and last event.

    Args:
        events: the slice; events outside the window do not count.
        bins: time bins, 1..4096.
        start_us: start of the window, µs, included; None: the first event.
        stop_us: end of the window, µs, excluded; None: 1 µs after the last event.
        shape: rows and columns of equal cells, each at most the sensor's; None: one per pixel.

    Returns:
        [2, bins, rows, columns] float32, events; index 0 is OFF, 1 is ON.

    Raises:
        ConfigError: bins out of range, more cells than pixels, or none.
        InputError: the window ends before it begins.

    Source: the event spike tensor with a counting kernel: D. Gehrig et al., "End-to-end learning
        of representations for asynchronous event-based data", ICCV 2019.
    """
    check_range("bins", bins, 1, MAX_BINS)
    columns = columns_of(events)
    ops = columns.ops
    first, last = (int(columns.t[0]), int(columns.t[-1])) if len(columns) else (0, 0)
    start = first if start_us is None else start_us
    stop = max(last + 1, start + 1) if stop_us is None else stop_us
    if stop <= start:
        raise InputError(f"the window ends at {stop} µs; it must end after it starts ({start} µs)")
    # Events outside the window go into a bin of their own, which is cut off.
    is_inside = (columns.t >= start) & (columns.t < stop)
    since = ops.xp.where(is_inside, columns.t, start) - start
    time_bin = ops.xp.where(is_inside, since * bins // (stop - start), bins)
    axes: tuple[Axis, ...] = ((columns.p, 2), (time_bin, bins + 1), *_cell_axes(columns, shape))
    return ops.cast(columns.count(*axes)[:, :bins], "float32")


def _cell_axes(columns: EventColumns, shape: tuple[int, int] | None) -> tuple[Axis, Axis]:
    """Row and column of each event's cell."""
    height, width = columns.size.shape
    rows, cells = shape if shape is not None else (height, width)
    check_range("rows", rows, 1, height)
    check_range("columns", cells, 1, width)
    return ((columns.y * rows // height, rows), (columns.x * cells // width, cells))


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
        exact; the code divides in float32, which can move an event on an edge.
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

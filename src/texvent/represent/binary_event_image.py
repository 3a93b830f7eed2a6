"""Binary event image: where events fell, the input of N-ImageNet's robust classifiers."""

from __future__ import annotations

from texvent.represent.array_ops import Array, Events, columns_of
from texvent.sensor import checked_size


def binary_event_image(events: Events, *, size: tuple[int, int] | None = None) -> Array:
    """1 where at least one event of a polarity fell, else 0.

    Args:
        events: the slice; N-ImageNet takes 30,000 events.
        size: (width, height) of the image, to which coordinates are scaled; N-ImageNet takes
            (224, 224). None: the sensor's.

    Returns:
        [2, H, W] float32; index 0 is ON, 1 is OFF: the order of N-ImageNet, not that of p.

    Raises:
        ConfigError: a side outside 1..65535.

    Source: J. Kim et al., "N-ImageNet: towards robust, fine-grained object recognition with event
        cameras", ICCV 2021, and its program, `reshape_event_no_sample` and `reshape_then_flat_pol`.
    Deviation: coordinates are scaled in whole numbers and rounded down exactly; the program
        multiplies by a float64 ratio, which can fall just below a whole number.

    Example:
        >>> from texvent.events import EventStream
        >>> from texvent.sensor import SensorSize
        >>> events = EventStream([0, 0, 3], [0, 0, 0], [1, 2, 3], [1, 1, 0], SensorSize(4, 1))
        >>> binary_event_image(events, size=(2, 1)).tolist()
        [[[1.0, 0.0]], [[0.0, 1.0]]]
    """
    columns = columns_of(events)
    width, height = columns.size if size is None else checked_size(*size)
    row = columns.y * height // columns.size.height
    column = columns.x * width // columns.size.width
    counts = columns.count((1 - columns.p, 2), (row, height), (column, width))
    return columns.ops.cast(counts > 0, "float32")

"""Event frames: counts, binary images and polarity per pixel."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.errors import ConfigError, shown
from texvent.events import EventStream
from texvent.represent.array_ops import Array, Events, columns_of
from texvent.sensor import checked_size

EventFrameKind = Literal["signed", "binary", "count", "polarity"]


def event_frame(events: Events, kind: EventFrameKind = "signed") -> Array:
    """Events as a dense array over the sensor; their times inside the slice do not matter.

    Args:
        events: the slice to show; cut it with `events.between(start_us, stop_us)`.
        kind: value of each pixel.

            * `"signed"`: sum of polarities Σ±1, [H, W] int32, 0 without events.
            * `"binary"`: 1 where at least one event fell, [H, W] uint8.
            * `"count"`: number of OFF events and of ON events, [2, H, W] int32 (index = p).
            * `"polarity"`: (sign(Σ±1) + 1) / 2, [H, W] float32: 0 OFF, 0.5 background or as
              many ON as OFF, 1 ON. The frame that EF-SSIM and EF-MSE compare.

    Returns:
        A new array; `events` is not changed.

    Raises:
        ConfigError: unknown kind.

    Example:
        >>> from texvent.sensor import SensorSize
        >>> events = EventStream([0, 0, 1], [0, 0, 0], [1, 2, 3], [1, 1, 0], SensorSize(3, 1))
        >>> event_frame(events).tolist()
        [[2, -1, 0]]
        >>> event_frame(events, "polarity").tolist()
        [[1.0, 0.0, 0.5]]
    """
    if kind not in get_args(EventFrameKind):
        raise ConfigError(
            f"unknown event frame {shown(kind)}; {suggest(kind, get_args(EventFrameKind))}"
        )
    columns = columns_of(events)
    counts, ops = columns.count((columns.p, 2), *columns.pixel_axes), columns.ops
    if kind == "count":
        return ops.cast(counts, "int32")
    if kind == "binary":
        return ops.cast(counts.sum(0) > 0, "uint8")
    signed = counts[1] - counts[0]
    if kind == "signed":
        return ops.cast(signed, "int32")
    return ops.cast((ops.xp.sign(signed) + 1) / 2, "float32")


def count_events(events: EventStream) -> NDArray[np.int32]:
    """Number of events per polarity and pixel, [2, H, W] int32; index 0 is OFF, 1 is ON."""
    return np.asarray(event_frame(events, "count"))


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

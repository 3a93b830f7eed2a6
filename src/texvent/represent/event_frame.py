"""Event frame: all events of a slice in one picture, one value per pixel."""

from __future__ import annotations

from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.errors import ConfigError
from texvent.events import EventStream

EventFrameKind = Literal["signed", "binary", "count", "polarity"]


def event_frame(events: EventStream, kind: EventFrameKind = "signed") -> NDArray[Any]:
    """Events as a dense array over the sensor; their times inside the slice do not matter.

    Args:
        events: the slice to show; cut it with `events.between(start_us, stop_us)`.
        kind: what each pixel holds.

            * `"signed"`: sum of polarities Σ±1, [H, W] int32, 0 without events.
            * `"binary"`: 1 where at least one event fell, [H, W] uint8 (N-ImageNet).
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
            f"unknown event frame {kind!r}; {suggest(kind, get_args(EventFrameKind))}"
        )
    counts = count_events(events)
    if kind == "count":
        return counts
    if kind == "binary":
        return np.asarray(counts.any(axis=0), dtype=np.uint8)
    signed = np.asarray(counts[1] - counts[0])
    if kind == "signed":
        return signed
    return np.asarray((np.sign(signed) + 1) / 2, dtype=np.float32)


def count_events(events: EventStream) -> NDArray[np.int32]:
    """Number of events per polarity and pixel, [2, H, W] int32; index 0 is OFF, 1 is ON."""
    width, height = events.size
    flat = (events.p.astype(np.int64) * height + events.y) * width + events.x
    counts = np.bincount(flat, minlength=2 * height * width)
    return counts.reshape(2, height, width).astype(np.int32)

"""Time surfaces and timestamp images: the last event of each pixel."""

from __future__ import annotations

from typing import Literal, get_args

from texvent._registry import suggest
from texvent.config import check_range
from texvent.errors import ConfigError, shown
from texvent.represent.array_ops import (
    Array,
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
    # An instant long before the first event would make the exponential of "never" infinite.
    age = ops.cast(ops.xp.where(latest >= 0, instant - first - latest, 0), "float64") / tau_us
    recency = ops.xp.exp(-age) if decay == "exponential" else ops.xp.clip(1 - age, 0, 1)
    return ops.cast(ops.xp.where(latest >= 0, recency, recency * 0.0), "float32")


def timestamp_image(events: Events) -> Array:
    """Time of the last event per polarity and pixel, as a share of the slice.

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
    ops, (height, width) = columns.ops, columns.size.shape
    index = flat_index((1 - columns.p, 2), *columns.pixel_axes)
    latest = ops.latest_at(index, columns.t - columns.t[:1], 2 * height * width, 0)
    span = max(int(columns.t[-1] - columns.t[0]), 1) if len(columns) else 1
    return ops.cast(ops.cast(latest.reshape(2, height, width), "float64") / span, "float32")

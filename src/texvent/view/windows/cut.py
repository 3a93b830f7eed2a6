"""Events cut into windows: by time, by count, or fading."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent.view.windows.event_window import EventWindow

NEVER = np.iinfo(np.int64).min // 2
"""Time of the last event where there was none; half, so that ages do not overflow."""
BUSIEST_WINDOWS = 50
"""A recording is cut into this many windows to find the busiest one ..."""
LONGEST_STILL_US = 40_000
"""... but none is longer than this, so that moving edges stay sharp."""


def cut_windows(
    packets: Iterable[EventStream], *, size: SensorSize, step_us: Fraction, window_us: int
) -> Iterator[EventWindow]:
    """Windows `[s, s + window_us)` for s = first event, + step, + 2 steps, ...

    Memory holds the events of one window and one packet. Step times are rounded to whole µs,
    never accumulated.

    Args:
        packets: events in time order.
        size: sensor size, pixels.
        step_us: from one window's start to the next, µs; may be shorter than the window
            (windows overlap) or a fraction.
        window_us: length of each window, µs.

    Raises:
        ConfigError: step or window is not above 0.
    """
    for start_us, part in cut_streams(packets, size, step_us, window_us):
        yield EventWindow(start_us, start_us + window_us, count_events(part))


def cut_fading(
    packets: Iterable[EventStream], *, size: SensorSize, step_us: Fraction, tau_us: int
) -> Iterator[EventWindow]:
    """One window per step with the exponential time surface at its end.

    As `texvent.represent.time_surface`: exp(−age / τ) of the last event of each polarity at each
    pixel. Memory holds one time per pixel and polarity besides the events of one step.

    Args:
        packets: events in time order.
        size: sensor size, pixels.
        step_us: from one image to the next, µs.
        tau_us: decay time τ, µs.

    Raises:
        ConfigError: the step is not above 0.
    """
    latest = np.full((2, *size.shape), NEVER, dtype=np.int64)
    # Rounded up, so that no event falls between two steps.
    window_us = max(1, -int(-step_us // 1))
    for start_us, part in cut_streams(packets, size, step_us, window_us):
        stop_us = start_us + window_us
        np.maximum.at(latest, (part.p, part.y, part.x), part.t)
        fading = _strength(latest, stop_us, tau_us)
        yield EventWindow(start_us, stop_us, count_events(part), fading=fading)


def with_fading(
    window: EventWindow, packets: Iterable[EventStream], *, size: SensorSize, tau_us: int
) -> EventWindow:
    """A window with the exponential time surface at its end, as `cut_fading` gives it."""
    latest = np.full((2, *size.shape), NEVER, dtype=np.int64)
    for packet in packets:
        part = packet[: int(np.searchsorted(packet.t, window.stop_us))]
        np.maximum.at(latest, (part.p, part.y, part.x), part.t)
        if len(part) < len(packet):
            break
    return replace(window, fading=_strength(latest, window.stop_us, tau_us))


def _strength(latest: NDArray[np.int64], stop_us: int, tau_us: int) -> NDArray[np.float32]:
    """exp(−age / τ) of the last events, 0 where there was none."""
    age = (stop_us - 1 - latest).astype(np.float32) / tau_us
    return np.where(latest == NEVER, np.float32(0), np.exp(-age))


def cut_counts(
    packets: Iterable[EventStream], *, size: SensorSize, count: int
) -> Iterator[EventWindow]:
    """Windows of `count` events each, however long they take; the last may have fewer.

    Args:
        packets: events in time order.
        size: sensor size, pixels.
        count: events per window.
    """
    held = EventStream.empty(size)
    for packet in packets:
        held = EventStream.concat([held, packet])
        # A window lasts until the event after it, so one more must be known.
        while len(held) > count:
            part, held = held[:count], held[count:]
            stop_us = max(int(held.t[0]), int(part.t[0]) + 1)
            yield EventWindow(int(part.t[0]), stop_us, count_events(part))
    if len(held):
        yield EventWindow(int(held.t[0]), int(held.t[-1]) + 1, count_events(held))


def cut_streams(
    packets: Iterable[EventStream], size: SensorSize, step_us: Fraction, window_us: int
) -> Iterator[tuple[int, EventStream]]:
    """Start and events of every window of `cut_windows`; arguments and errors as there."""
    if step_us <= 0 or window_us <= 0:
        raise ConfigError(
            f"window {window_us} µs, step {float(step_us):g} µs; both must be above 0"
        )
    held = EventStream.empty(size)
    first_us: int | None = None
    index = 0
    for packet in packets:
        if len(packet) == 0:
            continue
        first_us = int(packet.t[0]) if first_us is None else first_us
        held = EventStream.concat([held, packet])
        # A window is complete once an event at or after its end is known.
        while (start_us := first_us + round(index * step_us)) + window_us <= int(held.t[-1]):
            yield start_us, held.cut(start_us, start_us + window_us)
            index += 1
        held = held[int(np.searchsorted(held.t, start_us)) :]
    while first_us is not None and len(held):
        start_us = first_us + round(index * step_us)
        held = held[int(np.searchsorted(held.t, start_us)) :]
        if len(held):
            yield start_us, held.cut(start_us, start_us + window_us)
        index += 1


def time_range(packets: EventPackets) -> tuple[int, int] | None:
    """Half-open range of the event times, µs, from one pass; None without events."""
    first: int | None = None
    stop = 0
    for packet in packets:
        if len(packet):
            first = int(packet.t[0]) if first is None else first
            stop = int(packet.t[-1]) + 1
    return None if first is None else (first, stop)


def still_window_us(extent: tuple[int, int]) -> int:
    """A window short enough that moving edges stay sharp, µs."""
    return max(1, min(LONGEST_STILL_US, (extent[1] - extent[0]) // BUSIEST_WINDOWS))

"""Events alone, cut into windows of time: for recordings without a video."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction

import numpy as np

from texvent.errors import ConfigError
from texvent.events import EventPackets, EventStream
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent.view.interval import Interval
from texvent.view.palettes import DEFAULT_PALETTE, Palette
from texvent.view.still import StillPicker

LIVELIEST_WINDOWS = 50
"""A recording is cut into this many windows to find the liveliest one ..."""
LONGEST_STILL_US = 40_000
"""... but none is longer than this, so that moving edges stay sharp."""


def cut_windows(
    packets: Iterable[EventStream], *, size: SensorSize, step_us: Fraction, window_us: int
) -> Iterator[Interval]:
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
            yield _interval(held, start_us, window_us)
            index += 1
        held = held[int(np.searchsorted(held.t, start_us)) :]
    while first_us is not None and len(held):
        start_us = first_us + round(index * step_us)
        held = held[int(np.searchsorted(held.t, start_us)) :]
        if len(held):
            yield _interval(held, start_us, window_us)
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


def liveliest_window_png(
    events: EventStream,
    *,
    window_us: int | None = None,
    palette: str | Palette = DEFAULT_PALETTE,
    title: str = "",
) -> bytes | None:
    """A PNG of the window with the most events, or None without events."""
    extent = events.time_range
    if extent is None:
        return None
    length_us = window_us or still_window_us(extent)
    picker = StillPicker(size=events.size, palette=palette, side_by_side=False, title=title)
    for interval in cut_windows(
        (events,), size=events.size, step_us=Fraction(length_us), window_us=length_us
    ):
        picker.consider(interval)
    return picker.png()


def still_window_us(extent: tuple[int, int]) -> int:
    """A window short enough that moving edges stay sharp, µs."""
    return max(1, min(LONGEST_STILL_US, (extent[1] - extent[0]) // LIVELIEST_WINDOWS))


def _interval(held: EventStream, start_us: int, window_us: int) -> Interval:
    stop_us = start_us + window_us
    return Interval(start_us, stop_us, count_events(held.between(start_us, stop_us)))

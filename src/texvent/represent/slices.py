"""Slices of recordings by time or count, in memory and packet by packet."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import Any

from texvent.errors import ConfigError, InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.represent.array_ops import Array
from texvent.represent.named import load_representation, represent, represent_window
from texvent.sensor import SensorSize


def slices(
    events: EventStream,
    *,
    duration_us: int | None = None,
    count: int | None = None,
    overlap: int = 0,
    start_us: int | None = None,
    keep_partial: bool = True,
) -> Iterator[EventStream]:
    """Slices in time order, to be turned into representations one by one.

    Args:
        events: the recording.
        duration_us: length of a slice, µs; slices are half-open, and may be empty.
        count: events per slice. Give either this or `duration_us`.
        overlap: length shared with the slice before, in µs or in events; less than a slice.
        start_us: start of the first slice of fixed time, µs; default: the first event.
        keep_partial: also give a last slice that ends after the last event, or has fewer than
            `count` events.

    Returns:
        An iterator; nothing is copied. No slice where there are no events.

    Raises:
        ConfigError: both or none of `duration_us` and `count`, a value out of range, or
            `start_us` with `count`.

    Example:
        >>> from texvent.sensor import SensorSize
        >>> events = EventStream([0, 0, 0], [0, 0, 0], [5, 12, 31], [1, 1, 1], SensorSize(1, 1))
        >>> [part.t.tolist() for part in slices(events, duration_us=10)]
        [[5, 12], [], [31]]
        >>> [part.t.tolist() for part in slices(events, count=2, overlap=1)]
        [[5, 12], [12, 31]]
    """
    if (duration_us is None) == (count is None):
        raise ConfigError("give either duration_us or count: the length of a slice")
    if count is not None:
        if start_us is not None:
            raise ConfigError("start_us belongs to slices of fixed time; leave it out with count")
        stride = _stride("count", count, overlap)
        return _by_count(events, count, stride, keep_partial)
    length = int(duration_us or 0)
    stride = _stride("duration_us", length, overlap)
    return _by_time(events, length, stride, start_us, keep_partial)


def _stride(name: str, length: int, overlap: int) -> int:
    if length < 1:
        raise ConfigError(f"{name} is {length}; it must be at least 1")
    if not 0 <= overlap < length:
        raise ConfigError(f"overlap is {overlap}; it must be 0..{length - 1}, less than {name}")
    return length - overlap


def _by_count(
    events: EventStream, count: int, stride: int, keep_partial: bool
) -> Iterator[EventStream]:
    for first in range(0, len(events), stride):
        part = events[first : first + count]
        if len(part) == count or keep_partial:
            yield part
        if first + count >= len(events):
            return


def _by_time(
    events: EventStream, length: int, stride: int, start_us: int | None, keep_partial: bool
) -> Iterator[EventStream]:
    if not len(events):
        return
    start = int(events.t[0]) if start_us is None else start_us
    last = int(events.t[-1])
    while start <= last:
        if start + length <= last + 1 or keep_partial:
            yield events.cut(start, start + length)
        if start + length > last:
            return
        start += stride


END_OF_TIME_US = 2**62


def slice_between(
    packets: Iterable[EventStream], times_us: Iterable[int], *, size: SensorSize
) -> Iterator[tuple[int, EventStream]]:
    """Each instant but the first, with the events since the one before it, `[before, instant)`.

    Memory holds the events of one slice and one packet.

    Args:
        packets: events in time order.
        times_us: instants, µs, strictly increasing.
        size: sensor size, pixels.

    Yields:
        (instant, its events), also for instants after the last event.

    Raises:
        InputError: the instants do not increase.

    Example:
        >>> one = EventStream([0, 0, 0], [0, 0, 0], [5, 12, 31], [1, 1, 1], SensorSize(1, 1))
        >>> slices = slice_between([one], [10, 20, 30], size=SensorSize(1, 1))
        >>> [(t_us, events.t.tolist()) for t_us, events in slices]
        [(20, [12]), (30, [])]
    """
    source = iter(packets)
    held = EventStream.empty(size)
    before: int | None = None
    for t_us in times_us:
        if before is None:
            before = t_us
            continue
        if t_us <= before:
            raise InputError(f"instants must increase; {t_us} µs comes after {before} µs")
        parts = [held]
        while not len(parts[-1]) or int(parts[-1].t[-1]) < t_us:
            packet = next(source, None)
            if packet is None:
                break
            if len(packet) and int(packet.t[-1]) >= before:
                parts.append(packet)
        held = EventStream.concat(parts)
        yield t_us, held.cut(before, t_us)
        held = held.cut(t_us, END_OF_TIME_US)
        before = t_us


def slice_regularly(
    packets: Iterable[EventStream], *, step_us: Fraction
) -> Iterator[tuple[int, EventStream]]:
    """Slices of equal length from the first event to the last: (end in µs, events).

    Ends are rounded to whole µs, never accumulated. No slice where there are no events.

    Args:
        packets: events in time order.
        step_us: length of a slice, µs; may be a fraction.

    Raises:
        ConfigError: the length is below 1 µs.
    """
    if step_us < 1:
        raise ConfigError(f"a slice of {float(step_us):g} µs is too short; it must be at least 1")
    for _, stop_us, part in slice_windows(packets, step_us=step_us):
        yield stop_us, part


def slice_windows(
    packets: Iterable[EventStream],
    *,
    step_us: Fraction,
    window_us: int | None = None,
) -> Iterator[tuple[int, int, EventStream]]:
    """Windows from the first event to the last: (start in µs, stop in µs, events).

    Starts are rounded to whole µs, never accumulated. Memory holds the events of one window and
    one packet. No window where there are no events.

    Args:
        packets: events in time order.
        step_us: from one window's start to the next, µs, above 0; may be a fraction.
        window_us: length of a window, µs: windows may overlap or leave gaps; None: up to the next.
    """
    source = (packet for packet in packets if len(packet))
    first = next(source, None)
    if first is None:
        return
    first_us, index = int(first.t[0]), 0

    def bounds(index: int) -> tuple[int, int]:
        start_us, following_us = (first_us + round(one * step_us) for one in (index, index + 1))
        return start_us, following_us if window_us is None else start_us + window_us

    start_us, stop_us = bounds(0)
    parts: list[EventStream] = []
    for packet in itertools.chain([first], source):
        parts.append(packet)
        # A window is complete once an event at or after its end is known.
        if stop_us > int(packet.t[-1]):
            continue
        held = EventStream.concat(parts)
        while stop_us <= int(held.t[-1]):
            yield start_us, stop_us, held.cut(start_us, stop_us)
            index += 1
            start_us, stop_us = bounds(index)
        parts = [held.cut(start_us, END_OF_TIME_US)]
    held = EventStream.concat(parts)
    while len(held := held.cut(start_us, END_OF_TIME_US)):
        yield start_us, stop_us, held.cut(start_us, stop_us)
        index += 1
        start_us, stop_us = bounds(index)


def slice_by_count(
    packets: Iterable[EventStream], *, count: int, size: SensorSize
) -> Iterator[tuple[int, EventStream]]:
    """Slices of `count` events: (end in µs, events); the last may have fewer.

    A slice ends at its last event, or 1 µs after the slice before it if that is later.

    Args:
        packets: events in time order.
        count: events per slice.
        size: sensor size, pixels.

    Raises:
        ConfigError: the count is below 1.
    """
    if count < 1:
        raise ConfigError(f"a slice of {count} events is empty; it must have at least 1")
    end_us = -END_OF_TIME_US
    for part in _counted(packets, count, size):
        end_us = max(int(part.t[-1]), end_us + 1)
        yield end_us, part


def represent_slices(
    name: str,
    events: EventPackets,
    *,
    duration_us: int | None = None,
    count: int | None = None,
    device: str | None = None,
    **options: Any,
) -> Iterator[Array]:
    """A dense array for every slice of a recording; see `EventPackets.represent`."""
    if (duration_us is None) == (count is None):
        raise ConfigError(
            "give either duration_us or count, the length of a slice; for one array of the whole "
            "recording, collect() the packets first"
        )
    load_representation(name, options)  # refused here, not when the first array is asked for
    if count is not None:
        slices = slice_by_count(events, count=count, size=events.size)
        return (represent(name, part, device=device, **options) for _, part in slices)
    length = int(duration_us or 0)
    timed = slice_regularly(events, step_us=Fraction(length))
    return (
        represent_window(name, part, (end - length, end), device=device, **options)
        for end, part in timed
    )


def _counted(packets: Iterable[EventStream], count: int, size: SensorSize) -> Iterator[EventStream]:
    held = EventStream.empty(size)
    for packet in packets:
        held = EventStream.concat([held, packet])
        while len(held) >= count:
            part, held = held[:count], held[count:]
            yield part
    if len(held):
        yield held

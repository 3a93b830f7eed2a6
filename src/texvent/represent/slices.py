"""Cut a stream into slices of fixed time or of a fixed number of events."""

from __future__ import annotations

from collections.abc import Iterator

from texvent.errors import ConfigError
from texvent.events import EventStream


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
        overlap: what a slice shares with the one before, in µs or in events; less than a slice.
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
        is_partial = start + length > last + 1
        if not is_partial or keep_partial:
            yield events.cut(start, start + length)
        if is_partial:
            return
        start += stride

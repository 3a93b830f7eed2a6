"""Events cut at given instants, such as the times of frames, with flat memory."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize

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
        yield t_us, held.between(before, t_us)
        held = held.between(t_us, END_OF_TIME_US)
        before = t_us

"""Parts of the time, and other origins of it."""

from __future__ import annotations

from functools import partial

from texvent.errors import InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.time_range import SeenTimes, describe_outside
from texvent.transform.packets import Recording, map_packets, note_edit, packets_of
from texvent.video import MICROSECONDS


def keep_time(events: EventPackets, start_us: int, stop_us: int) -> EventPackets:
    """The events with `start_us <= t < stop_us`; what comes later is not even read.

    Raises:
        InputError: the stop is not after the start, or the recording lies elsewhere (found while
            reading, where the format does not tell its times before).
    """
    if not start_us < stop_us:
        raise InputError(
            f"the time from {start_us / MICROSECONDS:g} to {stop_us / MICROSECONDS:g} s is empty; "
            "the stop must be after the start"
        )
    return events.cut(start_us, stop_us, partial(_refuse_outside, start_us, stop_us))


def _refuse_outside(start_us: int, stop_us: int, seen: SeenTimes) -> None:
    problem = describe_outside(start_us, stop_us, seen, "s")
    if problem is not None:
        raise InputError(problem)


def start_at_zero(events: Recording) -> Recording:
    """The same events with times counted from the first one; it is looked up at once."""
    first_us = next((int(packet.t[0]) for packet in packets_of(events) if len(packet)), 0)

    def shift(packet: EventStream) -> EventStream:
        columns = {**packet.columns(), "t": packet.t - first_us}
        return EventStream(**columns, size=packet.size, metadata=packet.metadata)

    return note_edit(map_packets(events, shift), events, from_zero=True)

"""Polarity exchanged, and time that runs backwards."""

from __future__ import annotations

import numpy as np

from texvent.events import EventStream
from texvent.transform.packets import Recording, check_stream, map_packets, note_edit


def flip_polarity(events: Recording) -> Recording:
    """ON events as OFF ones and the other way round."""

    def exchange(packet: EventStream) -> EventStream:
        columns = {**packet.columns(), "p": np.uint8(1) - packet.p}
        return EventStream(**columns, size=packet.size, metadata=packet.metadata)

    return note_edit(map_packets(events, exchange), events, flip_polarity=True)


def reverse_time(events: EventStream) -> EventStream:
    """The events of the same scene played backwards, between the same first and last time.

    An event of time t moves to `first + last - t`, and its polarity is inverted: what becomes
    brighter becomes darker when it is played backwards. Events of one µs come in reverse order, so
    two reversals give back what was there.

    Deviation from what a camera would see: an event marks the end of a change by one contrast
    threshold. Played backwards, the same change ends where it began, so a camera's event comes
    later, by up to the time between two events; noise, refractory period and unequal thresholds are
    not reversed.

    Raises:
        InputError: packets, or anything else.
    """
    check_stream(events, "reverse_time")
    if not len(events):
        return note_edit(events, events, reverse_time=True)
    columns = {name: column[::-1] for name, column in events.columns().items()}
    columns["t"] = events.t[0] + (events.t[-1] - columns["t"])
    columns["p"] = np.uint8(1) - columns["p"]
    reverse = EventStream(**columns, size=events.size, metadata=events.metadata)
    return note_edit(reverse, events, reverse_time=True)

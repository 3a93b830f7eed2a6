"""Recordings made of other recordings: a whole stream at once, or packet by packet."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.event_methods import with_edit
from texvent.event_packets import EventPackets, LazyPackets
from texvent.events import EventStream
from texvent.sensor import SensorSize

Recording = TypeVar("Recording", EventStream, EventPackets)
"""Events in memory, or packet by packet."""


def packets_of(events: EventStream | EventPackets) -> Iterable[EventStream]:
    """The packets of a recording; a stream is one."""
    return (events,) if isinstance(events, EventStream) else events


def check_stream(events: object, what: str) -> None:
    """Refuse all but a stream where a change needs all events at once.

    Raises:
        InputError: `events` is something else.
    """
    if not isinstance(events, EventStream):
        raise InputError(
            f"{what} takes an EventStream, not {type(events).__name__}; of packets call .collect()"
        )


def map_packets(
    events: Recording,
    change: Callable[[EventStream], EventStream],
    *,
    size: SensorSize | None = None,
) -> Recording:
    """Every packet changed by a function; a stream is one packet."""
    return map_in_order(events, lambda: change, size=size)


def map_in_order(
    events: Recording,
    start: Callable[[], Callable[[EventStream], EventStream]],
    *,
    size: SensorSize | None = None,
) -> Recording:
    """As `map_packets`, by functions that remember earlier packets: `start` makes one per pass."""
    if isinstance(events, EventStream):
        return start()(events)

    def changed() -> Iterator[EventStream]:
        change = start()
        return (change(packet) for packet in events)

    return EventPackets(LazyPackets(changed), size or events.size, events.metadata)


def move_events(
    packet: EventStream,
    x: NDArray[np.integer[Any]],
    y: NDArray[np.integer[Any]],
    size: SensorSize,
) -> EventStream:
    """The events of a packet at other places, those outside the new sensor left out."""
    inside = (x >= 0) & (x < size.width) & (y >= 0) & (y < size.height)
    columns = {**packet.columns(), "x": x, "y": y}
    if not inside.all():
        columns = {name: column[inside] for name, column in columns.items()}
    return EventStream(**columns, size=size, metadata=packet.metadata)


def note_edit(changed: Recording, given: EventStream | EventPackets, **edit: Any) -> Recording:
    """A recording with the edits of the one it was made of, and one more entry for this edit.

    What single steps noted in between goes: one call is one entry.
    """
    return add_metadata(changed, {"edits": with_edit(given.metadata, edit)["edits"]})


def add_metadata(events: Recording, facts: Mapping[str, Any]) -> Recording:
    """The same recording with more metadata."""
    metadata = {**events.metadata, **facts}
    if isinstance(events, EventStream):
        return events.with_metadata(metadata)
    return EventPackets(events.packets, events.size, metadata)

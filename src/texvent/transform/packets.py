"""Recordings made of other recordings, packet by packet."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.event_packets import EventPackets, LazyPackets
from texvent.events import EventStream
from texvent.sensor import SensorSize


def map_packets(
    events: EventPackets,
    change: Callable[[EventStream], EventStream],
    *,
    size: SensorSize | None = None,
) -> EventPackets:
    """Every packet changed by a function.

    Args:
        events: the recording.
        change: gives the new packet.
        size: sensor size of the new packets; None: as before.
    """
    lazy = LazyPackets(lambda: (change(packet) for packet in events))
    return EventPackets(lazy, size or events.size, events.metadata)


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


def add_metadata(events: EventPackets, facts: Mapping[str, Any]) -> EventPackets:
    """The same recording with more metadata."""
    return EventPackets(events.packets, events.size, {**events.metadata, **facts})

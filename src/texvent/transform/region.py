"""Parts of the sensor, and other sensor sizes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from texvent.config import check_whole
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize, SizeLike, as_size
from texvent.transform.packets import Recording, map_packets, move_events, note_edit


@dataclass(frozen=True)
class Region:
    """A rectangle of pixels."""

    x: int
    """First column."""
    y: int
    """First row."""
    width: int
    height: int


def crop(events: Recording, region: Region) -> Recording:
    """The events in a region, whose top left pixel becomes (0, 0).

    Raises:
        ConfigError: one of its numbers is not whole.
        InputError: the region is empty or reaches over the sensor's edge.
    """
    for name, value in vars(region).items():
        check_whole(name, value)
    size = events.size
    fits_x = 0 <= region.x < region.x + region.width <= size.width
    fits_y = 0 <= region.y < region.y + region.height <= size.height
    if not (fits_x and fits_y):
        raise InputError(
            f"the region {region.x},{region.y},{region.width},{region.height} does not lie inside "
            f"the sensor of {size}; give x,y,width,height with x + width <= {size.width} and "
            f"y + height <= {size.height}"
        )
    smaller = SensorSize(region.width, region.height)

    def cut(packet: EventStream) -> EventStream:
        x = packet.x.astype(np.int32) - region.x
        y = packet.y.astype(np.int32) - region.y
        return move_events(packet, x, y, smaller)

    place = f"{region.x},{region.y},{region.width},{region.height}"
    return note_edit(map_packets(events, cut, size=smaller), events, crop=place)


def resize(events: Recording, size: SizeLike) -> Recording:
    """The events on a sensor of another size, each in the pixel that covers its old one.

    No event is added or taken away: a smaller sensor has pixels with the events of several, a
    larger one has pixels without any. Neither is what a camera of that size would have seen;
    simulate at the size you need where you can.

    Raises:
        ConfigError: the size is impossible.
    """
    new = as_size(size)
    old = events.size
    columns = (np.arange(old.width, dtype=np.int64) * new.width // old.width).astype(np.uint16)
    rows = (np.arange(old.height, dtype=np.int64) * new.height // old.height).astype(np.uint16)

    def place(packet: EventStream) -> EventStream:
        return move_events(packet, columns[packet.x], rows[packet.y], new)

    return note_edit(map_packets(events, place, size=new), events, resize=str(new))

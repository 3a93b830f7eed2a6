"""The sensor mirrored and turned, and events moved over it.

Events keep their order: those of one µs stay in the order they had, also where another one would be
that of their new places. So two mirrorings, or four quarter turns, give back what was there.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from texvent.errors import ConfigError, shown
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.transform.packets import Recording, map_packets, move_events, note_edit

Axes = Literal["x", "y", "xy"]
QUARTER_TURNS = (0, 90, 180, 270)


def flip(events: Recording, axes: Axes) -> Recording:
    """The events mirrored: "x" exchanges left and right, "y" top and bottom, "xy" both.

    Raises:
        ConfigError: other axes.
    """
    if axes not in ("x", "y", "xy"):
        raise ConfigError(f"axes is {shown(axes)}; give 'x' (left-right), 'y' (top-bottom) or 'xy'")
    return note_edit(_flip(events, axes), events, flip=axes)


def _flip(events: Recording, axes: str) -> Recording:
    size = events.size

    def mirror(packet: EventStream) -> EventStream:
        x = size.width - 1 - packet.x.astype(np.int32) if "x" in axes else packet.x
        y = size.height - 1 - packet.y.astype(np.int32) if "y" in axes else packet.y
        return move_events(packet, x, y, size)

    return map_packets(events, mirror)


def rotate(events: Recording, degrees: int) -> Recording:
    """The events turned clockwise, as a viewer sees them, by 0, 90, 180 or 270 degrees.

    A quarter turn exchanges width and height: the array of an event frame turns as
    `numpy.rot90(frame, -1)`.

    Raises:
        ConfigError: another angle; it would need pixels between pixels.
    """
    if degrees not in QUARTER_TURNS:
        raise ConfigError(f"degrees is {shown(degrees)}; it must be 0, 90, 180 or 270, clockwise")
    if degrees == 0:
        return events
    turned = _flip(events, "xy") if degrees == 180 else _turn(events, degrees)
    return note_edit(turned, events, rotate=int(degrees))


def _turn(events: Recording, degrees: int) -> Recording:
    """Turned by 90 or 270 degrees."""
    size = events.size
    turned = SensorSize(size.height, size.width)

    def turn(packet: EventStream) -> EventStream:
        x, y = packet.x.astype(np.int32), packet.y.astype(np.int32)
        if degrees == 90:
            return move_events(packet, size.height - 1 - y, x, turned)
        return move_events(packet, y, size.width - 1 - x, turned)

    return map_packets(events, turn, size=turned)


def shift(events: Recording, dx: int, dy: int) -> Recording:
    """The events moved right by dx and down by dy pixels; those that leave the sensor are lost."""

    def move(packet: EventStream) -> EventStream:
        x, y = packet.x.astype(np.int32) + dx, packet.y.astype(np.int32) + dy
        return move_events(packet, x, y, packet.size)

    return note_edit(map_packets(events, move), events, shift=f"{dx},{dy}")

"""Edits of recordings: flips, turns, regions, sizes, times, polarity, and merging."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np

from texvent.config import check_whole
from texvent.errors import ConfigError, InputError, shown
from texvent.event_packets import EventPackets, LazyPackets
from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.options.time_range import SeenTimes, describe_outside
from texvent.sensor import SensorSize, SizeLike, as_size
from texvent.transform.packets import (
    Recording,
    check_stream,
    map_packets,
    move_events,
    note_edit,
    packets_of,
)

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


def keep_time(events: EventPackets, start_us: int, stop_us: int) -> EventPackets:
    """The events with `start_us <= t < stop_us`; what comes later is not even read.

    Raises:
        InputError: the stop is not after the start, or the recording is elsewhere in time (found
            while reading, unless the format states its times).
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


def merge(recordings: Sequence[EventPackets]) -> EventPackets:
    """All events in time order, ties ordered by (t, y, x, p); metadata comes from the first.

    Memory holds about one packet of each recording. The signal/noise label is kept if every
    recording has one.

    Raises:
        InputError: there is no recording, or their sensors differ.
    """
    if not recordings:
        raise InputError("nothing to merge; give at least one recording")
    size = recordings[0].size
    for one in recordings:
        if one.size != size:
            raise InputError(
                f"cannot merge sensors of {size} and {one.size}; crop or resize one first"
            )
    lazy = LazyPackets(lambda: _merged(recordings))
    return EventPackets(lazy, size, recordings[0].metadata)


@dataclass
class _Reader:
    """Events of one recording that were read and not yet yielded."""

    packets: Iterator[EventStream]
    held: EventStream
    is_open: bool = True

    def read_on(self) -> None:
        """Hold one packet more."""
        following = next(self.packets, None)
        if following is None:
            self.is_open = False
        else:
            self.held = EventStream.concat([self.held, following]) if len(self.held) else following

    def take(self, stop_us: int | None) -> EventStream:
        """The events before a time, which are then no longer held; None: all."""
        cut = len(self.held)
        if stop_us is not None:
            cut = int(np.searchsorted(self.held.t, stop_us, side="left"))
        taken, self.held = self.held[:cut], self.held[cut:]
        return taken


def _merged(recordings: Sequence[EventPackets]) -> Iterator[EventStream]:
    """Packets up to the time that every recording has been read past."""
    readers = [_Reader(iter(one), EventStream.empty(one.size)) for one in recordings]
    while True:
        for reader in readers:
            while reader.is_open and not len(reader.held):
                reader.read_on()
        # A recording may go on at the time where its last packet ends.
        ends = [int(reader.held.t[-1]) for reader in readers if reader.is_open]
        stop_us = min(ends, default=None)
        taken = [reader.take(stop_us) for reader in readers]
        if any(len(part) for part in taken):
            yield _sorted(taken)
        if stop_us is None:
            return
        for reader in readers:
            if reader.is_open and int(reader.held.t[-1]) == stop_us:
                reader.read_on()


def _sorted(parts: Sequence[EventStream]) -> EventStream:
    parts = [part for part in parts if len(part)]
    columns = [part.columns() for part in parts]
    names = set.intersection(*(set(one) for one in columns))
    whole = {name: np.concatenate([one[name] for one in columns]) for name in names}
    order = np.lexsort((whole["p"], whole["x"], whole["y"], whole["t"]))
    ordered = {name: column[order] for name, column in whole.items()}
    return EventStream(**ordered, size=parts[0].size, metadata=parts[0].metadata)

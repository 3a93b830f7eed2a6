"""Several recordings of one sensor as one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from texvent.errors import InputError
from texvent.event_packets import EventPackets, LazyPackets
from texvent.events import EventStream


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

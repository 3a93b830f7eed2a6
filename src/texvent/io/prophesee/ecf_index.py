"""The time index of Prophesee HDF5 files: where to look for an event, every 2 ms.

Entry k belongs to the time `first event + 2000 k` µs. It names the first event of the last
2 ms bin before that time which is not empty, by its number and its time after the first event;
entry 0 is (0, −1). One more entry closes the index: the first event of the last bin.

Source: Prophesee OpenEB, the writer of HDF5 event files, from which the layout was learned.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

PERIOD_US = 2000
ENTRY = np.dtype([("id", "<u8"), ("ts", "<i8")])
BATCH = 1 << 18
"""Entries made at once; a long silence has many."""


class TimeIndex:
    """Makes the entries while events arrive, with flat memory."""

    def __init__(self) -> None:
        self.start_us: int | None = None
        """Time of the first event, µs, or None before it came."""
        self._events = 0
        self._bin = -1
        self._entry = (0, -1)

    def add(self, t: NDArray[np.int64]) -> Iterator[NDArray[Any]]:
        """Entries up to the last of these times.

        Args:
            t: times of the events that follow, µs, [n], n ≥ 1.

        Yields:
            Parts of the index, of `ENTRY`.
        """
        if self.start_us is None:
            self.start_us = int(t[0])
        since = t - self.start_us
        bins = since // PERIOD_US
        firsts = np.flatnonzero(np.diff(bins, prepend=self._bin))
        # Before each bin that is not empty, the entry of the bin before it repeats.
        repeats = np.diff(bins[firsts], prepend=self._bin)
        entries = np.empty(len(firsts) + 1, dtype=ENTRY)
        entries[0] = self._entry
        entries["id"][1:] = firsts + self._events
        entries["ts"][1:] = since[firsts]
        self._events += len(t)
        self._bin = int(bins[-1])
        self._entry = (int(entries[-1]["id"]), int(entries[-1]["ts"]))
        ends = np.cumsum(repeats)
        for start in range(0, int(ends[-1]) if len(ends) else 0, BATCH):
            numbers = np.arange(start, min(start + BATCH, int(ends[-1])))
            yield entries[np.searchsorted(ends, numbers, side="right")]

    def close(self) -> NDArray[Any]:
        """The closing entry; nothing where there was no event."""
        return np.array([self._entry] if self._events else [], dtype=ENTRY)

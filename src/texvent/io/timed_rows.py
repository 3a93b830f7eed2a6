"""Files of rows in time order, of which any rows can be read: a time is found by bisection."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from texvent.errors import FileFormatError
from texvent.io.block_codec import TimeSeek
from texvent.io.protocol import Columns


@dataclass(frozen=True)
class TimedRows:
    """The events of an open file."""

    count: int
    """Number of events."""
    time_of: Callable[[int], int]
    """Time of an event by its number, µs."""
    read: Callable[[int, int], Columns]
    """Columns of the events from one number to another, which is excluded."""
    block: int
    """Events of a packet, a multiple of `unit`."""
    unit: int = 1
    """Events that the file keeps in one piece: reading begins at a multiple."""

    def find(self, t_us: int) -> int:
        """How many units begin before a time; the rest of the file is not read."""
        units = range(-(-self.count // self.unit))
        return bisect_left(units, t_us, key=lambda unit: self.time_of(unit * self.unit))


OpenRows: TypeAlias = Callable[[], AbstractContextManager[TimedRows]]


def read_rows(open_rows: OpenRows) -> Iterator[Columns]:
    """All events, block by block."""
    with open_rows() as rows:
        for start in range(0, rows.count, rows.block):
            yield rows.read(start, min(start + rows.block, rows.count))


def seek_rows(path: Path, open_rows: OpenRows) -> TimeSeek:
    """How such a file finds a time; every time that is read on the way must be in order."""
    return TimeSeek(partial(_time_range, path, open_rows), partial(_read_between, path, open_rows))


def _time_range(path: Path, open_rows: OpenRows) -> tuple[int, int] | None:
    with open_rows() as rows:
        if not rows.count:
            return None
        first, last = rows.time_of(0), rows.time_of(rows.count - 1)
    _check_order(path, [first, last])
    return first, last + 1


def _check_order(path: Path, times: ArrayLike) -> None:
    """Refuse times that decrease: bisection would lose events.

    Raises:
        FileFormatError: they do.
    """
    t = np.asarray(times, np.int64)
    later = np.flatnonzero(t[1:] < t[:-1])
    if len(later):
        before, after = t[later[0] : later[0] + 2].tolist()
        raise FileFormatError(f"{path}: time decreases from {before} to {after} µs")


def _read_between(
    path: Path, open_rows: OpenRows, start_us: int, stop_us: int
) -> Iterator[Columns]:
    with open_rows() as opened:
        seen: dict[int, int] = {}

        def time_of(index: int) -> int:
            seen[index] = opened.time_of(index)
            return seen[index]

        rows = replace(opened, time_of=time_of)
        # The unit before the first that begins at the time or later may end after it.
        first = max(rows.find(start_us) - 1, 0) * rows.unit
        end = min(rows.find(stop_us) * rows.unit, rows.count)
        _check_order(path, [seen[index] for index in sorted(seen)])
        last: list[int] = []
        for start in range(first, end, rows.block):
            columns = rows.read(start, min(start + rows.block, end))
            _check_order(path, [*last, *columns["t"][:1]])
            _check_order(path, columns["t"])
            last = columns["t"][-1:].tolist()
            a, b = np.searchsorted(columns["t"], (start_us, stop_us), side="left")
            yield {name: column[a:b] for name, column in columns.items()}

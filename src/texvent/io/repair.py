"""Repair of damaged recordings, block by block: each kind of damage is mended and counted.

Events outside the sensor are dropped. Where the clock was reset, the times after it continue those
before. Other times that step back are sorted among the last million events; what comes later still
is dropped. Of a file that ends in damage, all before it is read.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.io.block_writer import Columns
from texvent.sensor import SensorSize

_Columns: TypeAlias = dict[str, NDArray[Any]]
HELD_EVENTS = 2**20
"""Events that are held back to be sorted."""
RESET_US = 1_000_000
"""A fall by more may be a reset of the clock ..."""
RESET_EVENTS = 100
"""... if as many events after it lie below the time before it."""


@dataclass
class RepairCounts:
    """How much was repaired."""

    outside_sensor: int = 0
    """Events dropped because no pixel has their coordinates."""
    out_of_order: int = 0
    """Events whose time is before that of an earlier one."""
    dropped_late: int = 0
    """Of those, events too late to be sorted, which are dropped."""
    clock_resets: int = 0
    """Resets of the clock that were joined."""
    unreadable_rows: int = 0
    """Rows of a text that are no events, which are dropped."""
    cut_off: str = ""
    """Damage that ended the reading."""

    def facts(self) -> dict[str, int | str]:
        """Counts that are not zero, by name."""
        values = {one.name: getattr(self, one.name) for one in fields(self)}
        return {name: value for name, value in values.items() if value}


def repair_blocks(
    blocks: Iterator[Columns], size: SensorSize, counts: RepairCounts
) -> Iterator[Columns]:
    """Blocks of events that lie on the sensor and in time order; `counts` gets the rest."""
    held: _Columns = {}
    tail: _Columns = {}
    latest_us = released_us = -(2**62)
    added_us = 0
    for block in itertools.chain(_until_damage(blocks, counts), [None]):
        coming = tail if block is None else _joined(tail, _on_sensor(block, size, counts))
        count = len(coming.get("t", ()))
        # A reset shows in the events after it, so the last ones wait for the next block.
        ready = count if block is None else max(0, count - RESET_EVENTS)
        if ready:
            times, resets = _join_resets(coming["t"], latest_us, added_us)
            counts.clock_resets += sum(at < ready for at in resets)
            added_us = int(times[ready - 1]) - int(coming["t"][ready - 1])
            times = times[:ready]
            steps = np.maximum.accumulate(np.concatenate([[latest_us], times]))
            counts.out_of_order += int((times < steps[:-1]).sum())
            latest_us = int(steps[-1])
            now = {name: column[:ready] for name, column in coming.items()}
            held = _joined(held, {**now, "t": times})
        tail = {name: column[ready:] for name, column in coming.items()}
        if not held or (not ready and block is not None):
            continue
        order = np.argsort(held["t"], kind="stable")
        held = {name: column[order] for name, column in held.items()}
        late = int(np.searchsorted(held["t"], released_us))
        counts.dropped_late += late
        ready = len(order) if block is None else max(late, len(order) - HELD_EVENTS)
        if ready > late:
            yield {name: column[late:ready] for name, column in held.items()}
            released_us = int(held["t"][ready - 1])
        held = {name: column[ready:] for name, column in held.items()}


def _until_damage(blocks: Iterator[Columns], counts: RepairCounts) -> Iterator[Columns]:
    try:
        yield from blocks
    except FileFormatError as error:
        counts.cut_off = str(error)


def _on_sensor(block: Columns, size: SensorSize, counts: RepairCounts) -> _Columns:
    x, y = (np.asarray(block[name]).astype(np.int64, copy=False) for name in "xy")
    inside = (x >= 0) & (x < size.width) & (y >= 0) & (y < size.height)
    counts.outside_sensor += int(inside.size - np.count_nonzero(inside))
    return {name: np.asarray(column)[inside] for name, column in block.items()}


def _join_resets(
    stored: NDArray[np.generic], latest_us: int, added_us: int
) -> tuple[NDArray[np.int64], list[int]]:
    """Times that continue after each reset of the clock, and the numbers of the first after one."""
    times = stored.astype(np.int64) + added_us
    resets: list[int] = []
    start, before = 0, latest_us
    while True:
        previous = np.concatenate([[before], times[start:-1]])
        falls = np.flatnonzero(times[start:] < previous - RESET_US)
        found = (at for at in falls.tolist() if _stays_below(times[start + at :], previous[at]))
        reset = next(found, None)
        if reset is None:
            return times, resets
        before = int(previous[reset])
        start += reset
        times[start:] += before - int(times[start])
        resets.append(start)


def _stays_below(times: NDArray[np.int64], limit_us: int) -> bool:
    following = times[:RESET_EVENTS]
    return len(following) == RESET_EVENTS and bool((following < limit_us).all())


def _joined(first: _Columns, second: _Columns) -> _Columns:
    if not first:
        return second
    return {name: np.concatenate([first[name], second[name]]) for name in first}


def valid_events(block: Columns, size: SensorSize, last_us: int) -> int:
    """Number of events at the start of a block that lie on the sensor and in time order."""
    x, y, t = (np.asarray(block[name]).astype(np.int64, copy=False) for name in "xyt")
    sound = (x >= 0) & (x < size.width) & (y >= 0) & (y < size.height)
    sound &= np.diff(t, prepend=last_us) >= 0
    return int(sound.argmin()) if not sound.all() else len(t)

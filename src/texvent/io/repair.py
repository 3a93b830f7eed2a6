"""Repair of damaged recordings, block by block: each kind of damage is mended and counted.

Events outside the sensor are dropped. Where the clock was reset, the times after it continue those
before. Other times that step back are sorted among the last million events; what comes later still
is dropped. Of a file that ends in damage, all before it is read.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.io.protocol import Columns
from texvent.sensor import SensorSize

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
    cut_off: str = ""
    """Damage that ended the reading."""

    def facts(self) -> dict[str, int | str]:
        """Counts that are not zero, by name."""
        values = {one.name: getattr(self, one.name) for one in fields(self)}
        return {name: value for name, value in values.items() if value}


def repair_blocks(
    blocks: Iterator[Columns], size: SensorSize, counts: RepairCounts
) -> Iterator[Columns]:
    """Blocks of events that lie on the sensor and in time order.

    Args:
        blocks: columns x, y, t, p, and others, as the file has them.
        size: sensor size, pixels.
        counts: receives how much was repaired.
    """
    held: dict[str, NDArray[np.generic]] | None = None
    latest_us = released_us = -(2**62)
    added_us = 0
    for block in _until_damage(blocks, counts):
        columns = _on_sensor(block, size, counts)
        if len(columns["t"]) == 0:
            continue
        times, added_us = _join_resets(columns["t"], latest_us, added_us, counts)
        steps = np.maximum.accumulate(np.concatenate([[latest_us], times]))
        counts.out_of_order += int((times < steps[:-1]).sum())
        latest_us = int(steps[-1])
        columns["t"] = times
        held = columns if held is None else _joined(held, columns)
        order = np.argsort(held["t"], kind="stable")
        held = {name: column[order] for name, column in held.items()}
        late = int(np.searchsorted(held["t"], released_us))
        counts.dropped_late += late
        ready = max(late, len(order) - HELD_EVENTS)
        if ready > late:
            yield {name: column[late:ready] for name, column in held.items()}
            released_us = int(held["t"][ready - 1])
        held = {name: column[ready:] for name, column in held.items()}
    if held is not None and len(held["t"]):
        yield held


def _until_damage(blocks: Iterator[Columns], counts: RepairCounts) -> Iterator[Columns]:
    try:
        yield from blocks
    except FileFormatError as error:
        counts.cut_off = str(error)


def _on_sensor(
    block: Columns, size: SensorSize, counts: RepairCounts
) -> dict[str, NDArray[np.generic]]:
    x, y = (np.asarray(block[name]).astype(np.int64, copy=False) for name in "xy")
    inside = (x >= 0) & (x < size.width) & (y >= 0) & (y < size.height)
    counts.outside_sensor += int(inside.size - np.count_nonzero(inside))
    return {name: np.asarray(column)[inside] for name, column in block.items()}


def _join_resets(
    stored: NDArray[np.generic], latest_us: int, added_us: int, counts: RepairCounts
) -> tuple[NDArray[np.int64], int]:
    """Times that continue after each reset of the clock, and what is added from here on, µs."""
    times = stored.astype(np.int64) + added_us
    before = latest_us
    start = 0
    while True:
        previous = np.concatenate([[before], times[start:-1]])
        falls = np.flatnonzero(times[start:] < previous - RESET_US)
        resets = (at for at in falls.tolist() if _stays_below(times[start + at :], previous[at]))
        reset = next(resets, -1)
        if reset < 0:
            return times, added_us
        shift = int(previous[reset]) - int(times[start + reset])
        times[start + reset :] += shift
        added_us += shift
        counts.clock_resets += 1
        before, start = int(previous[reset]), start + reset


def _stays_below(times: NDArray[np.int64], limit_us: int) -> bool:
    following = times[:RESET_EVENTS]
    return len(following) == RESET_EVENTS and bool((following < limit_us).all())


def _joined(
    first: dict[str, NDArray[np.generic]], second: dict[str, NDArray[np.generic]]
) -> dict[str, NDArray[np.generic]]:
    return {name: np.concatenate([first[name], second[name]]) for name in first}


def valid_events(block: Columns, size: SensorSize, last_us: int) -> int:
    """Number of events at the start of a block that lie on the sensor and in time order."""
    x, y, t = (np.asarray(block[name]).astype(np.int64, copy=False) for name in "xyt")
    sound = (x >= 0) & (x < size.width) & (y >= 0) & (y < size.height)
    sound &= np.diff(t, prepend=last_us) >= 0
    return int(sound.argmin()) if not sound.all() else len(t)

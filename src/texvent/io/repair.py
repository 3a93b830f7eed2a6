"""Repair of damaged recordings, block by block: each kind of damage is mended and counted.

Events outside the sensor are dropped. Times are judged by what follows them, 100 events at most:

* A few stamps in a row, after which the clock leaps back to where it was, are strays, and dropped.
* Where the clock falls and stays low it was set anew (its times then continue those before) or,
  after a fall by 2^31 or 2^32 µs or ns, it turned over (they count on).
* A leap that stays high is a pause; but a few events that are more than 10 minutes from all others,
  at an end of the recording, are strays.
* Times that step back by some ms, or for a while by less than a second, are sorted among the last
  million events; what comes later still is dropped.

Of a file that ends in damage, all before it is read.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.io.block_writer import Columns
from texvent.io.clocks import DISORDER_US, MOST_STRAYS
from texvent.sensor import SensorSize

_Columns: TypeAlias = dict[str, NDArray[Any]]
_Times: TypeAlias = NDArray[np.int64]
BATCH_EVENTS = 2**18
"""Events judged at once: how a file was cut into blocks changes nothing."""
HELD_EVENTS = 2**20
"""Events that are held back to be sorted."""
UNREADABLE_US = -(1 << 63)
"""Time of a row that holds no event."""
LOOK_EVENTS = 2**14
"""Events among which the clock is sought again after a fall ..."""
LATEST_US = 1_000_000
"""... by less than this: those before it are late, and sorted."""
SHORT_TURNS_US = ((1 << 31) // 1000, (1 << 32) // 1000)
"""Ranges of clocks of 32 bits that count ns, which never show more."""
TURNS_US = (1 << 31, 1 << 32, *SHORT_TURNS_US)
"""Ranges of clocks that turn over."""
LONGEST_TURN_US, TURN_SHARE = 60_000_000, 32
"""Between the last event before a turn and the first after it; at most so small a share of it."""
LONGEST_PAUSE_US = 600_000_000
"""A few events before or after a longer one, at an end of the recording, are strays."""


@dataclass
class RepairCounts:
    """Counts of repaired events."""

    outside_sensor: int = 0
    """Events dropped because no pixel has their coordinates."""
    out_of_order: int = 0
    """Events whose time is before that of an earlier one."""
    dropped_late: int = 0
    """Events among them that are too late to be sorted, which are dropped."""
    stray_times: int = 0
    """Events dropped because their time is none of the recording."""
    clock_resets: int = 0
    """Resets of the clock that were joined."""
    clock_turns: int = 0
    """Falls of the clock by its range, that were joined."""
    unreadable_rows: int = 0
    """Rows that are no events, which are dropped."""
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
    clock = _Clock(counts)
    released_us = -(2**62)
    sound = (_on_sensor(block, size, counts) for block in _until_damage(blocks, counts))
    for batch, ready, is_last in _batches(sound):
        times, is_kept = clock.follow(batch["t"].astype(np.int64), ready, is_last=is_last)
        now = {name: column[:ready][is_kept] for name, column in batch.items()}
        held = _joined(held, {**now, "t": times[is_kept]})
        order = np.argsort(held["t"], kind="stable")
        held = {name: column[order] for name, column in held.items()}
        late = int(np.searchsorted(held["t"], released_us))
        counts.dropped_late += late
        ready = len(order) if is_last else max(late, len(order) - HELD_EVENTS)
        if ready > late:
            yield {name: column[late:ready] for name, column in held.items()}
            released_us = int(held["t"][ready - 1])
        held = {name: column[ready:] for name, column in held.items()}


def _batches(blocks: Iterator[_Columns]) -> Iterator[tuple[_Columns, int, bool]]:
    """Batches of one length with the events that follow, the number without these, is it last."""
    waiting: list[_Columns] = []
    count = 0
    for block in blocks:
        waiting.append(block)
        count += len(block["t"])
        while count >= BATCH_EVENTS + LOOK_EVENTS:
            whole = _concatenated(waiting)
            yield (
                {n: one[: BATCH_EVENTS + LOOK_EVENTS] for n, one in whole.items()},
                BATCH_EVENTS,
                False,
            )
            waiting = [{name: column[BATCH_EVENTS:] for name, column in whole.items()}]
            count -= BATCH_EVENTS
    if count:
        yield _concatenated(waiting), count, True


def _until_damage(blocks: Iterator[Columns], counts: RepairCounts) -> Iterator[Columns]:
    try:
        yield from blocks
    except FileFormatError as error:
        counts.cut_off = str(error)


def _on_sensor(block: Columns, size: SensorSize, counts: RepairCounts) -> _Columns:
    x, y = (np.asarray(block[name]).astype(np.int64, copy=False) for name in "xy")
    t = np.asarray(block["t"])
    # Rows of zeros, several together, are space that was allocated and never written.
    is_blank = np.pad((x | y | t | np.asarray(block["p"])) == 0, 1)
    is_read = (t != UNREADABLE_US) & ~(is_blank[1:-1] & (is_blank[:-2] | is_blank[2:]))
    inside = (x >= 0) & (x < size.width) & (y >= 0) & (y < size.height) & is_read
    counts.unreadable_rows += int(is_read.size - np.count_nonzero(is_read))
    counts.outside_sensor += int(np.count_nonzero(is_read) - np.count_nonzero(inside))
    return {name: np.asarray(column)[inside] for name, column in block.items()}


class _Clock:
    """The one clock of a recording, of whose stored times some are strays, resets or turns."""

    def __init__(self, counts: RepairCounts) -> None:
        self._counts = counts
        self._kept = self._skipped = self._added_us = 0
        self._latest_us: int | None = None
        """Largest of the stored times since the last reset."""
        self._reached_us = -(2**62)
        """Latest time on the clock."""

    def follow(
        self, stored: _Times, ready: int, *, is_last: bool
    ) -> tuple[_Times, NDArray[np.bool_]]:
        """Times of the first events on the clock, [ready], and which of them are kept.

        Args:
            stored: those of the events that are judged now, and of some that follow.
            ready: number of events that are judged now.
            is_last: whether none follow these.
        """
        if self._latest_us is None:
            self._latest_us = int(stored[0])
        is_kept, added = np.ones(len(stored), bool), np.zeros(len(stored), np.int64)
        at = self._skipped
        is_kept[:at], added[0] = False, self._added_us
        steps = np.abs(np.diff(stored, prepend=self._latest_us))
        for jump in np.flatnonzero(steps > DISORDER_US).tolist():
            if not at <= jump < ready:
                continue
            self._pass(stored[at:jump])
            future = stored[jump : jump + LOOK_EVENTS]
            is_end = is_last and len(future) <= MOST_STRAYS
            past = stored[:jump][is_kept[:jump]] if self._kept < MOST_STRAYS else future
            if 0 < len(past) < len(future) and _is_false_start(past, future):
                is_kept[:jump] = False
                self._kept, self._latest_us = 0, int(future[0])
            before_us = self._added_us
            at = jump + self._strays(future, is_end=is_end)
            is_kept[jump:at] = False
            added[jump] += self._added_us - before_us
        self._pass(stored[at:ready])
        self._skipped = max(at - ready, 0)
        times = (stored + np.cumsum(added))[:ready]
        self._count(times, is_kept[:ready])
        return times, is_kept[:ready]

    def _pass(self, times: _Times) -> None:
        """Go on by times that are in line."""
        if len(times):
            self._latest_us = max(int(times.max()), self._latest_us or int(times[0]))
            self._kept += len(times)

    def _strays(self, future: _Times, *, is_end: bool) -> int:
        """Number of strays after which the clock goes on; a reset or turn before them is joined."""
        latest_us = self._latest_us or 0
        step_us = int(future[0]) - latest_us
        if abs(step_us) <= DISORDER_US or _is_late(future, latest_us):
            return 0
        found = _strays_before_return(future, latest_us)
        if found:
            return found
        turn_us = _turn_us(step_us, latest_us)
        if is_end and not turn_us and abs(step_us) > LONGEST_PAUSE_US:
            return len(future)
        if step_us < 0:
            self._added_us += turn_us or -step_us
            self._latest_us = int(future[0])
            self._counts.clock_turns += turn_us > 0
            self._counts.clock_resets += turn_us == 0
        return 0

    def _count(self, times: _Times, is_kept: NDArray[np.bool_]) -> None:
        kept = times[is_kept]
        reached = np.maximum.accumulate(np.concatenate([[self._reached_us], kept]))
        self._counts.stray_times += len(times) - len(kept)
        self._counts.out_of_order += int((kept < reached[:-1]).sum())
        self._reached_us = int(reached[-1])


def _turn_us(step_us: int, latest_us: int) -> int:
    """Range of a clock that turned over at this step; 0: it did not."""
    for turn_us in TURNS_US:
        longest_us = min(LONGEST_TURN_US, turn_us // TURN_SHARE)
        is_turn = 0 <= step_us + turn_us <= longest_us
        if is_turn and (turn_us not in SHORT_TURNS_US or latest_us <= turn_us):
            return turn_us
    return 0


def _strays_before_return(future: _Times, latest_us: int) -> int:
    """Number of times before a leap back to the clock; 0: it stays away."""
    window = future[: MOST_STRAYS + 1]
    away = np.abs(window - latest_us)
    half = np.minimum.accumulate(away)[:-1] // 2
    # A clock that was set anew may come back too, step by step.
    least = np.where(window[:-1] < latest_us, away[0] // 2, half)
    is_back = (away[1:] < half) & (np.abs(np.diff(window)) > least)
    return int(is_back.argmax()) + 1 if is_back.any() else 0


def _is_late(future: _Times, latest_us: int) -> bool:
    """Whether many events come late: the clock leaps back to just where it was."""
    fall_us = latest_us - int(future[0])
    is_back = np.abs(future[1:] - latest_us) <= min(DISORDER_US, fall_us // 4)
    return 0 < fall_us <= LATEST_US and bool((is_back & (np.diff(future) > fall_us // 2)).any())


def _is_false_start(past: _Times, future: _Times) -> bool:
    """Whether the few times before a jump are strays, and the recording begins after it."""
    before_us = int(past.max())
    is_far = abs(int(future[0]) - before_us) > LONGEST_PAUSE_US
    return is_far and not _strays_before_return(future, before_us)


def _joined(first: _Columns, second: _Columns) -> _Columns:
    return _concatenated([first, second]) if first else second


def _concatenated(parts: list[_Columns]) -> _Columns:
    if len(parts) == 1:
        return parts[0]
    return {name: np.concatenate([one[name] for one in parts]) for name in parts[0]}


def valid_events(block: Columns, size: SensorSize, last_us: int) -> int:
    """Number of events at the start of a block that lie on the sensor and in time order."""
    x, y, t = (np.asarray(block[name]).astype(np.int64, copy=False) for name in "xyt")
    sound = (x >= 0) & (x < size.width) & (y >= 0) & (y < size.height)
    sound &= np.diff(t, prepend=last_us) >= 0
    return int(sound.argmin()) if not sound.all() else len(t)

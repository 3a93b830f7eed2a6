"""Clocks of limited width: times that go on where the counter of a camera begins anew.

A counter of 32 bits of µs turns after 71.6 minutes, one of 31 bits (the positive half of a signed
number) after 35.8. jAER's starts below 0, so that its files pass from 2^32 - 1 to 0.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

BITS_OF_32 = (32, 31)
"""Widths of a counter that is stored as 32 bits, signed or not."""
SLACK = 16
"""At a turn the clock stands still for at most this part of it; other falls are damage."""
MOST_STRAYS = 100
"""More wrong stamps in a row are a clock of their own."""
DISORDER_US = 50_000
"""Times that step back by less are only out of order."""


class TurningClock:
    """Unrolls consecutive blocks of the times of one counter.

    Args:
        bits: widths that the counter may have, in bits of µs.
    """

    def __init__(self, *bits: int) -> None:
        self._turns_us = [1 << one for one in bits]
        self._least_us = min(self._turns_us) // SLACK * (SLACK - 1)
        self._last_us: int | None = None
        self._turned_us = self._count = 0
        self._rise = -MOST_STRAYS - 1, 0
        """Number of the last event that rose far before the first turn; time before it, µs."""

    def unroll(self, stored: NDArray[Any]) -> NDArray[np.int64]:
        """Times of the next block, µs: those stored and the length of all turns before them.

        A time from before a turn that comes after it goes back by the turn.
        """
        times = stored.astype(np.int64)
        if not len(times):
            return times
        before = np.concatenate([times[:1] if self._last_us is None else [self._last_us], times])
        self._last_us = int(times[-1])
        steps = np.diff(before)
        added = np.zeros(len(times), np.int64)
        if (np.abs(steps) >= self._least_us).any():
            for turn_us in self._turns_us:
                is_turn = np.abs(steps) >= turn_us // SLACK * (SLACK - 1)
                is_turn &= np.maximum(before[:-1], times) < turn_us
                added[is_turn] = -np.sign(steps[is_turn]) * turn_us
        turned_us = self._turned_us
        for at in np.flatnonzero(added).tolist():
            rise, low_us = self._rise
            since_us = int(times[at]) - low_us
            is_return = self._count + at - rise <= MOST_STRAYS and since_us >= -DISORDER_US
            if added[at] < 0 and not self._turned_us:
                # Before the first turn a time that rises far is only later.
                self._rise, added[at] = (self._count + at, int(before[at])), 0
            elif added[at] > 0 and is_return and since_us < added[at] // SLACK:
                added[at] = 0
            added[at] = max(int(added[at]), -self._turned_us)
            self._turned_us += int(added[at])
        self._count += len(times)
        return times + turned_us + np.cumsum(added)

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


class TurningClock:
    """Unrolls consecutive blocks of the times of one counter.

    Args:
        bits: widths that the counter may have, in bits of µs.
    """

    def __init__(self, *bits: int) -> None:
        self._turns_us = [1 << one for one in bits]
        self._least_us = min(self._turns_us) // SLACK * (SLACK - 1)
        self._last_us: int | None = None
        self._turned_us = 0
        self._lowest_us = 0

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
        if (np.abs(steps) < self._least_us).all():
            return times + (self._turned_us - self._lowest_us)
        added = np.zeros(len(times), np.int64)
        for turn_us in self._turns_us:
            is_turn = np.abs(steps) >= turn_us // SLACK * (SLACK - 1)
            is_turn &= np.maximum(before[:-1], times) < turn_us
            added[is_turn] = -np.sign(steps[is_turn]) * turn_us
        turned = self._turned_us + np.cumsum(added)
        # Before the first turn a time that rises far is only later.
        lowest = np.minimum(np.minimum.accumulate(turned), self._lowest_us)
        self._turned_us, self._lowest_us = int(turned[-1]), int(lowest[-1])
        return times + (turned - lowest)

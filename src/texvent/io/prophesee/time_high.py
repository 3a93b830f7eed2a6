"""High bits of the time in EVT2, EVT2.1 and EVT3: a counter whose turns are counted.

A fall by a whole turn less at most a sixteenth is a turn; other falls are damage, and times fall
with them. One wrong value, after which the counter goes on at the value before it, is no turn. Of a
silence that spans turns texvent writes the last and the first value of each: steps between these
two are turns.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.io.clocks import SLACK
from texvent.runtime.jit import jit

FIRST_STATE = (0, -1, -1, 0)
"""Turns, value (−1: none yet), the value before it, and how many turns were between these two."""


@jit
def follow(state: NDArray[np.int64], fresh: np.int64, bits: int) -> None:
    """Let the counter, of so many bits, have its next value."""
    turns, high, before, added = state[0], state[1], state[2], state[3]
    if fresh == high:
        return
    turn = 1 << bits
    least, step = turn - turn // SLACK, fresh - high
    is_back = before >= 0 and abs(high - before) >= least and 0 <= fresh - before < turn // SLACK
    if is_back and high != turn - 1 and least <= abs(step) < turn - 1:
        added = -added
    else:
        added = np.int64(step <= -least)
    state[0], state[1], state[2], state[3] = turns + added, fresh, high, added


@jit
def count_turns(
    highs: NDArray[np.int64], state: NDArray[np.int64], bits: int, turns: NDArray[np.int64]
) -> None:
    """Fill `turns` with those up to each of consecutive values."""
    for i in range(highs.size):
        follow(state, highs[i], bits)
        turns[i] = state[0]

"""Runs of 64 pixels as words of 64 bits: how compiled scans over frames skip what cannot fire.

A scan first asks of each run of 64 pixels whether any of them may fire. That takes some vector
instructions for all 64, as fast as memory. Runs in which none may, nearly all where little moves,
are skipped. Of each of the others a second look makes a word with a bit per pixel, and its bits are
then taken one by one: no branch is taken per pixel, and only one per run is unpredictable.

Arrays are passed whole, and never in tuples, to functions without branches: where Numba has to
count references to an array, that costs as much as looking at a run.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit

ByteArray = NDArray[np.uint8]
Int64Array = NDArray[np.int64]

RUN = 64
"""Pixels that are skipped together: the bits of a word."""

# Numba turns a sum of uint64 and int64 into a float, so every constant is uint64. Pixels of a run
# are counted in uint64 too: a number that cannot be negative needs no check for counting from the
# end, and a loop without that check becomes vector instructions.
_0, _8, _56, _58 = (np.uint64(number) for number in (0, 8, 56, 58))
_GATHER = np.uint64(sum(1 << (56 - 7 * byte) for byte in range(8)))
"""A word of eight bytes that are 0 or 1, times this, has them as bits in its highest byte."""
_DE_BRUIJN = np.uint64(0x03F79D71B4CB0A89)
"""Its 64 runs of six bits are all different, so that a shift is known by the highest six."""
_BIT_NUMBER = np.empty(64, np.uint8)
_BIT_NUMBER[[int(_DE_BRUIJN) << bit >> 58 & 63 for bit in range(64)]] = np.arange(64)


class MarkedRuns(NamedTuple):
    """Pixels that may fire."""

    run: Int64Array
    """[m] numbers of runs, ascending."""
    bits: NDArray[np.uint64]
    """[m] which of their pixels: bit i for the i-th."""


@jit(inline="always")
def number_of(bit: np.uint64) -> Any:
    """Which bit of a word is set, of a word in which one is."""
    return _BIT_NUMBER[bit * _DE_BRUIJN >> _58]


@jit
def make_flags(pixels: int) -> ByteArray:
    """Room for a flag per run; that of a last one that is not whole is set."""
    return np.ones(-(-pixels // RUN), np.uint8)


@jit
def list_marked_runs(is_marked: ByteArray) -> Int64Array:
    """The numbers of the flags that are set."""
    run, found = np.empty(is_marked.sum() + 1, np.int64), 0
    for number in range(is_marked.size):
        # Written always, kept if marked: without a branch that cannot be foreseen.
        run[found] = number
        found += int(is_marked[number])
    return run[:found]


@jit
def as_bits(word: NDArray[np.uint64]) -> np.uint64:
    """One bit for each of eight words of eight bytes that are 0 or 1."""
    bits = _0
    for number in range(np.uint64(RUN // 8)):
        bits |= (word[number] * _GATHER >> _56) << number * _8
    return bits

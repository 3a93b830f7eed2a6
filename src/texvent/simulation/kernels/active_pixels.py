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
from numba.cpython.unsafe.numbers import trailing_zeros
from numba.extending import overload
from numpy.typing import NDArray

from texvent.runtime.jit import jit

ByteArray = NDArray[np.uint8]
Int64Array = NDArray[np.int64]

RUN = 64
"""Pixels that are skipped together: the bits of a word."""

# Numba turns a sum of uint64 and int64 into a float, so every constant is uint64. Pixels of a run
# are counted in uint64 too: a number that cannot be negative needs no check for counting from the
# end, and a loop without that check becomes vector instructions.
_trailing_zeros: Any = trailing_zeros
_0, _8, _56 = (np.uint64(number) for number in (0, 8, 56))
_GATHER = np.uint64(sum(1 << (56 - 7 * byte) for byte in range(8)))
"""A word of eight bytes that are 0 or 1, times this, has them as bits in its highest byte."""


class MarkedRuns(NamedTuple):
    """Pixels that may fire."""

    run: Int64Array
    """[m] numbers of runs, ascending."""
    bits: NDArray[np.uint64]
    """[m] which of their pixels: bit i for the i-th."""


def number_of_lowest(bits: np.uint64) -> np.uint64:
    """Number of the lowest bit that is set in a word, which is not 0."""
    return np.uint64((int(bits) & -int(bits)).bit_length() - 1)


@overload(number_of_lowest, strict=False)
def _compile_number_of_lowest(bits: Any) -> Any:
    """The same as one instruction."""
    return lambda bits: _trailing_zeros(bits)


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


Uint64Array = NDArray[np.uint64]
WORD = 8
"""Pixels that are skipped together if none of them is marked."""


@jit
def is_equal(one: NDArray[Any], other: NDArray[Any]) -> bool:
    """Whether two arrays of a size have the same elements."""
    different = 0
    for j in range(one.size):
        different |= one[j] != other[j]
    return different == 0


@jit
def list_marked(
    words: Uint64Array, marks: NDArray[np.uint8], listed: NDArray[np.unsignedinteger[Any]]
) -> int:
    """List the marked pixels of a block; return how many there are.

    Args:
        words: the marks, `WORD` at a time.
        marks: 1 or 0 for each pixel, and 0 beyond the last; the same memory.
        listed: the list, with room for `WORD` more than there are pixels.
    """
    found = 0
    for word in range(words.size):
        if words[word] == 0:
            continue
        for j in range(WORD * word, WORD * word + WORD):
            listed[found] = j
            found += int(np.int64(marks[j]))
    return found


@jit
def grown(array: NDArray[Any], room: int) -> NDArray[Any]:
    """The same elements, with room for more."""
    larger = np.empty(room, array.dtype)
    larger[: array.size] = array
    return larger


@jit
def append_by_lane(
    events: Uint64Array, count: NDArray[np.int64], keys: Uint64Array, found: int
) -> tuple[Uint64Array, int]:
    """Append the events of a block to a list of keys, lane after lane.

    Args:
        events: [2, m] keys, those of each lane in order, and their lanes.
        count: [lanes] how many events each has; used as scratch.
        keys: [room].
        found: how many keys there are.

    Returns:
        The list, a longer one if there was no room, and how many keys there are now.
    """
    if found + events.shape[1] > keys.size:
        keys = grown(keys, 2 * (found + events.shape[1]))
    for lane in range(count.size):
        own = count[lane]
        count[lane] = found
        found += own
    for k in range(events.shape[1]):
        keys[count[events[1, k]]] = events[0, k]
        count[events[1, k]] += 1
    return keys, found


@jit
def make_room(events: Uint64Array, needed: int) -> Uint64Array:
    """The same events, with room for that many."""
    if needed <= events.shape[1]:
        return events
    larger = np.empty((2, 2 * needed), np.uint64)
    larger[:, : events.shape[1]] = events
    return larger

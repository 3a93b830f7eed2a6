"""Lanes: pixels that a kernel processes side by side, in loops that fill vector registers.

A kernel marks the pixels of a block that need work, lists them, and gives each a lane. Events come
lane by lane.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit

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

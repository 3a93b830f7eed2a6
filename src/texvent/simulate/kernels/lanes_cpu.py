"""Events that lanes of pixels make round after round, put in the order of their pixels."""

from __future__ import annotations

import numba
import numpy as np
from numpy.typing import NDArray

Uint64Array = NDArray[np.uint64]


@numba.njit(cache=True, nogil=True)
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
        larger = np.empty(2 * (found + events.shape[1]), np.uint64)
        larger[:found] = keys[:found]
        keys = larger
    for lane in range(count.size):
        own = count[lane]
        count[lane] = found
        found += own
    for k in range(events.shape[1]):
        keys[count[events[1, k]]] = events[0, k]
        count[events[1, k]] += 1
    return keys, found


@numba.njit(cache=True, nogil=True)
def make_room(events: Uint64Array, needed: int) -> Uint64Array:
    """The same events, with room for that many."""
    if needed <= events.shape[1]:
        return events
    larger = np.empty((2, 2 * needed), np.uint64)
    larger[:, : events.shape[1]] = events
    return larger

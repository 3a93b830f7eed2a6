"""Events of the bytes of Event Stream files; the layout is described in `event_stream2.py`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit

RESET = 0xFE
"""It and the overflow, 0xFF, are larger than the first byte of every event."""
OVERFLOW_US = 127
EVENT_BYTES = 5


@jit
def decode_events(
    data: NDArray[np.uint8],
    start: tuple[int, int],
    columns: tuple[NDArray[np.uint16], NDArray[np.int64], NDArray[np.int64], NDArray[np.uint8]],
) -> tuple[int, int, int]:
    """Fill columns x, y, t, p from whole events at the beginning of `data`.

    Args:
        data: bytes of the file, [n].
        start: time of the event before the first, µs, and y of the top row as stored.
        columns: room for n / 5 events; a row above the sensor becomes negative.

    Returns:
        Number of events, number of bytes used, time after them, µs.
    """
    now, top = start
    x, y, t, p = columns
    place = 0
    count = 0
    while place < len(data):
        first = data[place]
        if first >= RESET:
            now += OVERFLOW_US * (first & 1)
            place += 1
            continue
        if place + EVENT_BYTES > len(data):
            break
        now += first >> 1
        x[count] = data[place + 1] | np.uint16(data[place + 2]) << 8
        y[count] = top - (np.int64(data[place + 3]) | np.int64(data[place + 4]) << 8)
        t[count] = now
        p[count] = first & 1
        count += 1
        place += EVENT_BYTES
    return count, place, now

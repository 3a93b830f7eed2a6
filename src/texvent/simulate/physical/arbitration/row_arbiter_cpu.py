"""The row arbiter, compiled by Numba: the reference's times, with the events of a row in a list."""

from __future__ import annotations

import numpy as np

from texvent.runtime.jit import jit
from texvent.simulate.physical.arbitration.row_arbiter import LOST, WAITS, Int64Array, RowRules

NONE = -1


@jit
def serve_rows(
    pixel: Int64Array,
    t_us: Int64Array,
    shape: tuple[int, int],
    rules: RowRules,
    free_ns: int,
    stop_us: int,
) -> tuple[Int64Array, int]:
    """When each event is read out; see `row_arbiter_reference.serve_rows`."""
    read_us = np.full(pixel.size, WAITS, np.int64)
    is_held = np.zeros(shape[0] * shape[1], np.bool_)
    # The waiting events of a row, and the rows that wait, first to last.
    first = np.full(shape[0], NONE, np.int64)
    last, following = first.copy(), np.full(pixel.size, NONE, np.int64)
    queue = np.empty(pixel.size, np.int64)
    head = tail = arrived = 0
    while arrived < pixel.size or head < tail:
        now_ns = free_ns
        if head == tail:
            now_ns = max(free_ns, t_us[arrived] * 1000)
        if now_ns >= stop_us * 1000:
            break
        while arrived < pixel.size and t_us[arrived] * 1000 <= now_ns:
            row = pixel[arrived] // shape[1]
            if is_held[pixel[arrived]]:
                read_us[arrived] = LOST
            elif first[row] == NONE:
                first[row] = arrived
                queue[tail] = row
                tail += 1
            else:
                following[last[row]] = arrived
            if read_us[arrived] != LOST:
                is_held[pixel[arrived]] = True
                last[row] = arrived
            arrived += 1
        row = queue[head]
        head += 1
        event, count = first[row], 0
        while event != NONE:
            read_us[event] = now_ns // 1000
            is_held[pixel[event]] = False
            event = following[event]
            count += 1
        first[row] = NONE
        free_ns = now_ns + rules.row_ns + rules.event_ns * count
    return read_us, free_ns

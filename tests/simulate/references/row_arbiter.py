"""The definition of the row arbiter, event by event."""

from __future__ import annotations

import numpy as np

from texvent.simulate.physical.readout import LOST, WAITS, Int64Array, RowRules


def serve_rows(
    pixel: Int64Array,
    t_us: Int64Array,
    shape: tuple[int, int],
    rules: RowRules,
    free_ns: int,
    stop_us: int,
) -> tuple[Int64Array, int]:
    """When each event is read out.

    The arbiter serves the row whose first waiting event is the oldest, as soon as it is free. A
    pixel whose event waits is held: what it fires meanwhile is lost.

    Args:
        pixel: flat index y · W + x, [n].
        t_us: when the events fired, µs, [n], not decreasing.
        shape: (height, width) of the sensor.
        rules: how long a row takes.
        free_ns: when the arbiter is free, ns.
        stop_us: rows are served before this, µs.

    Returns:
        Read-out times, µs, [n], `WAITS` or `LOST`; and when the arbiter is free, ns.
    """
    read_us = np.full(len(pixel), WAITS, np.int64)
    queue: dict[int, dict[int, int]] = {}  # row → its waiting pixels → their event
    arrived = 0
    while arrived < len(pixel) or queue:
        now_ns = free_ns if queue else max(free_ns, int(t_us[arrived]) * 1000)
        if now_ns >= stop_us * 1000:
            break
        while arrived < len(pixel) and t_us[arrived] * 1000 <= now_ns:
            waiting = queue.setdefault(int(pixel[arrived]) // shape[1], {})
            if waiting.setdefault(int(pixel[arrived]), arrived) != arrived:
                read_us[arrived] = LOST
            arrived += 1
        served = queue.pop(next(iter(queue)))
        read_us[list(served.values())] = now_ns // 1000
        free_ns = now_ns + rules.row_ns + rules.event_ns * len(served)
    return read_us, free_ns

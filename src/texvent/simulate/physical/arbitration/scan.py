"""A scan: the columns of the sensor are read one after the other, again and again."""

from __future__ import annotations

import numpy as np

from texvent.simulate.physical.arbitration.row_arbiter import LOST, Int64Array


def scan_times_us(
    pixel: Int64Array, t_us: Int64Array, width: int, period_ns: int, first_us: int
) -> Int64Array:
    """When a scan reads each event: as soon as it comes by the column again.

    Scan k reads column x of W at `first + (k + (W - 1 - x) / W) period`: the last column first.

    Args:
        pixel: flat index y · W + x, [n].
        t_us: when the events fired, µs, [n], not decreasing.
        width: of the sensor.
        period_ns: from one scan to the next, ns.
        first_us: when the first scan starts, µs.

    Returns:
        Read-out times, µs, rounded down, [n]; `LOST` for all but the first event of a pixel that
        one scan finds.
    """
    column_ns = first_us * 1000 + (width - 1 - pixel % width) * period_ns // width
    number = -((column_ns - t_us * 1000) // period_ns)
    read_us = (column_ns + number * period_ns) // 1000
    order = np.lexsort((number, pixel))  # stable: first come, first kept
    is_repeated = (np.diff(pixel[order]) == 0) & (np.diff(number[order]) == 0)
    read_us[order[1:][is_repeated]] = LOST
    return np.asarray(read_us)

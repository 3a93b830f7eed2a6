"""The readout of the `physical` model: a scan of the columns, one after the other, again and again.

A pixel holds one event; whatever it fires while that waits is lost. So nothing piles up.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulation.packets import UnsortedEvents

Int64Array: TypeAlias = NDArray[np.int64]

LOST = -(2**63)
"""In place of a read-out time: the event is never read."""


def scan_times_us(
    pixel: Int64Array, t_us: Int64Array, width: int, period_ns: int, first_us: int
) -> Int64Array:
    """Read-out times of events behind a scan, which reads them as it comes by their column again.

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


class ColumnScan:
    """The scan of one sensor, from its first frame on."""

    def __init__(self, period_ns: int, *, first_us: int, width: int) -> None:
        """Start with nothing waiting.

        Args:
            period_ns: from one scan to the next, ns.
            first_us: time of the first frame, when the first scan starts, µs.
            width: of the sensor, pixels.
        """
        self._period_ns, self._first_us, self._width = period_ns, first_us, width
        self._waiting = UnsortedEvents.none()

    def read(self, fired: UnsortedEvents, stop_us: int) -> UnsortedEvents:
        """Events that are read before `stop_us`, with the time of that; the others wait.

        Args:
            fired: events of the interval that ends there, in any order.
            stop_us: when the interval ends, µs.
        """
        fired = UnsortedEvents.concat((self._waiting, fired))
        fired = fired.take(np.lexsort((fired.label, fired.p, fired.pixel, fired.t)))
        read_us = scan_times_us(fired.pixel, fired.t, self._width, self._period_ns, self._first_us)
        waits = read_us >= stop_us
        self._waiting = fired.take(waits)
        return fired._replace(t=read_us).take(~waits & (read_us != LOST))

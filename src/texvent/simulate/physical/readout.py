"""The readout of the `physical` model: an arbiter or a scan, and the event rate controller.

A pixel holds one event; whatever it fires while that waits is lost. So nothing piles up. Behind a
row arbiter, a pixel that fires asks for its row. The rows are served one by one, in the order in
which they asked; all events that wait in a row leave at once, with one time stamp. Serving takes a
time for the row and a time for each event, so the more events there are, the longer they wait. A
scan reads the columns one after the other, again and again.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulate.packets import FrameInterval, UnsortedEvents
from texvent.simulate.physical.config import PhysicalConfig
from texvent.simulate.random.draws import Purpose, draw_uniforms
from texvent.video import MICROSECONDS

Int64Array: TypeAlias = NDArray[np.int64]

WAITS, LOST = -1, -2
"""In place of a read-out time: the event has not been read out yet; it never will be."""


class RowRules(NamedTuple):
    """Time that the arbiter needs for a row, ns."""

    row_ns: int
    """For each row that it serves."""
    event_ns: int
    """For each event of that row, in addition."""


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
    """Read-out times of events behind a row arbiter.

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


class Arbiter:
    """The arbiter of one sensor, from its first frame on."""

    def __init__(self, config: PhysicalConfig, *, first_us: int, shape: tuple[int, int]) -> None:
        """Start with nothing waiting.

        Args:
            config: options; `arbiter` is "rows" or "scan".
            first_us: time of the first frame, µs: when the first scan starts.
            shape: (height, width) of the sensor.
        """
        self._config = config
        self._rows = RowRules(config.arbiter_row_ns, config.arbiter_event_ns)
        self._first_us = first_us
        self._shape = shape
        self._waiting = UnsortedEvents.none()
        self._free_ns = first_us * 1000

    def read(self, fired: UnsortedEvents, stop_us: int) -> UnsortedEvents:
        """Events that are read before `stop_us`, with the time of that; the others wait.

        Args:
            fired: events of the interval that ends there, in any order.
            stop_us: when the interval ends, µs.
        """
        fired = UnsortedEvents.concat((self._waiting, fired))
        fired = fired.take(np.lexsort((fired.label, fired.p, fired.pixel, fired.t)))
        if self._config.arbiter == "rows":
            read_us, self._free_ns = serve_rows(
                fired.pixel, fired.t, self._shape, self._rows, self._free_ns, stop_us
            )
        else:
            read_us = scan_times_us(
                fired.pixel, fired.t, self._shape[1], self._config.scan_period_ns, self._first_us
            )
            read_us[read_us >= stop_us] = WAITS
        self._waiting = fired.take(read_us == WAITS)
        is_read = (read_us != WAITS) & (read_us != LOST)
        return fired._replace(t=read_us).take(is_read)


class RateLimit:
    """The event rate controller of one sensor, from its first frame on.

    It drops events with the probability that the number of events in the window before asks for.
    """

    def __init__(self, rate_hz: float, window_us: int, *, first_us: int, width: int) -> None:
        """Begin before the first event.

        Args:
            rate_hz: events per second of the whole sensor above which events are dropped.
            window_us: window in which events are counted, µs.
            first_us: time of the first frame, µs: start of the first window.
            width: of the sensor, pixels.
        """
        self._rate_hz, self._window_us = rate_hz, window_us
        self._first_us, self._width = first_us, width
        self._window, self._count_before, self._count = 0, 0, 0

    def read(self, fired: UnsortedEvents, interval: FrameInterval) -> UnsortedEvents:
        """Events of an interval that pass.

        Source: the event rate controller of Prophesee's sensors, which estimates the rate over
            one reference period and drops events at random to meet the target.
        """
        if len(fired.t) == 0:
            return fired
        fired = fired.take(np.lexsort((fired.label, fired.p, fired.pixel, fired.t)))
        window = (fired.t - self._first_us) // self._window_us
        first = int(window[0])
        counts = np.bincount(window - first)
        if first == self._window:
            counts[0] += self._count
            before = self._count_before
        else:
            before = self._count if first == self._window + 1 else 0
        allowed = self._rate_hz * self._window_us / MICROSECONDS
        seen = np.concatenate([[before], counts])[window - first]
        self._window, self._count = int(window[-1]), int(counts[-1])
        self._count_before = int(counts[-2]) if len(counts) > 1 else before
        y, x = np.divmod(fired.pixel, self._width)
        draw = Purpose.RATE_LIMIT.draw(_order_in_pixel(fired.pixel))
        chance = draw_uniforms(interval.key, y, x, draw)
        kept = chance * np.maximum(seen, 1) < allowed
        return fired.take(kept)


def _order_in_pixel(pixel: NDArray[np.int64]) -> NDArray[np.int64]:
    """Number of earlier events of its pixel, for each event; [n]."""
    by_pixel = np.argsort(pixel, kind="stable")
    ordered = pixel[by_pixel]
    is_first = np.concatenate([[True], ordered[1:] != ordered[:-1]])[: len(pixel)]
    place = np.arange(len(pixel))
    order = np.empty(len(pixel), np.int64)
    order[by_pixel] = place - np.maximum.accumulate(np.where(is_first, place, 0))
    return order

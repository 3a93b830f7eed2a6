"""What happens to events between the pixel and the file: delay, coarse clock, filters, rate limit.

Events wait for the arbiter, so they may be read out after the frame interval in which they fired;
`Readout` holds them until the interval that they belong to. Everything only moves events later.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.sensor import SensorSize
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.physical.readout_filters import ReadoutFilters
from texvent.simulate.random.draws import Purpose, draw_uniforms
from texvent.video import MICROSECONDS


@dataclass(frozen=True, kw_only=True)
class ReadoutRules:
    """What the readout does; the defaults are an ideal one."""

    latency_us: int = 0
    """Delay of every event, µs."""
    jitter_us: int = 0
    """Further delay, uniform in 0..jitter_us, µs."""
    clock_us: int = 1
    """Events get the time of the next tick of a clock of this period, µs."""
    rate_limit_hz: float = 0.0
    """Events per second of the whole sensor above which events are dropped; 0 is never."""
    rate_limit_window_us: int = 1000
    """Window in which events are counted for the limit, µs."""
    filters: tuple[str, ...] = ()
    """Filters before the limit; see `readout_filters`."""

    @property
    def is_ideal(self) -> bool:
        """Whether events come out as they went in."""
        return (
            self.latency_us == self.jitter_us == 0
            and self.clock_us == 1
            and self.rate_limit_hz == 0
            and not self.filters
        )


class Readout:
    """The way out of one sensor, from its first frame on."""

    def __init__(self, rules: ReadoutRules, *, first_us: int, size: SensorSize) -> None:
        """Start with nothing waiting.

        Args:
            rules: what is done to events.
            first_us: time of the first frame, µs: where the clock and the windows start.
            size: of the sensor.
        """
        self._rules = rules
        self._first_us = first_us
        self._width = size.width
        self._filters = ReadoutFilters(rules.filters, size, first_us=first_us)
        self._waiting = UnsortedEvents.none()
        self._window, self._count_before, self._count = 0, 0, 0

    def read(self, fired: UnsortedEvents, interval: FrameInterval) -> UnsortedEvents:
        """Events that leave the sensor in an interval, given those that fired in it.

        Events that would leave after the last frame are never read out.
        """
        if self._rules.is_ideal:
            return fired
        late = self._delay(_in_order(fired), interval)
        late = UnsortedEvents.concat((late, self._waiting))
        leaves = late.t < interval.stop_us
        self._waiting = late.take(~leaves)
        return self._limit(self._filters.read(_in_order(late.take(leaves))), interval)

    def _delay(self, fired: UnsortedEvents, interval: FrameInterval) -> UnsortedEvents:
        """Latency, jitter and clock; draws by pixel and by its events in the interval."""
        rules = self._rules
        delay = np.full(len(fired.t), rules.latency_us, np.int64)
        if rules.jitter_us > 0:
            chance = self._draw(fired, interval, Purpose.READOUT)
            delay += np.floor(chance * (rules.jitter_us + 1)).astype(np.int64)
        ticks = -((self._first_us - (fired.t + delay)) // rules.clock_us)
        return fired._replace(t=self._first_us + ticks * rules.clock_us)

    def _limit(self, fired: UnsortedEvents, interval: FrameInterval) -> UnsortedEvents:
        """Drop events with the probability that the window before asks for.

        Source: the event rate controller of Prophesee's sensors, which estimates the rate over
            one reference period and drops events at random to meet the target.
        """
        rules = self._rules
        if rules.rate_limit_hz == 0 or len(fired.t) == 0:
            return fired
        window = (fired.t - self._first_us) // rules.rate_limit_window_us
        first = int(window[0])
        counts = np.bincount(window - first)
        if first == self._window:
            counts[0] += self._count
            before = self._count_before
        else:
            before = self._count if first == self._window + 1 else 0
        allowed = rules.rate_limit_hz * rules.rate_limit_window_us / MICROSECONDS
        seen = np.concatenate([[before], counts])[window - first]
        self._window, self._count = int(window[-1]), int(counts[-1])
        self._count_before = int(counts[-2]) if len(counts) > 1 else before
        kept = self._draw(fired, interval, Purpose.RATE_LIMIT) * np.maximum(seen, 1) < allowed
        return fired.take(kept)

    def _draw(
        self, fired: UnsortedEvents, interval: FrameInterval, purpose: Purpose
    ) -> NDArray[np.float64]:
        y, x = np.divmod(fired.pixel, self._width)
        return draw_uniforms(interval.key, y, x, purpose.draw(_order_in_pixel(fired.pixel)))


def _in_order(fired: UnsortedEvents) -> UnsortedEvents:
    """Events by (t, pixel, p, label): an order that does not depend on where they come from."""
    return fired.take(np.lexsort((fired.label, fired.p, fired.pixel, fired.t)))


def _order_in_pixel(pixel: NDArray[np.int64]) -> NDArray[np.int64]:
    """How many earlier events of its pixel there are, for each event; [n]."""
    by_pixel = np.argsort(pixel, kind="stable")
    ordered = pixel[by_pixel]
    is_first = np.concatenate([[True], ordered[1:] != ordered[:-1]])[: len(pixel)]
    place = np.arange(len(pixel))
    order = np.empty(len(pixel), np.int64)
    order[by_pixel] = place - np.maximum.accumulate(np.where(is_first, place, 0))
    return order

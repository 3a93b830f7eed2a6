"""A cap on the event rate, as a readout of limited bandwidth has it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.transform.filters.protocol import Keep

ROUNDING = 4 * float(np.finfo(np.float64).eps)
"""Relative error of a rate that was computed, such as 3 / 700e-6: it means 3 events in 700 µs."""


@dataclass(frozen=True, kw_only=True)
class RateLimitFilter:
    """Keeps the first events of every window of time, up to a rate; later ones of it are lost.

    Windows are half-open and begin at multiples of `window_us`. A window holds whole events: rate
    times length, rounded down.

    Raises:
        ConfigError: a value out of range, or less than one event per window.
    """

    rate_hz: float = 1e7
    """Events per second of the whole sensor."""
    window_us: int = 1000
    """Length of a window, µs."""

    def __post_init__(self) -> None:
        check_range("rate_hz", self.rate_hz, 1e-3, 1e12)
        check_range("window_us", self.window_us, 1, 10**9)
        if self.most < 1:
            raise ConfigError(
                f"rate_hz is {self.rate_hz:g}, less than one event per window of {self.window_us} "
                f"µs; give window_us of at least "
                f"{np.ceil(1e6 / self.rate_hz * (1 - ROUNDING)):.0f}"
            )

    @property
    def most(self) -> int:
        """Events that a window holds."""
        return int(self.rate_hz * self.window_us / 1e6 * (1 + ROUNDING))

    def start(self, events: EventStream | EventPackets) -> Keep:
        """See `EventFilter`."""
        del events
        open_window: int | None = None
        before = 0

        def keep(packet: EventStream) -> NDArray[np.bool_]:
            nonlocal open_window, before
            if not len(packet):
                return np.zeros(0, np.bool_)
            windows = packet.t // self.window_us
            first = np.searchsorted(windows, windows, side="left")
            place = np.arange(len(packet)) - first
            place[windows == open_window] += before
            open_window, before = int(windows[-1]), int(place[-1]) + 1
            return np.asarray(place < self.most)

        return keep

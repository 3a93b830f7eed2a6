"""Filters of rates: anti-flicker and rate limit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_choices, check_range
from texvent.errors import ConfigError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.transform.filters.apply import BLOCK, MOST_BURSTS, NEVER, FlickerLimits, Keep

TICK_US = 128
"""Unit of the sensor's periods, µs."""
DUTY_STEPS = 16
"""Steps of its duty cycle."""
LOWEST_HZ, HIGHEST_HZ = 50, 520
"""Frequencies that the sensors take."""


@dataclass(frozen=True, kw_only=True)
class AntiFlickerFilter:
    """Drops the events of blocks of 4x4 pixels that flicker, as the IMX636 and GenX320 do (AFK).

    A burst of a block starts at an ON event that follows an OFF event of the block. The time since
    the burst before is a period. Each period in the band counts one up, to 7; a shorter one counts
    one down; after a longer one the count restarts. A block flickers from the event on with
    which its count reaches `start_bursts`, until it falls below `stop_bursts` or no burst starts
    for longer than the longest period of the band.

    Source: Prophesee's documentation of event signal processing (blocks of 4x4) and OpenEB 5.1,
    `antiflicker_filter.cpp`: the band, periods in units of 128 µs, the duty cycle in sixteenths,
    the count of 3 bits with its two thresholds, both modes, and all defaults.
    Deviation: what starts a burst is not published, nor what the duty cycle does. Here it is the
    share of the shortest period in which a block that has started a burst starts no other one.

    Raises:
        ConfigError: a value out of range, or the band or the thresholds are the wrong way round.
    """

    low_hz: int = LOWEST_HZ
    """Lowest frequency of the band, Hz."""
    high_hz: int = HIGHEST_HZ
    """Highest frequency of the band, Hz."""
    mode: Literal["band-stop", "band-pass"] = "band-stop"
    """Drop the events of blocks that flicker, or all others."""
    duty_cycle: float = 50.0
    """Duty cycle of the flicker, percent, rounded to sixteenths."""
    start_bursts: int = 6
    """Periodic bursts after which a block flickers."""
    stop_bursts: int = 4
    """Periodic bursts below which it no longer does."""

    def __post_init__(self) -> None:
        check_choices(self)
        for name in ("low_hz", "high_hz"):
            check_range(name, getattr(self, name), LOWEST_HZ, HIGHEST_HZ)
        check_range("duty_cycle", self.duty_cycle, 100 / DUTY_STEPS, 100.0)
        for name in ("start_bursts", "stop_bursts"):
            check_range(name, getattr(self, name), 0, MOST_BURSTS)
        for low, high in (("low_hz", "high_hz"), ("stop_bursts", "start_bursts")):
            if getattr(self, low) > getattr(self, high):
                raise ConfigError(
                    f"{low} is {getattr(self, low)}, above {high}, {getattr(self, high)}; "
                    f"give {low} of at most that"
                )

    @property
    def limits(self) -> FlickerLimits:
        """Limits of flicker in the sensor's units of time."""
        shortest, longest = (1_000_000 // hz // TICK_US for hz in (self.high_hz, self.low_hz))
        off = min(int(DUTY_STEPS * (100.0 - self.duty_cycle) / 100.0 + 0.5), DUTY_STEPS - 1)
        return FlickerLimits(
            shortest_us=shortest * TICK_US,
            longest_us=(longest + 1) * TICK_US - 1,
            hold_us=shortest * TICK_US * (DUTY_STEPS - off) // DUTY_STEPS,
            begin=self.start_bursts,
            end=self.stop_bursts,
        )

    def start(self, events: EventStream | EventPackets) -> Keep:
        """See `EventFilter`."""
        from texvent.transform.filters.kernels_cpu import find_flicker  # brings Numba

        limits = self.limits
        shape = tuple(-(-side // BLOCK) for side in events.size.shape)
        start_us, state = np.full(shape, NEVER, np.int64), np.zeros((3, *shape), np.uint8)
        keeps_flicker = self.mode == "band-pass"

        def keep(packet: EventStream) -> NDArray[np.bool_]:
            found = find_flicker(packet.x, packet.y, packet.t, packet.p, start_us, state, limits)
            return np.asarray(found == keeps_flicker)

        return keep


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

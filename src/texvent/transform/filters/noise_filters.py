"""Filters: background activity, refractory period, hot pixels, masks, rate limit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.errors import ConfigError, InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.transform.filters.apply import NEVER, Keep
from texvent.transform.packets import packets_of

MAX_WINDOW_US = 10**12


@dataclass(frozen=True, kw_only=True)
class BackgroundActivityFilter:
    """Keeps an event if enough pixels around its own fired shortly before it.

    An event is kept if at least `support` of the pixels in the square of side 2 radius + 1 around
    its own, that one left out, fired at most `window_us` before it. Events that are not kept
    support others too, and the order of the stream decides for events of one µs.

    With `support=1` this is the nearest-neighbour filter of Delbruck, "Frame-free dynamic digital
    vision", Intl. Symp. on Secure-Life Electronics, 2008. With more it is the spatiotemporal
    correlation filter (STCF) of Guo and Delbruck, "Low cost and latency event camera background
    activity denoising", TPAMI 2023; with `polarity` only events of the same polarity count.

    Raises:
        ConfigError: a value out of range.
    """

    window_us: int = 10_000
    """Time for which an event supports those around it, µs, included."""
    support: int = 1
    """Neighbours that must have fired."""
    radius: int = 1
    """Radius of the neighbourhood, pixels."""
    polarity: bool = False
    """Whether only events of the same polarity support each other."""

    def __post_init__(self) -> None:
        check_range("window_us", self.window_us, 0, MAX_WINDOW_US)
        check_range("radius", self.radius, 1, 10)
        check_range("support", self.support, 1, (2 * self.radius + 1) ** 2 - 1)

    def start(self, events: EventStream | EventPackets) -> Keep:
        """See `EventFilter`."""
        from texvent.transform.filters.kernels import find_supported  # brings Numba

        height, width = events.size.shape
        last_us = np.full((1 + self.polarity, height, width), NEVER, np.int64)

        def keep(packet: EventStream) -> NDArray[np.bool_]:
            plane = packet.p if self.polarity else np.zeros(len(packet), np.uint8)
            found: NDArray[np.bool_] = find_supported(
                packet.x, packet.y, packet.t, plane, last_us, self.window_us,
                self.support, self.radius,
            )  # fmt: skip
            return found

        return keep


MAX_PERIOD_US = 10**12


@dataclass(frozen=True, kw_only=True)
class RefractoryFilter:
    """Drops an event of a pixel that fired less than `period_us` before.

    The period runs from the last event that was kept, as in a pixel that is held in reset: a
    dropped event does not prolong it. Polarity does not matter.

    Raises:
        ConfigError: a value out of range.
    """

    period_us: int = 1000
    """Time after an event in which its pixel has no other one, µs."""

    def __post_init__(self) -> None:
        check_range("period_us", self.period_us, 0, MAX_PERIOD_US)

    def start(self, events: EventStream | EventPackets) -> Keep:
        """See `EventFilter`."""
        from texvent.transform.filters.kernels import find_rested  # brings Numba

        kept_us = np.full(events.size.shape, NEVER, np.int64)

        def keep(packet: EventStream) -> NDArray[np.bool_]:
            found: NDArray[np.bool_] = find_rested(
                packet.x, packet.y, packet.t, kept_us, self.period_us
            )
            return found

        return keep


LEAST_EVENTS = 40
"""Pixels with fewer events are never hot."""
FACTOR = 5.0
"""Hot pixels fire this many times as often as the second busiest of their eight neighbours: where
an edge passes, two neighbours at least are as busy."""
AROUND = tuple((dy, dx) for dy in (0, 1, 2) for dx in (0, 1, 2) if (dy, dx) != (1, 1))


@dataclass(frozen=True, kw_only=True)
class HotPixelFilter:
    """Drops the events of hot pixels, which it finds by reading the recording once before.

    Raises:
        ConfigError: a value out of range.
    """

    factor: float = FACTOR
    """A hot pixel fires so many times as often as the second busiest of its eight neighbours."""
    least_events: int = LEAST_EVENTS
    """Pixels with fewer events are never hot."""

    def __post_init__(self) -> None:
        check_range("factor", self.factor, 1.0)
        check_range("least_events", self.least_events, 1)

    def start(self, events: EventStream | EventPackets) -> Keep:
        """See `EventFilter`."""
        hot = find_hot_pixels(events, factor=self.factor, least_events=self.least_events)
        return lambda packet: ~hot[packet.y, packet.x]


def find_hot_pixels(
    events: EventStream | EventPackets,
    *,
    factor: float = FACTOR,
    least_events: int = LEAST_EVENTS,
) -> NDArray[np.bool_]:
    """Mask of hot pixels of a recording, [H, W] bool; packets are read once, with flat memory."""
    counts = np.zeros(events.size.width * events.size.height, np.int64)
    for packet in packets_of(events):
        pixel = packet.y.astype(np.int64) * events.size.width + packet.x
        counts += np.bincount(pixel, minlength=counts.size)
    return mask_hot_pixels(
        counts.reshape(events.size.shape), factor=factor, least_events=least_events
    )


def mask_hot_pixels(
    counts: NDArray[np.int64], *, factor: float = FACTOR, least_events: int = LEAST_EVENTS
) -> NDArray[np.bool_]:
    """Mask of the hot pixels, [H, W] bool.

    A pixel is compared with its neighbours, not with the sensor: a busy scene is busy in
    neighbouring pixels too, and the statistics of a sensor depend on the scene.

    Args:
        counts: events per pixel, [H, W].
        factor: see `FACTOR`.
        least_events: see `LEAST_EVENTS`.
    """
    hot = np.zeros(counts.shape, np.bool_)
    y, x = np.nonzero(counts >= least_events)
    if not len(y) or counts.size == 1:
        return hot
    # A mirrored hot pixel would count twice and hide the one at the edge, so the second time those
    # that were found are left out beyond the edge.
    for _ in range(2):
        padded = _mirrored(np.where(hot, 0, counts))
        padded[1:-1, 1:-1] = counts
        neighbours = np.stack([padded[y + dy, x + dx] for dy, dx in AROUND])
        second_busiest = np.sort(neighbours, axis=0)[-2]
        hot[y, x] = counts[y, x] > factor * np.maximum(second_busiest, 1)
    return hot


def _mirrored(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    """Counts with one more pixel on each side, [H + 2, W + 2].

    They are mirrored, so that a line which ends at the sensor's edge has two busy neighbours there
    too. Across a single row or column there is nothing to mirror, and they are 0.
    """
    for axis, length in enumerate(counts.shape):
        width = [(1, 1) if one == axis else (0, 0) for one in range(2)]
        counts = np.pad(counts, width, mode="reflect" if length > 1 else "constant")
    return counts


@dataclass(frozen=True, eq=False)
class MaskFilter:
    """Drops the events of the pixels where a mask is true.

    Raises:
        InputError: the mask is not a two-dimensional array of truth values (found here), or of
            another size than the sensor (found by `start`).
    """

    pixels: NDArray[np.bool_]
    """True where events are left out, [H, W] bool."""

    def __post_init__(self) -> None:
        mask: Any = np.asarray(self.pixels)
        if mask.ndim != 2 or mask.dtype != np.bool_:
            raise InputError(
                f"the mask is {mask.dtype} of shape {mask.shape}; give [height, width] bool, true "
                "where events are left out, such as find_hot_pixels gives"
            )
        object.__setattr__(self, "pixels", mask)

    def start(self, events: EventStream | EventPackets) -> Keep:
        """See `EventFilter`."""
        if self.pixels.shape != events.size.shape:
            height, width = self.pixels.shape
            raise InputError(
                f"the mask is for a sensor of {width}x{height}, the events are of {events.size}; "
                "give a mask of that size"
            )
        return lambda packet: ~self.pixels[packet.y, packet.x]


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

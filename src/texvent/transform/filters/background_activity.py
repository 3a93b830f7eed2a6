"""Background activity: events that no neighbour supports."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.transform.filters.protocol import Keep
from texvent.transform.filters.reference import NEVER

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
    """How long an event supports those around it, µs, included."""
    support: int = 1
    """Neighbours that must have fired."""
    radius: int = 1
    """Of the neighbourhood, pixels."""
    polarity: bool = False
    """Whether only events of the same polarity support each other."""

    def __post_init__(self) -> None:
        check_range("window_us", self.window_us, 0, MAX_WINDOW_US)
        check_range("radius", self.radius, 1, 10)
        check_range("support", self.support, 1, (2 * self.radius + 1) ** 2 - 1)

    def start(self, events: EventStream | EventPackets) -> Keep:
        """See `EventFilter`."""
        from texvent.transform.filters.kernels_cpu import find_supported  # brings Numba

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

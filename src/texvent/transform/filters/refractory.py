"""A refractory period, imposed on a recording."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.transform.filters.protocol import Keep
from texvent.transform.filters.reference import NEVER

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
        from texvent.transform.filters.kernels_cpu import find_rested  # brings Numba

        kept_us = np.full(events.size.shape, NEVER, np.int64)

        def keep(packet: EventStream) -> NDArray[np.bool_]:
            found: NDArray[np.bool_] = find_rested(
                packet.x, packet.y, packet.t, kept_us, self.period_us
            )
            return found

        return keep

"""Event trails: what follows the first events of a burst of one pixel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_choices, check_range
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.transform.filters.protocol import Keep
from texvent.transform.filters.reference import NEVER

MAX_THRESHOLD_US = 10**12
LATER = 3
"""Place in its burst of every event after the second one."""
KEPT = {"trail": (1,), "stc-cut-trail": (2,), "stc-keep-trail": (2, LATER)}
"""Mode → places in its burst of the events that stay."""


@dataclass(frozen=True, kw_only=True)
class EventTrailFilter:
    """Keeps the first or the second event of every burst, as the IMX636 and GenX320 do.

    A burst is a series of events of one pixel and one polarity, each less than `threshold_us`
    after the one before. `trail` keeps the first event of a burst. `stc-cut-trail` keeps the
    second event, so that single events vanish; `stc-keep-trail` keeps the second and all later
    ones (STC: spatio-temporal contrast).

    Source: `I_EventTrailFilterModule` of Prophesee's OpenEB 5.1 and the description of
    `TrailFilterAlgorithm` (an event passes if the last one of its pixel had the other polarity, or
    was at least the threshold before). The sensors take 1,000 to 100,000 µs, in whole ms.
    Deviation: a pause of the threshold begins a new burst in every mode. OpenEB says so of bursts
    in general, but also says "after a polarity change" of both STC modes.

    Raises:
        ConfigError: a value out of range.
    """

    mode: Literal["trail", "stc-cut-trail", "stc-keep-trail"] = "stc-cut-trail"
    """Which events of a burst stay: the first, the second, or all from the second on."""
    threshold_us: int = 10_000
    """Time without an event after which a burst is over, µs."""

    def __post_init__(self) -> None:
        check_choices(self)
        check_range("threshold_us", self.threshold_us, 1, MAX_THRESHOLD_US)

    def start(self, events: EventStream | EventPackets) -> Keep:
        """See `EventFilter`."""
        from texvent.transform.filters.kernels_cpu import find_places_in_bursts  # brings Numba

        last_us = np.full(events.size.shape, NEVER, np.int64)
        burst = np.zeros((2, *events.size.shape), np.uint8)
        kept = np.isin(np.arange(LATER + 1), KEPT[self.mode])

        def keep(packet: EventStream) -> NDArray[np.bool_]:
            places = find_places_in_bursts(
                packet.x, packet.y, packet.t, packet.p, last_us, burst, self.threshold_us
            )
            return np.asarray(kept[places])

        return keep

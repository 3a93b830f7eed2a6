"""Pixels whose events are left out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.transform.filters.protocol import Keep


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

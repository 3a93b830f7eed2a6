"""Events of v2e's crossing pixels, and the reset of their references: types and kernel."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.mismatch import PixelMismatch
from texvent.simulate.v2e.low_pass import CrossingPixels, Float64Array, V2ePixelState


class LastEvents(NamedTuple):
    """What pixels know of their last events; [n] each."""

    fired_us: NDArray[np.int64]
    """Time of the last event that counts for the refractory period, µs."""
    interval_us: NDArray[np.int64]
    """End of the interval of the last event of any kind, µs."""
    noise: Float64Array
    """Noise of the photoreceptor then, log units; [0] without."""


class EmissionRules(NamedTuple):
    """Where the events are in time and space, and the refractory period."""

    interval: FrameInterval
    refractory_us: int
    shape: tuple[int, int]
    """(height, width) of the sensor."""


EmitAndReset: TypeAlias = Callable[
    [
        CrossingPixels,
        tuple[PixelMismatch, V2ePixelState],
        LastEvents,
        UnsortedEvents,
        EmissionRules,
    ],
    UnsortedEvents | SortedEvents,
]
"""`emit_and_reset(crossing, (mismatch, state), last, noise, rules)`, see
`reference.emit_and_reset`."""
EMIT_AND_RESET = Kernel[EmitAndReset](__name__, "emit_and_reset")

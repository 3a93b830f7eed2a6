"""What a kernel gets and gives when v2e's pixels fire and memorise the level that they fired at."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import AUTO, load_kernel_when_ready
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.v2e.kernels.low_pass import Float64Array, Pixels, PixelState, Restless


class LastEvents(NamedTuple):
    """What pixels know of their last events; [n] each."""

    fired_us: NDArray[np.int64]
    """When the last event was that counts for the refractory period, µs."""
    interval_us: NDArray[np.int64]
    """End of the interval of the last event of any kind, µs."""
    voltage: Float64Array | None
    """Noise of the photoreceptor then; None without."""


class Rules(NamedTuple):
    """Where the events are, and how long their pixels rest."""

    interval: FrameInterval
    refractory_us: int
    shape: tuple[int, int]
    """(height, width) of the sensor."""


FireAndMemorise: TypeAlias = Callable[
    [Restless, tuple[Pixels, PixelState], LastEvents, UnsortedEvents, Rules],
    UnsortedEvents | SortedEvents,
]
"""`fire_and_memorise(restless, (pixels, state), last, noise, rules)`, see
`memorise_reference.fire_and_memorise`."""


def load_fire_and_memorise(backend: str = AUTO) -> FireAndMemorise:
    """The function of a backend; "auto" is NumPy until the compiled one is ready.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    return cast("FireAndMemorise", load_kernel_when_ready(__name__, "fire_and_memorise", backend))

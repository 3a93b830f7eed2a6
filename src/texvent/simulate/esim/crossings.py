"""Threshold crossings of ESIM's pixels in one interval: input, state, and kernel by backend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel
from texvent.simulate.crossing.ramp import RefractoryPeriod
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.random.mismatch import Thresholds

Float64Array: TypeAlias = NDArray[np.float64]


class RampPixels(NamedTuple):
    """Pixels that may fire, and their luma or brightness at both ends; [n] each."""

    pixel: NDArray[np.int64]
    """Flat index, ascending."""
    before: NDArray[Any]
    """At the start: luma if there is a table, else brightness."""
    now: NDArray[Any]
    """At the end, likewise."""
    table: Float64Array | None
    """[256] brightness of 8-bit luma, or None."""
    thresholds: Thresholds
    """Of these pixels."""


class References(NamedTuple):
    """What pixels remember of their last event; a kernel changes both."""

    reference: Float64Array
    """[H · W] brightness at the last event, log units."""
    fired_us: NDArray[np.int64]
    """[H · W] time of the last event, µs; not looked at, so also [0], without a refractory
    period."""


CrossThresholds: TypeAlias = Callable[
    [RampPixels, References, tuple[int, int], RefractoryPeriod, tuple[int, int]], SortedEvents
]
"""`cross_thresholds(pixels, references, (start_us, stop_us), refractory, (height, width))`, see
`reference.cross_thresholds`."""
CROSS_THRESHOLDS = Kernel[CrossThresholds](__name__, "cross_thresholds")

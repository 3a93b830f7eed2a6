"""Threshold crossings of ESIM's pixels in one interval: input, state, and kernel by backend.

`reference.py` (`cross_thresholds`) defines when a pixel crosses; `crossings_cpu.py` is its compiled
form. Both solve the linear ramp of `simulate/crossing/ramp_reference.py`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel
from texvent.simulate.crossing.ramp import RefractoryPeriod
from texvent.simulate.esim.segments import CrossingState
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


CrossThresholds: TypeAlias = Callable[
    [RampPixels, CrossingState, tuple[int, int], RefractoryPeriod, tuple[int, int]], SortedEvents
]
"""`cross_thresholds(pixels, references, (start_us, stop_us), refractory, (height, width))`, see
`reference.cross_thresholds`."""
CROSS_THRESHOLDS = Kernel[CrossThresholds](__name__, "cross_thresholds")

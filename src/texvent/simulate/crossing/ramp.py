"""Threshold crossings of brightness that changes in a straight line between two frames.

ESIM and v2e share them. Both compare the brightness of a pixel with its reference, fire at every
threshold that is crossed, and move the reference by one threshold per event.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.random.mismatch import Thresholds

Float64Array: TypeAlias = NDArray[np.float64]


class Ramp(NamedTuple):
    """Change of some pixels against their references, a straight line in time, log units."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x, ascending: all pixels that may fire."""
    start: Float64Array
    """[n] change at the start of the interval."""
    stop: Float64Array
    """[n] change at its end."""
    threshold_on: Float64Array
    """[n] above 0."""
    threshold_off: Float64Array
    """[n] above 0."""


class RefractoryPeriod(NamedTuple):
    """How long a pixel cannot fire after an event."""

    period_us: int
    """µs; 0 is none."""
    is_level_lost: bool
    """Whether a crossing within the period is lost (ESIM: the reference moves past it) or may still
    fire in a later interval (v2e: the reference stays)."""


class RampCrossings(NamedTuple):
    """Events of one interval, by pixel in row-major order, then in time."""

    pixel: NDArray[np.int64]
    """[m] flat index."""
    t: NDArray[np.int64]
    """[m] times, µs."""
    p: NDArray[np.uint8]
    """[m] 1 = ON, 0 = OFF."""
    steps: NDArray[np.int64]
    """[n] by how many thresholds the reference of each pixel of the ramp moves; OFF below 0."""


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
`ramp_reference.cross_thresholds`."""
CROSS_THRESHOLDS = Kernel[CrossThresholds](__name__, "cross_thresholds")

"""Threshold crossings of brightness that changes in a straight line between two frames.

ESIM and v2e share them. Both compare the brightness of a pixel with its reference, fire at every
threshold that is crossed, and move the reference by one threshold per event.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

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

"""Threshold crossings of brightness that is piecewise linear in time, pixel by pixel.

The pixel compares brightness with a reference, fires at every threshold crossed, at the time of
the crossing, and its reference moves in steps. The fused pass lists some segments of some pixels;
`crossings.py` is for whole frames.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel
from texvent.simulate.fused.definitions import Float64Array, Int64Array


class Segments(NamedTuple):
    """Linear segments, a row each, by pixel and then in time; segments may be left out."""

    pixel: Int64Array
    """[n] flat index y · W + x."""
    start_us: Int64Array
    """[n] µs."""
    stop_us: Int64Array
    """[n] µs, after the start."""
    before: Float64Array
    """[n] brightness at the start, log units."""
    now: Float64Array
    """[n] brightness at the stop, log units."""


class CrossingRules(NamedTuple):
    """When a pixel fires."""

    threshold_on: float
    """Log units, above 0."""
    threshold_off: float
    """Log units, above 0."""
    refractory_us: int
    """Time after an event in which crossings are lost; 0 is none."""


class CrossingState(NamedTuple):
    """State of the pixels; kernels change it in place."""

    reference: Float64Array
    """[H · W] reference brightness, log units."""
    fired_us: Int64Array
    """[H · W] time of the last event, µs; not used, and [0], without a refractory period."""


class SegmentCrossings(NamedTuple):
    """Events, by pixel and then in time."""

    row: Int64Array
    """[n] number of the segment that the event lies on."""
    t: Int64Array
    """[n] µs."""
    p: NDArray[np.uint8]
    """[n] 1 = ON, 0 = OFF."""


CrossSegments: TypeAlias = Callable[[Segments, CrossingRules, CrossingState], SegmentCrossings]
CROSS_SEGMENTS = Kernel[CrossSegments](__name__, "cross_segments")
"""`cross_segments(segments, rules, state)`, see `segments_reference.cross_segments`."""

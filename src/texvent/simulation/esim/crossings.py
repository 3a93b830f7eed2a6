"""Threshold crossings of ESIM's pixels in an interval, compiled.

The pixel compares brightness with a reference, fires at every threshold crossed, at the time of
the crossing, and its reference moves in steps.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import take_scratch
from texvent.simulation.crossing.ramp import (
    RampChanges,
    RefractoryPeriod,
    key_layout,
    list_crossing_keys,
)
from texvent.simulation.kernels.radix_sort import sort_keyed_events
from texvent.simulation.packets import SortedEvents
from texvent.simulation.random.mismatch import Thresholds

Float64Array: TypeAlias = NDArray[np.float64]


class CrossingState(NamedTuple):
    """State of the pixels; kernels change it in place."""

    reference: Float64Array
    """[H · W] reference brightness, log units."""
    fired_us: NDArray[np.int64]
    """[H · W] time of the last event, µs; not used, and [0], without a refractory period."""


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
    """Thresholds of these pixels."""


def cross_thresholds(
    pixels: RampPixels,
    references: CrossingState,
    span_us: tuple[int, int],
    refractory: RefractoryPeriod,
    shape: tuple[int, int],
) -> SortedEvents:
    """Threshold crossings of some pixels in an interval; moves their references.

    Brightness is a straight line between the frames; `crossing.ramp` has the times.

    Args:
        pixels: those that may fire, and their brightness at both ends.
        references: what they compare with; changed in place.
        span_us: start (included) and stop (excluded) of the interval, µs.
        refractory: the refractory period.
        shape: (height, width) of the sensor.

    Returns:
        The events in the order of a packet, all of them signal.

    Raises:
        InputError: the interval is too long for a sensor of this size.

    Source: Rebecq, Gehrig and Scaramuzza, "ESIM: an open event camera simulator", CoRL 2018,
        section 3.1.
    """
    layout = key_layout(span_us, shape)
    # Numba leaves out branches for arguments that are None, but not for their fields.
    pixel, before, now, table, thresholds = pixels
    start, stop, threshold = (
        take_scratch(use, len(pixel), np.float64) for use in ("start", "stop", "threshold")
    )
    changes = RampChanges(start, stop, threshold, take_scratch("steps", len(pixel), np.int64))
    _compare((pixel, before, now), table, references.reference, changes)
    fired_us = references.fired_us
    keys = list_crossing_keys(pixel, changes, thresholds, fired_us, layout, refractory)
    _step(pixel, changes, references.reference)
    return sort_keyed_events(keys, span_us, shape)


@jit
def _compare(
    pixels: tuple[NDArray[np.int64], NDArray[Any], NDArray[Any]],
    table: Float64Array | None,
    reference: Float64Array,
    changes: RampChanges,
) -> None:
    """Fill in the changes against the references."""
    pixel, before, now = pixels
    start, stop, _, _ = changes
    for n in range(pixel.size):
        level = reference[np.uint64(pixel[n])]
        if table is not None:
            start[n], stop[n] = table[before[n]] - level, table[now[n]] - level
        else:
            start[n], stop[n] = before[n] - level, now[n] - level


@jit
def _step(pixel: NDArray[np.int64], changes: RampChanges, reference: Float64Array) -> None:
    """Move the references by the thresholds crossed."""
    _, _, threshold, steps = changes
    for n in range(pixel.size):
        reference[np.uint64(pixel[n])] += steps[n] * threshold[n]

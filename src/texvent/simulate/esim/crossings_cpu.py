"""ESIM's crossing times, compiled by Numba: the reference's bits.

Each crossing is one 64-bit key of `packets.sorting_cpu`; a packet needs no further columns.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.scratch import take_scratch
from texvent.simulate.crossing.ramp import RefractoryPeriod
from texvent.simulate.crossing.ramp_cpu import (
    RampChanges,
    count_crossings,
    key_layout,
    list_crossing_keys,
)
from texvent.simulate.esim import reference
from texvent.simulate.esim.crossings import Float64Array, RampPixels
from texvent.simulate.esim.segments import CrossingState
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.sorting_cpu import sort_keyed_events


def cross_thresholds(
    pixels: RampPixels,
    references: CrossingState,
    span_us: tuple[int, int],
    refractory: RefractoryPeriod,
    shape: tuple[int, int],
) -> SortedEvents:
    """See `reference.cross_thresholds`."""
    layout = key_layout(span_us, shape)
    if layout is None:
        return reference.cross_thresholds(pixels, references, span_us, refractory, shape)
    # Numba leaves out branches for arguments that are None, but not for their fields.
    pixel, before, now, table, thresholds = pixels
    start, stop, threshold = (
        take_scratch(use, len(pixel), np.float64) for use in ("start", "stop", "threshold")
    )
    changes = RampChanges(start, stop, threshold, take_scratch("steps", len(pixel), np.int64))
    _compare((pixel, before, now), table, references.reference, changes)
    count_crossings(changes, thresholds)
    keys = list_crossing_keys(pixel, changes, references.fired_us, layout, refractory)
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
        level = reference[pixel[n]]
        if table is not None:
            start[n], stop[n] = table[before[n]] - level, table[now[n]] - level
        else:
            start[n], stop[n] = before[n] - level, now[n] - level


@jit
def _step(pixel: NDArray[np.int64], changes: RampChanges, reference: Float64Array) -> None:
    """Move the references by the thresholds crossed."""
    _, _, threshold, steps = changes
    for n in range(pixel.size):
        reference[pixel[n]] += steps[n] * threshold[n]

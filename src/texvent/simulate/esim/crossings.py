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
from texvent.simulate.crossing.ramp import (
    FEW,
    NO_LEVEL,
    KeyLayout,
    RampChanges,
    RefractoryPeriod,
    add_up,
    count_crossings,
    drop_refractory,
    key_layout,
    list_crossings,
)
from texvent.simulate.kernels.active_pixels import grown
from texvent.simulate.kernels.radix_sort import KEY_USES, sort_keyed_events
from texvent.simulate.packets import SortedEvents, check_event_number, most_events
from texvent.simulate.random.mismatch import Thresholds

SOME = 1024
"""Pixels that are gone through together: what is computed of them stays in the first cache."""
USUAL = 3
"""Events per pixel for which there is room at first."""
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
    """Of these pixels."""


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
    keys = take_scratch(KEY_USES[0], USUAL * len(pixel) + FEW, np.uint64)
    keys, number = _cross(
        (pixel, before, now), table, thresholds, references, layout, refractory, most_events(), keys
    )
    check_event_number(number)
    return sort_keyed_events(keys[:number], span_us, shape)


@jit(error_model="numpy")
def _cross(
    pixels: tuple[NDArray[np.int64], NDArray[Any], NDArray[Any]],
    table: Float64Array | None,
    thresholds: Thresholds,
    references: CrossingState,
    layout: KeyLayout,
    refractory: RefractoryPeriod,
    most: int,
    keys: NDArray[np.uint64],
) -> tuple[NDArray[np.uint64], int]:
    """Keys of all events, by pixel and then in time, and how many; ends beyond `most`.

    Some pixels at a time, whose numbers stay in the first cache.
    """
    pixel, before, now = pixels
    on, off = thresholds
    room, found = (
        RampChanges(np.empty(SOME), np.empty(SOME), np.empty(SOME), np.empty(SOME, np.int64)),
        0,
    )
    for first in range(0, pixel.size, SOME):
        part = slice(first, min(first + SOME, pixel.size))
        size = part.stop - first
        start, stop, threshold, steps = room
        changes = RampChanges(start[:size], stop[:size], threshold[:size], steps[:size])
        own = Thresholds(on[part], off[part]) if on.size > 1 else thresholds
        _compare((pixel[part], before[part], now[part]), table, references.reference, changes)
        count_crossings(changes, own)
        number = add_up(changes.steps)
        if found + number > most:
            return keys, found + number
        if found + number + FEW > keys.size:
            keys = grown(keys, 2 * (found + number + FEW))
        list_crossings(pixel[part], changes, NO_LEVEL, layout, keys[found:])
        if refractory.period_us > 0:
            number = drop_refractory(
                pixel[part], changes.steps, references.fired_us, layout, refractory, keys[found:]
            )
        found += number
        _step(pixel[part], changes, references.reference)
    return keys, found


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

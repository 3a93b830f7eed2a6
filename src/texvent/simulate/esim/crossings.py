"""Threshold crossings of ESIM's pixels, compiled: in one interval, and on segments of a pair.

The pixel compares brightness with a reference, fires at every threshold crossed, at the time of
the crossing, and its reference moves in steps. `cross_thresholds` is for whole frames;
`cross_segments` for the segments that the fused pass lists.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.scratch import take_scratch
from texvent.simulate.crossing.ramp import (
    RampChanges,
    RefractoryPeriod,
    count_crossings,
    key_layout,
    list_crossing_keys,
)
from texvent.simulate.fused.bounds import Float64Array, Int64Array
from texvent.simulate.kernels.active_pixels import grown
from texvent.simulate.kernels.radix_sort import sort_keyed_events
from texvent.simulate.packets import SortedEvents
from texvent.simulate.random.mismatch import Thresholds


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
    """Thresholds and refractory period."""

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
    """[n] number of the event's segment."""
    t: Int64Array
    """[n] µs."""
    p: NDArray[np.uint8]
    """[n] 1 = ON, 0 = OFF."""


Events = tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.uint8]]


def cross_segments(
    segments: Segments, rules: CrossingRules, state: CrossingState
) -> SegmentCrossings:
    """Threshold crossings of brightness on linear segments, at the times of the crossings.

    On a segment the change is d(u) = start + u · (stop − start), u in 0..1, log units. The
    k-th ON event happens where d reaches k · θ_on, the k-th OFF event where it reaches −k · θ_off,
    for every k that the stop has reached; a level that the start had reached fires at once.
    The reference then moves by k · θ, also over crossings that fell into the refractory period.

    Args:
        segments: linear segments, by pixel and then in time.
        rules: thresholds and refractory period.
        state: updated in place.

    Returns:
        The events, times rounded down, never the stop of their segment.
    """
    found, (row, t, p) = _cross(segments, rules, state)
    return SegmentCrossings(row[:found], t[:found], p[:found])


@jit
def _cross(segments: Segments, rules: CrossingRules, state: CrossingState) -> tuple[int, Events]:
    # Unpacked once: Numba counts references to every array that it takes out of a tuple.
    pixel, starts, stops, befores, nows = segments
    reference, fired_us = state
    room = 2 * pixel.size
    rows, times, polarities = (
        np.empty(room, np.int64),
        np.empty(room, np.int64),
        np.empty(room, np.uint8),
    )
    found = 0
    for k in range(pixel.size):
        i, start_us, stop_us = pixel[k], starts[k], stops[k]
        first, last = befores[k] - reference[i], nows[k] - reference[i]
        sign = 1 if last > 0 else -1
        threshold = rules.threshold_on if sign > 0 else rules.threshold_off
        first, last = sign * first, sign * last
        passed = 0
        while last >= (passed + 1) * threshold:
            passed += 1
        if found + passed > rows.size:
            room = 2 * rows.size + passed
            rows, times, polarities = grown(rows, room), grown(times, room), grown(polarities, room)
        for number in range(1, passed + 1):
            level = number * threshold
            fraction = (level - first) / (last - first) if first < level else 0.0
            t = min(start_us + math.floor(fraction * (stop_us - start_us)), stop_us - 1)
            if rules.refractory_us:
                if t - fired_us[i] < rules.refractory_us:
                    continue
                fired_us[i] = t
            rows[found], times[found], polarities[found] = k, t, sign > 0
            found += 1
        reference[i] += sign * passed * threshold
    return found, (rows, times, polarities)


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

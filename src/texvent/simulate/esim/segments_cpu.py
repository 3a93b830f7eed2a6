"""Threshold crossings on linear segments, compiled by Numba: the reference's bits."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulate.backend.lanes_cpu import grown
from texvent.simulate.esim.segments import CrossingRules, CrossingState, SegmentCrossings, Segments

Events = tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.uint8]]


def cross_segments(
    segments: Segments, rules: CrossingRules, state: CrossingState
) -> SegmentCrossings:
    """Every threshold that brightness crosses; see `segments_reference.cross_segments`."""
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

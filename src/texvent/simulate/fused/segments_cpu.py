"""Threshold crossings on linear segments, compiled by Numba: the reference's bits."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulate.fused.segments import CrossingRules, CrossingState, SegmentCrossings, Segments

Events = tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.uint8]]


def cross_segments(
    segments: Segments, rules: CrossingRules, state: CrossingState
) -> SegmentCrossings:
    """Every threshold that brightness crosses; see `pieces_reference.cross_segments`."""
    found, (row, t, p) = _cross(segments, rules, state)
    return SegmentCrossings(row[:found], t[:found], p[:found])


def warm_up() -> None:
    """Compile everything, or load what was compiled before."""
    one, level = np.ones(1, np.int64), np.zeros(1)
    state = CrossingState(level.copy(), one.copy())
    cross_segments(Segments(one - 1, one, one + 1, level, level), CrossingRules(1.0, 1.0, 0), state)


@jit
def _cross(segments: Segments, rules: CrossingRules, state: CrossingState) -> tuple[int, Events]:
    # Unpacked once: Numba counts references to every array that it takes out of a tuple.
    pixel, starts, stops, befores, nows = segments
    reference, fired_us = state
    rows, times, polarities = _events(2 * pixel.size)
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
            rows, times, polarities = _grown((rows, times, polarities), passed)
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


@jit
def _events(size: int) -> Events:
    return np.empty(size, np.int64), np.empty(size, np.int64), np.empty(size, np.uint8)


@jit
def _grown(events: Events, least: int) -> Events:
    """The same events with more room."""
    size = events[0].size
    larger = _events(2 * size + least)
    larger[0][:size] = events[0]
    larger[1][:size] = events[1]
    larger[2][:size] = events[2]
    return larger

"""Threshold crossings on straight pieces, compiled by Numba: the reference's bits."""

from __future__ import annotations

import math

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.engine.kernels.pieces import LineCrossings, LineRules, LineState, Pieces

Events = tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.uint8]]


def cross_pieces(pieces: Pieces, rules: LineRules, state: LineState) -> LineCrossings:
    """Every threshold that brightness crosses; see `pieces_reference.cross_pieces`."""
    found, (pixel, t, p) = _cross(pieces, rules, state)
    return LineCrossings(pixel[:found], t[:found], p[:found])


@numba.njit(cache=True, nogil=True)
def _cross(pieces: Pieces, rules: LineRules, state: LineState) -> tuple[int, Events]:
    pixel, starts, stops, befores, nows = pieces
    reference, fired_us = state
    found, events = 0, _events(pixel.size)
    for k in range(pixel.size):
        i, start_us, stop_us = pixel[k], starts[k], stops[k]
        first, last = befores[k] - reference[i], nows[k] - reference[i]
        sign = 1 if last > 0 else -1
        threshold = rules.threshold_on if sign > 0 else rules.threshold_off
        first, last = sign * first, sign * last
        passed = 0
        while last >= (passed + 1) * threshold:
            passed += 1
            level = passed * threshold
            fraction = (level - first) / (last - first) if first < level else 0.0
            t = min(start_us + math.floor(fraction * (stop_us - start_us)), stop_us - 1)
            if t - fired_us[i] >= rules.refractory_us:
                fired_us[i] = t
                if found == events[0].size:
                    events = _grown(events)
                events[0][found], events[1][found], events[2][found] = i, t, sign > 0
                found += 1
        reference[i] += sign * passed * threshold
    return found, events


@numba.njit(cache=True, nogil=True)
def _events(size: int) -> Events:
    return np.empty(size, np.int64), np.empty(size, np.int64), np.empty(size, np.uint8)


@numba.njit(cache=True, nogil=True)
def _grown(events: Events) -> Events:
    """The same events with room for as many again."""
    size = events[0].size
    larger = _events(2 * size + 16)
    larger[0][:size] = events[0]
    larger[1][:size] = events[1]
    larger[2][:size] = events[2]
    return larger

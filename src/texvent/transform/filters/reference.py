"""The definitions of the filters that look at one event after the other, in plain Python.

`kernels_cpu` is the compiled form; tests hold both to equal results.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

NEVER = -(2**62)
"""Stands for the time of a pixel that has not fired, µs; no event is that early."""

UInt16Array = NDArray[np.uint16]
Int64Array = NDArray[np.int64]


def find_supported(
    x: UInt16Array,
    y: UInt16Array,
    t: Int64Array,
    plane: NDArray[np.uint8],
    last_us: Int64Array,
    window_us: int,
    support: int,
    radius: int,
) -> NDArray[np.bool_]:
    """Which events enough neighbours support, [n].

    Args:
        x: columns, [n].
        y: rows, [n].
        t: times, µs, [n], non-decreasing.
        plane: which plane of `last_us` an event is in, [n].
        last_us: time of the last event of each pixel, [planes, H, W]; changed.
        window_us: how long an event supports its neighbours, µs.
        support: neighbours that must have fired.
        radius: of the neighbourhood, pixels.
    """
    supported = np.zeros(len(t), np.bool_)
    for event in range(len(t)):
        column, row, seen = int(x[event]), int(y[event]), last_us[plane[event]]
        around = seen[
            max(row - radius, 0) : row + radius + 1, max(column - radius, 0) : column + radius + 1
        ]
        is_recent = (around != NEVER) & (t[event] - around <= window_us)
        own = seen[row, column]
        is_own_recent = own != NEVER and t[event] - own <= window_us
        supported[event] = is_recent.sum() - is_own_recent >= support
        seen[row, column] = t[event]
    return supported


def find_rested(
    x: UInt16Array, y: UInt16Array, t: Int64Array, kept_us: Int64Array, period_us: int
) -> NDArray[np.bool_]:
    """Which events come at least a period after the one before of their pixel that was kept, [n].

    Args:
        x: columns, [n].
        y: rows, [n].
        t: times, µs, [n], non-decreasing.
        kept_us: time of the last event of each pixel that was kept, [H, W]; changed.
        period_us: the refractory period, µs.
    """
    rested = np.zeros(len(t), np.bool_)
    for event in range(len(t)):
        pixel = int(y[event]), int(x[event])
        if kept_us[pixel] == NEVER or t[event] - kept_us[pixel] >= period_us:
            rested[event] = True
            kept_us[pixel] = t[event]
    return rested


def find_places_in_bursts(
    x: UInt16Array,
    y: UInt16Array,
    t: Int64Array,
    p: NDArray[np.uint8],
    last_us: Int64Array,
    burst: NDArray[np.uint8],
    threshold_us: int,
) -> NDArray[np.uint8]:
    """Which event of its burst each event is, [n]: 1, 2, or 3 for all later ones.

    A burst is a series of events of one pixel and one polarity, each less than the threshold after
    the one before.

    Args:
        x: columns, [n].
        y: rows, [n].
        t: times, µs, [n], non-decreasing.
        p: polarities, [n].
        last_us: time of the last event of each pixel, [H, W]; changed.
        burst: its polarity and its place in its burst, [2, H, W]; changed.
        threshold_us: time without an event after which a burst is over, µs.
    """
    places = np.zeros(len(t), np.uint8)
    polarity, place = burst
    for event in range(len(t)):
        pixel = int(y[event]), int(x[event])
        is_first = (
            last_us[pixel] == NEVER
            or polarity[pixel] != p[event]
            or t[event] - last_us[pixel] >= threshold_us
        )
        place[pixel] = 1 if is_first else min(int(place[pixel]) + 1, 3)
        polarity[pixel], last_us[pixel] = p[event], t[event]
        places[event] = place[pixel]
    return places


BLOCK = 4
"""Side of the blocks of pixels in which flicker is found, as in the IMX636."""
MOST_BURSTS = 7
"""Where the count of periodic bursts stops: 3 bits."""


class FlickerLimits(NamedTuple):
    """What counts as flicker."""

    shortest_us: int
    """Period of the highest frequency, µs."""
    longest_us: int
    """Period of the lowest frequency, µs."""
    hold_us: int
    """Time after the start of a burst in which no other one starts, µs."""
    begin: int
    """Periodic bursts from which a block flickers."""
    end: int
    """Periodic bursts below which it no longer does."""


def find_flicker(
    x: UInt16Array,
    y: UInt16Array,
    t: Int64Array,
    p: NDArray[np.uint8],
    start_us: Int64Array,
    state: NDArray[np.uint8],
    limits: FlickerLimits,
) -> NDArray[np.bool_]:
    """Which events lie in a block of pixels that flickers, [n].

    A burst of a block starts at an ON event that follows an OFF event of the block. A burst that
    starts within the band's periods after the one before counts up, an earlier one counts down,
    and a later one starts anew.

    Args:
        x: columns, [n].
        y: rows, [n].
        t: times, µs, [n], non-decreasing.
        p: polarities, [n].
        start_us: when the last burst of each block started, [H, W] in blocks; changed.
        state: whether its last event was ON, its count, and whether it flickers, [3, H, W];
            changed.
        limits: what counts as flicker.
    """
    found = np.zeros(len(t), np.bool_)
    was_on, count, flickers = state
    for event in range(len(t)):
        block = int(y[event]) // BLOCK, int(x[event]) // BLOCK
        is_new = start_us[block] == NEVER or t[event] - start_us[block] > limits.longest_us
        if is_new:
            count[block] = flickers[block] = 0
        if p[event] == 1 and not was_on[block]:
            if is_new:
                start_us[block] = t[event]
            elif t[event] - start_us[block] >= limits.hold_us:
                is_periodic = t[event] - start_us[block] >= limits.shortest_us
                step = 1 if is_periodic else -1
                count[block] = min(max(int(count[block]) + step, 0), MOST_BURSTS)
                if count[block] >= limits.begin:
                    flickers[block] = 1
                elif count[block] < limits.end:
                    flickers[block] = 0
                start_us[block] = t[event]
        was_on[block] = p[event]
        found[event] = flickers[block] == 1
    return found

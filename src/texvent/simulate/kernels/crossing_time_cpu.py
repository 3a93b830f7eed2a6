"""`crossing_time`, compiled by Numba to be called in kernels: same bits, many pixels at a time.

Lanes are the columns of one array, whose rows are the numbers of a course: loops over few rows each
fill vector registers, and Numba counts the references to one array instead of twenty. Only lanes on
a curve that meets a threshold are solved for, side by side at the end of the same rows.
"""

from __future__ import annotations

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.crossing_time import (
    LAST_STEP,
    MOST_STEPS,
    NEGLIGIBLE,
    NEVER,
    Course,
    Float64Array,
)
from texvent.simulate.kernels.elementary_cpu import exponential, natural_log

CHANGE, SLOPE, TRANSIENT, CORNER, ROOM, KEPT, ON, OFF = range(8)
"""Rows that say how a lane goes on, see `crossing_time.Course`, and its thresholds."""
WAIT, RISES = 8, 9
"""Rows that say when it gets to a threshold, and 1 for ON, 0 for OFF."""
TURN, STOP, LEFT, LEVEL = 10, 11, 12, 13
"""Scratch: when the curve turns round or else the room ends, and what it has come to then."""
ROWS = 14
TARGET, START, END, KEPT_FIRST, KEPT_LAST, FIRST, LAST, U, BUSY = range(4, 13)
"""Rows of lanes that are solved for, besides the first four: the arc, see `crossing_time._Arc`, and
how far the solution has got."""


def time_to_threshold(
    course: Course, on: Float64Array, off: Float64Array
) -> tuple[Float64Array, NDArray[np.uint8]]:
    """See `crossing_time.time_to_threshold`."""
    rows = np.empty((ROWS, len(on)))
    rows[:8] = (*course, on, off)
    with np.errstate(all="ignore"):
        find_crossings(rows, np.empty((ROWS, len(on))), np.empty(len(on), np.int64), len(on))
    return rows[WAIT], rows[RISES].astype(np.uint8)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def find_crossings(
    rows: Float64Array, solving: Float64Array, lane: NDArray[np.int64], size: int
) -> None:
    """Fill in `WAIT` and `RISES` of the first lanes.

    Args:
        rows: [ROWS, room]; those of the course are given.
        solving: [ROWS, room], scratch.
        lane: [room], scratch.
        size: how many lanes.
    """
    _along_line(rows, size)
    _turn(rows, size)
    busy = _choose_arcs(rows, solving, lane, size)
    _solve(solving, busy)
    for k in range(busy):
        rows[WAIT, lane[k]] = solving[U, k]


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _along_line(rows: Float64Array, size: int) -> None:
    for j in range(size):
        change, slope = rows[CHANGE, j], rows[SLOPE, j]
        target = rows[ON, j] if slope > 0 else -rows[OFF, j]
        wait = (target - change) / slope
        is_late = (slope == 0) | (wait > rows[ROOM, j])
        rows[WAIT, j], rows[RISES, j] = NEVER if is_late else wait, 1.0 if slope > 0 else 0.0
    for j in range(size):
        is_over, is_under = rows[CHANGE, j] >= rows[ON, j], -rows[CHANGE, j] >= rows[OFF, j]
        rows[WAIT, j] = 0.0 if is_over | is_under else rows[WAIT, j]
        rows[RISES, j] = 1.0 if is_over else (0.0 if is_under else rows[RISES, j])


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _turn(rows: Float64Array, size: int) -> None:
    """Where the first arc of a curve ends; see `crossing_time._along_curve`."""
    for j in range(size):
        slope, corner = rows[SLOPE, j], rows[CORNER, j]
        kick = corner * rows[TRANSIENT, j]
        turns = (slope + kick) * slope < 0
        ratio = -kick / slope if turns else 1.0
        turn = natural_log(ratio) / corner if turns else NEVER
        is_first = turn >= rows[ROOM, j]
        rows[TURN, j] = turn
        rows[STOP, j] = rows[ROOM, j] if is_first else turn
        rows[LEFT, j] = rows[KEPT, j] if is_first else 1.0 / ratio
    for j in range(size):
        line = rows[CHANGE, j] + rows[SLOPE, j] * rows[STOP, j]
        rows[LEVEL, j] = line + rows[TRANSIENT, j] * (1.0 - rows[LEFT, j])


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _choose_arcs(
    rows: Float64Array, solving: Float64Array, lane: NDArray[np.int64], size: int
) -> int:
    """List the lanes on a curve that meets a threshold, and say on which arc; how many."""
    busy = 0
    for j in range(size):
        change, slope, transient = rows[CHANGE, j], rows[SLOPE, j], rows[TRANSIENT, j]
        on, off, level = rows[ON, j], rows[OFF, j], rows[LEVEL, j]
        is_curved = abs(transient) > NEGLIGIBLE * min(on, off)
        if not (is_curved and change < on and -change < off):
            continue
        first = slope + rows[CORNER, j] * transient
        rises = slope > 0 if first == 0 else first > 0
        rows[RISES, j], rows[WAIT, j] = 1.0 if rises else 0.0, NEVER
        solving[START, busy], solving[END, busy] = 0.0, rows[STOP, j]
        solving[KEPT_FIRST, busy], solving[KEPT_LAST, busy] = 1.0, rows[LEFT, j]
        solving[FIRST, busy], solving[LAST, busy] = change, level
        if not (level >= on if rises else -level >= off):
            if rows[TURN, j] >= rows[ROOM, j]:
                continue
            rises = slope > 0
            last = change + slope * rows[ROOM, j] + transient * (1.0 - rows[KEPT, j])
            if not (last >= on if rises else -last >= off):
                continue
            rows[RISES, j] = 1.0 if rises else 0.0
            solving[START, busy], solving[END, busy] = rows[STOP, j], rows[ROOM, j]
            solving[KEPT_FIRST, busy], solving[KEPT_LAST, busy] = rows[LEFT, j], rows[KEPT, j]
            solving[FIRST, busy], solving[LAST, busy] = level, last
        solving[CHANGE, busy], solving[SLOPE, busy] = change, slope
        solving[TRANSIENT, busy], solving[CORNER, busy] = transient, rows[CORNER, j]
        solving[TARGET, busy] = on if rises else -off
        lane[busy] = j
        busy += 1
    return busy


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _solve(solving: Float64Array, size: int) -> None:
    """When the changes reach their targets; see `crossing_time._solve`."""
    for j in range(size):
        start, fall = solving[START, j], solving[KEPT_FIRST, j] - solving[KEPT_LAST, j]
        first, line = solving[FIRST, j], solving[END, j] - solving[START, j]
        part = (solving[TARGET, j] - first) / (solving[LAST, j] - first)
        by_line = abs(solving[SLOPE, j]) * line >= abs(solving[TRANSIENT, j]) * fall
        solving[U, j], solving[BUSY, j] = start + part * line, 1.0 if by_line else 0.0
        solving[LAST, j] = 1.0 if by_line else solving[KEPT_FIRST, j] - part * fall
    for j in range(size):
        by_curve = -natural_log(solving[LAST, j]) / solving[CORNER, j]
        u = solving[U, j] if solving[BUSY, j] > 0 else by_curve
        solving[U, j] = min(max(u, solving[START, j]), solving[END, j])
        solving[BUSY, j] = 1.0
    for _ in range(MOST_STEPS):
        if not _step(solving, size):
            break


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _step(solving: Float64Array, size: int) -> bool:
    """A step of Halley's method; whether any lane needs another."""
    for j in range(size):
        u, corner, slope = solving[U, j], solving[CORNER, j], solving[SLOPE, j]
        kept = exponential(-corner * u)
        line = solving[CHANGE, j] + slope * u
        excess = line + solving[TRANSIENT, j] * (1.0 - kept) - solving[TARGET, j]
        kick = corner * solving[TRANSIENT, j] * kept
        tangent = slope + kick
        newton = 2.0 * tangent * tangent
        bend = newton + excess * (corner * kick)
        bend = newton if 2.0 * bend < newton else bend
        step = 2.0 * excess * tangent / bend if bend > 0 else 0.0
        ahead = min(max(u - step, solving[START, j]), solving[END, j])
        solving[U, j] = ahead if solving[BUSY, j] > 0 else u
        goes_on = (solving[BUSY, j] > 0) & (abs(step) * corner > LAST_STEP)
        solving[BUSY, j] = 1.0 if goes_on else 0.0
    busy = 0
    for j in range(size):
        busy += solving[BUSY, j] > 0
    return busy > 0

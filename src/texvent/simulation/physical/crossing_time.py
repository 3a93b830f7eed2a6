"""Times at which changes with a constant slope and a decaying transient first reach a threshold.

After a time u the change is `x + S u + D (1 − e^(−ω u))`: a straight line, and the decay of the
photoreceptor's lag. The curve has at most one extremum, and is monotonic on the arc before and
after it; on the arc that meets a threshold, Halley's method solves for the time.

Lanes are the columns of one array whose rows are the variables of a curve: loops over few rows each
fill vector registers, and Numba counts the references to one array instead of twenty. Only lanes on
a curve that reaches a threshold are solved for, side by side at the end of the same rows.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulation.kernels.compiled_elementary import exponential, natural_log

Float64Array = NDArray[np.float64]

NEVER = np.inf
NEGLIGIBLE = 1e-6
"""A transient below this share of the threshold is ignored."""
LAST_STEP = 0.01
"""A step of Halley's method that is shorter, in time constants, is the last: what is left then is
in the order of its cube."""
MOST_STEPS = 60

CHANGE, SLOPE, TRANSIENT, CUTOFF, DURATION, KEPT, ON, OFF = range(8)
"""Rows of the change of a lane, and its thresholds."""
WAIT, RISES = 8, 9
"""Rows of the time to a threshold, and 1 for ON, 0 for OFF."""
TURN, STOP, LEFT, LEVEL = 10, 11, 12, 13
"""Scratch: time of the extremum, or else the end, and the change at that time."""
AT_END, MEETS = 14, 15
"""Scratch: the change at the end, and which arc reaches a threshold: 1, 2, or 0 for none."""
ROWS = 16
TARGET, START, END, KEPT_FIRST, KEPT_LAST, FIRST, LAST, U, UNSOLVED = range(4, 13)
"""Rows of lanes that are solved for, besides the first four: the arc, and the state
of the solution."""


@jit(error_model="numpy")
def find_crossings(
    rows: Float64Array, solving: Float64Array, lane: NDArray[np.int64], size: int
) -> None:
    """Fill in `WAIT` and `RISES` of the first lanes.

    Args:
        rows: [ROWS, lanes]; those of the curve are given.
        solving: [ROWS, lanes], scratch.
        lane: [lanes], scratch.
        size: how many lanes.
    """
    _along_line(rows, size)
    _turn(rows, size)
    _meet(rows, size)
    unsolved = _list_arcs(rows, solving, lane, size)
    _solve(solving, unsolved)
    for k in range(unsolved):
        rows[WAIT, lane[k]] = solving[U, k]


@jit(error_model="numpy")
def _along_line(rows: Float64Array, size: int) -> None:
    # Here as below, everything is read before it is chosen from: what is read in one case only is
    # a branch, and no vector instruction.
    for j in range(size):
        change, slope, duration = rows[CHANGE, j], rows[SLOPE, j], rows[DURATION, j]
        on, off = rows[ON, j], -rows[OFF, j]
        wait = ((on if slope > 0 else off) - change) / slope
        wait = NEVER if wait > duration else wait
        wait = NEVER if slope == 0 else wait
        rises = 1.0 if slope > 0 else 0.0
        wait = 0.0 if change <= off else wait
        wait = 0.0 if change >= on else wait
        rises = 0.0 if change <= off else rises
        rows[WAIT, j], rows[RISES, j] = wait, 1.0 if change >= on else rises


@jit(error_model="numpy")
def _turn(rows: Float64Array, size: int) -> None:
    """End of the first arc of a curve: its one extremum, or its end."""
    for j in range(size):
        slope, decay_slope = rows[SLOPE, j], rows[CUTOFF, j] * rows[TRANSIENT, j]
        ratio = -decay_slope / slope
        rows[LEFT, j] = ratio if (slope + decay_slope) * slope < 0 else 1.0
    for j in range(size):
        rows[TURN, j] = natural_log(rows[LEFT, j]) / rows[CUTOFF, j]
    for j in range(size):
        slope, decay_slope, turn = (
            rows[SLOPE, j],
            rows[CUTOFF, j] * rows[TRANSIENT, j],
            rows[TURN, j],
        )
        rows[TURN, j] = turn if (slope + decay_slope) * slope < 0 else NEVER
    for j in range(size):
        turn, duration, kept, left = (
            rows[TURN, j],
            rows[DURATION, j],
            rows[KEPT, j],
            1.0 / rows[LEFT, j],
        )
        rows[STOP, j] = duration if turn >= duration else turn
        rows[LEFT, j] = kept if turn >= duration else left
    for j in range(size):
        line = rows[CHANGE, j] + rows[SLOPE, j] * rows[STOP, j]
        rows[LEVEL, j] = line + rows[TRANSIENT, j] * (1.0 - rows[LEFT, j])
    for j in range(size):
        line = rows[CHANGE, j] + rows[SLOPE, j] * rows[DURATION, j]
        rows[AT_END, j] = line + rows[TRANSIENT, j] * (1.0 - rows[KEPT, j])


@jit(error_model="numpy")
def _meet(rows: Float64Array, size: int) -> None:
    """The arc of each curve that meets a threshold."""
    for j in range(size):
        slope, last, on, off = rows[SLOPE, j], rows[AT_END, j], rows[ON, j], -rows[OFF, j]
        up, down = 2.0 if last >= on else 0.0, 2.0 if last <= off else 0.0
        later = up if slope > 0 else down
        rows[MEETS, j] = later if rows[TURN, j] < rows[DURATION, j] else 0.0
    for j in range(size):
        slope, decay_slope, level = (
            rows[SLOPE, j],
            rows[CUTOFF, j] * rows[TRANSIENT, j],
            rows[LEVEL, j],
        )
        on, off, later = rows[ON, j], -rows[OFF, j], rows[MEETS, j]
        up, down = 1.0 if level >= on else later, 1.0 if level <= off else later
        direction = slope if slope + decay_slope == 0 else slope + decay_slope
        rows[MEETS, j] = up if direction > 0 else down
    for j in range(size):
        change, on, off, wait = rows[CHANGE, j], rows[ON, j], rows[OFF, j], rows[WAIT, j]
        meets, transient = rows[MEETS, j], rows[TRANSIENT, j]
        lowest = NEGLIGIBLE * (on if on < off else off)
        is_curved = (abs(transient) > lowest) & (change < on) & (-change < off)
        rows[WAIT, j], rows[MEETS, j] = NEVER if is_curved else wait, meets if is_curved else 0.0


@jit(error_model="numpy")
def _list_arcs(
    rows: Float64Array, solving: Float64Array, lane: NDArray[np.int64], size: int
) -> int:
    """Copy the lanes that meet a threshold on a curve, side by side; how many those are."""
    unsolved = 0
    for j in range(size):
        lane[unsolved] = j
        unsolved += rows[MEETS, j] > 0
    for k in range(unsolved):
        j = lane[k]
        is_first, change, slope = rows[MEETS, j] == 1.0, rows[CHANGE, j], rows[SLOPE, j]
        stop, duration, left, kept = rows[STOP, j], rows[DURATION, j], rows[LEFT, j], rows[KEPT, j]
        level, at_end, on, off = rows[LEVEL, j], rows[AT_END, j], rows[ON, j], -rows[OFF, j]
        solving[CHANGE, k], solving[SLOPE, k] = change, slope
        solving[TRANSIENT, k], solving[CUTOFF, k] = rows[TRANSIENT, j], rows[CUTOFF, j]
        solving[START, k], solving[END, k] = (
            0.0 if is_first else stop,
            stop if is_first else duration,
        )
        solving[KEPT_FIRST, k] = 1.0 if is_first else left
        solving[KEPT_LAST, k] = left if is_first else kept
        first, last = change if is_first else level, level if is_first else at_end
        solving[FIRST, k], solving[LAST, k] = first, last
        # It rises to ON, or falls to OFF.
        solving[TARGET, k] = on if last > first else off
        rows[RISES, j] = 1.0 if last > first else 0.0
    return unsolved


@jit(error_model="numpy")
def _solve(solving: Float64Array, size: int) -> None:
    """Times at which the changes reach their targets: Halley's method."""
    for j in range(size):
        start, fall = solving[START, j], solving[KEPT_FIRST, j] - solving[KEPT_LAST, j]
        first, line = solving[FIRST, j], solving[END, j] - solving[START, j]
        part = (solving[TARGET, j] - first) / (solving[LAST, j] - first)
        by_line = abs(solving[SLOPE, j]) * line >= abs(solving[TRANSIENT, j]) * fall
        solving[U, j], solving[UNSOLVED, j] = start + part * line, 1.0 if by_line else 0.0
        solving[LAST, j] = 1.0 if by_line else solving[KEPT_FIRST, j] - part * fall
    for j in range(size):
        by_line, by_curve = solving[U, j], -natural_log(solving[LAST, j]) / solving[CUTOFF, j]
        u = by_line if solving[UNSOLVED, j] > 0 else by_curve
        solving[U, j] = min(max(u, solving[START, j]), solving[END, j])
        solving[UNSOLVED, j] = 1.0
    for _ in range(MOST_STEPS):
        if not _step(solving, size):
            break


@jit(error_model="numpy")
def _step(solving: Float64Array, size: int) -> bool:
    """A step of Halley's method; whether any lane needs another."""
    for j in range(size):
        u, cutoff, slope = solving[U, j], solving[CUTOFF, j], solving[SLOPE, j]
        kept = exponential(-cutoff * u)
        line = solving[CHANGE, j] + slope * u
        excess = line + solving[TRANSIENT, j] * (1.0 - kept) - solving[TARGET, j]
        decay_slope = cutoff * solving[TRANSIENT, j] * kept
        tangent = slope + decay_slope
        newton = 2.0 * tangent * tangent
        denominator = newton + excess * (cutoff * decay_slope)
        denominator = newton if 2.0 * denominator < newton else denominator
        step = 2.0 * excess * tangent / denominator if denominator > 0 else 0.0
        ahead = min(max(u - step, solving[START, j]), solving[END, j])
        solving[U, j] = ahead if solving[UNSOLVED, j] > 0 else u
        goes_on = (solving[UNSOLVED, j] > 0) & (abs(step) * cutoff > LAST_STEP)
        solving[UNSOLVED, j] = 1.0 if goes_on else 0.0
    unsolved = 0
    for j in range(size):
        unsolved += solving[UNSOLVED, j] > 0
    return unsolved > 0

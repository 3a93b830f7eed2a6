"""Bounds of what a pixel can show between two frames, to leave out those that cannot fire.

Every intermediate picture is, pixel by pixel, a mean of bilinear samples of both frames, at most
the length of the flow away (`interpolate.kernels.reference.warp_between`: the way to a frame is
τ or 1 − τ times a mean of one flow and the other turned around). So what a pixel shows lies between
the darkest and the brightest that both frames have within that distance.

* Up to 1 px of flow, a bilinear sample differs from the pixel itself by less than
  `|dx|` times the steps to its left and right neighbours (in the rows it may touch) plus `|dy|`
  times those up and down.
* Further out, the extremes over cells of `CELL` pixels that the flow of the pixel's cell reaches.
"""

from __future__ import annotations

import math

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.engine.kernels.interface import MARGIN, Levels, Pictures

CELL = 8
"""Side of a cell, px."""
FARTHEST = 8
"""Cells further away than this are not looked up: such a cell counts as reaching everything."""
SLACK = 8.0 * MARGIN
"""Relative room that trigger levels are given for rounding."""
ROUNDING = np.float32(1e-6)
"""By how much rounding may take a picture past what it is a mean of, as a share of the brightest;
ten times the error of mixing float32."""


@numba.njit(cache=True, nogil=True)
def find_reachable(
    earlier: NDArray[np.float32],
    later: NDArray[np.float32],
    forward: NDArray[np.float32],
    backward: NDArray[np.float32],
) -> NDArray[np.float32]:
    """Darkest and brightest luma that the pixels of each cell can reach.

    Returns:
        [rows, columns, 2] float32: for each cell the lowest and the highest; empty without flow.
    """
    height, width = earlier.shape
    down, across = (height + CELL - 1) // CELL, (width + CELL - 1) // CELL
    reached = np.empty((down, across, 2), np.float32)
    if forward.size == 0:
        return reached[:0]
    own = np.empty((down, across, 2), np.float32)
    reach = np.empty((down, across, 2), np.int64)
    for i in range(down):
        rows = slice(i * CELL, min((i + 1) * CELL, height))
        flows = forward[rows], backward[rows]
        _look_at_cells(earlier[rows], later[rows], flows, own[i], reach[i])
    for i in range(down):
        for j in range(across):
            aside, above = reach[i, j]
            if max(aside, above) > FARTHEST:
                reached[i, j, 0], reached[i, j, 1] = 0.0, np.inf
                continue
            near = own[max(i - above, 0) : i + above + 1, max(j - aside, 0) : j + aside + 1]
            reached[i, j, 0], reached[i, j, 1] = near[:, :, 0].min(), near[:, :, 1].max()
    return reached


@numba.njit(cache=True, nogil=True)
def _look_at_cells(
    earlier: NDArray[np.float32],
    later: NDArray[np.float32],
    flows: tuple[NDArray[np.float32], NDArray[np.float32]],
    own: NDArray[np.float32],
    reach: NDArray[np.int64],
) -> None:
    """Extremes of one row of cells, and how many cells away their flow leads along x and y."""
    forward, backward = flows
    height, width = earlier.shape
    low, high = np.minimum(earlier[0], later[0]), np.maximum(earlier[0], later[0])
    farthest = np.zeros(2 * width, np.float32)
    for y in range(height):
        first, second = earlier[y], later[y]
        for x in range(width):
            low[x] = min(low[x], min(first[x], second[x]))
            high[x] = max(high[x], max(first[x], second[x]))
        ahead, back = forward[y].reshape(-1), backward[y].reshape(-1)
        for x in range(2 * width):
            farthest[x] = max(farthest[x], max(abs(ahead[x]), abs(back[x])))
    for j in range(len(own)):
        columns = slice(j * CELL, min((j + 1) * CELL, width))
        own[j, 0], own[j, 1] = low[columns].min(), high[columns].max()
        for axis in range(2):
            longest = farthest[2 * columns.start + axis : 2 * columns.stop : 2].max()
            # A bilinear sample touches the pixel behind its position too.
            far = longest > CELL * FARTHEST
            reach[j, axis] = FARTHEST + 1 if far else (math.ceil(longest) + CELL) // CELL


@numba.njit(cache=True, nogil=True)
def list_active(
    pictures: Pictures,
    levels: Levels,
    cells: NDArray[np.float32],
    row: int,
    active: NDArray[np.int64],
) -> int:
    """Find the pixels of a row that may fire; none of the pictures of the others can.

    Args:
        pictures: the pair.
        levels: what the pixels compare with.
        cells: of `find_reachable`.
        row: which row.
        active: [W], filled in with their columns.

    Returns:
        How many there are.
    """
    earlier, later, forward, backward = pictures
    height, width = earlier.shape
    up, down = levels.up * (1.0 - SLACK), levels.down * (1.0 + SLACK)
    low, high = np.minimum(earlier[row], later[row]), np.maximum(earlier[row], later[row])
    if forward.size:
        above, below = max(row - 1, 0), min(row + 1, height - 1)
        first = earlier[above], earlier[row], earlier[below]
        second = later[above], later[row], later[below]
        _bound_row(first, second, forward[row], backward[row], cells[row // CELL], low, high)
    balance = levels.balance
    level = levels.reference[row] if levels.reference.size else earlier[row] + balance
    number = 0
    for x in range(width):
        room = ROUNDING * high[x]
        is_up = high[x] + room + balance >= level[x] * up
        is_down = low[x] - room + balance <= level[x] * down
        active[number] = x
        number += is_up | is_down
    return number


Rows = tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]


@numba.njit(cache=True, nogil=True)
def _bound_row(
    first: Rows,
    second: Rows,
    forward: NDArray[np.float32],
    backward: NDArray[np.float32],
    cells: NDArray[np.float32],
    low: NDArray[np.float32],
    high: NDArray[np.float32],
) -> None:
    """Bounds of a row with flow: near ones where the flow is at most a pixel, else the cell's."""
    width = low.size
    for x in range(width):
        left, right = max(x - 1, 0), min(x + 1, width - 1)
        dx = max(abs(forward[x, 0]), abs(backward[x, 0]))
        dy = max(abs(forward[x, 1]), abs(backward[x, 1]))
        least, most = cells[x // CELL, 0], cells[x // CELL, 1]
        if dx <= 1 and dy <= 1:
            a, b = first[1][x], second[1][x]
            room_a, room_b = (
                _room(first, left, x, right, dx, dy),
                _room(second, left, x, right, dx, dy),
            )
            least, most = min(a - room_a, b - room_b), max(a + room_a, b + room_b)
        low[x], high[x] = least, most


@numba.njit(cache=True, nogil=True, inline="always")
def _room(rows: Rows, left: int, x: int, right: int, dx: float, dy: float) -> float:
    """By how much a sample at most (dx, dy) away differs from the pixel, at most."""
    above, here, below = rows
    aside = max(abs(here[left] - here[x]), abs(here[right] - here[x]))
    aside = max(aside, max(abs(above[left] - above[x]), abs(above[right] - above[x])))
    aside = max(aside, max(abs(below[left] - below[x]), abs(below[right] - below[x])))
    room: float = dx * aside + dy * max(abs(above[x] - here[x]), abs(below[x] - here[x]))
    return room

"""The candidates of one pair, compiled by Numba: the reference's rows, without the pictures.

Pixel by pixel, from the first picture to the last, so no picture is ever written to memory. Most
pixels of most videos cannot fire at all: what they can show lies between bounds that cost a few
operations (`reach_cpu`), and they are not followed.

Numba's cache looks at this file only: whoever changes `warp_pixel` must touch this one as well.
"""

from __future__ import annotations

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.engine.kernels.interface import (
    FOLLOWS,
    MARGIN,
    STEPS,
    TAKES,
    Candidates,
    Cells,
    Grids,
    Levels,
    Pictures,
)
from texvent.engine.kernels.reach_cpu import find_reachable, list_active
from texvent.interpolate.kernels.cpu import warp_pixel

Columns = tuple[
    NDArray[np.int64],
    NDArray[np.int16],
    NDArray[np.int16],
    NDArray[np.float32],
    NDArray[np.float32],
]
FIRST_ROOM = 1024
SAMPLE = 16
"""Rows of which `estimate_active` looks at one."""
BUSY, PROBE = 0.9, 8
"""After a row of which a larger share than `BUSY` is active, all pixels are followed, up to the
next row whose number is a multiple of `PROBE`."""


def find_candidates(pictures: Pictures, grids: Grids, levels: Levels) -> Candidates:
    """Every piece at whose end a pixel may fire; see `candidates_reference.find_candidates`."""
    cells = find_cells(pictures)
    return find_in_rows(pictures, grids, levels, cells, (0, pictures.earlier.shape[0]))


def warm_up() -> None:
    """Compile everything, or load what was compiled before."""
    picture, flow = (np.zeros(shape, np.float32) for shape in ((1, 1), (1, 1, 2)))
    endless = np.array([np.inf])
    grids = Grids(np.ones((1, 1)), np.array([1]), endless, endless)
    pictures = Pictures(picture, picture, flow, flow)
    levels = Levels(np.empty((0, 0)), 1.0, 2.0, 0.5, TAKES)
    find_candidates(pictures, grids, levels)
    estimate_active(pictures, levels, find_cells(pictures))
    show_pixels(pictures, 0.5, np.zeros(1, np.int64))


def find_cells(pictures: Pictures) -> Cells:
    """What `find_in_rows` wants to know of the pair as a whole."""
    cells: Cells = find_reachable(*pictures.frozen())
    return cells


def estimate_active(pictures: Pictures, levels: Levels, cells: Cells) -> float:
    """Share of the pixels that may fire, 0..1, by every `SAMPLE`-th row of the picture."""
    return float(_estimate_active(pictures.frozen(), levels, cells))


@numba.njit(cache=True, nogil=True)
def _estimate_active(pictures: Pictures, levels: Levels, cells: Cells) -> float:
    height, width = pictures.earlier.shape
    active = np.empty(width, np.int64)
    number, rows = 0, 0
    for row in range(min(SAMPLE // 2, height - 1), height, SAMPLE):
        number += list_active(pictures, levels, cells, row, active)
        rows += 1
    share: float = number / (rows * width)
    return share


def find_in_rows(
    pictures: Pictures,
    grids: Grids,
    levels: Levels,
    cells: Cells,
    rows: tuple[int, int],
) -> Candidates:
    """The candidates of some rows of the picture; several threads may be at it.

    Args:
        pictures: the pair.
        grids: when pixels are looked at.
        levels: what they compare with.
        cells: of `find_cells`.
        rows: first row, and the one after the last.
    """
    found, columns = _find(pictures.frozen(), grids, levels, cells, rows)
    return Candidates(*columns).take(slice(found))


@numba.njit(cache=True, nogil=True)
def _find(
    pictures: Pictures,
    grids: Grids,
    levels: Levels,
    cells: Cells,
    rows: tuple[int, int],
) -> tuple[int, Columns]:
    width = pictures.earlier.shape[1]
    found, columns = 0, _columns(FIRST_ROOM)
    active, chosen = np.empty(width, np.int64), np.empty(width, np.int64)
    shown = np.empty(FIRST_ROOM, np.float32)
    number = 0
    for row in range(rows[0], rows[1]):
        # Where nearly all pixels may fire, looking for the others is not worth while.
        if number <= BUSY * width or row % PROBE == 0:
            number = list_active(pictures, levels, cells, row, active)
        else:
            number = _list_all(active)
        room = _choose_grids(pictures, grids, levels.balance, row, active[:number], chosen)
        if room > shown.size:
            shown = np.empty(2 * room, np.float32)
        if found + room > columns[0].size:
            columns = _grown(columns, room)
        _show(pictures, grids, row, (active[:number], chosen), shown)
        found = _follow(
            pictures, grids, levels, row, (active[:number], chosen), shown, (columns, found)
        )
    return found, columns


@numba.njit(cache=True, nogil=True)
def _list_all(active: NDArray[np.int64]) -> int:
    for column in range(active.size):
        active[column] = column
    return active.size


@numba.njit(cache=True, nogil=True)
def _choose_grids(
    pictures: Pictures,
    grids: Grids,
    balance: float,
    row: int,
    active: NDArray[np.int64],
    chosen: NDArray[np.int64],
) -> int:
    """Fill in the grid of each active pixel; return how many pieces they have together."""
    earlier, later, forward, backward = pictures
    last = grids.parts.size - 1
    room = 0
    for k in range(active.size):
        column = active[k]
        way2 = 0.0
        if forward.size:
            x, y = np.float64(forward[row, column, 0]), np.float64(forward[row, column, 1])
            way2 = x * x + y * y
            x, y = np.float64(backward[row, column, 0]), np.float64(backward[row, column, 1])
            way2 = max(way2, x * x + y * y)
        first = np.float64(earlier[row, column]) + balance
        second = np.float64(later[row, column]) + balance
        low, high = min(first, second), max(first, second)
        grid = 0
        while grid < last and not (way2 <= grids.reach2[grid] and high <= low * grids.ratio[grid]):
            grid += 1
        chosen[k] = grid
        room += grids.parts[grid]
    return room


@numba.njit(cache=True, nogil=True)
def _show(
    pictures: Pictures,
    grids: Grids,
    row: int,
    followed: tuple[NDArray[np.int64], NDArray[np.int64]],
    shown: NDArray[np.float32],
) -> None:
    """Fill in the luma of the followed pixels of a row at the ends of their pieces."""
    # Unpacked once per row: Numba counts references to every array that it takes out of a tuple.
    earlier, later, forward, backward = pictures
    positions, parts, _, _ = grids
    active, chosen = followed
    filled = 0
    for k in range(active.size):
        column, last = active[k], parts[chosen[k]] - 1
        start, stop = earlier[row, column], later[row, column]
        if forward.size:
            for j in range(last):
                place = positions[chosen[k], j]
                shown[filled + j] = warp_pixel(
                    earlier, later, forward, backward, place, row, column
                )
        else:
            for j in range(last):
                shown[filled + j] = start + np.float32(positions[chosen[k], j]) * (stop - start)
        shown[filled + last] = stop
        filled += last + 1


@numba.njit(cache=True, nogil=True)
def _follow(
    pictures: Pictures,
    grids: Grids,
    levels: Levels,
    row: int,
    followed: tuple[NDArray[np.int64], NDArray[np.int64]],
    shown: NDArray[np.float32],
    out: tuple[Columns, int],
) -> int:
    """List the candidates of a row behind those found so far; return how many there are then."""
    earlier = pictures.earlier
    parts = grids.parts
    reference, balance, up, down, rule = levels
    active, chosen = followed
    (pixel, grid, piece, befores, nows), found = out
    filled = 0
    for k in range(active.size):
        column = active[k]
        before = earlier[row, column]
        level = reference[row, column] if reference.size else np.float64(before) + balance
        above, below = level * (up * (1.0 - MARGIN)), level * (down * (1.0 + MARGIN))
        is_open: bool | np.bool_ = False
        for j in range(parts[chosen[k]]):
            now = shown[filled + j]
            shifted = np.float64(now) + balance
            is_up, is_down = shifted >= above, shifted <= below
            if is_up | is_down:
                pixel[found] = row * earlier.shape[1] + column
                grid[found], piece[found] = chosen[k], j
                befores[found], nows[found] = before, now
                found += 1
                level, is_unclear = _move(level, shifted, is_up, is_down, (up, down, rule))
                above, below = level * (up * (1.0 - MARGIN)), level * (down * (1.0 + MARGIN))
                is_open |= is_unclear
                if is_open:
                    # From here on every picture is listed.
                    above = -np.inf
            if rule == FOLLOWS:
                level = shifted
                above, below = level * (up * (1.0 - MARGIN)), level * (down * (1.0 + MARGIN))
            before = now
        filled += parts[chosen[k]]
    return found


@numba.njit(cache=True, nogil=True)
def _move(
    level: float,
    shifted: float,
    is_up: bool | np.bool_,
    is_down: bool | np.bool_,
    moves: tuple[float, float, int],
) -> tuple[float, bool | np.bool_]:
    """Where a reference stands after a picture, and whether that is unclear."""
    up, down, rule = moves
    if rule == FOLLOWS:
        return shifted, False
    above, below = 1.0 + MARGIN, 1.0 - MARGIN
    is_surely_up = shifted > level * (up * above)
    is_surely_down = shifted < level * (down * below)
    is_unclear = (is_up and not is_surely_up) or (is_down and not is_surely_down)
    if rule == TAKES:
        return (shifted if is_surely_up or is_surely_down else level), is_unclear
    if is_surely_up:
        level *= up
        while rule == STEPS and shifted > level * (up * above):
            level *= up
        is_unclear = rule == STEPS and shifted >= level * (up * below)
    elif is_surely_down:
        level *= down
        while rule == STEPS and shifted < level * (down * below):
            level *= down
        is_unclear = rule == STEPS and shifted <= level * (down * above)
    return level, is_unclear


@numba.njit(cache=True, nogil=True)
def _columns(size: int) -> Columns:
    return (
        np.empty(size, np.int64),
        np.empty(size, np.int16),
        np.empty(size, np.int16),
        np.empty(size, np.float32),
        np.empty(size, np.float32),
    )


@numba.njit(cache=True, nogil=True)
def _grown(columns: Columns, least: int) -> Columns:
    """The same columns with more room."""
    size = columns[0].size
    larger = _columns(2 * size + least)
    larger[0][:size] = columns[0]
    larger[1][:size] = columns[1]
    larger[2][:size] = columns[2]
    larger[3][:size] = columns[3]
    larger[4][:size] = columns[4]
    return larger


def show_pixels(
    pictures: Pictures, position: float, pixel: NDArray[np.int64]
) -> NDArray[np.float32]:
    """Luma of some pixels of the picture at a position.

    Args:
        pictures: the pair.
        position: τ, 0 = earlier, 1 = later.
        pixel: [n] flat indices.

    Returns:
        [n] float32: the bits that the whole picture has there.
    """
    shown: NDArray[np.float32] = _show_pixels(pictures.frozen(), position, pixel)
    return shown


@numba.njit(cache=True, nogil=True)
def _show_pixels(
    pictures: Pictures, position: float, pixel: NDArray[np.int64]
) -> NDArray[np.float32]:
    earlier, later, forward, backward = pictures
    width = earlier.shape[1]
    shown = np.empty(pixel.size, np.float32)
    for k in range(pixel.size):
        row, column = pixel[k] // width, pixel[k] % width
        if forward.size:
            shown[k] = warp_pixel(earlier, later, forward, backward, position, row, column)
        else:
            start = earlier[row, column]
            shown[k] = start + np.float32(position) * (later[row, column] - start)
    return shown

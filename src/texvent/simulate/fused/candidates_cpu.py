"""The candidates of one pair, compiled by Numba: the reference's rows, without the pictures.

Some rows at a time, from the first picture to the last, so no picture is ever written to memory.
Most pixels of most videos cannot fire at all: what they can show lies between bounds that cost a
few operations (`reach_cpu`), and they are not followed.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.warp_cpu import (
    POINTS,
    Room,
    WarpPair,
    make_room,
    prepare_pair,
    take_points,
    warp_points,
)
from texvent.runtime.jit import jit
from texvent.simulate.fused.bounds_cpu import find_reachable, list_active
from texvent.simulate.fused.interface import (
    FOLLOWS,
    MARGIN,
    STEPS,
    TAKES,
    Candidates,
    Cells,
    Grids,
    Levels,
    Pictures,
    Surveyed,
)

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
    surveyed = Surveyed(prepare_pair(*pictures), find_cells(pictures))
    return find_in_rows(pictures, grids, levels, surveyed, (0, pictures.earlier.shape[0]))


def warm_up() -> None:
    """Compile everything, or load what was compiled before."""
    picture, flow = (np.zeros(shape, np.float32) for shape in ((1, 1), (1, 1, 2)))
    endless = np.array([np.inf])
    grids = Grids(np.ones((1, 1)), np.array([1]), endless, endless)
    pictures = Pictures(picture, picture, flow, flow)
    levels = Levels(np.empty((0, 0)), 1.0, 2.0, 0.5, TAKES)
    find_candidates(pictures, grids, levels)
    estimate_active(pictures, levels, find_cells(pictures))
    show_pixels(pictures, prepare_pair(*pictures), 0.5, np.zeros(1, np.int64))


def find_cells(pictures: Pictures) -> Cells:
    """What `find_in_rows` wants to know of the pair as a whole."""
    cells: Cells = find_reachable(*pictures.frozen())
    return cells


def estimate_active(pictures: Pictures, levels: Levels, cells: Cells) -> float:
    """Share of the pixels that may fire, 0..1, by every `SAMPLE`-th row of the picture."""
    return float(_estimate_active(pictures.frozen(), levels, cells))


@jit
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
    surveyed: Surveyed,
    rows: tuple[int, int],
) -> Candidates:
    """The candidates of some rows of the picture; several threads may be at it.

    Args:
        pictures: the pair.
        grids: when pixels are looked at.
        levels: what they compare with.
        surveyed: the pair prepared, and its `find_cells`.
        rows: first row, and the one after the last.
    """
    found, columns = _find(pictures.frozen(), grids, levels, surveyed, rows)
    return Candidates(*columns).take(slice(found))


class _Followed(NamedTuple):
    """Active pixels, and where what they show is written; [n]."""

    pixel: NDArray[np.int64]
    """Flat index, ascending."""
    grid: NDArray[np.int64]
    start: NDArray[np.int64]
    """Where the pixel's first picture is in `shown`."""
    step: NDArray[np.int64]
    """How much further each of the next ones is."""


@jit
def _find(
    pictures: Pictures,
    grids: Grids,
    levels: Levels,
    surveyed: Surveyed,
    rows: tuple[int, int],
) -> tuple[int, Columns]:
    width = pictures.earlier.shape[1]
    found, columns = 0, _columns(FIRST_ROOM)
    room, shown = make_room(POINTS + width), np.empty(FIRST_ROOM, np.float32)
    memory = np.empty((5, POINTS + width), np.int64)
    row, number = rows[0], 0
    while row < rows[1]:
        filled = 0
        while row < rows[1] and filled < POINTS:
            # Where nearly all pixels may fire, looking for the others is not worth while.
            if number <= BUSY * width or row % PROBE == 0:
                number = list_active(pictures, levels, surveyed.cells, row, memory[4])
            else:
                number = _list_all(memory[4, :width])
            for k in range(number):
                memory[0, filled + k] = row * width + memory[4, k]
            filled += number
            row += 1
        followed = _Followed(
            memory[0, :filled], memory[1, :filled], memory[2, :filled], memory[3, :filled]
        )
        pieces = _choose_grids(pictures, grids, levels.balance, followed)
        if pieces > shown.size:
            shown = np.empty(2 * pieces, np.float32)
        if found + pieces > columns[0].size:
            columns = _grown(columns, pieces)
        _show(surveyed.pair, grids, followed, room, memory[4], shown)
        found = _follow(pictures, grids, levels, followed, shown, (columns, found))
    return found, columns


@jit
def _list_all(active: NDArray[np.int64]) -> int:
    for column in range(active.size):
        active[column] = column
    return active.size


@jit
def _choose_grids(pictures: Pictures, grids: Grids, balance: float, followed: _Followed) -> int:
    """Fill in the grid of each active pixel; return how many pieces they have together."""
    earlier, later = pictures.earlier.reshape(-1), pictures.later.reshape(-1)
    forward, backward = pictures.forward.reshape(-1), pictures.backward.reshape(-1)
    last = grids.parts.size - 1
    room = 0
    for k in range(followed.pixel.size):
        i = followed.pixel[k]
        way2 = 0.0
        if forward.size:
            x, y = np.float64(forward[2 * i]), np.float64(forward[2 * i + 1])
            way2 = x * x + y * y
            x, y = np.float64(backward[2 * i]), np.float64(backward[2 * i + 1])
            way2 = max(way2, x * x + y * y)
        first = np.float64(earlier[i]) + balance
        second = np.float64(later[i]) + balance
        low, high = min(first, second), max(first, second)
        grid = 0
        while grid < last and not (way2 <= grids.reach2[grid] and high <= low * grids.ratio[grid]):
            grid += 1
        followed.grid[k] = grid
        room += grids.parts[grid]
    return room


@jit
def _show(
    pair: WarpPair,
    grids: Grids,
    followed: _Followed,
    room: Room,
    chosen: NDArray[np.int64],
    shown: NDArray[np.float32],
) -> None:
    """Fill in the luma of the followed pixels at the ends of their pieces, grid by grid."""
    pixel, grid_of, start, step = followed
    points, filled = room.points, 0
    for grid in range(grids.parts.size):
        number, pieces = 0, grids.parts[grid]
        for k in range(pixel.size):
            if grid_of[k] == grid:
                start[k] = filled + number
                chosen[number] = pixel[k]
                number += 1
        for k in range(pixel.size):
            if grid_of[k] == grid:
                step[k] = number
        if number == 0:
            continue
        take_points(pair, chosen[:number], points)
        for piece in range(pieces - 1):
            place, out = grids.positions[grid, piece], shown[filled : filled + number]
            if pair.forward.size:
                warp_points(pair, room, number, place, out)
            else:
                _blend(points.earlier, points.later, np.float32(place), out)
            filled += number
        shown[filled : filled + number] = points.later[:number]
        filled += number


@jit
def _blend(
    earlier: NDArray[np.float32],
    later: NDArray[np.float32],
    position: np.float32,
    out: NDArray[np.float32],
) -> None:
    for k in range(out.size):
        out[k] = earlier[k] + position * (later[k] - earlier[k])


@jit
def _follow(
    pictures: Pictures,
    grids: Grids,
    levels: Levels,
    followed: _Followed,
    shown: NDArray[np.float32],
    out: tuple[Columns, int],
) -> int:
    """List the candidates among some pixels behind those found; return how many there are."""
    earlier = pictures.earlier.reshape(-1)
    parts = grids.parts
    reference, balance, up, down, rule = levels
    references = reference.reshape(-1)
    active, chosen, starts, steps = followed
    (pixel, grid, piece, befores, nows), found = out
    for k in range(active.size):
        i = active[k]
        before = earlier[i]
        level = references[i] if references.size else np.float64(before) + balance
        above, below = level * (up * (1.0 - MARGIN)), level * (down * (1.0 + MARGIN))
        is_open: bool | np.bool_ = False
        place, step = starts[k], steps[k]
        for j in range(parts[chosen[k]]):
            now = shown[place]
            place += step
            shifted = np.float64(now) + balance
            is_up, is_down = shifted >= above, shifted <= below
            if is_up | is_down:
                pixel[found] = i
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
    return found


@jit
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


@jit
def _columns(size: int) -> Columns:
    return (
        np.empty(size, np.int64),
        np.empty(size, np.int16),
        np.empty(size, np.int16),
        np.empty(size, np.float32),
        np.empty(size, np.float32),
    )


@jit
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
    pictures: Pictures, pair: WarpPair, position: float, pixel: NDArray[np.int64]
) -> NDArray[np.float32]:
    """Luma of some pixels of the picture at a position.

    Args:
        pictures: the pair.
        pair: the same, prepared.
        position: τ, 0 = earlier, 1 = later.
        pixel: [n] flat indices.

    Returns:
        [n] float32: the bits that the whole picture has there.
    """
    shown: NDArray[np.float32] = _show_pixels(pictures.frozen(), pair, position, pixel)
    return shown


@jit
def _show_pixels(
    pictures: Pictures, pair: WarpPair, position: float, pixel: NDArray[np.int64]
) -> NDArray[np.float32]:
    shown = np.empty(pixel.size, np.float32)
    room = make_room(pixel.size)
    take_points(pair, pixel, room.points)
    if pictures.forward.size:
        warp_points(pair, room, pixel.size, position, shown)
    else:
        _blend(room.points.earlier, room.points.later, np.float32(position), shown)
    return shown

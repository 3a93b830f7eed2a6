"""Candidates of a pair of frames, found without drawing a frame, in bands of rows on threads.

A few rows at a time pass through all intermediate instants, so no intermediate frame is written to
memory. Most pixels of most videos cannot fire at all: bounds of their luma cost a few operations
(`bounds`), and pixels whose bounds stay inside the trigger levels are skipped.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.motion_interpolation import MotionInterpolation
from texvent.pairs.warping import POINTS, Room, WarpPair, make_room, take_points, warp_points
from texvent.runtime.jit import jit
from texvent.runtime.threads import count_threads, run_parts
from texvent.simulation.crossing.trigger_levels import MARGIN
from texvent.simulation.fused.bounds import (
    BoundedPair,
    CrossingCandidates,
    Float32Array,
    Int64Array,
    ReferenceLevels,
    bound_paths,
    list_active,
)
from texvent.simulation.kernels.active_pixels import grown

BAND_PIXELS = 1 << 18
"""Most pixels that a thread takes at a time: candidates are held band by band."""
Decided = TypeVar("Decided")


def bound_pair(motion: MotionInterpolation) -> BoundedPair:
    """A pair with flow, with bounds of its luma."""
    return BoundedPair(motion.prepared, *bound_paths(motion.prepared))


def map_candidates(
    decide: Callable[[CrossingCandidates], Decided],
    levels: ReferenceLevels,
    motion: MotionInterpolation,
) -> list[Decided]:
    """The results of a function for the candidates of each band of rows, from the top.

    The number of bands and threads does not change the candidates.

    Args:
        decide: called in threads, so it must change the pixels of its candidates only.
        levels: what pixels are compared with.
        motion: of the pixels between the two frames; with flow.
    """
    bounded = bound_pair(motion)

    def decide_band(rows: tuple[int, int]) -> Decided:
        return decide(find_in_rows(bounded, levels, rows))

    height = len(motion.earlier)
    number = max(count_threads(), math.ceil(motion.earlier.size / BAND_PIXELS))
    step = math.ceil(height / number)
    return run_parts(
        decide_band, [(row, min(row + step, height)) for row in range(0, height, step)]
    )


def warp_pixels(motion: MotionInterpolation, index: int, pixel: Int64Array) -> Float32Array:
    """Luma of some pixels of an intermediate frame, [n], or of the later frame after the last one.

    Args:
        motion: of the pixels between the two frames; with flow.
        index: number of the intermediate frame.
        pixel: [n] flat indices.
    """
    if index == len(motion):
        return motion.later.reshape(-1)[pixel]
    warped: Float32Array = _warp_pixels(motion.prepared, index, pixel)
    return warped


Columns = tuple[
    NDArray[np.int64],
    NDArray[np.int16],
    NDArray[np.float32],
    NDArray[np.float32],
]
FIRST_ROOM = 1024


def find_in_rows(
    bounded: BoundedPair, levels: ReferenceLevels, rows: tuple[int, int]
) -> CrossingCandidates:
    """The candidates of some rows; threads may compute different rows at the same time.

    Args:
        bounded: the pair.
        levels: what pixels are compared with.
        rows: first row, and the one after the last.
    """
    found, columns = _find(bounded, levels, rows)
    return CrossingCandidates(*columns).take(slice(found))


@jit
def _find(
    bounded: BoundedPair, levels: ReferenceLevels, rows: tuple[int, int]
) -> tuple[int, Columns]:
    pair = bounded.pair
    width, parts = pair.first.shape[1], pair.positions.size + 1
    found, columns = 0, _columns(FIRST_ROOM)
    room, warped = make_room(POINTS + width), np.empty(FIRST_ROOM, np.float32)
    memory = np.empty((2, POINTS + width), np.int64)
    row = rows[0]
    while row < rows[1]:
        filled = 0
        while row < rows[1] and filled < POINTS:
            number = list_active(bounded, levels, row, memory[1])
            for k in range(number):
                memory[0, filled + k] = row * width + memory[1, k]
            filled += number
            row += 1
        active = memory[0, :filled]
        size = filled * parts
        if size > warped.size:
            warped = np.empty(2 * size, np.float32)
        if found + size > columns[0].size:
            columns = _grown(columns, size)
        lumas = warped[:size].reshape(parts, filled)
        _warp_active(pair, active, room, lumas)
        found = _list_candidates(pair.first, levels, active, lumas, (columns, found))
    return found, columns


@jit(inner=True)
def _warp_active(
    pair: WarpPair, active: NDArray[np.int64], room: Room, lumas: NDArray[np.float32]
) -> None:
    """Fill in the luma of active pixels [n] at the ends of the segments, [K + 1, n]."""
    take_points(pair, active, room.points)
    for index in range(pair.positions.size):
        warp_points(pair, room, active.size, index, lumas[index])
    lumas[pair.positions.size] = room.points.later[: active.size]


@jit(inner=True)
def _list_candidates(
    first: Float32Array,
    levels: ReferenceLevels,
    active: NDArray[np.int64],
    lumas: NDArray[np.float32],
    out: tuple[Columns, int],
) -> int:
    """List the candidates among some pixels behind those found; return how many there are."""
    earlier = first.reshape(-1)
    lowest = np.full(active.size, np.float32(np.inf))
    highest = np.full(active.size, np.float32(-np.inf))
    for j in range(len(lumas)):
        now = lumas[j]
        for k in range(active.size):
            lowest[k], highest[k] = min(lowest[k], now[k]), max(highest[k], now[k])
    reference, balance, up, down, is_step = levels
    references = reference.reshape(-1)
    (pixel, segment, befores, nows), found = out
    for k in range(active.size):
        i = active[k]
        before = earlier[i]
        level = references[i] if references.size else np.float64(before) + balance
        above, below = level * (up * (1.0 - MARGIN)), level * (down * (1.0 + MARGIN))
        if highest[k] + balance < above and lowest[k] + balance > below:
            continue
        is_open: bool | np.bool_ = False
        for j in range(len(lumas)):
            now = lumas[j, k]
            shifted = np.float64(now) + balance
            is_up, is_down = shifted >= above, shifted <= below
            if is_up | is_down:
                pixel[found], segment[found] = i, j
                befores[found], nows[found] = before, now
                found += 1
                level, is_unclear = _move(level, shifted, is_up, is_down, (up, down, is_step))
                above, below = level * (up * (1.0 - MARGIN)), level * (down * (1.0 + MARGIN))
                is_open |= is_unclear
                if is_open:
                    # From here on every instant is listed.
                    above = -np.inf
            before = now
    return found


@jit(inner=True)
def _move(
    level: float,
    shifted: float,
    is_up: bool | np.bool_,
    is_down: bool | np.bool_,
    moves: tuple[float, float, bool],
) -> tuple[float, bool | np.bool_]:
    """The reference after an instant, and whether it is unclear."""
    up, down, is_step = moves
    above, below = 1.0 + MARGIN, 1.0 - MARGIN
    is_surely_up = shifted > level * (up * above)
    is_surely_down = shifted < level * (down * below)
    is_unclear = (is_up and not is_surely_up) or (is_down and not is_surely_down)
    if not is_step:
        return (shifted if is_surely_up or is_surely_down else level), is_unclear
    if is_surely_up:
        level *= up
        while shifted > level * (up * above):
            level *= up
        is_unclear = shifted >= level * (up * below)
    elif is_surely_down:
        level *= down
        while shifted < level * (down * below):
            level *= down
        is_unclear = shifted <= level * (down * above)
    return level, is_unclear


@jit(inner=True)
def _columns(size: int) -> Columns:
    return (
        np.empty(size, np.int64),
        np.empty(size, np.int16),
        np.empty(size, np.float32),
        np.empty(size, np.float32),
    )


@jit(inner=True)
def _grown(columns: Columns, least: int) -> Columns:
    """The same columns with more room."""
    pixel, segment, before, now = columns
    room = 2 * pixel.size + least
    return grown(pixel, room), grown(segment, room), grown(before, room), grown(now, room)


@jit
def _warp_pixels(pair: WarpPair, index: int, pixel: NDArray[np.int64]) -> NDArray[np.float32]:
    """Luma of some pixels of an intermediate frame.

    Args:
        pair: the pair, prepared.
        index: number of the frame.
        pixel: [n] flat indices.

    Returns:
        [n] float32: the same bits as in the drawn frame.
    """
    warped = np.empty(pixel.size, np.float32)
    room = make_room(pixel.size)
    take_points(pair, pixel, room.points)
    warp_points(pair, room, pixel.size, index, warped)
    return warped

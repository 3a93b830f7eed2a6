"""The definition of the candidates of one pair, picture by picture in NumPy float64."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.warp_reference import warp_between
from texvent.simulate.fused.interface import (
    FOLLOWS,
    MARGIN,
    STEPS,
    TAKES,
    Candidates,
    Float64Array,
    Grids,
    Levels,
    Pictures,
)

Warp: TypeAlias = Callable[..., NDArray[np.float32]]
"""`pairs.warp_reference.warp_between`, or its compiled twin."""


def find_candidates(
    pictures: Pictures, grids: Grids, levels: Levels, warp: Warp = warp_between
) -> Candidates:
    """Every piece at whose end a pixel may fire; see `interface`.

    Args:
        pictures: the pair.
        grids: when pixels are looked at.
        levels: what they compare with.
        warp: draws a picture between two frames.

    Returns:
        The candidates by pixel, then by piece.
    """
    chosen = choose_grids(pictures, grids, levels.balance)
    found = [Candidates(*(np.empty(0, kind) for kind in ("i8", "i2", "i2", "f4", "f4")))]
    for grid in range(len(grids.parts)):
        pixel = np.flatnonzero(chosen.reshape(-1) == grid)
        if pixel.size:
            found += _follow(pixel, grid, (pictures, warp), grids, levels)
    joined = Candidates(*(np.concatenate(column) for column in zip(*found, strict=True)))
    return joined.take(np.lexsort((joined.piece, joined.pixel)))


def choose_grids(pictures: Pictures, grids: Grids, balance: float) -> NDArray[np.int64]:
    """The grid of each pixel: the first that is fine enough, else the last; [H, W]."""
    shape = pictures.earlier.shape
    way2 = np.zeros(shape)
    if pictures.forward.size:
        for flow in (pictures.forward.astype(np.float64), pictures.backward.astype(np.float64)):
            way2 = np.maximum(way2, flow[..., 0] * flow[..., 0] + flow[..., 1] * flow[..., 1])
    first, second = (one.astype(np.float64) + balance for one in pictures[:2])
    low, high = np.minimum(first, second), np.maximum(first, second)
    chosen = np.full(shape, len(grids.parts) - 1)
    for grid in reversed(range(len(grids.parts) - 1)):
        chosen[(way2 <= grids.reach2[grid]) & (high <= low * grids.ratio[grid])] = grid
    return chosen


def _follow(
    pixel: NDArray[np.int64],
    grid: int,
    drawing: tuple[Pictures, Warp],
    grids: Grids,
    levels: Levels,
) -> list[Candidates]:
    """The candidates among the pixels of one grid, piece by piece."""
    pictures, warp = drawing
    before = pictures.earlier.reshape(-1)[pixel]
    level = (
        levels.reference.reshape(-1)[pixel]
        if levels.reference.size
        else before.astype(np.float64) + levels.balance
    )
    is_open = np.zeros(pixel.size, np.bool_)
    found = []
    parts = int(grids.parts[grid])
    for piece in range(parts):
        is_last = piece == parts - 1
        place = float(grids.positions[grid, piece])
        picture = pictures.later if is_last else draw_picture(pictures, place, warp)
        now = picture.reshape(-1)[pixel]
        shifted = now.astype(np.float64) + levels.balance
        is_up = shifted >= level * (levels.up * (1.0 - MARGIN))
        is_down = shifted <= level * (levels.down * (1.0 + MARGIN))
        listed = is_open | is_up | is_down
        number = np.count_nonzero(listed)
        found.append(
            Candidates(
                pixel[listed],
                np.full(number, grid, np.int16),
                np.full(number, piece, np.int16),
                before[listed],
                now[listed],
            )
        )
        level, is_unclear = _moved(level, shifted, is_up, is_down, levels)
        is_open |= is_unclear & listed
        before = now
    return found


def draw_picture(
    pictures: Pictures, position: float, warp: Warp = warp_between
) -> NDArray[np.float32]:
    """The whole picture at a position between the frames, [H, W]."""
    if pictures.forward.size:
        return warp(*pictures, position)
    change = pictures.later - pictures.earlier
    return pictures.earlier + np.float32(position) * change


def _moved(
    level: Float64Array,
    shifted: Float64Array,
    is_up: NDArray[np.bool_],
    is_down: NDArray[np.bool_],
    levels: Levels,
) -> tuple[Float64Array, NDArray[np.bool_]]:
    """Where references stand after a picture, and where that is unclear."""
    if levels.rule == FOLLOWS:
        return shifted, np.zeros(level.shape, np.bool_)
    is_surely_up = shifted > level * (levels.up * (1.0 + MARGIN))
    is_surely_down = shifted < level * (levels.down * (1.0 - MARGIN))
    is_unclear = (is_up & ~is_surely_up) | (is_down & ~is_surely_down)
    if levels.rule == TAKES:
        return np.where(is_surely_up | is_surely_down, shifted, level), is_unclear
    moved = level.copy()
    moved[is_surely_up] *= levels.up
    moved[is_surely_down] *= levels.down
    if levels.rule == STEPS:
        for is_sure, factor, sign in (
            (is_surely_up, levels.up, 1.0),
            (is_surely_down, levels.down, -1.0),
        ):
            left = is_sure
            while left.any():
                passed = sign * shifted > sign * moved * (factor * (1.0 + sign * MARGIN))
                reached = sign * shifted >= sign * moved * (factor * (1.0 - sign * MARGIN))
                is_unclear |= left & reached & ~passed
                left = left & passed
                moved[left] *= factor
    return moved, is_unclear

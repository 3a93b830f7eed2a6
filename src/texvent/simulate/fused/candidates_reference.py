"""The definition of the candidates of one pair, instant by instant in NumPy float64."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.warp_reference import warp_between
from texvent.simulate.crossing.trigger_levels import MARGIN
from texvent.simulate.fused.definitions import (
    FOLLOWS,
    STEPS,
    TAKES,
    CrossingCandidates,
    Float64Array,
    PairArrays,
    ReferenceLevels,
    SampleGrids,
)

Warp: TypeAlias = Callable[..., NDArray[np.float32]]
"""`pairs.warp_reference.warp_between`, or its compiled twin."""


def find_candidates(
    arrays: PairArrays, grids: SampleGrids, levels: ReferenceLevels, warp: Warp = warp_between
) -> CrossingCandidates:
    """Every segment at whose end a pixel may fire; see `interface`.

    Args:
        arrays: the pair.
        grids: when pixels are evaluated.
        levels: what they are compared with.
        warp: draws a frame between two frames.

    Returns:
        The candidates by pixel, then by segment.
    """
    chosen = choose_grids(arrays, grids, levels.balance)
    found = [CrossingCandidates(*(np.empty(0, kind) for kind in ("i8", "i2", "i2", "f4", "f4")))]
    for grid in range(len(grids.parts)):
        pixel = np.flatnonzero(chosen.reshape(-1) == grid)
        if pixel.size:
            found += _list_candidates(pixel, grid, (arrays, warp), grids, levels)
    joined = CrossingCandidates(*(np.concatenate(column) for column in zip(*found, strict=True)))
    return joined.take(np.lexsort((joined.segment, joined.pixel)))


def choose_grids(arrays: PairArrays, grids: SampleGrids, balance: float) -> NDArray[np.int64]:
    """The grid of each pixel: the first that is fine enough, else the last; [H, W]."""
    shape = arrays.earlier.shape
    displacement2 = np.zeros(shape)
    if arrays.forward.size:
        for flow in (
            arrays.forward.astype(np.float64),
            arrays.backward.astype(np.float64),
        ):
            displacement2 = np.maximum(
                displacement2, flow[..., 0] * flow[..., 0] + flow[..., 1] * flow[..., 1]
            )
    first, second = (one.astype(np.float64) + balance for one in arrays[:2])
    low, high = np.minimum(first, second), np.maximum(first, second)
    chosen = np.full(shape, len(grids.parts) - 1)
    for grid in reversed(range(len(grids.parts) - 1)):
        chosen[
            (displacement2 <= grids.max_displacement2[grid]) & (high <= low * grids.max_ratio[grid])
        ] = grid
    return chosen


def _list_candidates(
    pixel: NDArray[np.int64],
    grid: int,
    drawing: tuple[PairArrays, Warp],
    grids: SampleGrids,
    levels: ReferenceLevels,
) -> list[CrossingCandidates]:
    """The candidates among the pixels of one grid, segment by segment."""
    arrays, warp = drawing
    before = arrays.earlier.reshape(-1)[pixel]
    level = (
        levels.reference.reshape(-1)[pixel]
        if levels.reference.size
        else before.astype(np.float64) + levels.balance
    )
    is_open = np.zeros(pixel.size, np.bool_)
    found = []
    parts = int(grids.parts[grid])
    for segment in range(parts):
        is_last = segment == parts - 1
        place = float(grids.positions[grid, segment])
        image = arrays.later if is_last else draw_image(arrays, place, warp)
        now = image.reshape(-1)[pixel]
        shifted = now.astype(np.float64) + levels.balance
        is_up = shifted >= level * (levels.up * (1.0 - MARGIN))
        is_down = shifted <= level * (levels.down * (1.0 + MARGIN))
        listed = is_open | is_up | is_down
        number = np.count_nonzero(listed)
        found.append(
            CrossingCandidates(
                pixel[listed],
                np.full(number, grid, np.int16),
                np.full(number, segment, np.int16),
                before[listed],
                now[listed],
            )
        )
        level, is_unclear = _moved(level, shifted, is_up, is_down, levels)
        is_open |= is_unclear & listed
        before = now
    return found


def draw_image(
    arrays: PairArrays, position: float, warp: Warp = warp_between
) -> NDArray[np.float32]:
    """The whole intermediate frame at a position between the frames, [H, W]."""
    if arrays.forward.size:
        return warp(*arrays, position)
    change = arrays.later - arrays.earlier
    return arrays.earlier + np.float32(position) * change


def _moved(
    level: Float64Array,
    shifted: Float64Array,
    is_up: NDArray[np.bool_],
    is_down: NDArray[np.bool_],
    levels: ReferenceLevels,
) -> tuple[Float64Array, NDArray[np.bool_]]:
    """Where references stand after an instant, and where that is unclear."""
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
                is_reached = sign * shifted >= sign * moved * (factor * (1.0 - sign * MARGIN))
                is_unclear |= left & is_reached & ~passed
                left = left & passed
                moved[left] *= factor
    return moved, is_unclear

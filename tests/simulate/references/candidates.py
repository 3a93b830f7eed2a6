"""The definition of the candidates of one pair, instant by instant in NumPy float64."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from tests.pairs.reference import warp_between

from texvent.simulate.crossing.trigger_levels import MARGIN
from texvent.simulate.fused.bounds import (
    CrossingCandidates,
    Float64Array,
    PairArrays,
    ReferenceLevels,
)


def find_candidates(
    arrays: PairArrays, positions: Float64Array, levels: ReferenceLevels
) -> CrossingCandidates:
    """Every segment at whose end a pixel may fire; see `definitions`.

    Args:
        arrays: the pair.
        positions: [K] τ of each intermediate instant.
        levels: what pixels are compared with.

    Returns:
        The candidates by pixel, then by segment.
    """
    before = arrays.earlier.reshape(-1)
    level = before.astype(np.float64) + levels.balance
    if levels.reference.size:
        level = levels.reference.reshape(-1)
    is_open = np.zeros(before.size, np.bool_)
    found = []
    images = [*(warp_between(*arrays, place) for place in positions.tolist()), arrays.later]
    for segment, image in enumerate(images):
        now = image.reshape(-1)
        shifted = now.astype(np.float64) + levels.balance
        is_up = shifted >= level * (levels.up * (1.0 - MARGIN))
        is_down = shifted <= level * (levels.down * (1.0 + MARGIN))
        listed = np.flatnonzero(is_open | is_up | is_down)
        number = np.full(listed.size, segment, np.int16)
        found.append(CrossingCandidates(listed, number, before[listed], now[listed]))
        level, is_unclear = _moved(level, shifted, is_up, is_down, levels)
        is_open |= is_unclear
        before = now
    joined = CrossingCandidates(*(np.concatenate(column) for column in zip(*found, strict=True)))
    return joined.take(np.lexsort((joined.segment, joined.pixel)))


def _moved(
    level: Float64Array,
    shifted: Float64Array,
    is_up: NDArray[np.bool_],
    is_down: NDArray[np.bool_],
    levels: ReferenceLevels,
) -> tuple[Float64Array, NDArray[np.bool_]]:
    """Where references stand after an instant, and where that is unclear."""
    is_surely_up = shifted > level * (levels.up * (1.0 + MARGIN))
    is_surely_down = shifted < level * (levels.down * (1.0 - MARGIN))
    is_unclear = (is_up & ~is_surely_up) | (is_down & ~is_surely_down)
    if not levels.is_step:
        return np.where(is_surely_up | is_surely_down, shifted, level), is_unclear
    moved = level.copy()
    moved[is_surely_up] *= levels.up
    moved[is_surely_down] *= levels.down
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

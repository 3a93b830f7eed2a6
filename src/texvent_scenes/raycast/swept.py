"""Swept regions: how fast is what passes a block of the image between consecutive instants.

Displacements from one frame to the next bound where something may be in between, generously for
what turns: a rotor may be anywhere within half its path. The shapes of the instants between tell
where it is.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.raycast.acceleration import CUBE, NEAR_M
from texvent_scenes.raycast.changed_tiles import (
    changed_shapes,
    drifting_windows,
    has_flow,
    mirroring_shapes,
    shadow_windows,
)
from texvent_scenes.raycast.records import Record, World
from texvent_scenes.raycast.render import Drawn
from texvent_scenes.raycast.vectors import NO_DISTORTION
from texvent_scenes.rendered_scene import Float32Array, Float64Array

_VIEW = ("origin", "corner", "right", "down", "sun", "shadows", "tile_rows", "tile_columns")
"""Fields of the instant that move all in the image, or its shadows."""
_MOST_BYTES = 1 << 26
"""Bytes of the instants of an interval, above which they are not kept all at once."""


class _Moving(NamedTuple):
    """Differences between two instants."""

    shapes: NDArray[np.int64]
    """[k] numbers of the shapes that differ."""
    windows: Float64Array
    """[k, 4] their screen bounds, all the way."""
    displacements: Float64Array
    """[k] of the fastest of their points, px."""
    others: Float64Array
    """[m, 4] screen bounds of shadows, reflections, spots of lamps and media."""


def is_small(one: Drawn, count: int) -> bool:
    """Whether so many instants like this one may be kept at once."""
    world = one.world
    arrays = (world.shapes, world.lists, world.media, one.primitives.to_world)
    return 2 * count * sum(each.nbytes for each in arrays) <= _MOST_BYTES


def swept_speeds(
    instants: Sequence[Drawn], shape: tuple[int, int], block: int, margin_px: float
) -> Float32Array | None:
    """Displacements between instants of the fastest shape that passes a block in each interval.

    A shape counts with the largest of its displacements; what is no shape, such as a shadow, with
    inf.

    Args:
        instants: of a scene, in their order.
        shape: rows and columns of blocks.
        block: side of a block, pixels.
        margin_px: added around what passes.

    Returns:
        [n - 1, rows, columns], 0 where nothing passes; None: nothing is known.
    """
    moves = list[_Moving]()
    fastest = np.zeros(len(instants[0].world.shapes))
    for before, after in pairwise(instants):
        found = _find_moving(before, after)
        if found is None:
            return None
        np.maximum.at(fastest, found.shapes, found.displacements)
        moves.append(found)
    speeds = np.zeros((len(moves), *shape), np.float32)
    for one, result in zip(moves, speeds, strict=True):
        own = _cells(one.windows, margin_px, block, shape)
        for (left, right, top, bottom), px in zip(own, fastest[one.shapes], strict=True):
            cells = result[top:bottom, left:right]
            np.maximum(cells, np.float32(px), out=cells)
        for left, right, top, bottom in np.unique(
            _cells(one.others, margin_px, block, shape), axis=0
        ):
            result[top:bottom, left:right] = np.inf
    return speeds


def _find_moving(before: Drawn, after: Drawn) -> _Moving | None:
    """Differences between two instants; None: anything may differ."""
    first, second = before.world, after.world
    one, other = first.instant[0], second.instant[0]
    if (
        len(first.shapes) != len(second.shapes)
        or len(first.media) != len(second.media)
        or len(first.glows) != len(second.glows)
        or one["distortion"] != NO_DISTORTION
        or has_flow(one)
        or any(not np.array_equal(one[name], other[name]) for name in _VIEW)
        or _any_beam_turns(first.lamps, second.lamps)
    ):
        return None
    chosen = changed_shapes(before, after)
    if len(chosen) and other["shadow_lamps"]:
        return None
    shadows = shadow_windows(before, after, chosen)
    mirroring = mirroring_shapes(before, after, chosen)
    if shadows is None or mirroring is None:
        return None
    ways = [_between(_glow_windows(first), _glow_windows(second))]
    ways += [_between(shadows[0], shadows[2])] if shadows else []
    still = [second.shapes["window"][mirroring], *shadows[1::2], *drifting_windows(first, second)]
    ends = [world.shapes["window"][chosen] for world in (first, second)]
    corners = [_corners(one, each.primitives.to_world[chosen]) for each in (before, after)]
    lengths = np.linalg.norm(corners[1] - corners[0], axis=2).max(axis=1, initial=0.0)
    displacements = np.where(np.isfinite(lengths), lengths, np.inf)
    return _Moving(chosen, _between(*ends), displacements, np.concatenate([*ways, *still]))


def _corners(instant: Record, to_world: Float64Array) -> Float64Array:
    """[k, 8, 2] corners of the boxes around shapes in the image, px; NaN behind the camera."""
    points = np.einsum("nij,kj->nki", to_world[:, :, :3], CUBE) + to_world[:, None, :, 3]
    basis = np.stack([instant["right"], instant["down"], instant["corner"]], axis=1)
    seen = (points - instant["origin"]) @ np.linalg.inv(basis).T
    depth = np.where(seen[..., 2:] > NEAR_M, seen[..., 2:], np.nan)
    return np.asarray(seen[..., :2] / depth)


def _any_beam_turns(before: NDArray[np.void], after: NDArray[np.void]) -> bool:
    """Whether a lamp with a beam differs, which may sweep anything."""
    if len(before) != len(after):
        return True
    beams = (before["full"] >= -1.0) | (after["full"] >= -1.0)
    return bool((beams & (before != after)).any())


def _glow_windows(world: World) -> Float64Array:
    """[g, 4] screen bounds of the bright spots of lamps."""
    glows = world.glows
    x, y = glows["place"].T
    reach = glows["core_reach"]
    return np.stack([x - reach, x + reach, y - reach, y + reach], axis=1)


def _between(before: Float64Array, after: Float64Array) -> Float64Array:
    """[k, 4] bounds of rectangles on their way, with half of it for what turns."""
    empty = (before[:, 0] > before[:, 1]) | (before[:, 2] > before[:, 3])
    gone = (after[:, 0] > after[:, 1]) | (after[:, 2] > after[:, 3])
    first = np.where(empty[:, None], after, before)
    last = np.where(gone[:, None], before, after)
    moved = 0.5 * np.abs(last - first).max(axis=1, initial=0.0)
    lows, highs = np.minimum(first, last), np.maximum(first, last)
    result = np.stack([lows[:, 0], highs[:, 1], lows[:, 2], highs[:, 3]], axis=1)
    result[:, ::2] -= moved[:, None]
    result[:, 1::2] += moved[:, None]
    result[empty & gone] = (np.inf, -np.inf, np.inf, -np.inf)
    return result


def _cells(
    windows: Float64Array, margin_px: float, block: int, shape: tuple[int, int]
) -> NDArray[np.int64]:
    """[k, 4] left, right, top and bottom of the blocks that each touches, ends not included."""
    limits = np.array([shape[1], shape[0]])
    low = np.clip(np.floor((windows[:, ::2] - margin_px) / block), 0, limits)
    high = np.clip(np.floor((windows[:, 1::2] + margin_px) / block) + 1, 0, limits)
    cells = np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], axis=1)
    return cells.astype(np.int64)

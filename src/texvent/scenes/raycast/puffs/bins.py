"""Puffs at one instant → the records the ray caster reads, listed by screen tile."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.projection import Rays
from texvent.scenes.raycast.acceleration import (
    TILE,
    Bins,
    bin_rectangles,
    invert_maps,
    screen_bounds,
)
from texvent.scenes.raycast.records import PUFF_RECORD
from texvent.scenes.scene import PUFF_COLUMNS, Float64Array, Shape
from texvent.sensor import SensorSize

WIDENED_PX = 1.5
"""Half extent of the smallest puff, pixels: one sample per pixel then sees all of it."""
_MASS = 15.0 / 16.0
"""1 / ∫ (1 - s²)² ds over -1..1: density in the middle for an optical depth of 1."""


class _Balls(NamedTuple):
    shape: NDArray[np.int8]
    to_world: Float64Array


def describe_puffs(puffs: Float64Array, rays: Rays, instant: Any) -> tuple[NDArray[Any], Bins]:
    """Records of the puffs, and which may be seen in each screen tile.

    Puffs are widened as a lens of `WIDENED_PX` would blur them, and thinned as much.

    Args:
        puffs: [k, 19] as in `Environment.puffs`.
        rays: the camera's rays.
        instant: `INSTANT_RECORD` with the size of the grid of tiles.
    """
    rows = np.asarray(puffs, dtype=np.float64).reshape(-1, PUFF_COLUMNS)
    columns, tile_rows = int(instant["tile_columns"]), int(instant["tile_rows"])
    to_world = rows[:, :12].reshape(-1, 3, 4).copy()
    pixel = float(instant["step"]) * np.linalg.norm(to_world[:, :, 3] - rays.origin, axis=1)
    half = np.maximum(np.linalg.norm(to_world[:, :, :3], axis=1), 1e-9)
    wide = np.hypot(half, WIDENED_PX * pixel[:, None])
    to_world[:, :, :3] *= (wide / half)[:, None, :]
    records = np.zeros(len(rows), dtype=PUFF_RECORD)
    inverse, exists = invert_maps(to_world)
    size = SensorSize(columns * TILE, tile_rows * TILE)
    shape = np.full(len(rows), Shape.ELLIPSOID, dtype=np.int8)
    bounds, depth = screen_bounds(_Balls(shape, to_world), rays, size)
    records["inverse"], records["depth"], records["window"] = inverse, depth, bounds
    records["eye"] = inverse[:, :, :3] @ rays.origin + inverse[:, :, 3]
    records["colour"], records["emission"] = rows[:, 12:15], rows[:, 16]
    records["detail"], records["seed"] = rows[:, 17], rows[:, 18]
    records["radius"] = np.cbrt(wide.prod(axis=1))
    thinned = np.cbrt((half / wide).prod(axis=1)) ** 2
    records["thickness"] = _MASS * rows[:, 15] * thinned / records["radius"]
    shown = exists & (bounds[:, 0] <= bounds[:, 1]) & (rows[:, 15] > 0.0)
    numbers = np.flatnonzero(shown)
    corner = instant["plane_corner"][[0, 0, 1, 1]]
    rectangles = np.floor((bounds[numbers] - corner) / TILE).astype(np.int64)
    return records, bin_rectangles(rectangles, numbers, columns, tile_rows)

"""Screen tiles: which of them rectangles touch, and where the ground and walls in them may be."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.raycast.acceleration import TILE
from texvent.scenes.scene import Float64Array, Ground

Mask = NDArray[np.bool_]
ROOM_HEIGHT = 0.6
"""Height of a room's ceiling as a share of half its side; see `trace.background_hit`."""


class Balls(NamedTuple):
    """Balls that hold things."""

    centre: Float64Array
    """[n, 3] m."""
    radius: Float64Array
    """[n] m; negative: there is nothing."""


def touched_tiles(windows: Float64Array, shape: tuple[int, int]) -> Mask:
    """[rows, columns] of that shape: the tiles that closed rectangles touch with their edges.

    The probes of a tile lie on its right and lower edge too.

    Args:
        windows: [k, 4] lowest x, highest x, lowest y, highest y, pixels; lowest > highest: nothing.
        shape: rows and columns of tiles.
    """
    real = windows[(windows[:, 0] <= windows[:, 1]) & (windows[:, 2] <= windows[:, 3])]
    first = np.ceil(real[:, ::2] / TILE).astype(np.int64) - 1
    last = np.floor(real[:, 1::2] / TILE).astype(np.int64) + 1
    rows, columns = shape
    first = np.clip(first, 0, [columns, rows])
    last = np.clip(last, first, [columns, rows])
    # Each rectangle adds 1 inside: +1 and -1 at its corners, summed over rows and columns.
    corners = np.zeros((rows + 1, columns + 1), dtype=np.int64)
    for x, y, sign in ((first, first, 1), (last, first, -1), (first, last, -1), (last, last, 1)):
        np.add.at(corners, (y[:, 1], x[:, 0]), sign)
    return np.asarray(corners.cumsum(axis=0).cumsum(axis=1)[:-1, :-1] > 0)


def tile_directions(instant: Any) -> Float64Array:
    """[rows, columns, 4, 3] rays through the corners of each tile, with 1 along the axis."""
    x = TILE * np.arange(int(instant["tile_columns"]) + 1.0)
    y = TILE * np.arange(int(instant["tile_rows"]) + 1.0)
    grid = (
        instant["corner"] + x[None, :, None] * instant["right"] + y[:, None, None] * instant["down"]
    )
    return np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, :-1], grid[1:, 1:]], axis=2)


def background_balls(instant: Any, directions: Float64Array, farthest_m: float) -> Balls:
    """Balls that hold all ground and walls seen in each tile, nearer than `farthest_m`.

    Args:
        instant: `INSTANT_RECORD` of a camera above the ground and inside the room, if any.
        directions: of `tile_directions`.
        farthest_m: what is farther from the camera counts as nothing, m.
    """
    rays = directions.reshape(-1, 4, 3)
    normals, distances = np.array([[0.0, 0.0, -1.0]]), np.array([instant["origin"][2]])
    if instant["ground"] == Ground.FLOOR:
        walls, apart = room_planes(instant)
        normals, distances = np.vstack([normals, walls]), np.append(distances, apart)
    towards = rays @ normals.T
    depth = np.where(towards > 0.0, distances / np.where(towards > 0.0, towards, 1.0), np.inf)
    # What all planes leave free is convex: between its corners a tile sees nothing nearer than the
    # nearest corner, and nothing behind any plane.
    first = depth.min(axis=(1, 2))
    last = np.minimum(depth.max(axis=1).min(axis=1), farthest_m)
    seen = first <= last
    first, last = np.where(seen, first, 0.0), np.where(seen, last, 0.0)
    ends = np.stack([first, last], axis=1)
    points = instant["origin"] + ends[:, :, None, None] * rays[:, None]
    points = points.reshape(len(rays), 8, 3)
    centre = points.mean(axis=1)
    radius = np.linalg.norm(points - centre[:, None], axis=2).max(axis=1)
    return Balls(centre, np.where(seen, radius * (1.0 + 1e-9) + 1e-6, -1.0))


def room_planes(instant: Any) -> tuple[Float64Array, Float64Array]:
    """Outward normals [5, 3] of a room's walls and ceiling, and the camera's distances [5], m."""
    normals = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]], dtype=float)
    half = float(instant["room"])
    return normals, half * np.array([1, 1, 1, 1, ROOM_HEIGHT]) - normals @ instant["origin"]

"""Scene at one instant → the arrays the ray caster reads, sorted so that it tests few shapes.

Shapes are listed per screen tile (front to back, for the rays from the camera) and per cell of a
grid facing the sun (for shadow rays). A ray then only tests the shapes listed where it is.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.generate.procedural.camera import Rays
from texvent.generate.procedural.primitives import (
    Environment,
    Float64Array,
    Primitives,
    Shape,
)
from texvent.sensor import SensorSize

TILE = 16
"""Side of a screen tile, pixels."""
SUN_CELLS = 64
"""Cells along each side of the sun grid."""
NEAR_M = 0.02
"""Nothing nearer to the camera than this is seen, metres."""
THIN_PX = 1.5
"""Shapes whose half-thickness is below this many pixels are looked for with a wider net."""
IntArray = NDArray[np.int64]
_CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)


class Bins(NamedTuple):
    """Which shapes may lie in each cell of a grid: `items[start[cell] : start[cell + 1]]`."""

    start: IntArray
    """[cells + 1], row-major cells."""
    items: IntArray
    """Shape numbers, in the order given to `bin_rectangles`."""
    columns: int
    rows: int


class Shapes(NamedTuple):
    """The shapes, structure of arrays over n."""

    kind: IntArray
    """[n] `Shape`."""
    inverse: Float64Array
    """[n, 3, 4] world → unit-shape coordinates."""
    eye: Float64Array
    """[n, 3] the camera's position in unit-shape coordinates."""
    sun: Float64Array
    """[n, 3] direction towards the sun in unit-shape coordinates."""
    depth: Float64Array
    """[n] no point of the shape is nearer than this along the optical axis, metres."""
    shrink: Float64Array
    """[n, 3] factors <= 1 on unit-shape coordinates that make a thin shape wide enough to find."""
    is_thin: NDArray[np.bool_]
    """[n] whether any factor is below 1."""
    casts_shadow: NDArray[np.bool_]
    """[n] lamps do not."""


class SunGrid(NamedTuple):
    """Shapes listed by where their shadows run: cells of a plane facing the sun."""

    bins: Bins
    axes: Float64Array
    """[2, 4] cell column and row of a world point: axes[:, :3] · point + axes[:, 3]."""


def bin_rectangles(rectangles: IntArray, numbers: IntArray, columns: int, rows: int) -> Bins:
    """List the rectangles that touch each cell of a grid, in the order given.

    Args:
        rectangles: [k, 4] first column, last column, first row, last row (both included; cells
            outside the grid are left out).
        numbers: [k] what to list.
        columns: cells across.
        rows: cells down.
    """
    low = np.maximum(rectangles[:, ::2], 0)
    high = np.minimum(rectangles[:, 1::2], [columns - 1, rows - 1])
    extent = np.maximum(high - low + 1, 0)
    count = extent[:, 0] * extent[:, 1]
    owner = np.repeat(np.arange(len(numbers)), count)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    column = low[owner, 0] + place % extent[owner, 0]
    row = low[owner, 1] + place // extent[owner, 0]
    cell = row * columns + column
    order = np.argsort(cell, kind="stable")
    start = np.searchsorted(cell[order], np.arange(columns * rows + 1))
    return Bins(start.astype(np.int64), numbers[owner[order]].astype(np.int64), columns, rows)


def picture_bounds(
    primitives: Primitives, rays: Rays, size: SensorSize
) -> tuple[Float64Array, Float64Array]:
    """Where shapes may appear, from the corners of the boxes around them.

    Returns:
        ([n, 4] lowest x, highest x, lowest y, highest y in pixels, [n] least depth in metres).
        A shape wholly behind the camera has an empty rectangle (lowest > highest).
    """
    to_world = primitives.to_world
    corners = np.einsum("nij,kj->nki", to_world[:, :, :3], _CUBE) + to_world[:, None, :, 3]
    basis = np.stack([rays.right, rays.down, rays.corner], axis=1)
    seen = (corners - rays.origin) @ np.linalg.inv(basis).T
    depth = seen[..., 2]
    first, second = np.triu_indices(len(_CUBE), 1)
    gap = depth[:, second] - depth[:, first]
    share = np.clip((NEAR_M - depth[:, first]) / np.where(gap == 0.0, np.inf, gap), 0.0, 1.0)
    cut = seen[:, first] + share[..., None] * (seen[:, second] - seen[:, first])
    points = np.concatenate([seen, cut], axis=1)
    front = points[..., 2] >= NEAR_M * (1.0 - 1e-9)
    place = points[..., :2] / np.where(front, points[..., 2], 1.0)[..., None]
    low = np.where(front[..., None], place, np.inf).min(axis=1)
    high = np.where(front[..., None], place, -np.inf).max(axis=1)
    bounds = np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], axis=1)
    _tighten_ellipsoids(bounds, primitives, np.linalg.inv(basis).astype(np.float64), rays)
    limit = 4.0 * max(size)
    return np.clip(bounds, -limit, limit + max(size)), np.maximum(depth.min(axis=1), 0.0)


def _tighten_ellipsoids(
    bounds: Float64Array, primitives: Primitives, to_picture: Float64Array, rays: Rays
) -> None:
    """Replace the bounds of ellipsoids wholly in front of the camera by their exact outline's."""
    chosen = np.flatnonzero(primitives.shape == Shape.ELLIPSOID)
    axes = np.einsum("ij,njk->nik", to_picture, primitives.to_world[chosen, :, :3])
    centre = (primitives.to_world[chosen, :, 3] - rays.origin) @ to_picture.T
    dual = np.einsum("nik,njk->nij", axes, axes) - centre[:, :, None] * centre[:, None, :]
    front = centre[:, 2] - np.linalg.norm(axes[:, 2], axis=1) > NEAR_M
    chosen, dual = chosen[front], dual[front]
    for axis in (0, 1):
        root = np.sqrt(np.maximum(dual[:, axis, 2] ** 2 - dual[:, axis, axis] * dual[:, 2, 2], 0.0))
        ends = (dual[:, axis, 2, None] + root[:, None] * [-1.0, 1.0]) / dual[:, 2, 2, None]
        bounds[chosen, 2 * axis] = ends.min(axis=1)
        bounds[chosen, 2 * axis + 1] = ends.max(axis=1)


def invert_maps(to_world: Float64Array) -> tuple[Float64Array, NDArray[np.bool_]]:
    """World → unit-shape maps of [n, 3, 4] affine maps, and which of them exist.

    A map that flattens its shape (a scale of 0) has no inverse: its shape is not drawn.
    """
    linear = to_world[:, :, :3]
    exists = np.abs(np.linalg.det(linear)) > 1e-15
    inverse = np.zeros_like(to_world)
    inverse[exists, :, :3] = np.linalg.inv(linear[exists])
    inverse[exists, :, 3] = -np.einsum("nij,nj->ni", inverse[exists, :, :3], to_world[exists, :, 3])
    return inverse, exists


def arrange_shapes(
    primitives: Primitives, environment: Environment, rays: Rays, size: SensorSize
) -> tuple[Shapes, Bins, SunGrid]:
    """Everything a ray needs in order to find the first shape it meets."""
    inverse, exists = invert_maps(np.asarray(primitives.to_world, dtype=np.float64))
    bounds, depth = picture_bounds(primitives, rays, size)
    seen = np.flatnonzero(exists & (bounds[:, 0] <= bounds[:, 1]))
    order = seen[np.argsort(depth[seen], kind="stable")]
    tiles = bin_rectangles(
        np.floor((bounds[order] + [-2.0, 2.0, -2.0, 2.0]) / TILE).astype(np.int64),
        order,
        -(-size.width // TILE),
        -(-size.height // TILE),
    )
    sun = np.asarray(environment.sun_direction, dtype=np.float64)
    sun = sun / np.linalg.norm(sun)
    shrink = _shrink_factors(primitives, rays)
    casts = exists & (np.asarray(primitives.emission) <= 0.0)
    shapes = Shapes(
        kind=primitives.shape.astype(np.int64),
        inverse=inverse,
        eye=inverse[:, :, :3] @ rays.origin + inverse[:, :, 3],
        sun=inverse[:, :, :3] @ sun,
        depth=depth,
        shrink=shrink,
        is_thin=np.any(shrink < 1.0, axis=1),
        casts_shadow=casts,
    )
    return shapes, tiles, _sun_grid(primitives, casts, sun)


def _shrink_factors(primitives: Primitives, rays: Rays) -> Float64Array:
    """[n, 3] by how much each axis must shrink so that the shape spans `THIN_PX` pixels."""
    half = np.linalg.norm(primitives.to_world[:, :, :3], axis=1)
    distance = np.linalg.norm(primitives.to_world[:, :, 3] - rays.origin, axis=1)
    wanted = THIN_PX * distance * np.linalg.norm(rays.right)
    return np.asarray(np.minimum(half / np.maximum(wanted, 1e-12)[:, None], 1.0))


def _sun_grid(primitives: Primitives, casts: NDArray[np.bool_], sun: Float64Array) -> SunGrid:
    """The shapes that cast shadows, listed on a plane facing the sun."""
    numbers = np.flatnonzero(casts)
    helper = np.eye(3)[np.argmin(np.abs(sun))]
    first = np.cross(sun, helper)
    first /= np.linalg.norm(first)
    plane = np.stack([first, np.cross(sun, first)])
    to_world = np.asarray(primitives.to_world, dtype=np.float64)[numbers]
    middle = to_world[:, :, 3] @ plane.T
    parts = np.einsum("ai,nij->naj", plane, to_world[:, :, :3])
    round_shape = primitives.shape[numbers] == Shape.ELLIPSOID
    reach = np.where(round_shape[:, None], np.linalg.norm(parts, axis=2), np.abs(parts).sum(axis=2))
    low, high = middle - reach, middle + reach
    if len(numbers):
        corner, span = low.min(axis=0), np.maximum(high.max(axis=0) - low.min(axis=0), 1e-6)
    else:
        corner, span = np.zeros(2), np.ones(2)
    scale = SUN_CELLS / (span * (1.0 + 1e-9))
    cells = np.empty((len(numbers), 4), dtype=np.int64)
    cells[:, ::2] = np.floor((low - corner) * scale - 1e-6)
    cells[:, 1::2] = np.floor((high - corner) * scale + 1e-6)
    bins = bin_rectangles(cells, numbers, SUN_CELLS, SUN_CELLS)
    axes = np.concatenate([plane * scale[:, None], (-corner * scale)[:, None]], axis=1)
    return SunGrid(bins, axes)

"""Scene at one instant → the arrays the ray caster reads, sorted so that it tests few shapes.

Shapes are listed per screen tile (front to back, for the rays from the camera) and per cell of a
grid facing the sun (for shadow rays). A ray then only tests the shapes listed where it is.
"""

from __future__ import annotations

import functools
import math
from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.camera import Rays
from texvent.lens import Lens, lens_reach
from texvent.runtime.jit import jit
from texvent.sensor import SensorSize
from texvent_scenes.raycast.meshes.tree import describe_surfaces, tree_of
from texvent_scenes.raycast.mirrored import list_mirrored
from texvent_scenes.raycast.records import (
    GLOW_RECORD,
    INSTANT_RECORD,
    SEEN_MEDIUM_RECORD,
    SHAPE_RECORD,
    World,
    describe_lens,
    describe_materials,
    describe_rays,
    describe_surroundings,
)
from texvent_scenes.rendered_scene import LAMP_RECORD, Environment, Float64Array, Primitives, Shape

TILE = 16
"""Side of a screen tile, pixels."""
SUN_CELLS = 96
"""Cells along each side of the sun grid."""
NEAR_M = 0.02
"""Nothing nearer to the camera than this is seen, metres."""
WINDOW_MARGIN_PX = 2.0
"""Added around the part of the image where a shape may be seen: room for widened thin shapes."""
ROUNDING_PX = 0.01
"""Part of it for rounding: beyond, no ray meets the shape itself."""
THIN_PROBES = 0.8
"""Shapes whose half-thickness is below this many probe distances could slip between the probes;
they are looked for with a wider net."""
BIG_SHARE = 1.0
"""Shadow casters wider than this share of all others' extent are tested everywhere, so that a
mountain does not make the sun grid's cells too large for a fence."""
IntArray = NDArray[np.int64]
CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)
"""[8, 3] corners of the box around a unit shape."""


class ImagePlane(NamedTuple):
    """Image without distortion that holds all rays."""

    size: SensorSize
    coarsest_angle: float = 1.0
    coarsest_step: float = 1.0
    """These two as `lens.LensReach` has them."""


class Bins(NamedTuple):
    """Shapes that may lie in each cell of a grid: `items[start[cell] : start[cell + 1]]`."""

    start: IntArray
    """[cells + 1], row-major cells."""
    items: IntArray | NDArray[np.int32]
    """Shape numbers, in the order given to `bin_rectangles`."""
    columns: int
    rows: int


def bin_rectangles(rectangles: IntArray, numbers: IntArray, columns: int, rows: int) -> Bins:
    """List the rectangles that touch each cell of a grid, in the order given.

    Args:
        rectangles: [k, 4] first column, last column, first row, last row (both included; cells
            outside the grid are left out).
        numbers: [k] what to list.
        columns: cells across.
        rows: cells down.
    """
    rectangles = np.ascontiguousarray(rectangles, dtype=np.int64)
    numbers = np.ascontiguousarray(numbers, dtype=np.int64)
    return Bins(*sort_into_cells(rectangles, numbers, columns, rows), columns, rows)


@jit
def sort_into_cells(
    rectangles: IntArray, numbers: IntArray, columns: int, rows: int
) -> tuple[IntArray, IntArray]:
    """`Bins.start` and `Bins.items` of `bin_rectangles`."""
    start = np.zeros(columns * rows + 1, np.int64)
    for first, last, top, bottom in rectangles:
        for row in range(max(top, 0), min(bottom, rows - 1) + 1):
            for column in range(max(first, 0), min(last, columns - 1) + 1):
                start[row * columns + column + 1] += 1
    for cell in range(columns * rows):
        start[cell + 1] += start[cell]
    free = start.copy()
    items = np.empty(start[-1], np.int64)
    for index in range(len(rectangles)):
        first, last, top, bottom = rectangles[index]
        for row in range(max(top, 0), min(bottom, rows - 1) + 1):
            for column in range(max(first, 0), min(last, columns - 1) + 1):
                cell = row * columns + column
                items[free[cell]] = numbers[index]
                free[cell] += 1
    return start, items


def screen_bounds(
    is_round: NDArray[np.bool_], to_world: Float64Array, rays: Rays, size: SensorSize
) -> tuple[Float64Array, Float64Array]:
    """Screen bounds of shapes, from the corners of the boxes around them.

    Args:
        is_round: [n] whether a shape is an ellipsoid.
        to_world: [n, 3, 4] unit shape → world.
        rays: of the camera.
        size: of the image, pixels.

    Returns:
        ([n, 4] lowest x, highest x, lowest y, highest y in pixels, [n] least depth in metres).
        A shape wholly behind the camera has an empty rectangle (lowest > highest).
    """
    corners = np.einsum("nij,kj->nki", to_world[:, :, :3], CUBE) + to_world[:, None, :, 3]
    basis = np.stack([rays.right, rays.down, rays.corner], axis=1)
    seen = (corners - rays.origin) @ np.linalg.inv(basis).T
    depth = seen[..., 2]
    low, high = _extremes(seen)
    crossing = (depth.min(axis=1) < NEAR_M) & (depth.max(axis=1) >= NEAR_M)
    if crossing.any():
        first, second = np.triu_indices(len(CUBE), 1)
        ends = seen[crossing]
        gap = ends[:, second, 2] - ends[:, first, 2]
        share = (NEAR_M - ends[:, first, 2]) / np.where(gap == 0.0, np.inf, gap)
        step = np.clip(share, 0.0, 1.0)[..., None] * (ends[:, second] - ends[:, first])
        points = np.concatenate([ends, ends[:, first] + step], axis=1)
        low[crossing], high[crossing] = _extremes(points)
    bounds = np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], axis=1)
    _tighten_ellipsoids(
        bounds, np.flatnonzero(is_round), to_world, np.linalg.inv(basis).astype(np.float64), rays
    )
    limit = 4.0 * max(size)
    return np.clip(bounds, -limit, limit + max(size)), np.maximum(depth.min(axis=1), 0.0)


def _extremes(points: Float64Array) -> tuple[Float64Array, Float64Array]:
    """Lowest and highest image point, [n, 2], of [n, k, 3] points in front of the camera."""
    front = points[..., 2] >= NEAR_M * (1.0 - 1e-9)
    place = points[..., :2] / np.where(front, points[..., 2], 1.0)[..., None]
    low = np.where(front[..., None], place, np.inf).min(axis=1)
    return low, np.where(front[..., None], place, -np.inf).max(axis=1)


def _tighten_ellipsoids(
    bounds: Float64Array,
    chosen: IntArray,
    to_world: Float64Array,
    to_image: Float64Array,
    rays: Rays,
) -> None:
    """Replace the bounds of ellipsoids wholly in front of the camera by their exact outline's."""
    axes = np.einsum("ij,njk->nik", to_image, to_world[chosen, :, :3])
    centre = (to_world[chosen, :, 3] - rays.origin) @ to_image.T
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


def build_world(
    primitives: Primitives,
    environment: Environment,
    rays: Rays,
    size: SensorSize,
    *,
    shadows: bool,
    samples: int,
    lens: Lens | None = None,
) -> World:
    """Everything the kernels need to draw one instant but lamps and media: see `render.light_up`.

    Args:
        primitives: the shapes.
        environment: the surroundings.
        rays: the camera's rays.
        size: image size, pixels.
        shadows: False turns shadows off.
        samples: probes per pixel side.
        lens: the camera's lens, whose distortion `rays` leave out.

    Raises:
        ConfigError: the lens folds within the image or looks too wide.
    """
    instant = np.zeros(1, dtype=INSTANT_RECORD)
    if getattr(numba.config, "DISABLE_JIT", False):
        # Python takes the fields of these alone as attributes.
        instant = instant.view(np.recarray)
    plane = ImagePlane(size)
    if lens is not None and lens.distortion != "none":
        plane = _describe_distortion(instant[0], lens, size)
    shapes = np.zeros(len(primitives.shape), dtype=SHAPE_RECORD)
    describe_rays(instant[0], rays)
    describe_surroundings(instant[0], environment, shadows)
    describe_materials(instant, shapes, primitives, environment)
    surfaces = describe_surfaces(shapes, primitives)
    inverse, exists = invert_maps(np.asarray(primitives.to_world, dtype=np.float64))
    shapes["inverse"] = inverse
    shapes["sun"] = inverse[:, :, :3] @ instant["sun"][0]
    wanted = _describe_view(instant, shapes, primitives, rays, plane, samples)
    corner = instant["plane_corner"][0][[0, 0, 1, 1]]
    tiles = _tile_lists(shapes["window"] - corner, shapes["depth"], exists, plane.size)
    casts = exists & (np.asarray(primitives.emission) <= 0.0) & (instant["shadows"] != 0)
    sun_cells = _describe_sun_cells(instant[0], shapes, primitives, casts, wanted)
    instant["tile_columns"], instant["tile_rows"] = tiles.columns, tiles.rows
    instant["sun_cells"] = len(tiles.start)
    return World(
        instant,
        shapes,
        _join_lists(tiles, sun_cells),
        surfaces,
        lamps=np.zeros(0, dtype=LAMP_RECORD),
        media=np.zeros(0, dtype=SEEN_MEDIUM_RECORD),
        glows=np.zeros(0, dtype=GLOW_RECORD),
        mirrored=list_mirrored(primitives, inverse, environment),
    ).addressed()


def _describe_view(
    instant: NDArray[Any],
    shapes: NDArray[Any],
    primitives: Primitives,
    rays: Rays,
    plane: ImagePlane,
    samples: int,
) -> Float64Array:
    """Write how shapes stand before the camera, by their inverse maps and extents in the records.

    The instant's record has what of a window's margin only thin shapes need.

    Returns:
        [n] widths that thin shapes are widened to, m.
    """
    is_round = primitives.shape == Shape.ELLIPSOID
    bounds, depth = screen_bounds(is_round, primitives.to_world, rays, plane.size)
    margin = plane.coarsest_step * WINDOW_MARGIN_PX
    inverse = shapes["inverse"]
    shapes["kind"] = primitives.shape
    shapes["eye"] = inverse[:, :, :3] @ rays.origin + inverse[:, :, 3]
    shapes["depth"] = depth
    instant["window_edge"] = margin - plane.coarsest_step * ROUNDING_PX
    shapes["window"] = bounds + margin * np.array([-1.0, 1.0, -1.0, 1.0])
    wanted = _wanted_widths(primitives, rays, plane.coarsest_angle * THIN_PROBES / samples)
    shapes["shrink"] = np.minimum(shapes["extent"] / wanted[:, None], 1.0)
    shapes["is_thin"] = (shapes["shrink"] < 1.0).any(axis=1)
    shapes["is_thin"] |= _mesh_widths(primitives, shapes["extent"]) < wanted
    return wanted


def _describe_sun_cells(
    instant: NDArray[Any],
    shapes: NDArray[Any],
    primitives: Primitives,
    casts: NDArray[np.bool_],
    wanted: Float64Array,
) -> Bins:
    """Write where shapes stand as the sun sees them; returns the shapes of each cell.

    Args:
        instant: the record of the instant; its sun is known.
        shapes: the records of the shapes; which ones are thin is known.
        primitives: the shapes.
        casts: [n] whether a shape casts a shadow.
        wanted: [n] widths that thin shapes are widened to, m.
    """
    sun = instant["sun"]
    plane = _sun_plane(tuple(sun.tolist()))
    margin = np.where(shapes["is_thin"], 2.0 * wanted, 0.0)
    shapes["sun_window"] = _sun_windows(primitives, np.vstack([plane, sun]), margin)
    cells, grid = _sun_lists(shapes["sun_window"], np.flatnonzero(casts))
    instant["sun_plane"], instant["sun_grid"] = plane, grid
    return cells


def _describe_distortion(instant: NDArray[Any], lens: Lens, size: SensorSize) -> ImagePlane:
    """Write the lens into the record."""
    reach = lens_reach(lens, size)
    left, top = (math.floor(edge) - 1 for edge in reach.plane[:2])
    right, bottom = (math.ceil(edge) + 1 for edge in reach.plane[2:])
    describe_lens(instant, lens, (left, top))
    plane = SensorSize(right - left, bottom - top)
    return ImagePlane(plane, reach.coarsest_angle, reach.coarsest_step)


def _join_lists(first: Bins, second: Bins) -> NDArray[np.int32]:
    """Both grids' lists in one array, starts first; starts count from the array's beginning."""
    head = len(first.start) + len(second.start)
    starts = (first.start + head, second.start + head + len(first.items))
    return np.concatenate([*starts, first.items, second.items]).astype(np.int32)


def _tile_lists(
    windows: Float64Array, depth: Float64Array, exists: NDArray[np.bool_], size: SensorSize
) -> Bins:
    """The shapes that may be seen in each screen tile, front to back."""
    seen = np.flatnonzero(exists & (windows[:, 0] <= windows[:, 1]))
    order = seen[np.argsort(depth[seen], kind="stable")]
    rectangles = np.floor(windows[order] / TILE).astype(np.int64)
    return bin_rectangles(rectangles, order, -(-size.width // TILE), -(-size.height // TILE))


def _wanted_widths(primitives: Primitives, rays: Rays, pixels: float) -> Float64Array:
    """[n] metres that `pixels` are at each shape's far end: half-thicknesses to be found."""
    distance = np.linalg.norm(primitives.to_world[:, :, 3] - rays.origin, axis=1)
    half = np.linalg.norm(primitives.to_world[:, :, :3], axis=1).max(axis=1)
    return np.asarray(pixels * np.linalg.norm(rays.right) * (distance + half) + 1e-12)


def _mesh_widths(primitives: Primitives, half: Float64Array) -> Float64Array:
    """[n] half-thickness of the thin parts of meshes, metres, from [n, 3] half extents."""
    widths = np.full(len(half), np.inf)
    if primitives.mesh is not None:
        for index in np.flatnonzero(primitives.shape == Shape.MESH):
            widths[index] = tree_of(primitives.mesh[index]).half_width * half[index].max()
    return widths


@functools.lru_cache(maxsize=4)
def _sun_plane(direction: tuple[float, ...]) -> Float64Array:
    """[2, 3] two unit vectors at right angles to the sun's direction and to each other."""
    sun = np.array(direction)
    helper = np.eye(3)[np.argmin(np.abs(sun))]
    first = np.cross(sun, helper)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(sun, first)])


def _sun_windows(primitives: Primitives, axes: Float64Array, margin: Float64Array) -> Float64Array:
    """[n, 5] bounds of the shapes along the sun plane's axes, and their top towards the sun.

    `axes` [3, 3] ends with the direction towards the sun; thin shapes are `margin` [n] m wider.
    """
    to_world = np.asarray(primitives.to_world, dtype=np.float64)
    middle = to_world[:, :, 3] @ axes.T
    parts = np.einsum("ai,nij->naj", axes, to_world[:, :, :3])
    is_round = (primitives.shape == Shape.ELLIPSOID)[:, None]
    reach = np.where(is_round, np.linalg.norm(parts, axis=2), np.abs(parts).sum(axis=2))
    low, high = middle - reach - margin[:, None], middle + reach + margin[:, None]
    return np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1], high[:, 2]], axis=1)


def _sun_lists(windows: Float64Array, numbers: IntArray) -> tuple[Bins, Float64Array]:
    """The shapes that cast shadows, listed by cells of the plane facing the sun.

    One more cell, the last, lists the big shapes. With the lists comes the grid: [4] its corner,
    metres, then cells per metre.
    """
    if not len(numbers):
        empty = np.zeros(SUN_CELLS * SUN_CELLS + 2, dtype=np.int64)
        return Bins(empty, numbers, SUN_CELLS, SUN_CELLS), np.array([0.0, 0.0, 1.0, 1.0])
    low, high = windows[numbers, 0:4:2], windows[numbers, 1:4:2]
    small = _small_casters(low, high)
    corner = low[small].min(axis=0)
    scale = SUN_CELLS / (np.maximum(high[small].max(axis=0) - corner, 1e-6) * (1.0 + 1e-9))
    cells = np.empty((int(small.sum()), 4), dtype=np.int64)
    cells[:, ::2] = np.floor((low[small] - corner) * scale - 1e-6)
    cells[:, 1::2] = np.floor((high[small] - corner) * scale + 1e-6)
    bins = bin_rectangles(cells, numbers[small], SUN_CELLS, SUN_CELLS)
    items = np.concatenate([bins.items, numbers[~small]])
    start = np.append(bins.start, len(items))
    return Bins(start, items, SUN_CELLS, SUN_CELLS), np.concatenate([corner, scale])


def _small_casters(low: Float64Array, high: Float64Array) -> NDArray[np.bool_]:
    """Shapes that are small beside the extent of the others: [k] from [k, 2] bounds."""
    width = (high - low).max(axis=1)
    extent = np.quantile(high, 0.9, axis=0) - np.quantile(low, 0.1, axis=0)
    small = width <= max(BIG_SHARE * float(extent.max()), float(np.median(width)))
    return np.asarray(small, dtype=np.bool_)

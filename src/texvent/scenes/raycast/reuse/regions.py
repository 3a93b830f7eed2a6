"""What a change of a shape or a lamp can reach: light and shadow."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.raycast.acceleration import CUBE, TILE, screen_bounds
from texvent.scenes.raycast.lamps.light import in_beam
from texvent.scenes.raycast.trace import MESH, SHADOW_BIAS_M
from texvent.scenes.scene import Float64Array, Ground, Primitives, Rays
from texvent.sensor import SensorSize

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


BIAS_M = 2.0 * SHADOW_BIAS_M
"""How far beside a surface its shadow rays may begin, with room for rounding, m."""
LOWEST_SUN = 1e-3
"""Below this sine of the sun's height its shadows are longer than the world."""


def shape_balls(shapes: NDArray[Any], primitives: Primitives) -> Balls:
    """Balls that hold shapes, as wide as thin ones are made to be found."""
    to_world = np.asarray(primitives.to_world, dtype=np.float64)
    widened = to_world[:, :, :3] / np.maximum(shapes["shrink"], 1e-9)[:, None, :]
    corners = np.einsum("nij,kj->nki", widened, CUBE)
    radius = np.linalg.norm(corners, axis=2).max(axis=1)
    return Balls(to_world[:, :, 3], radius * (1.0 + 1e-9) + BIAS_M)


def receiving_balls(shapes: NDArray[Any], balls: Balls) -> Balls:
    """Balls that hold the points of shapes where shadow rays begin."""
    # On a mesh they begin where it would be smooth: `trace.shadow_point`.
    return balls._replace(radius=np.where(shapes["kind"] == MESH, 3.0, 1.0) * balls.radius)


def lit_by_lamp(lamp: Any, balls: Balls) -> Mask:
    """[n] which balls a lamp's light may reach, whatever stands in its way."""
    offset = balls.centre - lamp["place"]
    distance = np.linalg.norm(offset, axis=1)
    there = balls.radius >= 0.0
    near = there & (distance - balls.radius <= lamp["reach"])
    if lamp["full"] >= -1.0:
        near &= in_beam(lamp, offset, distance, np.maximum(balls.radius, 0.0))
    return np.asarray(near)


def shaded_from_lamp(lamp: Any, casters: Balls, balls: Balls) -> Mask:
    """[n] which balls the shadow of a caster may fall on."""
    place = lamp["place"]
    towards, width = _seen_from(place, casters)
    ways, widths = _seen_from(place, balls)
    cosine = np.clip(towards @ ways.T, -1.0, 1.0)
    reaches = np.arccos(cosine) <= width[:, None] + widths[None, :] + 1e-6
    start = np.linalg.norm(casters.centre - place, axis=1) - casters.radius
    end = np.linalg.norm(balls.centre - place, axis=1) + balls.radius
    return np.asarray((reaches & (end >= start[:, None])).any(axis=0) & lit_by_lamp(lamp, balls))


def _seen_from(place: Float64Array, balls: Balls) -> tuple[Float64Array, Float64Array]:
    """Unit vectors to balls and their angular radii, radians; π around the place itself."""
    offset = balls.centre - place
    distance = np.maximum(np.linalg.norm(offset, axis=1), 1e-12)
    sine = balls.radius / distance
    width = np.where(sine >= 1.0 - 1e-9, np.pi, np.arcsin(np.clip(sine, 0.0, 1.0)))
    return offset / distance[:, None], width


def sun_shadow_windows(
    instant: Any, shapes: NDArray[Any], chosen: NDArray[np.int64]
) -> Float64Array | None:
    """Where in the image the sun's shadows of some shapes may lie on the ground: [k, 4], pixels.

    None: the sun is so low that there is no telling.
    """
    if instant["ground"] == Ground.NONE:
        return np.zeros((0, 4))
    sun, plane = instant["sun"], instant["sun_plane"]
    if sun[2] < LOWEST_SUN:
        return None
    window = shapes["sun_window"][chosen] + BIAS_M * np.array([-1.0, 1.0, -1.0, 1.0, 1.0])
    # Each axis of the plane facing the sun, moved along the sun's direction down to the ground.
    axes = plane - (plane[:, 2:] / sun[2]) * sun
    middle, half = window[:, 0:4:2] + window[:, 1:4:2], window[:, 1:4:2] - window[:, 0:4:2]
    to_world = np.zeros((len(chosen), 3, 4))
    to_world[:, :, :2] = 0.5 * half[:, None, :] * axes.T
    to_world[:, :, 3] = 0.5 * middle @ axes
    rays = Rays(instant["origin"], instant["corner"], instant["right"], instant["down"])
    size = SensorSize(TILE * int(instant["tile_columns"]), TILE * int(instant["tile_rows"]))
    bounds = screen_bounds(np.zeros(len(to_world), dtype=np.bool_), to_world, rays, size)[0]
    return np.asarray(bounds + np.array([-1.0, 1.0, -1.0, 1.0]))


def sunlit_behind(shapes: NDArray[Any], balls: Balls, chosen: NDArray[np.int64]) -> Mask:
    """[n] which shapes some shapes may shade from the sun.

    Shadow rays of a mesh begin where it would be smooth, which is at most its own size outside.
    """
    own, other = shapes["sun_window"], shapes["sun_window"][chosen]
    beyond = np.where(shapes["kind"] == MESH, 2.0 * balls.radius, BIAS_M)[:, None]
    result: Mask = np.ones((len(own), len(other)), dtype=np.bool_)
    for low, high in ((0, 1), (2, 3)):
        result &= own[:, low, None] - beyond <= other[None, :, high]
        result &= other[None, :, low] <= own[:, high, None] + beyond
    return np.asarray(result.any(axis=1))

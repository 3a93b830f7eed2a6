"""Tiles of the image that can differ between two instants of a scene.

A shape that differs reaches the tiles that it covers, and those of the sun's shadow; a medium those
that it covers. Where the camera, lamps or surroundings differ, all tiles can.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.camera import Rays
from texvent.sensor import SensorSize
from texvent_scenes.raycast.acceleration import CUBE, SUN_CELLS, TILE, screen_bounds
from texvent_scenes.raycast.mirrored import REACH
from texvent_scenes.raycast.records import INSTANT_RECORD, World
from texvent_scenes.raycast.render import Drawn
from texvent_scenes.raycast.shading.lighting import SHARP
from texvent_scenes.raycast.trace import MESH, SHADOW_BIAS_M
from texvent_scenes.raycast.vectors import NO_DISTORTION
from texvent_scenes.rendered_scene import FIRST_SURFACE, Float64Array, Ground, Primitives

Mask = NDArray[np.bool_]
BIAS_M = 2.0 * SHADOW_BIAS_M
"""Distance from a surface at which its shadow rays may begin, with room for rounding, m."""
LOWEST_SUN = 1e-3
"""Below this sine of the sun's height its shadows are longer than the world."""
_FLOWING = (Ground.SEA, Ground.UNDERWATER, Ground.RIVER, Ground.LAKE)
"""Grounds that change with time."""
_ELSEWHERE = {
    "lamp_cells", "medium_tiles", "shapes", "lists", "nodes", "triangles", "images", "texels",
    "lamps", "media", "glows", "mirrored", "sun_grid", "sun_cells", "time", "crossings",
}  # fmt: skip
"""Fields of the instant that are addresses, or that are compared on their own."""
_FIELDS = [name for name in INSTANT_RECORD.names or () if name not in _ELSEWHERE]


def changed_tiles(before: Drawn, after: Drawn) -> Mask | None:
    """Tiles of the image that can differ.

    Args:
        before: one instant of a scene, with the same size, samples and shadows as the other.
        after: another instant.

    Returns:
        [rows, columns] of tiles; None: all may differ.
    """
    if not _is_comparable(before.world, after.world):
        return None
    instant, chosen = after.world.instant[0], changed_shapes(before, after)
    if len(chosen) and instant["shadow_lamps"]:
        return None
    shadows = shadow_windows(before, after, chosen)
    if shadows is None:
        return None
    mirroring = mirroring_shapes(before, after, chosen)
    if mirroring is None:
        return None
    windows = [one.world.shapes["window"][chosen] for one in (before, after)]
    windows.append(after.world.shapes["window"][mirroring])
    windows += drifting_windows(before.world, after.world)
    tiles = touched_tiles(np.concatenate([*windows, *shadows]), instant)
    if before.world.instant[0]["time"] != instant["time"] and instant["clouds"] > 0.0:
        tiles |= _sky_tiles(instant)
    return tiles


def _is_comparable(before: World, after: World) -> bool:
    """Whether camera, lamps and surroundings are the same, and changes can be followed."""
    first, second = before.instant[0], after.instant[0]
    count = int(first["crossing_count"])
    return bool(
        len(before.shapes) == len(after.shapes)
        and first["distortion"] == NO_DISTORTION
        and not (first["time"] != second["time"] and has_flow(first))
        and all(np.array_equal(first[name], second[name]) for name in _FIELDS)
        and np.array_equal(first["crossings"][:count], second["crossings"][:count])
        and np.array_equal(before.lamps, after.lamps)
        and len(before.media) == len(after.media)
        and np.array_equal(before.glows, after.glows)
    )


def has_flow(instant: Any) -> bool:
    """Whether the ground changes with time."""
    return bool(instant["ground"] in _FLOWING)


def changed_shapes(before: Drawn, after: Drawn) -> NDArray[np.int64]:
    """Numbers of the shapes that differ in any bit, or whose mesh or image does."""
    changed = _differing(before.world.shapes, after.world.shapes)
    for name in ("mesh", "image"):
        one, other = getattr(before.primitives, name), getattr(after.primitives, name)
        if one is None and other is None:
            continue
        if one is None or other is None:
            changed[:] = True
        else:
            changed |= np.array([a is not b for a, b in zip(one, other, strict=True)], bool)
    return np.flatnonzero(changed)


def drifting_windows(before: World, after: World) -> list[Float64Array]:
    """Screen bounds of the media that differ, [k, 4] each, pixels."""
    differs = _differing(before.media, after.media)
    return [world.media["window"][differs] for world in (before, after)]


def mirroring_shapes(
    before: Drawn, after: Drawn, chosen: NDArray[np.int64]
) -> NDArray[np.int64] | None:
    """Numbers of glossy shapes that may mirror the `chosen`; None: the ground may too."""
    first, second = before.world.mirrored, after.world.mirrored
    if len(first) != len(second):
        return None
    differs = _differing(first, second)
    if not len(chosen) and not differs.any():
        return np.zeros(0, np.int64)
    moved = np.concatenate([first[differs], second[differs]])
    if after.world.instant[0]["wetness"] > 0.0:
        return None
    shapes, to_world = after.world.shapes, after.primitives.to_world
    texture = np.maximum(shapes["texture"] - FIRST_SURFACE, 0)
    coats = after.world.instant[0]["gloss"][texture]
    glossy = np.flatnonzero(coats[:, 0] > 0.0)
    radius = np.linalg.norm(to_world[glossy, :, :3], axis=(1, 2))
    away = np.linalg.norm(to_world[glossy, None, :, 3] - moved["middle"], axis=2)
    near = (away - radius[:, None] < REACH * moved["radius"]).any(axis=1)
    return np.asarray(glossy[near | (coats[glossy, 1] < SHARP)])


def _differing(first: NDArray[Any], second: NDArray[Any]) -> Mask:
    """[n] records that differ in any bit."""
    if not len(first):
        return np.zeros(0, np.bool_)
    one, other = (
        np.ascontiguousarray(records).view(np.uint8).reshape(len(records), -1)
        for records in (first, second)
    )
    return np.asarray((one != other).any(axis=1))


def touched_tiles(windows: Float64Array, instant: Any) -> Mask:
    """[rows, columns] of tiles that closed rectangles touch with their edges.

    The probes of a tile lie on its right and lower edge too.

    Args:
        windows: [k, 4] lowest x, highest x, lowest y, highest y, pixels; lowest > highest: nothing.
        instant: `INSTANT_RECORD` with the numbers of tiles.
    """
    rows, columns = int(instant["tile_rows"]), int(instant["tile_columns"])
    real = windows[(windows[:, 0] <= windows[:, 1]) & (windows[:, 2] <= windows[:, 3])]
    first = np.clip(np.ceil(real[:, ::2] / TILE).astype(np.int64) - 1, 0, [columns, rows])
    last = np.floor(real[:, 1::2] / TILE).astype(np.int64) + 1
    last = np.clip(last, first, [columns, rows])
    tiles: Mask = np.zeros((rows, columns), dtype=np.bool_)
    for (left, top), (right, bottom) in zip(first, last, strict=True):
        tiles[top:bottom, left:right] = True
    return tiles


def _sky_tiles(instant: Any) -> Mask:
    """[rows, columns] of tiles in which some ray goes up, where clouds drift; none in a room."""
    x = TILE * np.arange(int(instant["tile_columns"]) + 1.0)
    y = TILE * np.arange(int(instant["tile_rows"]) + 1.0)
    up = instant["corner"][2] + x * instant["right"][2] + y[:, None] * instant["down"][2] > 0.0
    if instant["ground"] == Ground.FLOOR:
        up[:] = False
    return np.asarray(up[:-1, :-1] | up[:-1, 1:] | up[1:, :-1] | up[1:, 1:])


def shadow_windows(
    before: Drawn, after: Drawn, chosen: NDArray[np.int64]
) -> list[Float64Array] | None:
    """Screen bounds of the sun's shadows of some shapes, pixels; None: anywhere.

    Two arrays for each instant, [k, 4] each: on the ground, of shapes that cast a shadow at either
    instant; and on other shapes.
    """
    if not after.world.instant[0]["shadows"]:
        return []
    if not np.array_equal(_big_casters(before.world), _big_casters(after.world)):
        return None
    dark = [world.shapes["emission"][chosen] <= 0.0 for world, _ in (before, after)]
    casters = chosen[dark[0] | dark[1]]
    windows = []
    for world, primitives in (before, after):
        on_ground = _windows_on_ground(world.instant[0], world.shapes, casters)
        if on_ground is None:
            return None
        behind = _sunlit_behind(world.shapes, primitives, casters)
        windows += [on_ground, world.shapes["window"][behind]]
    return windows


def _big_casters(world: World) -> NDArray[np.int32]:
    """Shapes that the sun grid lists apart: they are tested after the others."""
    lists = world.lists
    last = int(world.instant[0]["sun_cells"]) + SUN_CELLS * SUN_CELLS
    return lists[lists[last] : lists[last + 1]]


def _windows_on_ground(
    instant: Any, shapes: NDArray[Any], chosen: NDArray[np.int64]
) -> Float64Array | None:
    """Screen bounds of the sun's shadows of some shapes on the ground: [k, 4], pixels.

    None: anywhere, as the sun is low.
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


def _sunlit_behind(shapes: NDArray[Any], primitives: Primitives, chosen: NDArray[np.int64]) -> Mask:
    """[n] whether some other shapes may shade each shape from the sun.

    Shadow rays of a mesh begin where it would be smooth (`trace.shadow_point`), which is at most
    its own size outside.
    """
    corners = np.einsum("nij,kj->nki", np.asarray(primitives.to_world)[:, :, :3], CUBE)
    radius = np.linalg.norm(corners, axis=2).max(axis=1)
    own, other = shapes["sun_window"], shapes["sun_window"][chosen]
    beyond = np.where(shapes["kind"] == MESH, 2.0 * radius + BIAS_M, BIAS_M)[:, None]
    result: Mask = np.ones((len(own), len(other)), dtype=np.bool_)
    for low, high in ((0, 1), (2, 3)):
        result &= own[:, low, None] - beyond <= other[None, :, high]
        result &= other[None, :, low] <= own[:, high, None] + beyond
    return np.asarray(result.any(axis=1))

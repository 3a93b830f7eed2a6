"""A scene drawn at one instant after another: only tiles that can differ are drawn again."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.raycast.acceleration import SUN_CELLS, TILE
from texvent.scenes.raycast.records import INSTANT_RECORD, World
from texvent.scenes.raycast.render import light_of_rows, world_and_shapes
from texvent.scenes.raycast.reuse.regions import (
    Balls,
    Mask,
    background_balls,
    lit_by_lamp,
    receiving_balls,
    room_planes,
    shaded_from_lamp,
    shape_balls,
    sun_shadow_windows,
    sunlit_behind,
    tile_directions,
    touched_tiles,
)
from texvent.scenes.raycast.vectors import NO_DISTORTION
from texvent.scenes.scene import Float32Array, Float64Array, Ground, Primitives, Scene
from texvent.sensor import SensorSize
from texvent.transfer import encode_srgb

_WALL_M = 0.1
"""A camera or a lamp nearer to the ground or a wall than this may be outside, m."""
_FLOWING = (Ground.SEA, Ground.UNDERWATER, Ground.RIVER, Ground.LAKE)
"""Grounds that change with time."""
_ELSEWHERE = {
    "lamp_cells", "puff_tiles", "shapes", "lists", "nodes", "triangles", "images", "texels",
    "lamps", "puffs", "puff_count", "glows", "glow_count", "sun_grid", "sun_cells", "time",
    "crossings",
}  # fmt: skip
"""Fields of the instant that only say where something lies, or that are looked at by themselves."""
_FIELDS = [name for name in INSTANT_RECORD.names or () if name not in _ELSEWHERE]


class Drawn(NamedTuple):
    """One instant as it was drawn."""

    world: World
    primitives: Primitives


class _Pair(NamedTuple):
    """Two instants, and which of their shapes differ."""

    before: Drawn
    after: Drawn
    shapes: NDArray[np.int64]
    """Numbers of the shapes that differ."""
    directions: Float64Array
    """Of `tile_directions`."""

    @property
    def instant(self) -> Any:
        return self.after.world.instant[0]


def changed_tiles(before: Drawn, after: Drawn) -> Mask | None:
    """Which tiles of the image may differ.

    Args:
        before: one instant of a scene, with the same size, samples and shadows as the other.
        after: another instant.

    Returns:
        [rows, columns] of tiles; None: all may differ.
    """
    instant = after.world.instant[0]
    if not _is_comparable(before.world, after.world):
        return None
    pair = _Pair(before, after, _changed_shapes(before, after), tile_directions(instant))
    tiles: Mask = np.zeros(pair.directions.shape[:2], dtype=np.bool_)
    for part in (_by_time, _by_view, _by_sun, _by_puffs, _by_lamps, _by_glows):
        own = part(pair)
        if own is None:
            return None
        tiles |= own
    return tiles


def _is_comparable(before: World, after: World) -> bool:
    """Whether camera and surroundings are the same, and such that changes can be followed."""
    first, second = before.instant[0], after.instant[0]
    is_outside = first["origin"][2] < _WALL_M and first["ground"] != Ground.NONE
    if first["ground"] == Ground.FLOOR:
        is_outside |= bool(room_planes(first)[1].min() < _WALL_M)
    return bool(
        len(before.shapes) == len(after.shapes)
        and before.lamps.shape == after.lamps.shape
        and (len(before.glows) > 0) == (len(after.glows) > 0)
        and first["distortion"] == NO_DISTORTION
        and not is_outside
        and not (first["time"] != second["time"] and first["ground"] in _FLOWING)
        and all(np.array_equal(first[name], second[name]) for name in _FIELDS)
        and _same_crossings(first, second)
    )


def _same_crossings(first: Any, second: Any) -> bool:
    count = int(first["crossing_count"])
    return np.array_equal(first["crossings"][:count], second["crossings"][:count])


def _changed_shapes(before: Drawn, after: Drawn) -> NDArray[np.int64]:
    changed = _rows_differ(before.world.shapes, after.world.shapes)
    for name in ("mesh", "image"):
        first, second = getattr(before.primitives, name), getattr(after.primitives, name)
        if first is None and second is None:
            continue
        if first is None or second is None:
            changed[:] = True
        else:
            changed |= np.array([a is not b for a, b in zip(first, second, strict=True)], bool)
    return np.flatnonzero(changed)


def _rows_differ(first: NDArray[Any], second: NDArray[Any]) -> Mask:
    """[n] which rows of two arrays differ in any bit."""
    if not len(first):
        return np.zeros(0, dtype=np.bool_)
    one, other = (
        np.ascontiguousarray(each).view(np.uint8).reshape(len(first), -1)
        for each in (first, second)
    )
    return np.asarray((one != other).any(axis=1))


def _by_time(pair: _Pair) -> Mask | None:
    """Tiles with sky where clouds drift."""
    first, second = pair.before.world.instant[0], pair.instant
    if first["time"] == second["time"] or second["clouds"] <= 0.0:
        return np.zeros(pair.directions.shape[:2], dtype=np.bool_)
    if second["ground"] == Ground.FLOOR:
        return np.zeros(pair.directions.shape[:2], dtype=np.bool_)
    return np.asarray((pair.directions[..., 2] > 0.0).any(axis=2))


def _by_view(pair: _Pair) -> Mask:
    """Tiles where shapes that differ may be seen."""
    windows = [each.world.shapes["window"][pair.shapes] for each in (pair.before, pair.after)]
    return touched_tiles(np.concatenate(windows), pair.directions.shape[:2])


def _by_sun(pair: _Pair) -> Mask | None:
    """Tiles where the sun's shadows of shapes that differ may be seen."""
    shape = pair.directions.shape[:2]
    tiles: Mask = np.zeros(shape, dtype=np.bool_)
    if not pair.instant["shadows"]:
        return tiles
    if not np.array_equal(_big_casters(pair.before.world), _big_casters(pair.after.world)):
        return None
    for world, primitives in (pair.before, pair.after):
        chosen = pair.shapes[world.shapes["emission"][pair.shapes] <= 0.0]
        windows = sun_shadow_windows(world.instant[0], world.shapes, chosen)
        if windows is None:
            return None
        behind = sunlit_behind(world.shapes, shape_balls(world.shapes, primitives), chosen)
        tiles |= touched_tiles(windows, shape)
        tiles |= touched_tiles(world.shapes["window"][behind], shape)
    return tiles


def _big_casters(world: World) -> NDArray[np.int32]:
    """Shapes that the sun grid lists apart: they are tested after the others."""
    lists = world.lists
    last = int(world.instant[0]["sun_cells"]) + SUN_CELLS * SUN_CELLS
    return lists[lists[last] : lists[last + 1]]


def _by_puffs(pair: _Pair) -> Mask:
    """Tiles where puffs that differ may be seen; light of lamps that differ is on all of them."""
    first, second = pair.before.world, pair.after.world
    windows = [first.puffs["window"], second.puffs["window"]]
    if len(first.puffs) == len(second.puffs) and np.array_equal(first.lamps, second.lamps):
        differ = _rows_differ(first.puffs, second.puffs)
        windows = [one[differ] for one in windows]
    return touched_tiles(np.concatenate(windows), pair.directions.shape[:2])


def _by_glows(pair: _Pair) -> Mask:
    """Tiles that the glow of lamps reaches that differ."""
    first, second = pair.before.world.glows, pair.after.world.glows
    if len(first) == len(second):
        differ = _rows_differ(first, second)
        first, second = first[differ], second[differ]
    windows = []
    for glows in (first, second):
        reach = np.maximum(glows["core_reach"], glows["halo_reach"])[:, None] + 1.0
        place = glows["place"]
        windows.append(np.hstack([place - reach, place + reach])[:, [0, 2, 1, 3]])
    return touched_tiles(np.concatenate(windows), pair.directions.shape[:2])


def _by_lamps(pair: _Pair) -> Mask | None:
    """Tiles that light of lamps reaches that differ, or shadows in the light of others."""
    lamps = pair.before.world.lamps, pair.after.world.lamps
    count = int(pair.instant["shadow_lamps"])
    differ = [int(index) for index in np.flatnonzero(_rows_differ(*lamps))]
    if any(not _is_inside(pair.instant, each[index]) for each in lamps for index in differ):
        return None
    shape = pair.directions.shape[:2]
    tiles: Mask = np.zeros(shape, dtype=np.bool_)
    steady = [index for index in range(count) if index not in differ]
    if not differ and not (steady and len(pair.shapes)):
        return tiles
    ground = background_balls(pair.instant, pair.directions, _farthest(pair.instant, *lamps))
    hits: Mask = np.zeros(len(ground.radius), dtype=np.bool_)
    for rows, (world, primitives) in zip(lamps, (pair.before, pair.after), strict=True):
        balls = shape_balls(world.shapes, primitives)
        receivers = receiving_balls(world.shapes, balls)
        casters = Balls(*(each[pair.shapes] for each in balls))
        reached: Mask = np.zeros(len(balls.radius), dtype=np.bool_)
        for index in differ:
            reached |= lit_by_lamp(rows[index], receivers)
            hits |= lit_by_lamp(rows[index], ground)
        for index in steady if len(pair.shapes) else ():
            reached |= shaded_from_lamp(rows[index], casters, receivers)
            hits |= shaded_from_lamp(rows[index], casters, ground)
        # Which side of a shape faces a lamp that casts shadows is told beyond its light too.
        reached |= bool((lamps[0]["place"][:count] != lamps[1]["place"][:count]).any())
        tiles |= touched_tiles(world.shapes["window"][reached], shape)
    return tiles | hits.reshape(shape)


def _is_inside(instant: Any, lamp: Any) -> bool:
    """Whether a lamp is above the ground and inside the room: all of it then faces the lamp."""
    if instant["ground"] == Ground.NONE:
        return True
    inside = lamp["place"][2] > _WALL_M
    if instant["ground"] == Ground.FLOOR:
        normals, distances = room_planes(instant)
        inside &= ((lamp["place"] - instant["origin"]) @ normals.T + _WALL_M < distances).all()
    return bool(inside)


def _farthest(instant: Any, *lamps: NDArray[Any]) -> float:
    """How far along the camera's axis any of these lamps shines, m."""
    rows = np.concatenate(lamps)
    return (
        float((np.linalg.norm(rows["place"] - instant["origin"], axis=1) + rows["reach"]).max())
        + 1.0
    )


MOST_CHANGED = 0.9
"""Above this share of tiles all are drawn."""


class FrameMemory:
    """Draws a scene as `render` does, to the last bit, and remembers the last frame.

    Several threads may use it: each call reads the last frame once and replaces it whole.

    Args:
        scene: what is drawn.
        size: of the frames, pixels.
        samples: as for `render`.
        shadows: as for `render`.
        code: makes levels of light (1 is white).
    """

    def __init__(
        self,
        scene: Scene,
        size: SensorSize,
        *,
        samples: int,
        shadows: bool,
        code: Callable[[Float64Array], Float32Array] = encode_srgb,
    ) -> None:
        self._scene, self._size, self._code = scene, size, code
        self._samples, self._shadows = samples, shadows
        self._last: tuple[Drawn, Float32Array] | None = None

    def render(self, time_s: float) -> Float32Array:
        """The frame at an instant, [H, W, 3], coded."""
        size, samples = self._size, self._samples
        world, primitives = world_and_shapes(
            self._scene, time_s, size, shadows=self._shadows, samples=samples
        )
        drawn, last = Drawn(world, primitives), self._last
        tiles = None if last is None else changed_tiles(last[0], drawn)
        if last is None or tiles is None or tiles.mean() > MOST_CHANGED:
            light = light_of_rows(world, (0, size.height), size, samples=samples)
            pixels = self._code(light)
        else:
            wanted = tiles.repeat(TILE, axis=0).repeat(TILE, axis=1)[: size.height, : size.width]
            light = light_of_rows(world, (0, size.height), size, samples=samples, wanted=wanted)
            pixels = last[1].copy()
            pixels[wanted] = self._code(light[wanted])
        kept = pixels.copy()
        kept.flags.writeable = False
        self._last = drawn, kept
        return np.asarray(pixels)

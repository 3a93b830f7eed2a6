"""Light in every pixel of one tile (compiled by Numba).

Edges matter most: a pixel that jumps as an edge passes fires false events. So every pixel is first
probed on a fine lattice for *what* is there. Where all probes agree, one shaded sample is exact
enough, because textures are already averaged over the pixel; where they differ, or something thin
is near, many samples, no two of them in the same row or column, say what share each surface has.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from texvent.generate.procedural.primitives import Float64Array
from texvent.generate.procedural.raycast.arrange import TILE
from texvent.generate.procedural.raycast.borrow import borrow
from texvent.generate.procedural.raycast.light import light_at
from texvent.generate.procedural.raycast.records import World
from texvent.generate.procedural.raycast.sky import Colour
from texvent.generate.procedural.raycast.trace import (
    ROOM,
    SKY,
    background_hit,
    first_hit,
    hit_again,
    ray_direction,
    sun_reaches,
    surface_normal,
)

_THIN = -(1 << 40)
"""Probe value that agrees with nothing: something thin is near."""
_SHOULDER = 0.75
"""Light above this share of white is compressed instead of cut off."""


@njit(cache=True, nogil=True, error_model="numpy")
def _is_lit(world: World, x: float, y: float, hit: tuple[float, int, int]) -> tuple[bool, bool]:
    """Whether the sun reaches what was hit, and whether a thin shadow is near."""
    depth, number, face = hit
    if number in (SKY, ROOM):
        return False, False
    direction, origin = ray_direction(world.instant[0], x, y), world.instant[0].origin
    point = (
        origin[0] + depth * direction[0],
        origin[1] + depth * direction[1],
        origin[2] + depth * direction[2],
    )
    return sun_reaches(world, point, surface_normal(world, number, face, point))


@njit(cache=True, nogil=True, error_model="numpy")
def _probe(world: World, x: float, y: float) -> int:
    """What is at picture point (x, y), as one number: surface, face, and lit or not."""
    depth, number, face, _ = first_hit(world, x, y)
    lit = _is_lit(world, x, y, (depth, number, face))[0]
    return (number * 8 + face) * 2 + int(lit)


@njit(cache=True, nogil=True, error_model="numpy")
def _shoulder(light: float) -> float:
    """Linear light as a share of white: unchanged up to `_SHOULDER`, then bent smoothly to 1."""
    if light <= _SHOULDER:
        return max(light, 0.0)
    room = 1.0 - _SHOULDER
    return _SHOULDER + room * (1.0 - math.exp((_SHOULDER - light) / room))


@njit(cache=True, nogil=True, error_model="numpy")
def _exposed(world: World, light: Colour) -> Colour:
    exposure = world.instant[0].exposure
    return (
        _shoulder(light[0] * exposure),
        _shoulder(light[1] * exposure),
        _shoulder(light[2] * exposure),
    )


@njit(cache=True, nogil=True, error_model="numpy")
def _shade(world: World, x: float, y: float, probe: int) -> Colour:
    """Exposed light at picture point (x, y), where the surface `probe` is."""
    number, lit = probe >> 4, bool(probe & 1)
    depth, face = math.inf, 0
    if number >= 0:
        depth, face = hit_again(world, x, y, number)
    if depth == math.inf:
        instant = world.instant[0]
        depth, number, face = background_hit(instant, ray_direction(instant, x, y))
    return _exposed(world, light_at(world, x, y, (depth, number, face), lit))


@njit(cache=True, nogil=True, error_model="numpy")
def _mean(
    world: World, column: int, row: int, pattern: Float64Array, groups: Float64Array
) -> Colour:
    """Mean light over one pixel.

    The samples of `pattern` find which surfaces share the pixel, and how much of it each has.
    Each surface is then shaded once, in the middle of its samples: textures are averaged over the
    pixel anyway. `groups` is scratch space, [at least len(pattern), 4].
    """
    count = 0
    for index in range(len(pattern)):
        x, y = column + pattern[index, 0], row + pattern[index, 1]
        probe = float(_probe(world, x, y))
        place = 0
        while place < count and groups[place, 0] != probe:
            place += 1
        if place == count:
            groups[place, 0] = probe
            groups[place, 1] = groups[place, 2] = groups[place, 3] = 0.0
            count += 1
        groups[place, 1] += 1.0
        groups[place, 2] += x
        groups[place, 3] += y
    red, green, blue = 0.0, 0.0, 0.0
    for place in range(count):
        size = groups[place, 1]
        x, y = groups[place, 2] / size, groups[place, 3] / size
        light = _shade(world, x, y, int(groups[place, 0]))
        share = size / len(pattern)
        red += share * light[0]
        green += share * light[1]
        blue += share * light[2]
    return red, green, blue


@njit(cache=True, nogil=True, error_model="numpy")
def _probe_tile(
    world: World, edges: tuple[int, int, int, int], samples: int, probes: NDArray[np.int64]
) -> None:
    """Probe a tile, given its left, right, top and bottom edges in pixels, on a lattice.

    Shadow is looked for at every other lattice point; the points between take it over from their
    left neighbour on the same surface, which saves half of the shadow rays.
    """
    left, right, top, bottom = edges
    for j in range((bottom - top) * samples + 1):
        for i in range((right - left) * samples + 1):
            x, y = left + i / samples, top + j / samples
            depth, number, face, thin = first_hit(world, x, y)
            probe = (number * 8 + face) * 2
            if not thin and i > 0 and (i + j) % 2 == 1 and probes[j, i - 1] >> 1 == probe >> 1:
                probes[j, i] = probes[j, i - 1]
                continue
            lit, thin_shadow = _is_lit(world, x, y, (depth, number, face))
            probes[j, i] = _THIN if thin or thin_shadow else probe + int(lit)


@njit(cache=True, nogil=True, error_model="numpy")
def _agree(probes: NDArray[np.int64], top: int, left: int, samples: int) -> bool:
    """Whether all probes in and around one pixel saw the same surface."""
    first = probes[top, left]
    if first == _THIN:
        return False
    for row in range(top, top + samples + 1):
        for column in range(left, left + samples + 1):
            if probes[row, column] != first:
                return False
    return True


@njit(cache=True, nogil=True, error_model="numpy")
def draw_tile_row(
    owner: World, tile_row: int, samples: int, pattern: Float64Array, picture: Float64Array
) -> None:
    """Fill one row of tiles of a picture.

    Args:
        owner: the scene.
        tile_row: which row of tiles.
        samples: probes per pixel side.
        pattern: [k, 2] sample positions in [0, 1)² for pixels with an edge.
        picture: [H, W, 3] linear light, 0..1; this row of tiles is written.
    """
    world = World(
        borrow(owner.instant), borrow(owner.shapes), borrow(owner.lists), borrow(owner.lamps)
    )
    height, width = picture.shape[0], picture.shape[1]
    top, bottom = tile_row * TILE, min((tile_row + 1) * TILE, height)
    probes = np.empty((TILE * samples + 1, TILE * samples + 1), dtype=np.int64)
    groups = np.empty((len(pattern), 4), dtype=np.float64)
    for left in range(0, width, TILE):
        right = min(left + TILE, width)
        _probe_tile(world, (left, right, top, bottom), samples, probes)
        for row in range(top, bottom):
            for column in range(left, right):
                j, i = (row - top) * samples, (column - left) * samples
                if _agree(probes, j, i, samples):
                    light = _shade(world, column + 0.5, row + 0.5, int(probes[j, i]))
                else:
                    light = _mean(world, column, row, pattern, groups)
                picture[row, column, 0] = light[0]
                picture[row, column, 1] = light[1]
                picture[row, column, 2] = light[2]

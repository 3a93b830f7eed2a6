"""Light in every pixel of one tile (compiled by Numba).

Edges matter most: a pixel that jumps as an edge passes fires false events. So every pixel is first
probed on a fine lattice for *what* is there. Where all probes agree, one shaded sample is exact
enough, because textures are already averaged over the pixel; where they differ, or something thin
is near, the pixel is the mean of many samples, no two of them in the same row or column.
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
    if number == SKY:
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
    depth, number, face, thin = first_hit(world, x, y)
    lit, thin_shadow = _is_lit(world, x, y, (depth, number, face))
    if thin or thin_shadow:
        return _THIN
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
def _many(world: World, column: int, row: int, pattern: Float64Array) -> Colour:
    """Mean of the samples of `pattern` over one pixel."""
    red, green, blue = 0.0, 0.0, 0.0
    width = 1.0 / math.sqrt(len(pattern))
    for index in range(len(pattern)):
        x, y = column + pattern[index, 0], row + pattern[index, 1]
        depth, number, face, _ = first_hit(world, x, y)
        hit = (depth, number, face)
        lit = _is_lit(world, x, y, hit)[0]
        light = _exposed(world, light_at(world, x, y, hit, lit, width))
        red += light[0]
        green += light[1]
        blue += light[2]
    share = 1.0 / len(pattern)
    return red * share, green * share, blue * share


@njit(cache=True, nogil=True, error_model="numpy")
def _one(world: World, column: int, row: int, probe: int) -> Colour:
    """The pixel's centre, where all around it is the surface `probe`."""
    x, y = column + 0.5, row + 0.5
    number, face, lit = (probe >> 1) >> 3, (probe >> 1) & 7, bool(probe & 1)
    if number >= 0:
        depth, _ = hit_again(world, x, y, number)
    else:
        depth, number, face = background_hit(
            world.instant[0], ray_direction(world.instant[0], x, y)
        )
    return _exposed(world, light_at(world, x, y, (depth, number, face), lit, 1.0))


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
    for left in range(0, width, TILE):
        right = min(left + TILE, width)
        for j in range((bottom - top) * samples + 1):
            for i in range((right - left) * samples + 1):
                probes[j, i] = _probe(world, left + i / samples, top + j / samples)
        for row in range(top, bottom):
            for column in range(left, right):
                j, i = (row - top) * samples, (column - left) * samples
                if _agree(probes, j, i, samples):
                    light = _one(world, column, row, probes[j, i])
                else:
                    light = _many(world, column, row, pattern)
                picture[row, column, 0] = light[0]
                picture[row, column, 1] = light[1]
                picture[row, column, 2] = light[2]

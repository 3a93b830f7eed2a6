"""Colour and relief of what z = 0 is made of, and of the walls of a room (compiled by Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import Record, World
from texvent.scenes.raycast.shading.material import (
    Look,
    land_look,
    painted,
    patch_axes,
    sample_material,
)
from texvent.scenes.raycast.shading.road import strip_look
from texvent.scenes.raycast.shading.sky import mix
from texvent.scenes.raycast.shading.value_noise import box_coverage, lattice
from texvent.scenes.raycast.vectors import Vector, scaled, triple
from texvent.scenes.scene import Colour

_PLASTER, _STONE, _CLOTH = 33, 31, 43
_HANGING_EVERY_M = 2.3
_FRAME_M = 0.05
_FRAME = (0.70, 0.69, 0.66)
_DARK_FRAME = (0.10, 0.06, 0.035)
_SKIRTING = (0.3, 0.24, 0.2)
_CEILING = (1.7, 1.69, 1.64)
"""White, and lit from below by what floor and walls send back, which is not traced."""


@jit(error_model="numpy", inner=True)
def ground_look(world: World, point: Vector, patch: tuple[Vector, Vector], view_up: float) -> Look:
    """Reflectance and relief of the ground.

    Args:
        world: the scene.
        point: on the ground, metres.
        patch: what one pixel covers there, from `texture.surface_patch`.
        view_up: z of the ray's unit direction.
    """
    flat = (patch[0][0], patch[0][1], patch[1][0], patch[1][1])
    axes = patch_axes(flat)
    if world.instant[0].ground in (2, 3, 5, 11, 12):
        return strip_look(world, point[0], point[1], flat, axes, view_up)
    return land_look(world, point[0], point[1], axes)


@jit(error_model="numpy", inner=True)
def _box_share(place: tuple[float, float], half: tuple[float, float], feet: Colour) -> float:
    """Share of a pixel within a rectangle around (0, 0)."""
    return box_coverage(place[0], -half[0], half[0], feet[0]) * box_coverage(
        place[1], -half[1], half[1], feet[1]
    )


@jit(error_model="numpy", inner=True)
def _hang(
    instant: Record, wall: Colour, place: tuple[float, float], feet: Colour, side: int
) -> Colour:
    """A wall with windows and pictures on it; `place` is metres along and up."""
    cell = math.floor(place[0] / _HANGING_EVERY_M)
    chance = lattice(int(cell), side, 31)
    if chance > 0.75:
        return wall
    at = (place[0] - _HANGING_EVERY_M * (cell + 0.5), place[1] - 1.6)
    shape = lattice(int(cell), side, 32)
    if chance < 0.4:
        half = (0.62, 0.65)
        glass = scaled(mix(triple(instant.sky_top), triple(instant.sky_horizon), 0.5), 2.0)
        inside = mix(glass, scaled(glass, 0.75), box_coverage(at[1], -0.65, -0.1, feet[1]))
        cross = max(
            box_coverage(at[0], -0.02, 0.02, feet[0]), box_coverage(at[1], -0.02, 0.02, feet[1])
        )
        inside, frame = mix(inside, _FRAME, cross), _FRAME
    else:
        half = (0.22 + 0.2 * shape, 0.2 + 0.18 * lattice(int(cell), side, 33))
        hue = (0.15 + 0.4 * shape, 0.2 + 0.2 * chance, 0.5 - 0.4 * shape)
        hill = 0.3 * half[1] * math.sin(9.0 * at[0] / half[0] * (0.2 + 0.3 * shape)) - at[1]
        low = min(max(hill / max(feet[1], 0.01) + 0.5, 0.0), 1.0)
        inside, frame = mix(hue, scaled(hue, 0.35), low), _DARK_FRAME
    outer = (half[0] + _FRAME_M, half[1] + _FRAME_M)
    colour = mix(wall, frame, _box_share(at, outer, feet))
    return mix(colour, inside, _box_share(at, half, feet))


@jit(error_model="numpy", inner=True)
def wall_look(
    world: World, point: Vector, face: int, patch: tuple[Vector, Vector]
) -> tuple[Colour, Vector]:
    """Reflectance and normal of a room's wall or ceiling.

    Walls have a skirting board, windows and pictures; those of rock or drapery have no windows.
    """
    instant = world.instant[0]
    right, down = patch
    a, b = (1, 2) if face == 0 else (0, 2)
    if face == 2:
        a, b = 0, 1
    axes = patch_axes((right[a], right[b], down[a], down[b]))
    side = -1.0 if face == 2 or point[face] > 0.0 else 1.0
    if face == 2:
        sample = sample_material(instant, _PLASTER, point[0], point[1], axes, 1.0)
        look = painted(sample, _CEILING, scaled(_CEILING, 0.9), 1.0)
        return look[0], (-look[1], -look[2], -1.0)
    plain = triple(instant.wall_colour)
    sample = sample_material(instant, instant.wall_surface, point[a], point[b], axes, 1.0)
    look = painted(sample, plain, scaled(plain, 0.82), 1.0)
    feet = (abs(right[a]) + abs(down[a]), abs(right[2]) + abs(down[2]), 0.0)
    colour = look[0]
    if instant.wall_surface not in (_STONE, _CLOTH):
        colour = _hang(instant, colour, (point[a], point[2]), feet, 2 * face + int(side > 0.0))
    colour = mix(colour, _SKIRTING, box_coverage(point[2], 0.0, 0.14, feet[1]))
    if face == 0:
        return colour, (side, -look[1], -look[2])
    return colour, (-look[1], side, -look[2])

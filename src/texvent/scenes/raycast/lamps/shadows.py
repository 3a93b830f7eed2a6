"""What light reaches a surface: shadow rays to the sun and to lamps (compiled by Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.lamps.light import (
    LATITUDES,
    LONGITUDES,
    MOST_SHADOW_LAMPS,
    falloff,
    towards_lamp,
)
from texvent.scenes.raycast.records import World
from texvent.scenes.raycast.trace import (
    ROOM,
    SHADOW_BIAS_M,
    SKY,
    is_between,
    ray_direction,
    shadow_point,
    sun_reaches,
    surface_normal,
    widened_hit,
)
from texvent.scenes.raycast.vectors import Vector, along, dot, mapped, triple, turned

LIT_BITS = 1 + MOST_SHADOW_LAMPS
"""Bits of a probe that tell what light reaches a surface: the sun, then lamps."""


@jit(error_model="numpy", inner=True)
def direction_cell(towards: Vector, distance: float) -> int:
    """The cell of a lamp's grid of directions that a surface is in; `towards` leads to the lamp.

    Columns divide the outline of a diamond around the lamp, rows the height: see `lamps.light`.
    """
    x, y = -towards[0], -towards[1]
    corner = y / (abs(x) + abs(y) + 1e-300)
    if x < 0.0:
        corner = 2.0 - corner
    elif y < 0.0:
        corner += 4.0
    height = 0.5 - 0.5 * towards[2] / distance
    column = min(int(corner * (0.25 * LONGITUDES)), LONGITUDES - 1)
    row = min(max(int(height * LATITUDES), 0), LATITUDES - 1)
    return row * LONGITUDES + column


@jit(error_model="numpy", inner=True)
def _blocked(
    world: World, cell: int, point: Vector, towards: Vector, near: float
) -> tuple[bool, bool]:
    """Whether a shape of one cell stands between a point and a lamp, and whether a thin one nearly.

    Shapes beyond the share `near` of the way belong to the lamp itself.
    """
    lists = world.lists
    thin = False
    reach_mm = 1e3 * math.sqrt(dot(towards, towards))
    for index in range(lists[cell], lists[cell + 1], 2):
        if lists[index + 1] > reach_mm:
            break
        shape = world.shapes[lists[index]]
        o, d = mapped(shape.inverse, point), turned(shape.inverse, towards)
        if is_between(world, shape, o, d, near):
            return True, thin
        if shape.is_thin and not thin:
            thin = widened_hit(shape, o, d, 0.0) < near
    return False, thin


@jit(error_model="numpy")
def lamps_reach(world: World, point: Vector, normal: Vector, wanted: int) -> tuple[int, bool]:
    """Which of the lamps that cast shadows a surface sees, and whether a thin shadow is near.

    Only the lamps whose bit is set in `wanted` are looked for. Bit k belongs to lamp k. A lamp
    that the surface faces but whose light ends before it counts as seen.
    """
    instant = world.instant[0]
    seen, thin = 0, False
    for index in range(instant.shadow_lamps):
        if not (wanted >> index) & 1:
            continue
        lamp = world.lamps[index]
        start = along(point, normal, SHADOW_BIAS_M)
        towards = towards_lamp(lamp, start)
        if dot(towards, normal) <= 0.0:
            continue
        seen |= 1 << index
        share, distance = falloff(lamp, towards)
        if share <= 0.0:
            continue
        grid = instant.lamp_cells + index * (LONGITUDES * LATITUDES + 1)
        cell = grid + direction_cell(towards, distance)
        near = 1.0 - min(lamp[12] / distance, 0.9)
        is_blocked, is_thin = _blocked(world, cell, start, towards, near)
        thin = thin or is_thin
        if is_blocked:
            seen &= ~(1 << index)
    return seen, thin


ALL_LIGHTS = (1 << LIT_BITS) - 1
"""All bits of a probe that tell what light reaches a surface."""


@jit(error_model="numpy", inner=True)
def lit_by(
    world: World, x: float, y: float, hit: tuple[float, int, int], wanted: int
) -> tuple[int, bool]:
    """What light reaches what was hit (bit 0: sun, then lamps), and whether a thin shadow is near.

    Only the lights in `wanted` are looked for; only lamps that cast shadows count.
    """
    depth, number, face = hit
    instant = world.instant[0]
    if number == SKY or (number == ROOM and instant.shadow_lamps == 0):
        return 0, False
    point = along(triple(instant.origin), ray_direction(instant, x, y), depth)
    normal = surface_normal(world, number, face, point)
    point = shadow_point(world, number, face, point)
    is_sunlit, thin = False, False
    if number != ROOM and wanted & 1:
        is_sunlit, thin = sun_reaches(world, point, normal)
    lit = int(is_sunlit)
    if instant.shadow_lamps > 0:
        lamps, thin_lamp = lamps_reach(world, point, normal, wanted >> 1)
        lit |= lamps << 1
        thin = thin or thin_lamp
    return lit, thin

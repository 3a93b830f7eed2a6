"""Light that leaves a surface towards the camera, linear RGB (compiled by Numba).

Lambert reflection of sun and lamps, ambient light that is stronger from above, a soft highlight
on shapes, mirror-like sea, fog that grows with distance.
"""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import Record, World
from texvent.scenes.raycast.shading.ground import ground_colour, wall_colour
from texvent.scenes.raycast.shading.sky import Colour, mix, sky_colour, triple
from texvent.scenes.raycast.shading.texture import patch_extent, surface_colour, surface_patch
from texvent.scenes.raycast.shading.value_noise import smooth
from texvent.scenes.raycast.shading.water import caustics, sea_light
from texvent.scenes.raycast.trace import (
    GROUND,
    ROOM,
    SKY,
    ray_direction,
    surface_normal,
)
from texvent.scenes.scene import Float64Array

_SEA = 4
_UNDERWATER = 9
_FOG_HEIGHT_M = 40.0
"""Fog and water above this height do not count for rays that go up."""


@jit(error_model="numpy")
def _lamp_light(lamps: Float64Array, point: Colour, normal: Colour) -> Colour:
    """Light of all point lamps on a surface."""
    red, green, blue = 0.0, 0.0, 0.0
    for index in range(len(lamps)):
        lamp = lamps[index]
        dx, dy, dz = lamp[0] - point[0], lamp[1] - point[1], lamp[2] - point[2]
        square = dx * dx + dy * dy + dz * dz
        reach = lamp[6]
        if square >= reach * reach:
            continue
        distance = math.sqrt(square) + 1e-9
        facing = (dx * normal[0] + dy * normal[1] + dz * normal[2]) / distance
        if facing <= 0.0:
            continue
        window = 1.0 - square / (reach * reach)
        share = facing * window * window / max(square, 0.25)
        red += share * lamp[3]
        green += share * lamp[4]
        blue += share * lamp[5]
    return red, green, blue


@jit(error_model="numpy")
def _add_fog(instant: Record, colour: Colour, distance: float) -> Colour:
    if instant.fog == 0.0:
        return colour
    return mix(triple(instant.fog_colour), colour, math.exp(-distance * instant.fog))


@jit(error_model="numpy")
def _sky_light(instant: Record, direction: Colour, pixel: float) -> Colour:
    """Sky in a unit direction, behind the fog."""
    path = _FOG_HEIGHT_M / max(abs(direction[2]), 1e-6)
    return _add_fog(instant, sky_colour(instant, direction, pixel), path)


@jit(error_model="numpy")
def _reflected(
    world: World, colour: Colour, point: Colour, normal: Colour, footprint: float, is_lit: bool
) -> Colour:
    """Light reflected by a matt surface of which a pixel covers `foot` metres."""
    instant = world.instant[0]
    lamps = _lamp_light(world.lamps, point, normal)
    above = 0.68 + 0.32 * normal[2]
    facing = 0.0
    if is_lit:
        sun = instant.sun
        facing = max(normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2], 0.0)
        if instant.ground == _UNDERWATER:
            facing *= caustics(instant, point, footprint)
    return (
        colour[0] * (instant.ambient[0] * above + instant.sun_colour[0] * facing + lamps[0]),
        colour[1] * (instant.ambient[1] * above + instant.sun_colour[1] * facing + lamps[1]),
        colour[2] * (instant.ambient[2] * above + instant.sun_colour[2] * facing + lamps[2]),
    )


@jit(error_model="numpy")
def _shape_light(
    world: World,
    hit: tuple[float, int, int],
    point: Colour,
    direction: Colour,
    is_lit: bool,
) -> Colour:
    """Light from a shape: texture, reflection, a soft highlight, its own glow."""
    instant = world.instant[0]
    depth, number, face = hit
    normal = surface_normal(world, number, face, point)
    patch = surface_patch(instant, direction, depth, normal)
    colour = surface_colour(world, number, face, point, patch)
    view = _unit(direction)
    red, green, blue = _reflected(world, colour, point, normal, patch_extent(patch)[2], is_lit)
    if is_lit:
        sun = instant.sun
        hx, hy, hz = sun[0] - view[0], sun[1] - view[1], sun[2] - view[2]
        half = hx * normal[0] + hy * normal[1] + hz * normal[2]
        half = max(half, 0.0) / math.sqrt(hx * hx + hy * hy + hz * hz + 1e-12)
        shine = 0.12 * half**24
        red += shine * instant.sun_colour[0]
        green += shine * instant.sun_colour[1]
        blue += shine * instant.sun_colour[2]
    glow = world.shapes[number].emission
    return red + glow * colour[0], green + glow * colour[1], blue + glow * colour[2]


@jit(error_model="numpy")
def _unit(v: Colour) -> Colour:
    scale = 1.0 / math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    return v[0] * scale, v[1] * scale, v[2] * scale


@jit(error_model="numpy")
def _ground_light(
    world: World, depth: float, point: Colour, direction: Colour, is_lit: bool
) -> Colour:
    """Light from the ground or the sea, which fade into the horizon."""
    instant = world.instant[0]
    up = (0.0, 0.0, 1.0)
    footprint = patch_extent(surface_patch(instant, direction, depth, up))
    if instant.ground == _SEA:
        light = sea_light(instant, point, _unit(direction), footprint)
    else:
        colour = ground_colour(instant, point[0], point[1], footprint)
        light = _reflected(world, colour, point, up, footprint[2], is_lit)
    if instant.ground == _UNDERWATER:
        return light
    return mix(light, triple(instant.sky_horizon), smooth((depth - 150.0) / 1500.0))


@jit(error_model="numpy")
def shade_hit(
    world: World, x: float, y: float, hit: tuple[float, int, int], is_lit: bool
) -> Colour:
    """Linear light that reaches image point (x, y).

    Args:
        world: the scene.
        x: pixels from the left.
        y: pixels from the top.
        hit: depth, what was hit, and which face, from `first_hit`.
        is_lit: whether direct sunlight falls on it.
    """
    instant = world.instant[0]
    depth, number, face = hit
    direction = ray_direction(instant, x, y)
    if number == SKY:
        return _sky_light(instant, _unit(direction), instant.step)
    point = (
        instant.origin[0] + depth * direction[0],
        instant.origin[1] + depth * direction[1],
        instant.origin[2] + depth * direction[2],
    )
    distance = depth * math.sqrt(direction[0] ** 2 + direction[1] ** 2 + direction[2] ** 2)
    if number == GROUND:
        light = _ground_light(world, depth, point, direction, is_lit)
    elif number == ROOM:
        footprint = depth * instant.step
        colour = wall_colour(instant, point, face, footprint)
        normal = surface_normal(world, ROOM, face, point)
        light = _reflected(world, colour, point, normal, footprint, False)
    else:
        light = _shape_light(world, hit, point, direction, is_lit)
    return _add_fog(instant, light, distance)

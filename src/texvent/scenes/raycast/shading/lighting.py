"""Light that leaves a surface towards the camera, linear RGB (compiled by Numba).

Lambert reflection of sun and lamps, ambient light that is stronger from above, a soft highlight
on shapes, mirror-like sea, fog that grows with distance.
"""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.lamps.light import lamp_light
from texvent.scenes.raycast.lens_kernel import NO_DISTORTION, pixel_steps
from texvent.scenes.raycast.records import Record, World
from texvent.scenes.raycast.shading.ground import ground_look, wall_look
from texvent.scenes.raycast.shading.sky import mix, sky_colour
from texvent.scenes.raycast.shading.texture import patch_extent, surface_look, surface_patch
from texvent.scenes.raycast.shading.value_noise import smooth
from texvent.scenes.raycast.shading.water import caustics, sea_light
from texvent.scenes.raycast.trace import (
    GROUND,
    ROOM,
    SKY,
    ray_direction,
    surface_normal,
)
from texvent.scenes.raycast.vectors import along, dot, scaled, times, triple, unit
from texvent.scenes.scene import Colour

_SEA = 4
_UNDERWATER = 9
_FOG_HEIGHT_M = 40.0
"""Fog and water above this height do not count for rays that go up."""


@jit(error_model="numpy", inner=True)
def _add_fog(instant: Record, colour: Colour, distance: float) -> Colour:
    if instant.fog == 0.0:
        return colour
    return mix(triple(instant.fog_colour), colour, math.exp(-distance * instant.fog))


@jit(error_model="numpy", inner=True)
def _sky_light(instant: Record, direction: Colour, pixel: float) -> Colour:
    """Sky in a unit direction, behind the fog."""
    path = _FOG_HEIGHT_M / max(abs(direction[2]), 1e-6)
    return _add_fog(instant, sky_colour(instant, direction, pixel), path)


@jit(error_model="numpy", inner=True)
def _reflected(
    world: World, colour: Colour, point: Colour, normal: Colour, footprint: float, lit: int
) -> Colour:
    """Light reflected by a matt surface of which a pixel covers `foot` metres."""
    instant = world.instant[0]
    lamps = lamp_light(world, point, normal, lit)
    above = 0.68 + 0.32 * normal[2]
    facing = 0.0
    if lit & 1:
        facing = max(dot(normal, instant.sun), 0.0)
        if instant.ground == _UNDERWATER:
            facing *= caustics(instant, point, footprint)
    light = along(scaled(triple(instant.ambient), above), triple(instant.sun_colour), facing)
    return times(colour, along(light, lamps, 1.0))


@jit(error_model="numpy", inner=True)
def _shape_light(
    world: World,
    hit: tuple[float, int, int],
    point: Colour,
    direction: Colour,
    steps: tuple[Colour, Colour],
    lit: int,
) -> Colour:
    """Light from a shape: texture, reflection, a soft highlight, its own glow."""
    instant = world.instant[0]
    depth, number, face = hit
    normal = surface_normal(world, number, face, point)
    patch = surface_patch(steps, direction, depth, normal)
    colour, normal = surface_look(world, number, face, point, (normal, patch[0], patch[1]))
    view = unit(direction)
    light = _reflected(world, colour, point, normal, patch_extent(patch)[2], lit)
    if lit & 1:
        half = along(triple(instant.sun), view, -1.0)
        facing = max(dot(half, normal), 0.0) / math.sqrt(dot(half, half) + 1e-12)
        light = along(light, triple(instant.sun_colour), 0.12 * facing**24)
    return along(light, colour, world.shapes[number].emission)


@jit(error_model="numpy", inner=True)
def _ground_light(
    world: World,
    depth: float,
    point: Colour,
    direction: Colour,
    steps: tuple[Colour, Colour],
    lit: int,
) -> Colour:
    """Light from the ground or the sea, which fade into the horizon."""
    instant = world.instant[0]
    up = (0.0, 0.0, 1.0)
    patch = surface_patch(steps, direction, depth, up)
    footprint = patch_extent(patch)
    if instant.ground == _SEA:
        light = sea_light(instant, point, unit(direction), footprint)
    else:
        colour, slope_x, slope_y = ground_look(world, point, patch, unit(direction)[2])
        normal = unit((-slope_x, -slope_y, 1.0))
        light = _reflected(world, colour, point, normal, footprint[2], lit)
    if instant.ground == _UNDERWATER:
        return light
    return mix(light, triple(instant.sky_horizon), smooth((depth - 150.0) / 1500.0))


@jit(error_model="numpy", inner=True)
def _angle_of_step(direction: Colour, step: Colour) -> float:
    """Angle by which a small step turns a direction, radians: |step × direction| / |direction|²."""
    square, along_it = dot(direction, direction), dot(direction, step)
    return math.sqrt(max(dot(step, step) * square - along_it * along_it, 0.0)) / square


@jit(error_model="numpy", inner=True)
def shade_hit(world: World, x: float, y: float, hit: tuple[float, int, int], lit: int) -> Colour:
    """Linear light that reaches image point (x, y).

    Args:
        world: the scene.
        x: pixels from the left.
        y: pixels from the top.
        hit: depth, what was hit, and which face, from `first_hit`.
        lit: what falls on it, from `lamps_reach` shifted by one bit; bit 0: the sun.
    """
    instant = world.instant[0]
    depth, number, face = hit
    direction = ray_direction(instant, x, y)
    if math.isnan(direction[0]):  # the lens lets nothing through
        return 0.0, 0.0, 0.0
    steps, step = pixel_steps(instant, x, y), instant.step
    if instant.distortion != NO_DISTORTION:
        step = _angle_of_step(direction, steps[0])
    if number == SKY:
        return _sky_light(instant, unit(direction), step)
    point = along(triple(instant.origin), direction, depth)
    distance = depth * math.sqrt(direction[0] ** 2 + direction[1] ** 2 + direction[2] ** 2)
    if number == GROUND:
        light = _ground_light(world, depth, point, direction, steps, lit)
    elif number == ROOM:
        flat = surface_normal(world, ROOM, face, point)
        patch = surface_patch(steps, direction, depth, flat)
        colour, normal = wall_look(world, point, face, patch)
        light = _reflected(world, colour, point, unit(normal), patch_extent(patch)[2], lit)
    else:
        light = _shape_light(world, hit, point, direction, steps, lit)
    return _add_fog(instant, light, distance)

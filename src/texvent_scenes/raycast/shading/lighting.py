"""Light that leaves a surface towards the camera, linear RGB (compiled by Numba).

Lambert reflection of sun and lamps, ambient light that is stronger from above, a soft highlight
on shapes, mirror-like sea, fog that grows with distance.
"""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent_scenes.raycast.addresses import shape_at
from texvent_scenes.raycast.lamps.light import lamp_light
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.shading.ground import ground_look, wall_look
from texvent_scenes.raycast.shading.texture import patch_extent, surface_look, surface_patch
from texvent_scenes.raycast.shading.value_noise import (
    detail_fade,
    mix,
    sky_colour,
    sky_gradient,
    smooth,
)
from texvent_scenes.raycast.trace import (
    GROUND,
    ROOM,
    SKY,
    ray_direction,
    surface_normal,
)
from texvent_scenes.raycast.vectors import (
    NO_DISTORTION,
    along,
    dot,
    pixel_steps,
    scaled,
    times,
    triple,
    unit,
)
from texvent_scenes.rendered_scene import Colour

FOAM_FROM, FOAM_STEEPNESS = 0.085, 5.0
"""Sum of the waves' heights over their lengths, per wave height, from which on crests foam."""


@jit(error_model="numpy", inner=True)
def sea_light(instant: Record, point: Colour, view: Colour, footprint: Colour) -> Colour:
    """Moving waves that mirror the sky; waves smaller than a pixel fade out. High ones foam."""
    slope_x, slope_y, crest = 0.0, 0.0, 0.0
    length, angle = 9.0 * instant.wave_height, 0.4
    strength = 0.042 * instant.wave_height
    for _ in range(7):
        wave = 2.0 * math.pi / length
        cosine, sine = math.cos(angle), math.sin(angle)
        phase = wave * (cosine * point[0] + sine * point[1]) + math.sqrt(9.81 * wave) * instant.time
        size = strength * detail_fade(
            (abs(cosine) * footprint[0] + abs(sine) * footprint[1]) / length
        )
        slope_x += size * cosine * math.cos(phase)
        slope_y += size * sine * math.cos(phase)
        crest += size * math.sin(phase)
        length, angle, strength = 0.62 * length, angle + 2.4, 1.05 * strength
    scale = 1.0 / math.sqrt(1.0 + slope_x * slope_x + slope_y * slope_y)
    normal = (-slope_x * scale, -slope_y * scale, scale)
    facing = max(-dot(view, normal), 0.0)
    mirror = 0.03 + 0.75 * (1.0 - facing) ** 4
    up = abs(view[2] + 2.0 * facing * normal[2])
    deep = mix(
        triple(instant.colour),
        triple(instant.second_colour),
        smooth(0.5 + 2.2 * (slope_x + slope_y)),
    )
    sun_colour = triple(instant.sun_colour)
    water = times(deep, along(triple(instant.ambient), sun_colour, 0.5))
    colour = mix(water, sky_gradient(instant, up), mirror)
    half = along(triple(instant.sun), view, -1.0)
    shine = dot(half, normal) / math.sqrt(dot(half, half) + 1e-12)
    if instant.wave_height > 1.0:
        foam = 0.8 * smooth(FOAM_STEEPNESS * (crest - FOAM_FROM * instant.wave_height))
        white = along(triple(instant.ambient), sun_colour, 0.6)
        colour = mix(colour, white, foam)
    return along(colour, sun_colour, 0.5 * max(shine, 0.0) ** 60)


@jit(error_model="numpy", inner=True)
def caustics(instant: Record, point: Colour, footprint: float) -> float:
    """Ripples of light that waves throw on what is under water: a factor around 1."""
    share = detail_fade(1.2 * footprint)
    if share == 0.0:
        return 1.0
    x, y, t = 0.9 * point[0], 0.9 * point[1], 0.9 * instant.time
    bend_x = x + 0.6 * math.sin(1.7 * y + 1.1 * t) + 0.2 * point[2]
    bend_y = y + 0.6 * math.sin(1.5 * x - 1.3 * t)
    web = math.sin(1.9 * bend_x + 0.7 * t) + math.sin(2.1 * bend_y - 0.8 * t)
    return 1.0 + share * (0.9 * math.exp(-3.0 * abs(web)) - 0.25)


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
    instant: Record, colour: Colour, point: Colour, normal: Colour, footprint: float, lit: int
) -> Colour:
    """Light reflected by a matt surface of which a pixel covers `foot` metres."""
    lamps = lamp_light(instant, point, normal, lit)
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
    instant: Record,
    hit: tuple[float, int, int],
    point: Colour,
    direction: Colour,
    steps: tuple[Colour, Colour],
    lit: int,
) -> Colour:
    """Light from a shape: texture, reflection, a soft highlight, its own glow."""
    depth, number, face = hit
    normal = surface_normal(instant, number, face, point)
    patch = surface_patch(steps, direction, depth, normal)
    colour, normal = surface_look(instant, number, face, point, (normal, patch[0], patch[1]))
    view = unit(direction)
    light = _reflected(instant, colour, point, normal, patch_extent(patch)[2], lit)
    if lit & 1:
        half = along(triple(instant.sun), view, -1.0)
        facing = max(dot(half, normal), 0.0) / math.sqrt(dot(half, half) + 1e-12)
        light = along(light, triple(instant.sun_colour), 0.12 * facing**24)
    return along(light, colour, shape_at(instant.shapes, number).emission)


@jit(error_model="numpy", inner=True)
def _ground_light(
    instant: Record,
    depth: float,
    point: Colour,
    direction: Colour,
    steps: tuple[Colour, Colour],
    lit: int,
) -> Colour:
    """Light from the ground or the sea, which fade into the horizon."""
    up = (0.0, 0.0, 1.0)
    patch = surface_patch(steps, direction, depth, up)
    footprint = patch_extent(patch)
    if instant.ground == _SEA:
        light = sea_light(instant, point, unit(direction), footprint)
    else:
        colour, slope_x, slope_y = ground_look(instant, point, patch, unit(direction)[2])
        normal = unit((-slope_x, -slope_y, 1.0))
        light = _reflected(instant, colour, point, normal, footprint[2], lit)
    if instant.ground == _UNDERWATER:
        return light
    return mix(light, triple(instant.sky_horizon), smooth((depth - 150.0) / 1500.0))


@jit(error_model="numpy", inner=True)
def _angle_of_step(direction: Colour, step: Colour) -> float:
    """Angle by which a small step turns a direction, radians: |step × direction| / |direction|²."""
    square, along_it = dot(direction, direction), dot(direction, step)
    return math.sqrt(max(dot(step, step) * square - along_it * along_it, 0.0)) / square


@jit(error_model="numpy", inner=True)
def shade_hit(instant: Record, x: float, y: float, hit: tuple[float, int, int], lit: int) -> Colour:
    """Linear light that reaches image point (x, y).

    Args:
        instant: the scene.
        x: pixels from the left.
        y: pixels from the top.
        hit: depth, what was hit, and which face, from `first_hit`.
        lit: what falls on it, from `lamps_reach` shifted by one bit; bit 0: the sun.
    """
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
        light = _ground_light(instant, depth, point, direction, steps, lit)
    elif number == ROOM:
        flat = surface_normal(instant, ROOM, face, point)
        patch = surface_patch(steps, direction, depth, flat)
        colour, normal = wall_look(instant, point, face, patch)
        light = _reflected(instant, colour, point, unit(normal), patch_extent(patch)[2], lit)
    else:
        light = _shape_light(instant, hit, point, direction, steps, lit)
    return _add_fog(instant, light, distance)

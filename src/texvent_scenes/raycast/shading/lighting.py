"""Light that leaves a surface towards the camera, linear RGB (compiled by Numba).

Lambert reflection of sun and lamps, ambient light that is stronger from above, a soft highlight
on shapes, fog that grows with distance.
"""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent_scenes.raycast.addresses import shape_at
from texvent_scenes.raycast.lamps.gleam import lamp_gleam
from texvent_scenes.raycast.lamps.light import lamp_light, lamps_reach
from texvent_scenes.raycast.meshes.hit import hit_mesh
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.shading.ambient import ambient_light
from texvent_scenes.raycast.shading.ground import glossy_share, ground_look
from texvent_scenes.raycast.shading.reflection import (
    add_fog,
    caustics,
    fresnel,
    sea_light,
    sky_light,
    steepness,
    with_reflection,
)
from texvent_scenes.raycast.shading.texture import patch_extent, surface_look, surface_patch
from texvent_scenes.raycast.shading.value_noise import (
    detail_fade,
    mix,
    noise_2d,
    smooth,
)
from texvent_scenes.raycast.shading.wall import wall_look
from texvent_scenes.raycast.trace import (
    GROUND,
    ROOM,
    SKY,
    background_from,
    hit_shape,
    ray_direction,
    sun_reaches,
    surface_normal,
)
from texvent_scenes.raycast.vectors import (
    NO_DISTORTION,
    along,
    dot,
    mapped,
    pixel_steps,
    scaled,
    times,
    triple,
    turned,
    unit,
)
from texvent_scenes.rendered_scene import FIRST_SURFACE, Colour

_SEA, _RIVER, _LAKE = 4, 11, 12
_WATER_GLOSS = 0.02
_WET_DARK = 0.45
"""Share of its light that a wet ground loses."""
_BOX, _MESH = 1, 4
_UNDERWATER = 9
SHARP = 0.01
"""Roughness below which a surface shows a sharp image, radians."""
_OFF = 1e-3
"""Least distance at which a mirrored ray meets a surface, in units of the camera's depth."""
_ALL = -1
"""Bits of all lamps."""


@jit(error_model="numpy", inner=True)
def _reflected(
    instant: Record, colour: Colour, point: Colour, normal: Colour, footprint: float, lit: int
) -> Colour:
    """Light reflected by a matt surface of which a pixel covers `foot` metres."""
    lamps = lamp_light(instant, point, normal, lit)
    facing = 0.0
    if lit & 1:
        facing = max(dot(normal, instant.sun), 0.0)
        if instant.ground == _UNDERWATER:
            facing *= caustics(instant, point, footprint)
    light = along(ambient_light(instant, point, normal), triple(instant.sun_colour), facing)
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
    coat = _coat(instant, shape_at(instant.shapes, hit[1]))
    if coat[0] > 0.0 and coat[1] < SHARP:
        return _mirror_light(instant, hit, point, direction, steps, lit)
    return _coated_light(instant, hit, point, direction, steps, lit)


@jit(error_model="numpy", inner=True)
def _coat(instant: Record, shape: Record) -> Colour:
    """Gloss, roughness and crown of a shape's clear layer."""
    if shape.texture < FIRST_SURFACE or shape.kind == _MESH:
        return 0.0, 0.0, 0.0
    coat: Colour = triple(instant.gloss[shape.texture - FIRST_SURFACE])
    return coat


@jit(error_model="numpy", inner=True)
def _coated_light(
    instant: Record,
    hit: tuple[float, int, int],
    point: Colour,
    direction: Colour,
    steps: tuple[Colour, Colour],
    lit: int,
) -> Colour:
    """As `_shape_light`, with a soft image of its surroundings where it is glossy."""
    depth, number, face = hit
    shape = shape_at(instant.shapes, number)
    flat = surface_normal(instant, number, face, point)
    if dot(flat, direction) > 0.0:  # a mesh's faces the camera, in a mirror that may be behind it
        flat = scaled(flat, -1.0)
    patch = surface_patch(steps, direction, depth, flat)
    foot = patch_extent(patch)[2]
    gloss, rough, crown = _coat(instant, shape)
    crowned, bend = flat, 0.0
    if gloss > 0.0:
        crowned, bend = _crowned(shape, face, point, flat, crown)
    colour, normal = surface_look(instant, number, face, point, (crowned, patch[0], patch[1]))
    view = unit(direction)
    light = _reflected(instant, colour, point, normal, foot, lit)
    if gloss > 0.0:
        blur = rough + 0.5 * instant.step + bend * foot
        light = with_reflection(instant, light, (point, view, crowned), gloss, blur, shape.instance)
    if lit & 1:
        half = along(triple(instant.sun), view, -1.0)
        facing = max(dot(half, normal), 0.0) / math.sqrt(dot(half, half) + 1e-12)
        light = along(light, triple(instant.sun_colour), 0.12 * facing**24)
    return along(light, colour, shape.emission)


@jit(error_model="numpy", inner=True)
def _next_hit(
    instant: Record, point: Colour, direction: Colour, own: int
) -> tuple[float, int, int]:
    """First hit of a ray from a point of shape `own`: parameter, number, face."""
    best, found, best_face = background_from(instant, point, direction)
    for number in range(instant.shape_count):
        if number == own:
            continue
        shape = shape_at(instant.shapes, number)
        o, d = mapped(shape.inverse, point), turned(shape.inverse, direction)
        if shape.kind == _MESH:
            t, face = hit_mesh(instant, shape.root, o, d, _OFF, False)
        else:
            t, face = hit_shape(shape.kind, o, d, _OFF)
        if t < best:
            best, found, best_face = t, number, face
    return best, found, best_face


@jit(error_model="numpy", inner=True)
def _mirror_light(
    instant: Record,
    hit: tuple[float, int, int],
    point: Colour,
    direction: Colour,
    steps: tuple[Colour, Colour],
    lit: int,
) -> Colour:
    """Light of a smooth mirror: what the mirrored rays meet, which mirrors softly at most.

    Four rays in each pixel soften the edges in the image.
    """
    depth, number, face = hit
    shape = shape_at(instant.shapes, number)
    flat = surface_normal(instant, number, face, point)
    share = fresnel(_coat(instant, shape)[0], -dot(unit(direction), flat))
    patch = surface_patch(steps, direction, depth, flat)
    total = (0.0, 0.0, 0.0)
    for part in range(4):
        right, down = 0.5 * (part % 2) - 0.25, 0.5 * (part // 2) - 0.25
        place = along(along(point, patch[0], right), patch[1], down)
        seen = along(along(direction, steps[0], right), steps[1], down)
        seen = _mirrored(seen, flat)
        sides = _mirrored(steps[0], flat), _mirrored(steps[1], flat)
        light = _met_light(
            instant, _next_hit(instant, place, seen, number), place, seen, sides, depth
        )
        total = along(total, light, 0.25)
    colour, _ = surface_look(instant, number, face, point, (flat, patch[0], patch[1]))
    own = _reflected(instant, colour, point, flat, patch_extent(patch)[2], lit)
    return mix(own, total, share)


@jit(error_model="numpy", inner=True)
def _mirrored(vector: Colour, normal: Colour) -> Colour:
    return along(vector, normal, -2.0 * dot(vector, normal))


@jit(error_model="numpy", inner=True)
def _met_light(
    instant: Record,
    hit: tuple[float, int, int],
    start: Colour,
    direction: Colour,
    steps: tuple[Colour, Colour],
    before: float,
) -> Colour:
    """Light that comes back along a mirrored ray; `before` is the camera's depth of its start."""
    beyond, number, face = hit
    if number == SKY:
        return sky_light(instant, unit(direction), instant.step, 0.0)
    point = along(start, direction, beyond)
    normal = surface_normal(instant, number, face, point)
    if dot(normal, direction) > 0.0:
        normal = scaled(normal, -1.0)
    lit = int(number != ROOM and sun_reaches(instant, point, normal, False)[0])
    if instant.shadow_lamps > 0:
        lit |= lamps_reach(instant, point, normal, _ALL, False)[0] << 1
    depth = before + beyond
    if number == GROUND:
        light = _ground_light(instant, depth, point, direction, steps, lit)
    elif number == ROOM:
        light = _wall_light(instant, depth, face, point, direction, steps, lit)
    else:
        light = _coated_light(instant, (depth, number, face), point, direction, steps, lit)
    return add_fog(instant, light, beyond * math.sqrt(dot(direction, direction)))


@jit(error_model="numpy", inner=True)
def _wall_light(
    instant: Record,
    depth: float,
    face: int,
    point: Colour,
    direction: Colour,
    steps: tuple[Colour, Colour],
    lit: int,
) -> Colour:
    """Light from a room's wall or ceiling."""
    flat = surface_normal(instant, ROOM, face, point)
    patch = surface_patch(steps, direction, depth, flat)
    colour, normal = wall_look(instant, point, face, patch)
    return _reflected(instant, colour, point, unit(normal), patch_extent(patch)[2], lit)


@jit(error_model="numpy", inner=True)
def _crowned(
    shape: Record, face: int, point: Colour, normal: Colour, crown: float
) -> tuple[Colour, float]:
    """Normal of a face that bulges, and by how much normals turn along it, radians per metre."""
    extent = triple(shape.extent)
    if shape.kind != _BOX:
        return normal, 1.0 / max(min(extent[0], extent[1], extent[2]), 0.01)
    m = shape.inverse
    place = mapped(m, point)
    narrowest = math.inf
    for axis in range(3):
        if axis != face // 2:
            slope = crown * extent[axis] * place[axis]
            normal = along(normal, (m[axis, 0], m[axis, 1], m[axis, 2]), slope)
            narrowest = min(narrowest, extent[axis])
    return unit(normal), crown / max(narrowest, 0.01)


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
        wet, rough = glossy_share(instant, point, footprint[2])
        if wet > 0.0:
            view = unit(direction)
            light = _wetted(instant, light, point, view, (wet, rough, footprint[2]))
            if instant.wetness > 0.0:
                film = _WATER_GLOSS, rough, 0.5 * instant.step
                light = along(light, lamp_gleam(instant, point, view, up, film, lit), wet)
    if instant.ground == _UNDERWATER:
        return light
    return mix(light, triple(instant.sky_horizon), smooth((depth - 150.0) / 1500.0))


@jit(error_model="numpy", inner=True)
def _wetted(instant: Record, light: Colour, point: Colour, view: Colour, wet: Colour) -> Colour:
    """Light of the ground under water.

    `wet` is the share of it, the roughness, and the metres that a pixel covers.
    """
    share, rough, foot = wet
    slope_x, slope_y = 0.0, 0.0
    if instant.ground in (_RIVER, _LAKE):
        fade = 0.1 * steepness(instant.wave_height) * detail_fade(0.8 * foot)
        x, y, t = 0.8 * point[0], 1.3 * point[1], instant.time
        slope_x = fade * noise_2d(x + 0.7 * t, y, 9)
        slope_y = fade * noise_2d(x, y - 0.6 * t, 10)
    else:
        light = scaled(light, 1.0 - _WET_DARK * instant.wetness)
    normal = unit((-slope_x, -slope_y, 1.0))
    wetted = with_reflection(instant, light, (point, view, normal), _WATER_GLOSS, rough, -1)
    return mix(light, wetted, share)


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
        return sky_light(instant, unit(direction), step, instant.time)
    point = along(triple(instant.origin), direction, depth)
    distance = depth * math.sqrt(direction[0] ** 2 + direction[1] ** 2 + direction[2] ** 2)
    if number == GROUND:
        light = _ground_light(instant, depth, point, direction, steps, lit)
    elif number == ROOM:
        light = _wall_light(instant, depth, face, point, direction, steps, lit)
    else:
        light = _shape_light(instant, hit, point, direction, steps, lit)
    return add_fog(instant, light, distance)

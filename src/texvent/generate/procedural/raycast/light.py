"""Light that leaves a surface towards the camera, linear RGB (compiled by Numba).

Lambert reflection of sun and lamps, ambient light that is stronger from above, a soft highlight
on shapes, mirror-like sea, fog that grows with distance.
"""

from __future__ import annotations

import math

from numba import njit

from texvent.generate.procedural.primitives import Float64Array
from texvent.generate.procedural.raycast.ground import ground_colour, wall_colour
from texvent.generate.procedural.raycast.noise import keep, noise_3d, smooth, square_wave
from texvent.generate.procedural.raycast.records import Record, World
from texvent.generate.procedural.raycast.sky import Colour, mix, sky_colour, sky_gradient, triple
from texvent.generate.procedural.raycast.trace import (
    GROUND,
    ROOM,
    SKY,
    local_point,
    ray_direction,
    surface_normal,
)

_SEA = 4
_UNDERWATER = 9
_FOG_HEIGHT_M = 40.0
"""Fog and water above this height do not count for rays that go up."""


@njit(cache=True, nogil=True, error_model="numpy")
def surface_colour(world: World, number: int, face: int, point: Colour, pixel: float) -> Colour:
    """Reflectance of shape `number` at a world point, with its texture.

    Args:
        world: the scene.
        number: shape number.
        face: face that was hit.
        point: metres.
        pixel: metres that one pixel covers there.
    """
    shape = world.shapes[number]
    plain = triple(shape.colour)
    if shape.texture == 0:
        return plain
    m, scale = shape.inverse, shape.texture_scale
    p = local_point(world, number, point)
    steps = (
        scale * pixel * math.sqrt(m[0, 0] ** 2 + m[0, 1] ** 2 + m[0, 2] ** 2),
        scale * pixel * math.sqrt(m[1, 0] ** 2 + m[1, 1] ** 2 + m[1, 2] ** 2),
        scale * pixel * math.sqrt(m[2, 0] ** 2 + m[2, 1] ** 2 + m[2, 2] ** 2),
    )
    scaled = (p[0] * scale, p[1] * scale, p[2] * scale)
    return mix(plain, triple(shape.second_colour), _pattern(shape.texture, face, scaled, steps))


@njit(cache=True, nogil=True, error_model="numpy")
def _pattern(texture: int, face: int, p: Colour, steps: Colour) -> float:
    """Share of the second colour at texture coordinates `p`, averaged over a pixel."""
    if texture == 1:
        foot = max(steps[0], steps[1], steps[2])
        total = 0.62 * keep(2.0 * foot) * noise_3d(2.0 * p[0], 2.0 * p[1], 2.0 * p[2])
        fine = keep(4.6 * foot)
        if fine > 0.0:
            total += 0.38 * fine * noise_3d(4.6 * p[0], 4.6 * p[1], 4.6 * p[2] + 31.0)
        return smooth(0.5 + 0.75 * total)
    if texture == 2:
        return square_wave(p[2], steps[2])
    if texture == 3:
        x = 2.0 * square_wave(0.5 * p[0] + 0.01, 0.5 * steps[0]) - 1.0
        y = 2.0 * square_wave(0.5 * p[1] + 0.01, 0.5 * steps[1]) - 1.0
        z = 2.0 * square_wave(0.5 * p[2] + 0.01, 0.5 * steps[2]) - 1.0
        return 0.5 + 0.5 * x * y * z
    if face >= 4:
        return 0.0
    along, step = (p[1], steps[1]) if face < 2 else (p[0], steps[0])
    return square_wave(along + 0.25, step) * square_wave(p[2] + 0.25, steps[2])


@njit(cache=True, nogil=True, error_model="numpy")
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


@njit(cache=True, nogil=True, error_model="numpy")
def _fogged(instant: Record, colour: Colour, distance: float) -> Colour:
    if instant.fog == 0.0:
        return colour
    return mix(triple(instant.fog_colour), colour, math.exp(-distance * instant.fog))


@njit(cache=True, nogil=True, error_model="numpy")
def _sky_light(instant: Record, direction: Colour, pixel: float) -> Colour:
    """Sky in a unit direction, behind the fog."""
    path = _FOG_HEIGHT_M / max(abs(direction[2]), 1e-6)
    return _fogged(instant, sky_colour(instant, direction, pixel), path)


@njit(cache=True, nogil=True, error_model="numpy")
def _sea(world: World, point: Colour, view: Colour, foot: Colour) -> Colour:
    """Moving waves that mirror the sky; waves smaller than a pixel fade out."""
    instant = world.instant[0]
    slope_x, slope_y = 0.0, 0.0
    length, angle, strength = 9.0, 0.4, 0.05
    for _ in range(7):
        wave = 2.0 * math.pi / length
        cosine, sine = math.cos(angle), math.sin(angle)
        phase = wave * (cosine * point[0] + sine * point[1]) + math.sqrt(9.81 * wave) * instant.time
        size = strength * keep((abs(cosine) * foot[0] + abs(sine) * foot[1]) / length)
        slope_x += size * cosine * math.cos(phase)
        slope_y += size * sine * math.cos(phase)
        length, angle, strength = 0.62 * length, angle + 2.4, 1.05 * strength
    scale = 1.0 / math.sqrt(1.0 + slope_x * slope_x + slope_y * slope_y)
    nx, ny, nz = -slope_x * scale, -slope_y * scale, scale
    facing = max(-(view[0] * nx + view[1] * ny + view[2] * nz), 0.0)
    mirror = 0.03 + 0.75 * (1.0 - facing) ** 4
    up = abs(view[2] + 2.0 * facing * nz)
    deep = mix(
        triple(instant.colour),
        triple(instant.second_colour),
        smooth(0.5 + 2.2 * (slope_x + slope_y)),
    )
    light = (
        instant.ambient[0] + 0.5 * instant.sun_colour[0],
        instant.ambient[1] + 0.5 * instant.sun_colour[1],
        instant.ambient[2] + 0.5 * instant.sun_colour[2],
    )
    water = (deep[0] * light[0], deep[1] * light[1], deep[2] * light[2])
    colour = mix(water, sky_gradient(instant, up), mirror)
    sun = instant.sun
    hx, hy, hz = sun[0] - view[0], sun[1] - view[1], sun[2] - view[2]
    half = (hx * nx + hy * ny + hz * nz) / math.sqrt(hx * hx + hy * hy + hz * hz + 1e-12)
    glint = 0.5 * max(half, 0.0) ** 60
    return (
        colour[0] + glint * instant.sun_colour[0],
        colour[1] + glint * instant.sun_colour[1],
        colour[2] + glint * instant.sun_colour[2],
    )


@njit(cache=True, nogil=True, error_model="numpy")
def _caustics(instant: Record, point: Colour, foot: float) -> float:
    """Ripples of light that waves throw on what is under water: a factor around 1."""
    share = keep(1.2 * foot)
    if share == 0.0:
        return 1.0
    x, y, t = 0.9 * point[0], 0.9 * point[1], 0.9 * instant.time
    bend_x = x + 0.6 * math.sin(1.7 * y + 1.1 * t) + 0.2 * point[2]
    bend_y = y + 0.6 * math.sin(1.5 * x - 1.3 * t)
    web = math.sin(1.9 * bend_x + 0.7 * t) + math.sin(2.1 * bend_y - 0.8 * t)
    return 1.0 + share * (0.9 * math.exp(-3.0 * abs(web)) - 0.25)


@njit(cache=True, nogil=True, error_model="numpy")
def _ground_patch(world: World, direction: Colour, depth: float) -> Colour:
    """Metres of ground under one pixel: its extent in x and in y, and its longest side."""
    rays = world.instant[0]
    slope_right = rays.right[2] / direction[2]
    slope_down = rays.down[2] / direction[2]
    right_x = depth * (rays.right[0] - slope_right * direction[0])
    right_y = depth * (rays.right[1] - slope_right * direction[1])
    down_x = depth * (rays.down[0] - slope_down * direction[0])
    down_y = depth * (rays.down[1] - slope_down * direction[1])
    longest = max(math.hypot(right_x, right_y), math.hypot(down_x, down_y))
    return abs(right_x) + abs(down_x), abs(right_y) + abs(down_y), longest


@njit(cache=True, nogil=True, error_model="numpy")
def _reflected(world: World, colour: Colour, point: Colour, normal: Colour, is_lit: bool) -> Colour:
    """Light reflected by a matt surface."""
    instant = world.instant[0]
    lamps = _lamp_light(world.lamps, point, normal)
    above = 0.68 + 0.32 * normal[2]
    facing = 0.0
    if is_lit:
        sun = instant.sun
        facing = max(normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2], 0.0)
        if instant.ground == _UNDERWATER:
            facing *= _caustics(instant, point, 0.0)
    return (
        colour[0] * (instant.ambient[0] * above + instant.sun_colour[0] * facing + lamps[0]),
        colour[1] * (instant.ambient[1] * above + instant.sun_colour[1] * facing + lamps[1]),
        colour[2] * (instant.ambient[2] * above + instant.sun_colour[2] * facing + lamps[2]),
    )


@njit(cache=True, nogil=True, error_model="numpy")
def _shape_light(
    world: World, number: int, face: int, point: Colour, view: Colour, pixel: float, is_lit: bool
) -> Colour:
    """Light from shape `number`: texture, reflection, a soft highlight, its own glow."""
    instant = world.instant[0]
    colour = surface_colour(world, number, face, point, pixel)
    normal = surface_normal(world, number, face, point)
    red, green, blue = _reflected(world, colour, point, normal, is_lit)
    if is_lit:
        sun = instant.sun
        hx, hy, hz = sun[0] - view[0], sun[1] - view[1], sun[2] - view[2]
        half = hx * normal[0] + hy * normal[1] + hz * normal[2]
        half = max(half, 0.0) / math.sqrt(hx * hx + hy * hy + hz * hz + 1e-12)
        shine = 0.16 * half**24
        red += shine * instant.sun_colour[0]
        green += shine * instant.sun_colour[1]
        blue += shine * instant.sun_colour[2]
    glow = world.shapes[number].emission
    return red + glow * colour[0], green + glow * colour[1], blue + glow * colour[2]


@njit(cache=True, nogil=True, error_model="numpy")
def light_at(world: World, x: float, y: float, hit: tuple[float, int, int], is_lit: bool) -> Colour:
    """Linear light that reaches picture point (x, y).

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
    length = math.sqrt(direction[0] ** 2 + direction[1] ** 2 + direction[2] ** 2)
    view = (direction[0] / length, direction[1] / length, direction[2] / length)
    step = instant.step
    if number == SKY:
        return _sky_light(instant, view, step)
    distance = depth * length
    point = (
        instant.origin[0] + depth * direction[0],
        instant.origin[1] + depth * direction[1],
        instant.origin[2] + depth * direction[2],
    )
    if number == GROUND:
        foot = _ground_patch(world, direction, depth)
        if instant.ground == _SEA:
            light = _sea(world, point, view, foot)
        else:
            colour = ground_colour(instant, point[0], point[1], foot)
            light = _reflected(world, colour, point, (0.0, 0.0, 1.0), is_lit)
        haze = smooth((distance - 150.0) / 1500.0) if instant.ground != _UNDERWATER else 0.0
        light = mix(light, triple(instant.sky_horizon), haze)
    elif number == ROOM:
        colour = wall_colour(instant, point, face, depth * step)
        light = _reflected(world, colour, point, surface_normal(world, ROOM, face, point), False)
    else:
        light = _shape_light(world, number, face, point, view, depth * step, is_lit)
    return _fogged(instant, light, distance)

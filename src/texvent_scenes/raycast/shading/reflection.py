"""Light that glossy surfaces and waves mirror: sky, ground, walls, and near shapes (by Numba).

One mirrored ray per sample. Its image is blurred by the angle that a pixel covers after
reflection, and by the roughness of the surface, so that nothing in it flickers: the share of a
shape grows with the chord that the ray cuts of it.
"""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent_scenes.raycast.addresses import mirrored_at
from texvent_scenes.raycast.mirrored import REACH
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.shading.ground import inside_share, strip_place
from texvent_scenes.raycast.shading.value_noise import (
    box_coverage,
    detail_fade,
    mix,
    noise_2d,
    sky_colour,
    smooth,
)
from texvent_scenes.raycast.vectors import (
    Vector,
    along,
    dot,
    mapped,
    scaled,
    times,
    triple,
    turned,
)
from texvent_scenes.rendered_scene import Colour

_NO_GROUND, _FLOOR, _CITY, _RIVER, _LAKE = 10, 6, 5, 11, 12
_PAVED: Colour = (0.34, 0.33, 0.32)
_FOG_HEIGHT_M = 40.0
"""Fog and water above this height do not count for rays that go up."""
_NEAREST_M = 1e-3
"""A mirrored shape begins at least this far from the surface."""
_SOFTEST = 0.5
"""Most that a mirrored image is blurred, radians."""
_WAVE_BLUR = 0.15
"""Blur of what the sea mirrors, by the waves that are too small to be seen, radians."""
_FOAM_FROM, _FOAM_HIGH, _FOAM_LACE, _FOAM_STEEPNESS = 3.2, 1.8, 1.6, 0.35
"""Sum of the waves, each of size 1, from which on crests foam, and how much higher that is for
lower waves; what the lace of foam adds to it, and what the share of foam rises by."""


@jit(error_model="numpy", inner=True)
def add_fog(instant: Record, colour: Colour, distance: float) -> Colour:
    """Light after a distance through fog, metres."""
    if instant.fog == 0.0:
        return colour
    return mix(triple(instant.fog_colour), colour, math.exp(-distance * instant.fog))


@jit(error_model="numpy", inner=True)
def sky_light(instant: Record, direction: Vector, pixel: float, time: float) -> Colour:
    """Sky in a unit direction, behind the fog."""
    path = _FOG_HEIGHT_M / max(abs(direction[2]), 1e-6)
    return add_fog(instant, sky_colour(instant, direction, pixel, time), path)


@jit(error_model="numpy", inner=True)
def fresnel(base: float, facing: float) -> float:
    """Share of light that a surface mirrors: `base` straight on, all of it at grazing angles.

    Schlick's approximation, EUROGRAPHICS 1994; `facing` is the cosine of the angle of incidence.
    """
    return base + (1.0 - base) * (1.0 - facing) ** 5


@jit(error_model="numpy", inner=True)
def _chord(one: Record, point: Vector, direction: Vector) -> tuple[float, float]:
    """Distance at which a ray enters a mirrored shape, and the length that it cuts; metres."""
    o, d = mapped(one.inverse, point), turned(one.inverse, direction)
    if one.is_round:
        a, b, c = dot(d, d), dot(o, d), dot(o, o) - 1.0
        square = b * b - a * c
        if square <= 0.0:
            return 0.0, 0.0
        half = math.sqrt(square) / a
        return -b / a - half, 2.0 * half
    enter, leave = -math.inf, math.inf
    for axis in range(3):
        inverse = 1.0 / (d[axis] if d[axis] != 0.0 else 1e-300)
        first, second = (-1.0 - o[axis]) * inverse, (1.0 - o[axis]) * inverse
        enter, leave = max(enter, min(first, second)), min(leave, max(first, second))
    return enter, leave - enter


@jit(error_model="numpy", inner=True)
def _hidden_share(
    one: Record, point: Vector, direction: Vector, blur: float
) -> tuple[float, float]:
    """Share of a mirrored ray's cone that a shape fills, and its distance, metres."""
    offset = along(triple(one.middle), point, -1.0)
    ahead, square = dot(offset, direction), dot(offset, offset)
    radius = one.radius
    if square - ahead * ahead >= radius * radius or ahead <= -radius:
        return 0.0, 0.0
    near = smooth(0.5 * (REACH - math.sqrt(square) / radius))
    if near == 0.0:
        return 0.0, 0.0
    depth, chord = _chord(one, point, direction)
    if depth <= _NEAREST_M or chord <= 0.0:
        return 0.0, 0.0
    return near * min(chord / (2.0 * blur * depth + 0.02), 1.0), depth


@jit(error_model="numpy", inner=True)
def _room_light(instant: Record, direction: Vector) -> Colour:
    """Walls, ceiling and floor of a room as mirrored."""
    ambient = triple(instant.ambient)
    wall = times(triple(instant.wall_colour), ambient)
    light = mix(wall, scaled(ambient, 1.5), smooth((direction[2] - 0.2) / 0.3))
    floor = times(triple(instant.colour), ambient)
    return mix(light, floor, smooth((-direction[2] - 0.1) / 0.3))


@jit(error_model="numpy", inner=True)
def _land_light(instant: Record, point: Vector, direction: Vector, blur: float) -> Colour:
    """Ground as mirrored, without its texture."""
    distance = min(max(point[2], 0.0) / max(-direction[2], 1e-4), 2000.0)
    colour = triple(instant.colour)
    if instant.ground == _CITY:
        colour = _PAVED
    place = along(point, direction, distance)
    if instant.ground in (_RIVER, _LAKE):
        wet = inside_share(instant, strip_place(instant, place[0], place[1]), 2.0 * blur * distance)
        colour = mix(colour, triple(instant.second_colour), wet)
    if instant.ground in (2, 3, 5):
        across = strip_place(instant, place[0], place[1])[1]
        half = instant.road[2]
        road = box_coverage(across, -half, half, 0.1 + 2.0 * blur * distance)
        colour = mix(colour, triple(instant.second_colour), road)
    lit = along(triple(instant.ambient), triple(instant.sun_colour), 0.8 * max(instant.sun[2], 0.0))
    far = smooth((distance - 150.0) / 1500.0)
    return mix(times(colour, lit), triple(instant.sky_horizon), far)


@jit(error_model="numpy", inner=True)
def _surroundings_light(
    instant: Record, point: Vector, direction: Vector, blur: float, time: float
) -> Colour:
    """Surroundings as mirrored, without shapes."""
    if instant.ground == _FLOOR:
        return _room_light(instant, direction)
    up = 1.0
    if instant.ground != _NO_GROUND:
        up = smooth(0.5 * direction[2] / blur + 0.5)
    light = (0.0, 0.0, 0.0)
    if up > 0.0:
        light = sky_light(instant, direction, blur, time)
    if up < 1.0:
        light = mix(_land_light(instant, point, direction, blur), light, up)
    return light


@jit(error_model="numpy", inner=True)
def mirrored_light(
    instant: Record, point: Vector, direction: Vector, blur: float, own: int, time: float
) -> Colour:
    """Light that arrives at a point from a unit direction, blurred.

    Args:
        instant: the scene.
        point: on the surface that mirrors, metres.
        direction: of the mirrored ray.
        blur: half the angle of the cone that is averaged, radians.
        own: instance of the surface, which does not mirror itself; 0 = none.
        time: of the clouds, s.
    """
    floor = math.inf
    if direction[2] < 0.0 and instant.ground != _NO_GROUND:
        floor = max(point[2], 0.0) / -direction[2]
    total, weight, clear = (0.0, 0.0, 0.0), 0.0, 1.0
    for index in range(instant.mirrored_count):
        one = mirrored_at(instant.mirrored, index)
        if own > 0 and one.instance == own:
            continue
        share, depth = _hidden_share(one, point, direction, blur)
        if share > 0.0 and depth > floor:
            share *= smooth(1.0 - (depth - floor) / (blur * depth + 0.05))
        if share > 0.0:
            part = share / (depth * depth + 0.01)
            total, weight = along(total, triple(one.light), part), weight + part
            clear *= 1.0 - share
    light = (0.0, 0.0, 0.0)
    if clear > 0.0:
        light = scaled(_surroundings_light(instant, point, direction, blur, time), clear)
    if weight > 0.0:
        light = along(light, total, (1.0 - clear) / weight)
    return light


@jit(error_model="numpy", inner=True)
def with_reflection(
    instant: Record,
    light: Colour,
    rays: tuple[Vector, Vector, Vector],
    base: float,
    blur: float,
    own: int,
) -> Colour:
    """Light of a surface under a clear, glossy layer.

    Args:
        instant: the scene.
        light: that the surface sends back without the layer.
        rays: point, unit direction of the camera's ray, unit normal.
        base: share that is mirrored straight on; 0 = there is no layer.
        blur: as for `mirrored_light`.
        own: as for `mirrored_light`; −1 = the ground.
    """
    point, view, normal = rays
    facing = max(-dot(view, normal), 0.0)  # a bent normal may turn away
    share = fresnel(base, facing)
    direction = along(view, normal, 2.0 * facing)
    if own < 0:  # what the ground sends down meets it again
        direction = (direction[0], direction[1], abs(direction[2]))
    seen = mirrored_light(instant, point, direction, min(blur, _SOFTEST), own, 0.0)
    return mix(light, seen, share)


@jit(error_model="numpy", inner=True)
def steepness(wave_height: float) -> float:
    """Factor of the slopes of waves: those that are higher than usual are longer too."""
    return min(wave_height, 1.0) * math.sqrt(math.sqrt(max(wave_height, 1.0)))


@jit(error_model="numpy", inner=True)
def sea_light(instant: Record, point: Colour, view: Colour, footprint: Colour) -> Colour:
    """Moving waves that mirror the sky; waves smaller than a pixel fade out. High ones foam."""
    slope_x, slope_y, crest = 0.0, 0.0, 0.0
    length, angle = 9.0 * instant.wave_height, 0.4
    steep = steepness(instant.wave_height)
    strength = 0.042 * steep
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
    away = along(view, normal, 2.0 * facing)
    away = (away[0], away[1], abs(away[2]))
    seen = mirrored_light(instant, point, away, _WAVE_BLUR, 0, instant.time)
    deep = mix(
        triple(instant.colour),
        triple(instant.second_colour),
        smooth(0.5 + 2.2 * (slope_x + slope_y)),
    )
    sun_colour = triple(instant.sun_colour)
    water = times(deep, along(triple(instant.ambient), sun_colour, 0.5))
    colour = mix(water, seen, mirror)
    half = along(triple(instant.sun), view, -1.0)
    shine = dot(half, normal) / math.sqrt(dot(half, half) + 1e-12)
    if instant.wave_height > 1.0:
        x, y, foot = point[0], point[1], max(footprint[0], footprint[1])
        lace = noise_2d(1.7 * x, 1.7 * y, 7) + 0.7 * noise_2d(4.1 * x, 4.1 * y, 8)
        high = crest / (0.042 * steep) + _FOAM_LACE * lace * detail_fade(1.7 * foot)
        least = _FOAM_FROM + _FOAM_HIGH / instant.wave_height
        foam = 0.8 * smooth(_FOAM_STEEPNESS * (high - least))
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

"""Colour and relief of the ground, roads, rivers and a shore (Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.shading.material import (
    Look,
    Patch,
    land_look,
    mixed,
    painted,
    patch_axes,
    sample_material,
)
from texvent_scenes.raycast.shading.value_noise import (
    box_coverage,
    detail_fade,
    mix,
    noise_2d,
    smooth,
    square_wave,
)
from texvent_scenes.raycast.vectors import Vector, scaled, triple
from texvent_scenes.rendered_scene import Colour

_WHITE_PAINT = (0.62, 0.62, 0.60)
_KERB = (0.46, 0.46, 0.44)
_DASH_M = 6.0
_LINE_M = 0.14
_DIRT_ROAD = 3
_CITY = 5
_RIVER = 11
_LAKE = 12
_WATER = 30
_BREAKERS_M, _ROLL_M_S = 6.0, 2.0
"""Distance from one line of foam to the next, and their speed."""
_FOAM = (0.82, 0.84, 0.84)
_FLOW_M_S = 0.9
_DRIFT_M_S = 0.25

Strip = tuple[float, float, float, float]
"""Metres along and across a strip, and cosine and sine of its direction there."""


@jit(error_model="numpy")
def strip_place(instant: Record, x: float, y: float) -> Strip:
    """Position of a ground point along and across the main road's line."""
    cosine, sine, _, x0, y0 = instant.road
    return (
        (x - x0) * cosine + (y - y0) * sine,
        (y - y0) * cosine - (x - x0) * sine,
        cosine,
        sine,
    )


@jit(error_model="numpy", inner=True)
def _crossing_place(instant: Record, number: int, x: float, y: float) -> Strip:
    x0, y0, cosine, sine = instant.crossings[number]
    return (
        (x - x0) * cosine + (y - y0) * sine,
        (y - y0) * cosine - (x - x0) * sine,
        cosine,
        sine,
    )


@jit(error_model="numpy", inner=True)
def _feet(strip: Strip, patch: Patch) -> tuple[float, float]:
    """Metres that a pixel covers along and across a strip."""
    cosine, sine = strip[2], strip[3]
    return (
        abs(patch[0] * cosine + patch[1] * sine) + abs(patch[2] * cosine + patch[3] * sine),
        abs(patch[1] * cosine - patch[0] * sine) + abs(patch[3] * cosine - patch[2] * sine),
    )


@jit(error_model="numpy", inner=True)
def inside_share(instant: Record, strip: Strip, foot: float) -> float:
    """Share of a pixel that shows the strip rather than what lies beside it."""
    half = instant.road[2]
    if instant.ground in (2, _CITY):
        return box_coverage(strip[1], -half, half, foot)
    far = 1.0 if instant.ground == _DIRT_ROAD else 2.5
    wobble = far * (
        0.35 * noise_2d(0.35 * strip[0] / far, 0.0, 3) + 0.12 * noise_2d(1.3 * strip[0], 9.0, 4)
    )
    soft = max(0.6, 1.5 * foot)
    if instant.ground == _LAKE:
        return smooth((strip[1] + 2.0 * wobble) / soft + 0.5)
    return smooth((half + wobble - abs(strip[1])) / soft + 0.5)


@jit(error_model="numpy", inner=True)
def _line_marks(strip: Strip, half: float, feet: tuple[float, float]) -> float:
    """Share of white paint: edge lines and a dashed middle line."""
    edge = box_coverage(abs(strip[1]), half - 3.0 * _LINE_M, half - 2.0 * _LINE_M, feet[1])
    middle = box_coverage(strip[1], -0.5 * _LINE_M, 0.5 * _LINE_M, feet[1])
    return max(edge, middle * square_wave(strip[0] / _DASH_M, feet[0] / _DASH_M))


@jit(error_model="numpy", inner=True)
def _asphalt(instant: Record, x: float, y: float, axes: Patch, marks: float) -> Look:
    """Carriageway with worn paint; `marks` is its share of a pixel."""
    sample = sample_material(instant, instant.road_surface, x, y, axes, 1.0)
    tar = triple(instant.second_colour)
    surface = painted(sample, tar, scaled(tar, 2.2), 1.0)
    brightness = min(sample[0] + sample[1], 1.3)
    colour = mix(surface[0], scaled(_WHITE_PAINT, 0.55 + 0.45 * brightness), 0.9 * marks)
    return colour, surface[1], surface[2]


@jit(error_model="numpy", inner=True)
def _track(
    instant: Record, x: float, y: float, axes: Patch, strip: Strip, feet: tuple[float, float]
) -> Look:
    """A dirt road with two ruts."""
    sample = sample_material(instant, instant.road_surface, x, y, axes, 1.0)
    wobble = 0.3 * noise_2d(0.35 * strip[0], 0.0, 3)
    rut = smooth(1.6 - abs(abs(strip[1] + wobble) - 0.85) / 0.35)
    factor = 1.0 - 0.28 * rut * detail_fade(feet[1] / 1.5)
    soil = triple(instant.second_colour)
    return painted(sample, soil, scaled(soil, 1.3), factor)


@jit(error_model="numpy", inner=True)
def _foam_share(instant: Record, strip: Strip, feet: tuple[float, float]) -> float:
    """Share of foam on high waves: lines of it roll onto a shore, fewer far out."""
    if instant.wave_height <= 1.0 or instant.ground != _LAKE:
        return 0.0
    far = max(strip[1], 0.0)
    seaward = far + _ROLL_M_S * instant.time
    place = (seaward + 3.0 * noise_2d(0.12 * strip[0], 0.0, 5)) / _BREAKERS_M
    behind = place - math.floor(place)
    patchy = noise_2d(0.5 * strip[0], 0.9 * seaward, 6)
    sharp = _BREAKERS_M / max(feet[1], 0.5)
    lace = noise_2d(1.9 * strip[0], 1.9 * seaward, 7) + noise_2d(4.3 * strip[0], 4.3 * seaward, 8)
    width = 0.1 + 0.22 * patchy + 0.08 * lace * detail_fade(1.9 * max(feet[0], feet[1]))
    line = smooth((width - behind) * min(sharp, 6.0) + 0.5)
    near = math.exp(-far / (8.0 * instant.wave_height))
    most = 0.9 * near * (0.08 + (line - 0.08) * detail_fade(feet[1] / _BREAKERS_M))
    return most - most / float(instant.wave_height)


@jit(error_model="numpy", inner=True)
def _water(instant: Record, strip: Strip, axes: Patch, view_up: float, foam: float) -> Look:
    """Rippled water that flows along the strip and mirrors the sky."""
    speed = _FLOW_M_S if instant.ground == _RIVER else _DRIFT_M_S
    turned = (
        axes[0] * strip[2] + axes[1] * strip[3], axes[1] * strip[2] - axes[0] * strip[3],
        axes[2], axes[3],
    )  # fmt: skip
    place = strip[0] - speed * instant.time
    sample = sample_material(instant, _WATER, place, strip[1], turned, 1.0)
    mirror = 0.06 + 0.44 * (1.0 - min(abs(view_up), 1.0)) ** 4  # ripples too small to be seen
    deep = mix(triple(instant.second_colour), triple(instant.sky_horizon), mirror)
    bright = mix(deep, triple(instant.sky_horizon), 0.65)
    look = painted(sample, deep, bright, 1.0)
    # Ripples lie flat: their slopes turn what is mirrored, not the water's own shade.
    return mix(look[0], _FOAM, foam), 0.0, 0.0


@jit(error_model="numpy", inner=True)
def _carriageway(
    instant: Record,
    point: tuple[float, float],
    axes: Patch,
    main: tuple[Strip, tuple[float, float], float],
    other: tuple[Strip, tuple[float, float], float],
) -> Look:
    """Asphalt of the main road, of one that crosses it, or of both."""
    half = instant.road[2]
    strip, feet, inside = main
    marks = 0.0
    if inside > 0.0:
        marks = inside * _line_marks(strip, half, feet) * (1.0 - other[2])
    if other[2] > 0.0:
        marks += (1.0 - inside) * other[2] * _line_marks(other[0], half, other[1])
    return _asphalt(instant, point[0], point[1], axes, marks)


@jit(error_model="numpy", inner=True)
def _road_look(
    instant: Record, x: float, y: float, patch: Patch, axes: Patch, strip: Strip
) -> Look:
    """A road with those that cross it, and what lies beside it."""
    half = instant.road[2]
    feet = _feet(strip, patch)
    inside = inside_share(instant, strip, feet[1])
    other, other_feet, beyond = strip, feet, 0.0
    kerb = box_coverage(abs(strip[1]), half, half + 0.3, feet[1])
    for number in range(instant.crossing_count):
        place = _crossing_place(instant, number, x, y)
        spread = _feet(place, patch)
        share = inside_share(instant, place, spread[1])
        kerb = max(kerb, box_coverage(abs(place[1]), half, half + 0.3, spread[1]))
        if share > beyond:
            other, other_feet, beyond = place, spread, share
    covered = inside + (1.0 - inside) * beyond
    if covered <= 0.0:
        return _kerbed(land_look(instant, x, y, axes), instant, kerb)
    if instant.ground == _DIRT_ROAD:
        if inside >= beyond:
            surface = _track(instant, x, y, axes, strip, feet)
        else:
            surface = _track(instant, x, y, axes, other, other_feet)
    else:
        surface = _carriageway(
            instant, (x, y), axes, (strip, feet, inside), (other, other_feet, beyond)
        )
    if covered >= 1.0:
        return surface
    return mixed(_kerbed(land_look(instant, x, y, axes), instant, kerb), surface, covered)


@jit(error_model="numpy", inner=True)
def _kerbed(land: Look, instant: Record, kerb: float) -> Look:
    if instant.ground != _CITY or kerb == 0.0:
        return land
    colour: Colour = mix(land[0], _KERB, kerb)
    return colour, land[1], land[2]


@jit(error_model="numpy", inner=True)
def strip_look(
    instant: Record, x: float, y: float, patch: Patch, axes: Patch, view_up: float
) -> Look:
    """Reflectance and relief of a ground with a road, a river or a shore.

    Args:
        instant: the scene.
        x: metres east.
        y: metres north.
        patch: what one pixel covers there.
        axes: of that patch, from `patch_axes`.
        view_up: z of the ray's unit direction.
    """
    strip = strip_place(instant, x, y)
    if instant.ground not in (_RIVER, _LAKE):
        return _road_look(instant, x, y, patch, axes, strip)
    feet = _feet(strip, patch)
    wet = inside_share(instant, strip, feet[1])
    if wet >= 1.0:
        return _water(instant, strip, axes, view_up, _foam_share(instant, strip, feet))
    land = land_look(instant, x, y, axes)
    edge = strip[1] + 1.2 if instant.ground == _LAKE else instant.road[2] + 1.2 - abs(strip[1])
    bank = 0.6 * smooth(edge / 2.0)
    land = scaled(mix(land[0], (0.20, 0.155, 0.10), bank), 1.0 - 0.25 * bank), land[1], land[2]
    if wet <= 0.0:
        return land
    foam = _foam_share(instant, strip, feet)
    return mixed(land, _water(instant, strip, axes, view_up, foam), wet)


@jit(error_model="numpy", inner=True)
def glossy_share(instant: Record, point: Vector, foot: float) -> tuple[float, float]:
    """Share of the ground that is water or wet, and the roughness of it.

    `foot` is the length that a pixel covers, metres.
    """
    if instant.ground in (_RIVER, _LAKE):
        return inside_share(instant, strip_place(instant, point[0], point[1]), foot), 0.05
    if instant.wetness == 0.0 or instant.ground not in (0, 2, _CITY):
        return 0.0, 0.0
    share = 1.0
    if instant.ground == 2:
        share = inside_share(instant, strip_place(instant, point[0], point[1]), foot)
    puddle = 0.0
    if share > 0.0:
        hollow = noise_2d(0.31 * point[0], 0.31 * point[1], 7)
        hollow += 0.4 * noise_2d(0.9 * point[0], 0.9 * point[1], 8) * detail_fade(0.9 * foot)
        puddle = smooth(1.6 * hollow + 0.3) * detail_fade(0.31 * foot)
    return share * instant.wetness * (0.3 + 0.7 * puddle), 0.28 - 0.24 * puddle


@jit(error_model="numpy", inner=True)
def ground_look(
    instant: Record, point: Vector, patch: tuple[Vector, Vector], view_up: float
) -> Look:
    """Reflectance and relief of the ground.

    Args:
        instant: the scene.
        point: on the ground, metres.
        patch: what one pixel covers there, from `texture.surface_patch`.
        view_up: z of the ray's unit direction.
    """
    flat = (patch[0][0], patch[0][1], patch[1][0], patch[1][1])
    axes = patch_axes(flat)
    if instant.ground in (2, 3, 5, 11, 12):
        return strip_look(instant, point[0], point[1], flat, axes, view_up)
    return land_look(instant, point[0], point[1], axes)

"""Colour and relief of what z = 0 is made of, and of the walls of a room (compiled by Numba)."""

from __future__ import annotations

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import Record, World
from texvent.scenes.raycast.shading.material import (
    Patch,
    Sample,
    largest_patches,
    patch_axes,
    sample_material,
)
from texvent.scenes.raycast.shading.sky import mix
from texvent.scenes.raycast.shading.value_noise import (
    box_coverage,
    detail_fade,
    noise_2d,
    smooth,
    square_wave,
)
from texvent.scenes.raycast.vectors import Vector, along, scaled, triple
from texvent.scenes.scene import Colour

_WHITE_PAINT = (0.62, 0.62, 0.60)
_PAVEMENT = (0.34, 0.33, 0.32)
_KERB = (0.46, 0.46, 0.44)
_DRY = (0.05, 0.035, 0.008)
_DASH_M = 6.0
_LINE_M = 0.14
_DIRT_ROAD = 3
_CITY = 5

Look = tuple[Colour, float, float]
"""Reflectance, and slopes along x and y."""


@jit(error_model="numpy")
def _painted(sample: Sample, first: Colour, second: Colour, factor: float) -> Look:
    """A material in two colours."""
    colour = along(scaled(first, factor * sample[0]), second, factor * sample[1])
    return colour, sample[2], sample[3]


@jit(error_model="numpy")
def _mixed(first: Look, second: Look, share: float) -> Look:
    """`first` at share 0, `second` at share 1."""
    return (
        mix(first[0], second[0], share),
        first[1] + share * (second[1] - first[1]),
        first[2] + share * (second[2] - first[2]),
    )


@jit(error_model="numpy")
def _land(world: World, x: float, y: float, axes: Patch) -> Look:
    """What lies beside the road."""
    instant = world.instant[0]
    sample = sample_material(world, instant.ground_surface, x, y, axes, 1.0)
    factor = largest_patches(world, instant.ground_surface, x, y, axes)
    first, second = triple(instant.colour), triple(instant.second_colour)
    if instant.ground == _CITY:
        first, second = _PAVEMENT, scaled(_PAVEMENT, 1.25)
    elif instant.ground in (2, _DIRT_ROAD):
        second = along(scaled(first, 1.35), _DRY, 1.0)
    return _painted(sample, first, second, factor)


@jit(error_model="numpy")
def _line_marks(along_it: float, across: float, half: float, feet: tuple[float, float]) -> float:
    """Share of white paint: edge lines and a dashed middle line."""
    edge = box_coverage(abs(across), half - 3.0 * _LINE_M, half - 2.0 * _LINE_M, feet[1])
    middle = box_coverage(across, -0.5 * _LINE_M, 0.5 * _LINE_M, feet[1])
    return max(edge, middle * square_wave(along_it / _DASH_M, feet[0] / _DASH_M))


@jit(error_model="numpy")
def _asphalt(
    world: World, place: tuple[float, float], axes: Patch, feet: tuple[float, float]
) -> Look:
    """Carriageway with worn marks; `place` and `feet` are metres along and across it."""
    instant = world.instant[0]
    along_it, across = place
    sample = sample_material(world, instant.road_surface, along_it, across, axes, 1.0)
    factor = largest_patches(world, instant.road_surface, along_it, across, axes)
    tar = triple(instant.second_colour)
    surface = _painted(sample, tar, scaled(tar, 2.2), factor)
    paint = _line_marks(along_it, across, instant.road[2], feet)
    worn = scaled(_WHITE_PAINT, 0.55 + 0.45 * min(sample[0] + sample[1], 1.3))
    return mix(surface[0], worn, 0.9 * paint), surface[1], surface[2]


@jit(error_model="numpy")
def _track(
    world: World, place: tuple[float, float], axes: Patch, feet: tuple[float, float]
) -> Look:
    """A dirt road with two ruts."""
    instant = world.instant[0]
    sample = sample_material(world, instant.road_surface, place[0], place[1], axes, 1.0)
    factor = largest_patches(world, instant.road_surface, place[0], place[1], axes)
    wobble = 0.3 * noise_2d(0.35 * place[0], 0.0, 3)
    rut = smooth(1.6 - abs(abs(place[1] + wobble) - 0.85) / 0.35)
    factor *= 1.0 - 0.28 * rut * detail_fade(feet[1] / 1.5)
    soil = triple(instant.second_colour)
    return _painted(sample, soil, scaled(soil, 1.3), factor)


@jit(error_model="numpy")
def _road(world: World, x: float, y: float, patch: Patch, axes: Patch) -> Look:
    """ROAD, DIRT_ROAD and CITY: a strip along `road`, and what lies beside it."""
    instant = world.instant[0]
    cosine, sine, half, x0, y0 = instant.road
    along_it = (x - x0) * cosine + (y - y0) * sine
    across = (y - y0) * cosine - (x - x0) * sine
    feet = (
        abs(patch[0] * cosine + patch[1] * sine) + abs(patch[2] * cosine + patch[3] * sine),
        abs(patch[1] * cosine - patch[0] * sine) + abs(patch[3] * cosine - patch[2] * sine),
    )
    inside = _inside_share(instant, along_it, across, feet[1])
    if inside <= 0.0:
        land = _land(world, x, y, axes)
        if instant.ground == _CITY:
            kerb = box_coverage(abs(across), half, half + 0.3, feet[1])
            land = (mix(land[0], _KERB, kerb), land[1], land[2])
        return land
    turned = (
        axes[0] * cosine + axes[1] * sine, axes[1] * cosine - axes[0] * sine, axes[2], axes[3],
    )  # fmt: skip
    if instant.ground == _DIRT_ROAD:
        surface = _track(world, (along_it, across), turned, feet)
    else:
        surface = _asphalt(world, (along_it, across), turned, feet)
    surface = (
        surface[0],
        surface[1] * cosine - surface[2] * sine,
        surface[1] * sine + surface[2] * cosine,
    )
    if inside >= 1.0:
        return surface
    return _mixed(_land(world, x, y, axes), surface, inside)


@jit(error_model="numpy")
def _inside_share(instant: Record, along_it: float, across: float, foot: float) -> float:
    """Share of a pixel that shows the road rather than what lies beside it."""
    half = instant.road[2]
    if instant.ground != _DIRT_ROAD:
        return box_coverage(across, -half, half, foot)
    wobble = 0.35 * noise_2d(0.35 * along_it, 0.0, 3) + 0.12 * noise_2d(1.3 * along_it, 9.0, 4)
    return smooth((half + wobble - abs(across)) / max(0.6, 1.5 * foot) + 0.5)


@jit(error_model="numpy")
def ground_look(world: World, point: Vector, patch: tuple[Vector, Vector]) -> Look:
    """Reflectance and relief of the ground.

    Args:
        world: the scene.
        point: on the ground, metres.
        patch: what one pixel covers there, from `texture.surface_patch`.
    """
    flat = (patch[0][0], patch[0][1], patch[1][0], patch[1][1])
    axes = patch_axes(flat)
    if world.instant[0].ground in (2, _DIRT_ROAD, _CITY):
        return _road(world, point[0], point[1], flat, axes)
    return _land(world, point[0], point[1], axes)


@jit(error_model="numpy")
def wall_look(
    world: World, point: Vector, face: int, patch: tuple[Vector, Vector]
) -> tuple[Colour, Vector]:
    """Reflectance and normal of a room's wall or ceiling; walls have a skirting board."""
    instant = world.instant[0]
    right, down = patch
    a, b = (1, 2) if face == 0 else (0, 2)
    if face == 2:
        a, b = 0, 1
    axes = patch_axes((right[a], right[b], down[a], down[b]))
    sample = sample_material(world, instant.wall_surface, point[a], point[b], axes, 1.0)
    side = -1.0 if face == 2 or point[face] > 0.0 else 1.0
    plain = mix(triple(instant.second_colour), (0.85, 0.83, 0.78), 0.75)
    if face == 2:
        plain = (0.8, 0.8, 0.78)
    look = _painted(sample, plain, scaled(plain, 0.72), 1.0)
    foot = abs(right[2]) + abs(down[2])
    skirting = 0.0 if face == 2 else box_coverage(point[2], 0.0, 0.14, foot)
    colour = mix(look[0], (0.3, 0.24, 0.2), skirting)
    if face == 0:
        return colour, (side, -look[1], -look[2])
    if face == 1:
        return colour, (-look[1], side, -look[2])
    return colour, (-look[1], -look[2], side)

"""Light of lamps on a surface (compiled by Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import Record, World
from texvent.scenes.raycast.vectors import Vector, along, dot
from texvent.scenes.scene import Colour

POSITION, LIGHT, REACH, BEAM, FULL, DARK, RADIUS, CASTS, GLOWS = 0, 3, 6, 7, 10, 11, 12, 13, 14
"""Columns of a lamp; see `scene.LAMP_COLUMNS`."""


@jit(error_model="numpy", inner=True)
def beam_share(lamp: Record, away: Vector) -> float:
    """Share of a lamp's light that it sends along a unit vector: a beam with a soft edge."""
    if lamp[FULL] < -1.0:
        return 1.0
    cosine = lamp[BEAM] * away[0] + lamp[BEAM + 1] * away[1] + lamp[BEAM + 2] * away[2]
    if cosine <= lamp[DARK]:
        return 0.0
    if cosine >= lamp[FULL]:
        return 1.0
    share = (cosine - lamp[DARK]) / (lamp[FULL] - lamp[DARK])
    return float(share * share * (3.0 - 2.0 * share))


@jit(error_model="numpy", inner=True)
def falloff(lamp: Record, towards: Vector) -> tuple[float, float]:
    """(light on a surface that faces the lamp, as a share of that at 1 m; distance in metres).

    `towards` leads from the surface to the lamp, metres. A disc of radius r gives 1 / (d² + r²)
    on its axis; the square of 1 - d² / reach² lets it end at its reach.
    """
    square = dot(towards, towards)
    reach = lamp[REACH] * lamp[REACH]
    distance = math.sqrt(square) + 1e-9
    if square >= reach:
        return 0.0, distance
    step = -1.0 / distance
    share = beam_share(lamp, (step * towards[0], step * towards[1], step * towards[2]))
    window = 1.0 - square / reach
    return share * window * window / (square + lamp[RADIUS] * lamp[RADIUS]), distance


@jit(error_model="numpy", inner=True)
def towards_lamp(lamp: Record, point: Vector) -> Vector:
    """From a point to a lamp, metres."""
    return lamp[0] - point[0], lamp[1] - point[1], lamp[2] - point[2]


@jit(error_model="numpy")
def lamp_light(world: World, point: Vector, normal: Vector, lit: int) -> Colour:
    """Light of all lamps on a surface.

    Args:
        world: the scene.
        point: metres.
        normal: of the surface, unit vector.
        lit: bit 1 + k: whether the k-th of the lamps that cast shadows is visible from there.
    """
    light = (0.0, 0.0, 0.0)
    shadow_lamps = world.instant[0].shadow_lamps
    for index in range(world.instant[0].lamp_count):
        if index < shadow_lamps and not (lit >> (index + 1)) & 1:
            continue
        lamp = world.lamps[index]
        towards = towards_lamp(lamp, point)
        facing = dot(towards, normal)
        if facing <= 0.0:
            continue
        share, distance = falloff(lamp, towards)
        light = along(light, (lamp[3], lamp[4], lamp[5]), share * facing / distance)
    return light


@jit(error_model="numpy", inner=True)
def light_through(world: World, point: Vector) -> Colour:
    """Light of all lamps at a point in the air, from all sides, without shadows."""
    light = (0.0, 0.0, 0.0)
    for index in range(world.instant[0].lamp_count):
        lamp = world.lamps[index]
        share, _ = falloff(lamp, towards_lamp(lamp, point))
        light = along(light, (lamp[3], lamp[4], lamp[5]), share)
    return light

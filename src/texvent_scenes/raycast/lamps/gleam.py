"""Gleam of lamps on a wet ground: streaks of light towards the camera (compiled by Numba).

Water on a rough ground is a film of small slopes, each of which mirrors the lamp: the light has the
shape of their distribution (Trowbridge-Reitz, with the shadowing of Smith in Schlick's form).
"""

from __future__ import annotations

from texvent.runtime.jit import jit
from texvent_scenes.raycast.addresses import lamp_at
from texvent_scenes.raycast.lamps.light import falloff, towards_lamp
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.vectors import Vector, along, dot, triple, unit
from texvent_scenes.rendered_scene import Colour

_LEAST_FACING = 0.02
"""Least cosine at which a surface is seen."""


@jit(error_model="numpy")
def lamp_gleam(
    instant: Record, point: Vector, view: Vector, normal: Vector, film: Vector, lit: int
) -> Colour:
    """Light of all lamps that a film of water sends to the camera.

    Args:
        instant: the scene.
        point: metres.
        view: unit vector from the camera.
        normal: of the surface, unit vector.
        film: reflectance straight on, roughness, and angle that a pixel covers, radians.
        lit: as for `lamp_light`.
    """
    base, rough, pixel = film
    facing = max(-dot(view, normal), _LEAST_FACING)
    light = (0.0, 0.0, 0.0)
    for index in range(instant.lamp_count):
        if index < instant.shadow_lamps and not (lit >> (index + 1)) & 1:
            continue
        lamp = lamp_at(instant.lamps, index)
        towards = towards_lamp(lamp, point)
        if dot(towards, normal) <= 0.0:
            continue
        share, distance = falloff(lamp, towards)
        if share <= 0.0:
            continue
        onto = dot(towards, normal) / distance
        half = unit(along(towards, view, -distance))
        spread = rough + pixel + 0.5 * lamp.radius / distance
        square = spread * spread
        bulge = dot(half, normal) ** 2 * (square - 1.0) + 1.0
        slopes = square / (bulge * bulge)
        rest = 0.5 * spread
        open_share = 4.0 * (onto * (1.0 - rest) + rest) * (facing * (1.0 - rest) + rest)
        mirrored = base + (1.0 - base) * (1.0 - max(-dot(half, view), 0.0)) ** 5
        light = along(light, triple(lamp.light), share * onto * slopes * mirrored / open_share)
    return light

"""Colour of the sky: gradient, drifting clouds, sun or moon, stars (compiled by Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import Record
from texvent.scenes.raycast.shading.value_noise import fractal_2d, lattice, smooth
from texvent.scenes.raycast.vectors import along, dot, scaled, triple
from texvent.scenes.scene import Colour

_STAR_CELLS = 26
_CLOUD_SPEED = 0.012
"""Drift of the clouds, in cloud heights per second."""


@jit(error_model="numpy", inner=True)
def mix(first: Colour, second: Colour, share: float) -> Colour:
    """`first` at share 0, `second` at share 1."""
    return along(scaled(first, 1.0 - share), second, share)


@jit(error_model="numpy", inner=True)
def sky_gradient(instant: Record, height: float) -> Colour:
    """Clear sky where the ray's unit direction has this z: horizon at 0, zenith at 1."""
    return mix(
        triple(instant.sky_horizon), triple(instant.sky_top), math.sqrt(min(abs(height), 1.0))
    )


@jit(error_model="numpy", inner=True)
def _stars(x: float, y: float, z: float, pixel: float) -> float:
    """Light of the stars in a unit direction; each is a soft dot at least a pixel wide."""
    ax, ay, az = abs(x), abs(y), abs(z)
    if az >= ax and az >= ay:
        face, u, v = 0 if z > 0 else 1, x / az, y / az
    elif ax >= ay:
        face, u, v = 2 if x > 0 else 3, y / ax, z / ax
    else:
        face, u, v = 4 if y > 0 else 5, x / ay, z / ay
    i, j = math.floor(u * _STAR_CELLS), math.floor(v * _STAR_CELLS)
    chance = lattice(int(i), int(j), face)
    if chance > 0.35:
        return 0.0
    du = u * _STAR_CELLS - i - (0.3 + 0.4 * lattice(int(i), int(j), face + 6))
    dv = v * _STAR_CELLS - j - (0.3 + 0.4 * lattice(int(i), int(j), face + 12))
    width = max(0.7 * pixel, 0.0012) * _STAR_CELLS
    brightness = 0.06 + 2.0 * ((0.35 - chance) / 0.35) ** 4
    return brightness * math.exp(-(du * du + dv * dv) / (2.0 * width * width))


@jit(error_model="numpy", inner=True)
def _cloud_cover(instant: Record, x: float, y: float, z: float, pixel: float) -> float:
    """Share of the sky that cloud hides in a unit direction with z > 0."""
    height = max(z, 0.02)
    u = 1.1 * x / height + _CLOUD_SPEED * instant.time
    v = 1.1 * y / height + 0.4 * _CLOUD_SPEED * instant.time
    thickness = fractal_2d(u, v, 5, 1.1 * pixel / (height * height))
    cover = smooth((thickness + 1.7 * instant.clouds - 0.95) / 0.7)
    return cover * smooth((z - 0.01) / 0.12)


@jit(error_model="numpy", inner=True)
def sky_colour(instant: Record, direction: Colour, pixel: float) -> Colour:
    """Light from the sky, before fog and exposure.

    Args:
        instant: the surroundings.
        direction: unit vector from the camera.
        pixel: angle that one pixel covers, radians.
    """
    x, y, z = direction
    colour = sky_gradient(instant, z)
    if instant.stars > 0.0:
        light = instant.stars * _stars(x, y, z, pixel)
        colour = along(colour, (1.0, 1.0, 1.0), light)
    facing = min(dot(direction, instant.sun), 1.0)
    if facing > 0.6:
        angle = math.acos(facing)
        disc = smooth((instant.sun_radius - angle) / max(2.0 * pixel, 0.002) + 0.5)
        glow = 0.25 * math.exp(-angle / 0.09)
        colour = along(
            colour, triple(instant.sun_colour), 1.2 * disc + glow * (1.0 - instant.stars * 0.8)
        )
    if instant.clouds > 0.0 and z > 0.0:
        white = mix(triple(instant.sky_horizon), triple(instant.ambient), 0.5)
        lit = along(white, triple(instant.sun_colour), 0.28)
        colour = mix(colour, lit, 0.92 * _cloud_cover(instant, x, y, z, pixel))
    return colour

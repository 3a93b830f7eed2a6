"""Smooth noise, filtered patterns that stay calm when they shrink, and the sky (by Numba).

Every pattern takes its footprint, the pattern length that one pixel covers, and fades to its mean
as the footprint approaches the pattern's own detail. Detail finer than a pixel would flicker as
objects move, and an event simulator would report the flicker.
"""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.vectors import along, dot, scaled, triple
from texvent_scenes.rendered_scene import Colour


@jit(error_model="numpy", inner=True)
def lattice(x: int, y: int, z: int) -> float:
    """A fixed pseudo-random number in [0, 1) for each lattice point."""
    mixed = x * 0x2545F4914F6CDD1D + y * 0x369DEA0F31A53F85 + z * 0x27BB2EE687B0B0FD
    mixed ^= mixed >> 31
    mixed *= 0x1B8735939E3779B9
    mixed ^= mixed >> 29
    mixed *= 0x38495AB5A4C1FE5D
    mixed ^= mixed >> 33
    return (mixed & 0xFFFFFF) / 16777216.0


@jit(error_model="numpy", inner=True)
def smooth(x: float) -> float:
    """0 below 0, 1 above 1, smooth between (continuous second derivative)."""
    if x <= 0.0:
        return 0.0
    if x >= 1.0:
        return 1.0
    return x * x * x * (x * (6.0 * x - 15.0) + 10.0)


@jit(error_model="numpy")
def detail_fade(footprint: float) -> float:
    """Share of a pattern of period 1 to show: all if a pixel covers little of it, none from 1/2."""
    return smooth((0.5 - footprint) * 4.0)


@jit(error_model="numpy")
def noise_2d(x: float, y: float, layer: int) -> float:
    """Value noise in [-1, 1], lattice spacing 1."""
    column, row = math.floor(x), math.floor(y)
    i, j = int(column), int(row)
    u, v = smooth(x - column), smooth(y - row)
    top = lattice(i, j, layer) * (1.0 - u) + lattice(i + 1, j, layer) * u
    bottom = lattice(i, j + 1, layer) * (1.0 - u) + lattice(i + 1, j + 1, layer) * u
    return 2.0 * (top * (1.0 - v) + bottom * v) - 1.0


@jit(error_model="numpy")
def noise_3d(x: float, y: float, z: float) -> float:
    """Value noise in [-1, 1], lattice spacing 1."""
    floor_z = math.floor(z)
    k, w = int(floor_z), smooth(z - floor_z)
    return noise_2d(x, y, k) * (1.0 - w) + noise_2d(x, y, k + 1) * w


@jit(error_model="numpy")
def fractal_2d(x: float, y: float, octaves: int, footprint: float) -> float:
    """Sum of noise octaves (each twice as fine and half as strong), about [-1, 1]."""
    total, strength = 0.0, 0.5
    for octave in range(octaves):
        share = detail_fade(footprint)
        if share == 0.0:
            break
        # Each octave is turned by 37°, so that no lattice direction stands out.
        x, y = 0.8 * x - 0.6 * y + 17.1, 0.6 * x + 0.8 * y + 5.3
        total += strength * share * noise_2d(x, y, octave)
        x, y = 2.03 * x, 2.03 * y
        footprint *= 2.03
        strength *= 0.5
    return 1.6 * total


@jit(error_model="numpy", inner=True)
def _square_integral(x: float) -> float:
    """Integral from 0 to x of the square wave that is 1 on [0, 1/2) and 0 on [1/2, 1)."""
    whole = math.floor(x)
    return 0.5 * whole + min(x - whole, 0.5)


@jit(error_model="numpy")
def square_wave(x: float, footprint: float) -> float:
    """Average over `footprint` of the wave that is 1 on [0, 1/2), 0 on [1/2, 1), and repeats."""
    width = max(footprint, 1e-6)
    return (_square_integral(x + 0.5 * width) - _square_integral(x - 0.5 * width)) / width


@jit(error_model="numpy")
def box_coverage(x: float, low: float, high: float, footprint: float) -> float:
    """Share of the stretch of length `footprint` around x that lies in [low, high]."""
    width = max(footprint, 1e-9)
    start, stop = max(x - 0.5 * width, low), min(x + 0.5 * width, high)
    return max(stop - start, 0.0) / width


_STAR_CELLS = 26
_CLOUD_SPEED, _CLOUDS, _CLOUD_RISE, _CLOUD_STEP = 0.012, 2.0, 0.1, 0.02
"""Drift of the clouds and how many there are, per cloud height and second; sine of the angle by
which they are seen from the side at the horizon, as they tower; and of that from a point of one
to what shades it."""
_CLOUD_FOOT = 0.6
"""Light of a cloud from below, where it is thick, as a share of that of its rims."""


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
    if width >= 0.5:  # wider than its cell, of which the edges would be seen
        return 0.0
    brightness = 0.06 + 2.0 * ((0.35 - chance) / 0.35) ** 4
    return detail_fade(width) * brightness * math.exp(-(du * du + dv * dv) / (2.0 * width * width))


@jit(error_model="numpy", inner=True)
def _clouds(instant: Record, direction: Colour, pixel: float, time: float) -> tuple[float, float]:
    """Share of what is behind that cloud hides in a unit direction, and that of its shaded foot."""
    x, y, z = direction
    height = max(z, 0.0) + _CLOUD_RISE
    scale = _CLOUDS / height
    drift = _CLOUD_SPEED * time
    footprint = scale * pixel / height
    thickness = fractal_2d(scale * x + drift, scale * y + 0.4 * drift, 5, footprint)
    closed = smooth((instant.clouds - 0.85) / 0.15)  # no gap is left of a sky that is covered
    excess = thickness + 1.7 * instant.clouds + closed - 0.95
    if excess <= 0.0:
        return 0.0, 0.0
    scale = _CLOUDS / (height + _CLOUD_STEP)
    above = fractal_2d(scale * x + drift, scale * y + 0.4 * drift, 4, footprint)
    return smooth(excess / 0.4), smooth(0.45 + 0.9 * (above - thickness) + 0.4 * thickness)


@jit(error_model="numpy", inner=True)
def sky_colour(instant: Record, direction: Colour, pixel: float, time: float) -> Colour:
    """Light from the sky, before fog and exposure.

    Args:
        instant: the surroundings.
        direction: unit vector from the camera.
        pixel: angle that one pixel covers, radians.
        time: of the clouds, s.
    """
    x, y, z = direction
    colour = sky_gradient(instant, z)
    cover, shaded = 0.0, 0.0
    if instant.clouds > 0.0:
        cover, shaded = _clouds(instant, direction, pixel, time)
    clear = 1.0 - cover if instant.stars > 0.0 else 1.0
    if instant.stars > 0.0:
        light = clear * instant.stars * _stars(x, y, z, pixel)
        colour = along(colour, (1.0, 1.0, 1.0), light)
    facing = min(dot(direction, instant.sun), 1.0)
    if facing > 0.6:
        angle = math.acos(facing)
        disc = smooth((instant.sun_radius - angle) / max(2.0 * pixel, 0.002) + 0.5)
        glow = 0.25 * math.exp(-angle / 0.09)
        colour = along(
            colour,
            triple(instant.sun_colour),
            1.2 * clear * disc + glow * (1.0 - instant.stars * 0.8),
        )
    if cover > 0.0 and z > 0.0:
        white = mix(triple(instant.sky_horizon), triple(instant.ambient), 0.5)
        lit = along(white, triple(instant.sun_colour), 0.36)
        lit = scaled(lit, 1.0 + (_CLOUD_FOOT - 1.0) * shaded)
        colour = mix(colour, lit, 0.92 * cover * smooth((z - 0.005) / 0.12))
    return colour

"""Colour of what z = 0 is made of, and of the walls of a room (compiled by Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import Record
from texvent.scenes.raycast.shading.sky import mix
from texvent.scenes.raycast.shading.value_noise import (
    box_coverage,
    detail_fade,
    fractal_2d,
    noise_2d,
    smooth,
    square_wave,
)
from texvent.scenes.raycast.vectors import scaled, triple
from texvent.scenes.scene import Colour

_WHITE_PAINT = (0.75, 0.75, 0.72)
_PAVEMENT = (0.34, 0.33, 0.32)
_DASH_M = 6.0
_LINE_M = 0.14


@jit(error_model="numpy")
def _meadow(instant: Record, x: float, y: float, footprint: float) -> Colour:
    """Grass: patches, tufts and blades."""
    patches = fractal_2d(0.23 * x, 0.23 * y, 3, 0.23 * footprint)
    blades = fractal_2d(3.1 * x, 3.1 * y, 3, 3.1 * footprint)
    colour = mix(triple(instant.colour), triple(instant.second_colour), smooth(0.5 + 0.6 * patches))
    return scaled(colour, 1.0 + 0.45 * blades)


@jit(error_model="numpy")
def _speckled(colour: Colour, x: float, y: float, footprint: float, contrast: float) -> Colour:
    """A rough plain surface: asphalt, soil, snow."""
    coarse = fractal_2d(0.6 * x, 0.6 * y, 3, 0.6 * footprint)
    fine = fractal_2d(7.0 * x, 7.0 * y, 2, 7.0 * footprint)
    return scaled(colour, 1.0 + contrast * (0.6 * coarse + 0.5 * fine))


@jit(error_model="numpy")
def _asphalt(instant: Record, along: float, across: float, footprints: Colour) -> Colour:
    """Carriageway with a dashed middle line and edge lines.

    `footprints` are metres that a pixel covers along and across, and the pixel's longest side.
    """
    half = instant.road[2]
    footprint_along, footprint_across, pixel = footprints
    colour = _speckled(triple(instant.second_colour), along, across, pixel, 0.18)
    edge = box_coverage(abs(across), half - 3.0 * _LINE_M, half - 2.0 * _LINE_M, footprint_across)
    middle = box_coverage(across, -0.5 * _LINE_M, 0.5 * _LINE_M, footprint_across)
    dashes = square_wave(along / _DASH_M, footprint_along / _DASH_M)
    return mix(colour, _WHITE_PAINT, max(edge, middle * dashes))


@jit(error_model="numpy")
def _road(instant: Record, x: float, y: float, footprint: Colour) -> Colour:
    """ROAD, DIRT_ROAD and CITY: a strip along `road`, and what lies beside it."""
    cosine, sine, half, x0, y0 = instant.road
    along = (x - x0) * cosine + (y - y0) * sine
    across = (y - y0) * cosine - (x - x0) * sine
    footprint_along = abs(footprint[0] * cosine) + abs(footprint[1] * sine)
    footprint_across = abs(footprint[1] * cosine) + abs(footprint[0] * sine)
    if instant.ground == 3:
        wobble = 0.35 * noise_2d(0.35 * along, 0.0, 3) + 0.12 * noise_2d(1.3 * along, 9.0, 4)
        soil = _speckled(triple(instant.second_colour), along, across, footprint[2], 0.55)
        track = smooth(1.6 - abs(abs(across + 0.3 * wobble) - 0.85) / 0.35)
        soil = scaled(soil, 1.0 - 0.28 * track * detail_fade(footprint_across / 1.5))
        inside = smooth((half + wobble - abs(across)) / max(0.6, 1.5 * footprint_across) + 0.5)
        return mix(_meadow(instant, x, y, footprint[2]), soil, inside)
    inside = box_coverage(across, -half, half, footprint_across)
    if instant.ground == 2:
        beside = _meadow(instant, x, y, footprint[2])
    else:
        slabs = square_wave(along / 2.4, footprint_along / 2.4) - 0.5
        rows = square_wave(across / 2.4, footprint_across / 2.4) - 0.5
        beside = _speckled(_PAVEMENT, x, y, footprint[2], 0.12)
        beside = scaled(beside, 1.0 + 0.5 * slabs * rows)
        kerb = box_coverage(abs(across), half, half + 0.3, footprint_across)
        beside = mix(beside, (0.5, 0.5, 0.48), kerb)
    surface = _asphalt(instant, along, across, (footprint_along, footprint_across, footprint[2]))
    return mix(beside, surface, inside)


@jit(error_model="numpy")
def _floor(instant: Record, x: float, y: float, footprint: Colour) -> Colour:
    """Boards along x."""
    row = math.floor(y / 0.22)
    shade = 0.5 + 0.5 * noise_2d(7.3 * row, 0.7 * x + 3.7 * row, 5)
    shade = 0.5 + (shade - 0.5) * detail_fade(footprint[1] / 0.22)
    grain = fractal_2d(1.2 * x, 14.0 * y, 2, max(1.2 * footprint[0], 14.0 * footprint[1]))
    colour = mix(triple(instant.colour), triple(instant.second_colour), shade)
    gap = box_coverage(y - 0.22 * row, 0.0, 0.012, footprint[1]) + box_coverage(
        y - 0.22 * row, 0.22, 0.232, footprint[1]
    )
    return scaled(colour, (1.0 + 0.15 * grain) * (1.0 - 0.55 * min(gap, 1.0)))


@jit(error_model="numpy")
def ground_colour(instant: Record, x: float, y: float, footprint: Colour) -> Colour:
    """Reflectance of the ground at (x, y), metres.

    Args:
        instant: the surroundings.
        x: metres east.
        y: metres north.
        footprint: metres that one pixel covers in x and in y, and the longest side of its patch.
    """
    kind = instant.ground
    if kind == 1:
        return _meadow(instant, x, y, footprint[2])
    if kind in (2, 3, 5):
        return _road(instant, x, y, footprint)
    if kind == 6:
        return _floor(instant, x, y, footprint)
    if kind == 7 or kind == 9:
        bend = 0.8 * noise_2d(0.5 * x, 0.5 * y, 7)
        ripple = math.sin(2.0 * math.pi * (1.4 * y + 0.4 * x + bend)) * detail_fade(
            1.5 * footprint[2]
        )
        base = _speckled(triple(instant.colour), x, y, footprint[2], 0.25)
        return mix(base, triple(instant.second_colour), 0.5 + 0.22 * ripple)
    if kind == 8:
        return _speckled(triple(instant.colour), x, y, footprint[2], 0.12)
    return _speckled(triple(instant.colour), x, y, footprint[2], 0.2)


@jit(error_model="numpy")
def wall_colour(instant: Record, point: Colour, face: int, footprint: float) -> Colour:
    """Reflectance of a room's wall or ceiling; walls have a skirting board."""
    plain = mix(triple(instant.second_colour), (0.85, 0.83, 0.78), 0.75)
    if face == 2:
        return (0.8, 0.8, 0.78)
    skirting = box_coverage(point[2], 0.0, 0.14, footprint)
    spread = fractal_2d(0.4 * (point[0] + point[1]), 0.4 * point[2], 2, 0.4 * footprint)
    return mix(scaled(plain, 1.0 + 0.06 * spread), (0.3, 0.24, 0.2), skirting)

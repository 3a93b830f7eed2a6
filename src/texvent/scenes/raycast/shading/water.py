"""The sea's surface, and the light it throws on what is under water (compiled by Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import Record
from texvent.scenes.raycast.shading.sky import mix, sky_gradient
from texvent.scenes.raycast.shading.value_noise import detail_fade, smooth
from texvent.scenes.raycast.vectors import along, dot, times, triple
from texvent.scenes.scene import Colour

FOAM_FROM, FOAM_STEEPNESS = 0.085, 5.0
"""Sum of the waves' heights over their lengths, per wave height, from which on crests foam."""


@jit(error_model="numpy", inner=True)
def sea_light(instant: Record, point: Colour, view: Colour, footprint: Colour) -> Colour:
    """Moving waves that mirror the sky; waves smaller than a pixel fade out. High ones foam."""
    slope_x, slope_y, crest = 0.0, 0.0, 0.0
    length, angle = 9.0 * instant.wave_height, 0.4
    strength = 0.042 * instant.wave_height
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
    up = abs(view[2] + 2.0 * facing * normal[2])
    deep = mix(
        triple(instant.colour),
        triple(instant.second_colour),
        smooth(0.5 + 2.2 * (slope_x + slope_y)),
    )
    sun_colour = triple(instant.sun_colour)
    water = times(deep, along(triple(instant.ambient), sun_colour, 0.5))
    colour = mix(water, sky_gradient(instant, up), mirror)
    half = along(triple(instant.sun), view, -1.0)
    shine = dot(half, normal) / math.sqrt(dot(half, half) + 1e-12)
    if instant.wave_height > 1.0:
        foam = 0.8 * smooth(FOAM_STEEPNESS * (crest - FOAM_FROM * instant.wave_height))
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

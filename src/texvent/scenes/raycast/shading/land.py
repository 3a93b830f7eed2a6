"""Open ground of one material, and the pieces that roads and floors share (compiled by Numba)."""

from __future__ import annotations

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import World
from texvent.scenes.raycast.shading.material import (
    Patch,
    Sample,
    sample_material,
)
from texvent.scenes.raycast.shading.sky import mix
from texvent.scenes.raycast.vectors import along, scaled, triple
from texvent.scenes.scene import Colour

_PAVEMENT = (0.34, 0.33, 0.32)
_DRY = (0.05, 0.035, 0.008)
_CITY = 5
_SNOW = 25

Look = tuple[Colour, float, float]
"""Reflectance, and slopes along x and y."""


@jit(error_model="numpy", inner=True)
def painted(sample: Sample, first: Colour, second: Colour, factor: float) -> Look:
    """A material in two colours."""
    colour = along(scaled(first, factor * sample[0]), second, factor * sample[1])
    return colour, sample[2], sample[3]


@jit(error_model="numpy", inner=True)
def mixed(first: Look, second: Look, share: float) -> Look:
    """`first` at share 0, `second` at share 1."""
    return (
        mix(first[0], second[0], share),
        first[1] + share * (second[1] - first[1]),
        first[2] + share * (second[2] - first[2]),
    )


@jit(error_model="numpy", inner=True)
def land_look(world: World, x: float, y: float, axes: Patch) -> Look:
    """The ground's material at (x, y), metres; `axes` of the patch from `patch_axes`."""
    instant = world.instant[0]
    sample = sample_material(instant, instant.ground_surface, x, y, axes, 1.0)
    first, second = triple(instant.colour), triple(instant.second_colour)
    if instant.ground == _CITY:
        first, second = _PAVEMENT, scaled(_PAVEMENT, 1.25)
    elif instant.ground in (2, 3, 11, 12):  # the second colour is that of the road or the water
        second = along(scaled(first, 1.35), _DRY, 1.0)
        if instant.ground_surface == _SNOW:
            second = scaled(first, 0.85)
    return painted(sample, first, second, 1.0)

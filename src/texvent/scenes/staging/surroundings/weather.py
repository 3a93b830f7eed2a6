"""Rain and snow as small shapes whose paths are functions of time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from texvent.scenes.scene import Float64Array, Primitives, Shape
from texvent.scenes.staging.particles.shapes import ParticleEffect, many_shapes

RAIN_DROPS = 130
SNOW_FLAKES = 170
_DEPTH_BELOW_M = 0.6
"""Drops return to the top when they are this far under the ground, out of sight."""


@dataclass(frozen=True)
class FallingParticles(ParticleEffect):
    """Objects that fall through a box around what the camera looks at."""

    places: Float64Array
    """[n, 3] at t = 0, m; z counts from the bottom of the box."""
    base: Float64Array
    """[3] middle of the bottom of the box, m."""
    height_m: float
    fall_m_s: float
    sway_m: float
    half: Float64Array
    """[3] half extents of one drop, m."""
    colour: tuple[float, float, float]
    shape: Shape

    def at(self, time_s: float) -> Primitives:
        """All drops at that instant."""
        fallen = np.mod(self.places[:, 2] - self.fall_m_s * time_s, self.height_m)
        phase = 17.0 * self.places[:, 0]
        x = self.places[:, 0] + self.sway_m * np.sin(1.9 * time_s + phase)
        maps = np.zeros((len(self.places), 3, 4))
        maps[:, [0, 1, 2], [0, 1, 2]] = self.half
        maps[:, :, 3] = np.column_stack([x, self.places[:, 1], fallen]) + self.base
        return many_shapes(maps, self.shape, self.colour)


def make_rain(base: Float64Array, extent_m: float, rng: np.random.Generator) -> FallingParticles:
    """Rain over a square of that side around `base`, m."""
    height = 0.8 * extent_m + _DEPTH_BELOW_M
    places = _scatter(RAIN_DROPS, extent_m, height, rng)
    thick = 0.0011 * extent_m
    return FallingParticles(
        places, base - [0.0, 0.0, _DEPTH_BELOW_M], height, 8.0, 0.0,
        np.array([thick, thick, 0.022 * extent_m]), (0.66, 0.72, 0.80), Shape.CYLINDER,
    )  # fmt: skip


def make_snow(base: Float64Array, extent_m: float, rng: np.random.Generator) -> FallingParticles:
    """Snow over a square of that side around `base`, m."""
    height = 0.8 * extent_m + _DEPTH_BELOW_M
    places = _scatter(SNOW_FLAKES, extent_m, height, rng)
    radius = 0.0028 * extent_m
    return FallingParticles(
        places, base - [0.0, 0.0, _DEPTH_BELOW_M], height, 0.09 * extent_m, 0.015 * extent_m,
        np.full(3, radius), (0.95, 0.96, 1.0), Shape.ELLIPSOID,
    )  # fmt: skip


def _scatter(
    count: int, extent_m: float, height_m: float, rng: np.random.Generator
) -> Float64Array:
    low = np.array([-0.5 * extent_m, -0.5 * extent_m, 0.0])
    high = np.array([0.5 * extent_m, 0.5 * extent_m, height_m])
    return np.asarray(rng.uniform(low, high, size=(count, 3)))


WEATHERS: Mapping[str, Callable[[Float64Array, float, np.random.Generator], FallingParticles]] = (
    MappingProxyType({"rain": make_rain, "snow": make_snow})
)
"""Weather that falls."""

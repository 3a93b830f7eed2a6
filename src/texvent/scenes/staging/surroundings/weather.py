"""Rain and snow as small shapes whose paths are functions of time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import Colour, Float64Array, Primitives, Shape
from texvent.scenes.staging.particles.shapes import ParticleEffect, many_shapes

_DEPTH_BELOW_M = 0.6
"""Drops return to the top when they are this far under the ground, out of sight."""


@dataclass(frozen=True)
class Fall:
    """One kind of weather that falls; lengths are shares of the width of the box that it fills."""

    count: int
    half: tuple[float, float, float]
    """Half extents of a drop."""
    colour: Colour
    shape: Shape
    speed_m_s: float = 0.0
    speed_share: float = 0.0
    """How fast it falls: in m/s, and in widths of the box each second."""
    sway: float = 0.0


FALLS = {
    "rain": Fall(130, (0.0011, 0.0011, 0.022), (0.66, 0.72, 0.80), Shape.CYLINDER, 8.0),
    "snow": Fall(170, (0.0028,) * 3, (0.95, 0.96, 1.0), Shape.ELLIPSOID, 0.0, 0.09, 0.015),
}
"""Weather that falls."""


@dataclass(frozen=True)
class FallingParticles(ParticleEffect):
    """Drops that fall through a box around what the camera looks at."""

    kind: Fall
    places: Float64Array
    """[n, 3] at t = 0, m; z counts from the bottom of the box."""
    base: Float64Array
    """[3] middle of the ground that it falls on, m."""
    extent_m: float
    """Side of the box."""

    def at(self, time_s: float) -> Primitives:
        """All drops at that instant."""
        kind, extent = self.kind, self.extent_m
        speed = kind.speed_m_s + kind.speed_share * extent
        fallen = np.mod(self.places[:, 2] - speed * time_s, _height(extent)) - _DEPTH_BELOW_M
        sway = kind.sway * extent * np.sin(1.9 * time_s + 17.0 * self.places[:, 0])
        maps = np.zeros((len(self.places), 3, 4))
        maps[:, [0, 1, 2], [0, 1, 2]] = extent * np.array(kind.half)
        maps[:, :, 3] = np.column_stack([self.places[:, 0] + sway, self.places[:, 1], fallen])
        maps[:, :, 3] += self.base
        return many_shapes(maps, kind.shape, kind.colour)


def _height(extent_m: float) -> float:
    return 0.8 * extent_m + _DEPTH_BELOW_M


def let_fall(
    weather: str, base: Float64Array, extent_m: float, rng: np.random.Generator
) -> FallingParticles:
    """Weather of `FALLS` over a square of that side around `base`, m."""
    low = np.array([-0.5 * extent_m, -0.5 * extent_m, 0.0])
    high = np.array([0.5 * extent_m, 0.5 * extent_m, _height(extent_m)])
    places = rng.uniform(low, high, size=(FALLS[weather].count, 3))
    return FallingParticles(FALLS[weather], places, base, extent_m)

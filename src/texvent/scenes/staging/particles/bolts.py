"""Bolts of lightning."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import Float64Array, Primitives, Shape
from texvent.scenes.staging.particles.shapes import TINY_M, ParticleEffect, along, many_shapes
from texvent.scenes.staging.surroundings.lighting import flash_number, lightning_level

_BOLTS = 4
_STEPS = 12
"""Straight pieces of a bolt, without its branch."""
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Lightning(ParticleEffect):
    """Bolts in the sky; `lighting.lightning_level` lights the scene with them."""

    bolts: Float64Array
    """[bolts, pieces, 2, 3] ends of their straight pieces, m."""
    thick_m: float

    @classmethod
    def of(
        cls, middle: Float64Array, away: Float64Array, reach_m: float, rng: np.random.Generator
    ) -> Lightning:
        """Bolts behind what the camera looks at.

        Args:
            middle: [3] on the ground below what the camera looks at, m.
            away: [3] horizontal unit vector away from the camera.
            reach_m: distance of the camera to what it looks at.
            rng: shapes them.
        """
        side = np.cross(away, _UP)
        bolts = []
        for number in range(_BOLTS):
            foot = middle + 3.2 * reach_m * away
            foot = foot + reach_m * (0.9 - 0.6 * number + 0.2 * rng.uniform()) * side
            bolts.append(_bolt(foot, side, 2.6 * reach_m, rng))
        return cls(np.array(bolts), 0.016 * reach_m)

    def at(self, time_s: float) -> Primitives:
        """All bolts; only that of the present flash is there."""
        level = lightning_level(time_s)
        shown = flash_number(time_s) % len(self.bolts)
        maps = []
        for number, pieces in enumerate(self.bolts):
            start, end = pieces[:, 0], pieces[:, 1]
            half = np.full((len(pieces), 3), TINY_M)
            if number == shown and level > 0.02:
                half[:, :2] = self.thick_m * math.sqrt(level)
                half[:, 2] = 0.55 * np.linalg.norm(end - start, axis=1)
                half[_STEPS:, :2] *= 0.5
            maps.append(along(0.5 * (start + end), end - start, half))
        return many_shapes(np.concatenate(maps), Shape.ELLIPSOID, (0.85, 0.9, 1.0), 6.0)


def _bolt(
    foot: Float64Array, side: Float64Array, tall_m: float, rng: np.random.Generator
) -> Float64Array:
    """[pieces, 2, 3] a jagged line from the clouds to the ground, with one branch."""
    sway = np.cumsum(rng.uniform(-1.0, 1.0, size=_STEPS + 1)) * 0.05 * tall_m
    heights = tall_m * np.linspace(1.0, 0.0, _STEPS + 1)
    points = foot + sway[:, None] * side + heights[:, None] * _UP
    out = np.cumsum(np.concatenate([[0.0], 0.03 + 0.05 * rng.uniform(size=5)])) * tall_m
    down = 0.07 * tall_m * np.arange(6.0)
    twig = points[5] + out[:, None] * side - down[:, None] * _UP
    lines = [np.stack([line[:-1], line[1:]], axis=1) for line in (points, twig)]
    return np.concatenate(lines)

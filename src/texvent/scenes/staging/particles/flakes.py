"""Flakes that fall all around, swaying and tumbling: leaves, confetti."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.models.effects import FlakeStyle
from texvent.scenes.scene import Colour, Float64Array, Primitives, Shape
from texvent.scenes.staging.particles.shapes import ParticleEffect, many_shapes, tumbling

_BELOW = 0.06
"""Flakes return to the top when they are this share of the box under the ground."""


@dataclass(frozen=True)
class Flakes(ParticleEffect):
    """Flakes that fall through a box around what the camera looks at."""

    style: FlakeStyle
    base: Float64Array
    """[3] middle of the bottom of the box, m."""
    extent_m: float
    """Side of the box, m."""
    colours: Float64Array
    """[k, 3] linear RGB."""
    draws: Float64Array
    """[n, 8] in 0..1."""

    @classmethod
    def of(
        cls, style: FlakeStyle, base: Float64Array, extent_m: float, rng: np.random.Generator,
        colour: Colour | None = None,
    ) -> Flakes:  # fmt: skip
        """Flakes of a style, of one colour where the scene says one."""
        colours = np.array(style.colours if colour is None else [colour])
        return cls(style, base, extent_m, colours, rng.uniform(size=(style.count, 8)))

    def at(self, time_s: float) -> Primitives:
        """All flakes at that instant."""
        style, extent, draws = self.style, self.extent_m, self.draws
        height = 0.8 * extent
        fall = style.fall_m_s * (0.75 + 0.5 * draws[:, 3])
        phase = 2.0 * math.pi * draws[:, 4]
        swing = 2.0 * math.pi * style.swing_hz * time_s * (0.8 + 0.4 * draws[:, 5]) + phase
        sway = style.sway * extent
        up = np.mod(draws[:, 2] * height - fall * time_s, height)
        places = np.stack(
            [
                extent * (draws[:, 0] - 0.5) + sway * np.sin(swing),
                extent * (draws[:, 1] - 0.5) + sway * np.cos(1.3 * swing),
                up - _BELOW * extent + 0.25 * sway * np.sin(2.0 * swing),
            ],
            axis=1,
        )
        turn = 2.0 * math.pi * style.turn_hz * time_s * (0.6 + 0.8 * draws[:, 6])
        angles = np.stack([turn + phase, np.zeros_like(turn), 0.5 * turn + 2.0 * phase], axis=1)
        half = extent * np.array(style.half) * (0.75 + 0.5 * draws[:, 7:8])
        colours = self.colours[(draws[:, 6] * len(self.colours)).astype(np.int64)]
        return many_shapes(tumbling(places + self.base, angles, half), Shape.ELLIPSOID, colours)

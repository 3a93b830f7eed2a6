"""Leaves, petals, confetti, feathers and hail that fall all around."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.scene import Colour, Float64Array, Primitives, Shape
from texvent.scenes.staging.particles.shapes import SolidEffect, many_shapes, tumbling

_BELOW = 0.06
"""Flakes return to the top when they are this share of the box under the ground."""


@dataclass(frozen=True)
class FlakeStyle:
    """What falls; lengths are multiples of the side of the box it falls through."""

    count: int
    size: tuple[float, float, float]
    """Half extents."""
    fall_m_s: float
    sway: float
    """How far it swings to the sides."""
    swing_hz: float
    turn_hz: float
    """How fast it tumbles."""
    colours: tuple[Colour, ...]
    shape: Shape = Shape.ELLIPSOID


FLAKES: dict[str, FlakeStyle] = {
    "leaves": FlakeStyle(
        150, (0.016, 0.0095, 0.0010), 1.1, 0.035, 0.45, 0.5,
        ((0.60, 0.20, 0.02), (0.68, 0.38, 0.03), (0.42, 0.10, 0.02), (0.35, 0.27, 0.04)),
    ),
    "petals": FlakeStyle(
        160, (0.0085, 0.0062, 0.0008), 0.8, 0.03, 0.5, 0.6, ((0.90, 0.55, 0.62), (0.93, 0.72, 0.76))
    ),
    "confetti": FlakeStyle(
        200, (0.0075, 0.0045, 0.0006), 1.3, 0.02, 0.9, 1.4,
        ((0.75, 0.05, 0.05), (0.06, 0.2, 0.75), (0.85, 0.65, 0.05), (0.1, 0.55, 0.15),
         (0.75, 0.12, 0.55), (0.8, 0.8, 0.8)), Shape.BOX,
    ),
    "feathers": FlakeStyle(
        60, (0.021, 0.0042, 0.0008), 0.5, 0.05, 0.35, 0.3, ((0.88, 0.88, 0.86), (0.75, 0.75, 0.73))
    ),
    "hail": FlakeStyle(
        170, (0.0026, 0.0026, 0.0026), 11.0, 0.0, 0.0, 0.0, ((0.86, 0.89, 0.93),)
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Falling(SolidEffect):
    """Flakes that fall through a box around what the camera looks at, swaying and tumbling."""

    base: Float64Array
    """[3] middle of the bottom of the box, m."""
    extent_m: float
    style: FlakeStyle
    draws: Float64Array
    """[n, 8] in 0..1."""

    @classmethod
    def of(
        cls,
        kind: str,
        base: Float64Array,
        extent_m: float,
        rng: np.random.Generator,
        colour: Colour | None = None,
    ) -> Falling:
        """What falls, of a kind of `FLAKES`, over a square of that side, m."""
        style = FLAKES[kind]
        if colour is not None:
            style = replace(style, colours=(colour,))
        return cls(base, extent_m, style, rng.uniform(size=(style.count, 8)))

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
        half = extent * np.array(style.size) * (0.75 + 0.5 * draws[:, 7:8])
        palette = np.array(style.colours)
        colours = palette[(draws[:, 6] * len(palette)).astype(np.int64)]
        return many_shapes(tumbling(places + self.base, angles, half), style.shape, colours)

"""Lights that go on and off: beacons, turn signals, strings of lights; and bolts of lightning."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.models.effects import LightStyle
from texvent.scenes.scene import LAMP_COLUMNS, Colour, Float64Array, Primitives, Shape
from texvent.scenes.staging.particles.emitter import (
    TINY_M,
    ParticleEffect,
    Source,
    along,
    many_shapes,
)
from texvent.scenes.staging.surroundings.lighting import flash_number, lightning_level

_BULBS, _WINDINGS = 48, 5.5
_BOLTS, _STEPS = 4, 12
"""Bolts, and straight pieces of one."""
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class BodyLights(ParticleEffect):
    """Lights fixed to a body, or around a point, that go on and off."""

    source: Source
    style: LightStyle
    places: Float64Array
    """[n, 3] from the source's point, along its body's axes, m."""
    colours: Float64Array
    """[n, 3]."""
    radius_m: float

    @classmethod
    def of(
        cls, style: LightStyle, source: Source, colour: Colour | None, *, tapers: bool
    ) -> BodyLights:
        """The lights of a body whose lowest point is the source, or of a box in the air.

        All have the colour, None = those of the style; a string winds closer upwards if the body
        tapers.
        """
        extents = source.extents_m
        places = np.array(style.places) * [0.5, 0.5, 1.0] if style.places else _winding(tapers)
        hues = [colour or style.colours[n % len(style.colours)] for n in range(len(places))]
        radius = style.size * float(np.cbrt(extents.prod()))
        return cls(source, style, places * extents, np.array(hues), radius)

    def at(self, time_s: float) -> Primitives:
        """The lights at that instant."""
        maps = np.zeros((len(self.places), 3, 4))
        maps[:, [0, 1, 2], [0, 1, 2]] = self.radius_m
        maps[:, :, 3] = self._places(time_s)
        level = self._level(time_s)
        colours = self.colours * (0.15 + 0.85 * level[:, None])
        return many_shapes(maps, Shape.ELLIPSOID, colours, 0.02 + self.style.glow * level)

    def lamps(self, time_s: float) -> Float64Array:
        """[m, 15] the light they shed."""
        if self.style.intensity <= 0.0:
            return super().lamps(time_s)
        rows = np.zeros((len(self.places), LAMP_COLUMNS))
        rows[:, :3] = self._places(time_s)
        rows[:, 3:6] = self.style.intensity * self._level(time_s)[:, None] * self.colours
        rows[:, 6], rows[:, 10:12] = 12.0 * math.sqrt(self.style.intensity), -2.0
        rows[:, 12], rows[:, 14] = self.radius_m, 1.0
        return rows

    def _level(self, time_s: float) -> Float64Array:
        phases = np.resize(self.style.phases, len(self.places))
        return (np.mod(self.style.blink_hz * time_s + phases, 1.0) < 0.5).astype(np.float64)

    def _places(self, time_s: float) -> Float64Array:
        return self.source.at(np.array([time_s])) + self.places @ self.source.turn(time_s).T


def _winding(tapers: bool) -> Float64Array:
    """[n, 3] a helix around a box, in its extents, from below."""
    share = (np.arange(_BULBS) + 0.5) / _BULBS
    angle = 2.0 * math.pi * _WINDINGS * share
    out = 0.49 * (1.06 - share) if tapers else np.full(_BULBS, 0.54)
    return np.stack([out * np.cos(angle), out * np.sin(angle), 0.16 + 0.8 * share], axis=1)


@dataclass(frozen=True)
class Lightning(ParticleEffect):
    """Bolts in the sky; `lightning.lightning_level` lights the scene with them."""

    bolts: Float64Array
    """[bolts, points, 3] jagged lines from the clouds to the ground, m."""
    thick_m: float

    @classmethod
    def of(
        cls, middle: Float64Array, away: Float64Array, reach_m: float, rng: np.random.Generator
    ) -> Lightning:
        """Bolts behind the point on the ground that the camera looks at from a distance, m."""
        side, tall_m = np.cross(away, _UP), 2.6 * reach_m
        places = 0.9 - 0.6 * np.arange(_BOLTS) + 0.2 * rng.uniform(size=_BOLTS)
        feet = middle + 3.2 * reach_m * away + reach_m * places[:, None] * side
        sway = np.cumsum(rng.uniform(-0.05, 0.05, size=(_BOLTS, _STEPS + 1)), axis=1)
        shape = sway[:, :, None] * side + np.linspace(1.0, 0.0, _STEPS + 1)[:, None] * _UP
        return cls(feet[:, None, :] + tall_m * shape, 0.016 * reach_m)

    def at(self, time_s: float) -> Primitives:
        """All bolts; only that of the present flash is there."""
        level, shown = lightning_level(time_s), flash_number(time_s) % len(self.bolts)
        pieces = np.diff(self.bolts, axis=1)
        half = np.full(pieces.shape, TINY_M)
        if level > 0.02:
            half[shown, :, :2] = self.thick_m * math.sqrt(level)
            half[shown, :, 2] = 0.55 * np.linalg.norm(pieces[shown], axis=1)
        middles = self.bolts[:, :-1] + 0.5 * pieces
        maps = along(middles.reshape(-1, 3), pieces.reshape(-1, 3), half.reshape(-1, 3))
        return many_shapes(maps, Shape.ELLIPSOID, (0.85, 0.9, 1.0), 6.0)

"""Flashes in the sky: bolts of lightning, and fireworks."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import LAMP_COLUMNS, Colour, Float64Array, Primitives, Shape
from texvent.scenes.staging.particles.motion import directions, flight, flight_velocity
from texvent.scenes.staging.particles.shapes import TINY_M, ParticleEffect, along, many_shapes
from texvent.scenes.staging.surroundings.light.lightning import flash_number, lightning_level

_BOLTS = 4
_STEPS = 12
"""Straight pieces of a bolt, without its branch."""
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Lightning(ParticleEffect):
    """Bolts in the sky; `lightning.lightning_level` lights the scene with them."""

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


_COLOURS: tuple[Colour, ...] = (
    (1.0, 0.07, 0.04), (0.10, 0.28, 1.0), (0.10, 0.9, 0.14), (1.0, 0.45, 0.08), (0.85, 0.08, 0.7),
    (1.0, 0.25, 0.35),
)  # fmt: skip
_PERIOD_S, _CLIMB_S, _FADE_S = 2.6, 0.8, 1.7
"""From one shell to the next, and how long it climbs and its stars glow."""
_SHELLS, _LIVES, _STARS = 3, 12, 60
_BRAKE_S = 0.35
"""Time in which drag takes all but 37 % of a star's velocity."""


@dataclass(frozen=True)
class Fireworks(ParticleEffect):
    """Shells that climb, burst into stars, and are followed by others."""

    middle: Float64Array
    """[3] around which they burst, m."""
    size_m: float
    """Radius of a burst, m."""
    draws: Float64Array
    """[shells, lives, 4] in 0..1."""
    stars: Float64Array
    """[n, 3] directions and shares of the radius."""

    @classmethod
    def of(cls, middle: Float64Array, size_m: float, rng: np.random.Generator) -> Fireworks:
        """Three shells at a time."""
        stars = directions(rng.uniform(size=(_STARS, 2)), (0.0, math.pi))
        stars *= rng.uniform(0.85, 1.0, size=(_STARS, 1))
        return cls(middle, size_m, rng.uniform(size=(_SHELLS, _LIVES, 4)), stars)

    def _shell(self, number: int, time_s: float) -> tuple[Float64Array, Colour, float]:
        """Where a shell bursts, its colour, and its age since the burst, s; below 0 it climbs."""
        cycles = time_s / _PERIOD_S + number / _SHELLS + 0.45
        draws = self.draws[number, math.floor(cycles) % _LIVES]
        place = self.middle + self.size_m * (draws[:3] - 0.5) * [4.5, 1.0, 1.3]
        colour = _COLOURS[int(draws[3] * len(_COLOURS))]
        return place, colour, (cycles % 1.0) * _PERIOD_S - _CLIMB_S

    def at(self, time_s: float) -> Primitives:
        """All shells and stars at that instant."""
        maps, colours, glow = [], [], []
        thick, pull = 0.026 * self.size_m, np.array([0.0, 0.0, -0.35 * self.size_m])
        velocity = self.stars * self.size_m / _BRAKE_S
        for number in range(_SHELLS):
            place, colour, age = self._shell(number, time_s)
            left = min(max(-age / _CLIMB_S, 0.0), 1.0)
            climb = place - [0.0, 0.0, 3.2 * self.size_m * left * left]
            rising = thick if age < 0.0 else TINY_M
            maps.append(along(climb[None], _UP[None], rising * np.array([[0.6, 0.6, 2.5]])))
            ages = np.full(_STARS, max(age, 0.0))
            places = place + flight(ages, velocity, _BRAKE_S, pull)
            fade = max(1.0 - age / _FADE_S, 0.0) if age > 0.0 else 0.0
            wide = max(thick * math.sqrt(fade), TINY_M)
            half = np.tile([wide, wide, wide * (1.0 + 2.0 * fade)], (_STARS, 1))
            maps.append(along(places, flight_velocity(ages, velocity, _BRAKE_S, pull), half))
            colours.append(np.tile(colour, (1 + _STARS, 1)))
            glow.append(np.concatenate([[1.5], np.full(_STARS, 0.9 * fade + 1e-3)]))
        return many_shapes(
            np.concatenate(maps), Shape.ELLIPSOID, np.concatenate(colours), np.concatenate(glow)
        )

    def lamps(self, time_s: float) -> Float64Array:
        """[m, 15] the light of each burst."""
        rows = np.zeros((_SHELLS, LAMP_COLUMNS))
        for number, row in enumerate(rows):
            place, colour, age = self._shell(number, time_s)
            level = min(max(age, 0.0) / 0.03, 1.0) * math.exp(-max(age, 0.0) / 0.45)
            row[:3], row[3:6] = place, 0.2 * self.size_m**2 * level * np.array(colour)
            row[6], row[10:12], row[12] = 8.0 * self.size_m, -2.0, self.size_m
        return rows

"""Light that moves or flashes of itself: lightning, stage lights, lasers."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import LAMP_COLUMNS, Colour, Float64Array, Primitives, Shape
from texvent.scenes.staging.particles.shapes import (
    TINY_M,
    PuffEffect,
    SolidEffect,
    along,
    many_shapes,
)
from texvent.scenes.staging.surroundings.light.lamps import haze_rows
from texvent.scenes.staging.surroundings.light.lightning import flash_number, lightning_level

_HUES: tuple[Colour, ...] = ((1.0, 0.12, 0.10), (0.15, 0.35, 1.0), (0.9, 0.15, 0.9),
                             (0.2, 1.0, 0.3))  # fmt: skip
_STEPS = 12
"""Straight pieces of a bolt, without its branch."""
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Lightning(SolidEffect):
    """Bolts in the sky; `lightning.lightning_level` lights the scene with them."""

    bolts: Float64Array
    """[bolts, pieces, 2, 3] ends of their straight pieces, m."""
    thick_m: float

    @classmethod
    def of(
        cls,
        middle: Float64Array,
        away: Float64Array,
        reach_m: float,
        rng: np.random.Generator,
        behind: float = 1.0,
    ) -> Lightning:
        """Four bolts behind what the camera looks at.

        Args:
            middle: [3] on the ground below what the camera looks at, m.
            away: [3] horizontal unit vector away from the camera.
            reach_m: distance of the camera to what it looks at.
            rng: shapes them.
            behind: how far behind it they are, relative to the usual.
        """
        side = np.cross(away, _UP)
        bolts, spread = [], (1.0 + 3.2 * behind) / 4.2
        for number in range(4):
            foot = middle + 3.2 * behind * reach_m * away
            foot = foot + spread * reach_m * (0.9 - 0.6 * number + 0.2 * rng.uniform()) * side
            bolts.append(_bolt(foot, side, 2.6 * reach_m, rng))
        return cls(np.array(bolts), 0.016 * reach_m)

    def at(self, time_s: float) -> Primitives:
        """All bolts; only that of the present flash is there."""
        level = lightning_level(time_s)
        shown = flash_number(time_s) % len(self.bolts)
        maps = []
        for number, pieces in enumerate(self.bolts):
            start, end = pieces[:, 0], pieces[:, 1]
            long = 0.5 * np.linalg.norm(end - start, axis=1)
            is_there = number == shown and level > 0.02
            half = np.full((len(pieces), 3), TINY_M)
            if is_there:
                half[:, :2], half[:, 2] = self.thick_m * math.sqrt(level), 1.1 * long
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
    branch = [points[5]]
    for _ in range(5):
        out = (0.03 + 0.05 * rng.uniform()) * tall_m * side
        branch.append(branch[-1] + out - 0.07 * tall_m * _UP)
    twig = np.array(branch)
    return np.concatenate(
        [np.stack([points[:-1], points[1:]], axis=1), np.stack([twig[:-1], twig[1:]], axis=1)]
    )


@dataclass(frozen=True)
class StageLights(PuffEffect):
    """Spotlights above that sweep over the scene and change their colours."""

    middle: Float64Array
    """[3] on the ground below what the camera looks at, m."""
    side: Float64Array
    """[3] horizontal unit vector to the right in the image."""
    reach_m: float
    colour: Colour | None = None
    """Of all of them; None = they change."""

    COUNT = 4

    def lamps(self, time_s: float) -> Float64Array:
        """[4, 15] their light."""
        return np.array([self._row(number, time_s) for number in range(self.COUNT)])

    def puffs(self, time_s: float) -> Float64Array:
        """Their beams in the haze."""
        rows = [haze_rows(row, 0.62 * self.reach_m, 1.6) for row in self.lamps(time_s)]
        return np.concatenate(rows)

    def _row(self, number: int, time_s: float) -> Float64Array:
        reach, row = self.reach_m, np.zeros(LAMP_COLUMNS)
        share = (number + 0.5) / self.COUNT - 0.5
        place = self.middle + 0.9 * reach * share * self.side + 0.55 * reach * _UP
        swing = 0.30 * math.sin(2.0 * math.pi * (0.45 + 0.13 * number) * time_s + 1.7 * number)
        aim = self.middle + reach * (0.25 * share + swing) * self.side - place
        hue = self.colour or _HUES[(number + math.floor(2.0 * time_s + 0.37 * number)) % len(_HUES)]
        row[:3] = place
        row[3:6] = 1.6 * (0.55 * reach) ** 2 * np.array(hue)
        row[6] = 2.0 * reach
        row[7:10] = aim / np.linalg.norm(aim)
        row[10], row[11], row[12] = math.cos(0.12), math.cos(0.24), 0.02 * reach
        row[14] = 1.0
        return row


@dataclass(frozen=True)
class Lasers(SolidEffect):
    """Fans of thin bright beams that sweep through the air."""

    middle: Float64Array
    """[3] m."""
    side: Float64Array
    """[3] horizontal unit vector to the right in the image."""
    reach_m: float
    colour: Colour | None = None

    FANS, BEAMS = 2, 5

    def at(self, time_s: float) -> Primitives:
        """All beams at that instant."""
        places, ways, colours = [], [], []
        for fan in range(self.FANS):
            way = 1.0 if fan == 0 else -1.0
            root = self.middle - 0.42 * way * self.reach_m * self.side + 0.05 * self.reach_m * _UP
            middle = 0.75 + 0.35 * math.sin(2.0 * math.pi * (0.4 + 0.15 * fan) * time_s + fan)
            for beam in range(self.BEAMS):
                angle = middle + 0.13 * (beam - 0.5 * (self.BEAMS - 1))
                heading = way * math.cos(angle) * self.side + math.sin(angle) * _UP
                ways.append(heading)
                places.append(root + 0.6 * self.reach_m * heading)
                colours.append(self.colour or _HUES[(fan + 3) % len(_HUES)])
        thick = 0.0028 * self.reach_m
        half = np.tile([thick, thick, 0.6 * self.reach_m], (len(places), 1))
        maps = along(np.array(places), np.array(ways), half)
        return many_shapes(maps, Shape.CYLINDER, np.array(colours), 3.0)

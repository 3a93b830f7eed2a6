"""Rain, snow and dust as small shapes whose paths are functions of time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import (
    Float64Array,
    Primitives,
    Shape,
    Texture,
)
from texvent.scenes.staging.trajectories.trajectory import Trajectory

RAIN_DROPS = 130
SNOW_FLAKES = 170
DUST_PUFFS = 44
_DEPTH_BELOW_M = 0.6
"""Drops return to the top when they are this far under the ground, out of sight."""


@dataclass(frozen=True)
class FallingParticles:
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
        return uniform_primitives(maps, self.shape, self.colour)


@dataclass(frozen=True)
class DustTrail:
    """Puffs that a moving object leaves behind: each rises, grows, and is used again."""

    source: Trajectory
    back_m: float
    """From the middle of the object to where the dust rises, m."""
    size_m: float
    seeds: Float64Array
    """[n, 3] in 0..1: sideways, size, and time of birth."""
    life_s: float = 0.9

    def at(self, time_s: float) -> Primitives:
        """All puffs at that instant; one that is just born or about to go has no size."""
        maps = np.zeros((len(self.seeds), 3, 4))
        for row, (side, size, birth) in enumerate(self.seeds):
            age = (time_s / self.life_s + birth) % 1.0
            born = self.source.at(time_s - age * self.life_s)
            place = born.to_world() @ np.array(
                [-self.back_m, 1.1 * self.size_m * (side - 0.5), 0.0, 1.0]
            )
            radius = max(self.size_m * (0.012 + 0.026 * size) * 4.0 * age * (1.0 - age), 1e-4)
            maps[row, :, :3] = radius * np.diag([1.2, 1.2, 0.8])
            place[2] += self.size_m * (0.05 + 0.28 * age * size)
            maps[row, :, 3] = place
        return uniform_primitives(maps, Shape.ELLIPSOID, (0.46, 0.33, 0.20))


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


def make_dust(source: Trajectory, length_m: float, rng: np.random.Generator) -> DustTrail:
    """Dust behind an object of that length, m."""
    return DustTrail(source, 0.45 * length_m, 0.5 * length_m, rng.uniform(size=(DUST_PUFFS, 3)))


def uniform_primitives(
    maps: Float64Array, shape: Shape, colour: tuple[float, float, float]
) -> Primitives:
    """Shapes of one kind and colour, scenery without an id."""
    count = len(maps)
    return Primitives(
        shape=np.full(count, shape, dtype=np.int8),
        to_world=maps,
        colour=np.tile(np.array(colour, dtype=np.float32), (count, 1)),
        second_colour=np.zeros((count, 3), dtype=np.float32),
        texture=np.full(count, Texture.PLAIN, dtype=np.int8),
        texture_scale=np.ones(count, dtype=np.float32),
        emission=np.zeros(count, dtype=np.float32),
        instance=np.zeros(count, dtype=np.int32),
    )


def _scatter(
    count: int, extent_m: float, height_m: float, rng: np.random.Generator
) -> Float64Array:
    low = np.array([-0.5 * extent_m, -0.5 * extent_m, 0.0])
    high = np.array([0.5 * extent_m, 0.5 * extent_m, height_m])
    return np.asarray(rng.uniform(low, high, size=(count, 3)))

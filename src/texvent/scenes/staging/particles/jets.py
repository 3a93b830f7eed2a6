"""Sparks, embers, bubbles, fountains, spray and poured water: streams of small solid bodies."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from texvent.scenes.scene import Colour, Float64Array, Primitives, Shape
from texvent.scenes.staging.particles.motion import (
    GRAVITY,
    Lives,
    Source,
    directions,
    flight,
    flight_velocity,
    turbulence,
)
from texvent.scenes.staging.particles.shapes import TINY_M, SolidEffect, along, many_shapes

WATER: Colour = (0.62, 0.74, 0.82)


@dataclass(frozen=True)
class JetStyle:
    """What a stream looks like.

    Lengths are multiples of the source's size s, speeds of √(g·s), times of √(s / g).
    """

    count: int
    life: float
    speed: float
    spread_rad: float
    """Half angle of the cone it fills."""
    radius: float
    """Of one body."""
    colours: tuple[Colour, ...]
    gravity: float = 1.0
    """Share of gravity that acts; below 0 it rises."""
    drag: float = math.inf
    stretch: float = 1.0
    """Length along its flight by its width."""
    emission: float = 0.0
    aim: tuple[float, float, float] = (0.0, 0.0, 1.0)
    """Middle of the cone."""
    curl: float = 0.0
    grows: bool = False
    """Whether bodies grow all their life, as bubbles do, rather than shrink at its end."""
    area: float = 0.02


JETS: dict[str, JetStyle] = {
    "sparks": JetStyle(
        110, 2.2, 1.5, 0.6, 0.008, ((1.0, 0.42, 0.06), (1.0, 0.28, 0.03), (1.0, 0.62, 0.22)), 0.6,
        2.0, 6.0, 2.2, (0.75, -0.25, 0.6),
    ),
    "embers": JetStyle(
        40, 8.0, 0.5, 0.6, 0.014, ((1.0, 0.22, 0.02), (1.0, 0.36, 0.05)), -0.12, 2.0, 1.0, 2.2,
        curl=0.6, area=0.3,
    ),
    "fountain": JetStyle(280, 2.9, 1.42, 0.14, 0.010, (WATER, (0.8, 0.87, 0.92)), stretch=1.8),
    "pour": JetStyle(
        110, 1.9, 0.25, 0.05, 0.05, (WATER, (0.75, 0.84, 0.9)), stretch=1.6, aim=(1.0, 0.0, 0.1),
    ),
    "spray": JetStyle(
        140, 1.5, 1.7, 0.28, 0.012, (WATER, (0.85, 0.9, 0.94)), drag=2.0, stretch=1.6,
        aim=(1.0, 0.0, 0.45),
    ),
    "popcorn": JetStyle(
        46, 2.4, 1.35, 0.30, 0.055, ((0.92, 0.88, 0.74), (0.85, 0.72, 0.40)), area=0.35,
    ),
    "bubbles": JetStyle(
        34, 9.0, 0.3, 0.6, 0.07, ((0.75, 0.88, 0.95), (0.9, 0.85, 0.95)), -0.03, 2.0, curl=0.5,
        grows=True, area=0.25,
    ),
}  # fmt: skip


BREATHED = frozenset({"bubbles", "smoke", "steam"})
"""Effects that come from the mouth of a person."""
BLOWN: dict[str, Any] = {
    "aim": (1.0, 0.0, 0.2), "speed": 1.0, "drag": 6.0, "spread_rad": 0.3, "area": 0.02,
    "radius": 0.12, "count": 24,
}  # fmt: skip
"""`JetStyle` of bubbles that a person blows, where it differs."""


@dataclass(frozen=True)
class Jet(SolidEffect):
    """Bodies that leave a source one after the other and fly until they are gone."""

    source: Source
    style: JetStyle
    lives: Lives
    start_s: float = -math.inf
    end_s: float = math.inf

    @classmethod
    def of(
        cls,
        kind: str,
        source: Source,
        rng: np.random.Generator,
        *,
        colour: Colour | None = None,
        start_s: float | None = None,
    ) -> Jet:
        """A stream of a kind of `JETS`; `colour` replaces its colours."""
        style = JETS[kind]
        if colour is not None:
            style = replace(style, colours=(colour,))
        life = style.life * math.sqrt(source.size_m / GRAVITY)
        start = -math.inf if start_s is None else start_s
        return cls(source, style, Lives.of(style.count, life, rng), start)

    def until_ground(self) -> Jet:
        """The same stream whose bodies live until they reach the ground."""
        height = max(float(self.source.at(np.zeros(1))[0, 2]), 0.02)
        life = 1.1 * math.sqrt(2.0 * height / GRAVITY)
        return replace(self, lives=replace(self.lives, life_s=life))

    def at(self, time_s: float) -> Primitives:
        """Its bodies at that instant."""
        style, size = self.style, self.source.size_m
        age, draws = self.lives.at(time_s)
        unit_s, unit_m_s = math.sqrt(size / GRAVITY), math.sqrt(size * GRAVITY)
        age_s = age * self.lives.life_s
        born = self.source.at(time_s - age_s)
        born[:, :2] += style.area * size * (2.0 * draws[:, 3:5] - 1.0)
        aimed = _aimed(directions(draws, style.spread_rad), style.aim) @ self.source.turn(time_s).T
        velocity = style.speed * unit_m_s * (0.8 + 0.4 * draws[:, 2:3]) * aimed
        pull = np.array([0.0, 0.0, -style.gravity * GRAVITY])
        drag_s = style.drag * unit_s
        places = born + flight(age_s, velocity, drag_s, pull)
        if style.curl:
            eddies = turbulence(places + 9.0 * size * draws[:, 4:5], time_s, size, 0.3 / unit_s)
            places += style.curl * size * age[:, None] * eddies
        share = np.minimum(1.0, 12.0 * age)
        share = share * (0.4 + 0.6 * age) if style.grows else share
        share = share * np.clip(6.0 * (1.0 - age), 0.0, 1.0)
        born_s = time_s - age_s
        share *= (
            (born_s >= self.start_s)
            & (born_s <= self.end_s)
            & (places[:, 2] > -style.radius * size)
        )
        radius = np.maximum(style.radius * size * (0.7 + 0.6 * draws[:, 5]) * share, TINY_M)
        half = radius[:, None] * [1.0, 1.0, style.stretch]
        heading = flight_velocity(age_s, velocity, drag_s, pull)
        palette = np.array(style.colours)
        colours = palette[(draws[:, 6] * len(palette)).astype(np.int64)]
        glow = style.emission * (1.0 - 0.8 * age)
        return many_shapes(along(places, heading, half), Shape.ELLIPSOID, colours, glow)


def _aimed(upward: Float64Array, aim: tuple[float, float, float]) -> Float64Array:
    """Directions around straight up, turned to be around `aim`."""
    z = np.array(aim) / np.linalg.norm(aim)
    helper = np.array([0.0, 1.0, 0.0])
    x = np.cross(helper, z)
    x /= np.linalg.norm(x)
    return np.asarray(upward @ np.stack([x, np.cross(z, x), z]))


@dataclass(frozen=True)
class Dripping(SolidEffect):
    """Drops that swell on a source, fall, and splash where they hit the ground."""

    source: Source
    height_m: float
    """From the source to where they hit, m."""
    period_s: float
    draws: Float64Array
    """[drops, splinters, 3] in 0..1."""
    colour: Colour
    drop: float = 0.10
    """Radius of a drop, in sizes of the source."""

    @classmethod
    def of(
        cls, source: Source, height_m: float, rng: np.random.Generator, colour: Colour = WATER
    ) -> Dripping:
        """A drop falls about as often as one needs to fall."""
        fall_s = math.sqrt(2.0 * max(height_m, 0.01) / GRAVITY)
        return cls(source, height_m, max(0.9 * fall_s, 0.25), rng.uniform(size=(4, 7, 3)), colour)

    def at(self, time_s: float) -> Primitives:
        """All drops and what splashes off them at that instant."""
        drops, splinters, _ = self.draws.shape
        size = self.drop * self.source.size_m
        fall_s = math.sqrt(2.0 * max(self.height_m, 0.01) / GRAVITY)
        cycle = drops * self.period_s
        age = np.mod(time_s + self.period_s * np.arange(drops), cycle) - 0.6 * self.period_s
        falling = np.clip(age, 0.0, fall_s)
        origin = self.source.at(time_s - np.maximum(age, 0.0))
        places = origin - [0.0, 0.0, 1.0] * (0.5 * GRAVITY * falling**2)[:, None]
        grown = np.clip(1.0 + age / (0.6 * self.period_s), 0.0, 1.0)
        radius = np.where(age < fall_s, size * np.cbrt(grown), TINY_M)
        slim = 1.0 + 0.25 * np.clip(age / 0.1, 0.0, 1.0)
        half = np.maximum(radius, TINY_M)[:, None] * np.stack([1 / slim, 1 / slim, slim], axis=1)
        maps = [along(places, np.tile([0.0, 0.0, 1.0], (drops, 1)), half)]
        after = age - fall_s
        speed = 0.45 * math.sqrt(2.0 * GRAVITY * max(self.height_m, 0.01))
        for number in range(splinters):
            u = self.draws[:, number]
            turn = 2.0 * math.pi * (number + 0.6 * u[:, 0]) / splinters
            flat = speed * (0.3 + 0.4 * u[:, 1])
            velocity = np.stack(
                [flat * np.cos(turn), flat * np.sin(turn), speed * (0.5 + 0.5 * u[:, 2])], axis=1
            )
            landed_s = 2.0 * velocity[:, 2] / GRAVITY
            in_air = np.clip(after, 0.0, landed_s)
            way = flight(in_air, velocity, math.inf, np.array([0.0, 0.0, -GRAVITY]))
            floor = origin - [0.0, 0.0, self.height_m]
            seen = (after > 0.0) & (after < landed_s)
            small = np.where(seen, 0.38 * size, TINY_M)
            maps.append(along(floor + way, velocity, np.tile(small[:, None], (1, 3))))
        return many_shapes(np.concatenate(maps), Shape.ELLIPSOID, self.colour)

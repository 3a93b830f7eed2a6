"""What happens once: things break, burst and explode; water splashes; fireworks."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import LAMP_COLUMNS, Colour, Float64Array, Primitives, Shape
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.particles.motion import (
    GRAVITY,
    directions,
    flight,
    flight_velocity,
    turbulence,
)
from texvent.scenes.staging.particles.shapes import (
    TINY_M,
    PuffEffect,
    SolidEffect,
    along,
    many_shapes,
    puff_rows,
    tumbling,
)

PIECES = 56
_DOWN = np.array([0.0, 0.0, -GRAVITY])
_SPEEDS = {"break": 0.45, "burst": 1.5, "explode": 2.4}
"""How fast pieces leave, in √(g · size)."""


@dataclass(frozen=True)
class Pieces(SolidEffect):
    """The pieces of an object that breaks, bursts or explodes; they fly, fall and lie."""

    actor: Actor
    kind: str
    start_s: float
    draws: Float64Array
    """[n, 9] in 0..1."""
    colours: Float64Array
    """[n, 3] linear RGB."""
    floor_m: float
    """Height that pieces come to rest at; -inf: they fall on."""

    @classmethod
    def of(
        cls, actor: Actor, kind: str, start_s: float, rng: np.random.Generator, floor_m: float
    ) -> Pieces:
        """Pieces in the colours of the object's largest parts."""
        parts = sorted(
            actor.place(0.0).parts, key=lambda part: -abs(np.linalg.det(part.to_body[:, :3]))
        )[:6]
        palette = np.array([part.colour for part in parts])
        volume = np.array([abs(np.linalg.det(part.to_body[:, :3])) for part in parts])
        share = np.cbrt(volume) ** 2 / (np.cbrt(volume) ** 2).sum()
        colours = palette[rng.choice(len(palette), size=PIECES, p=share)]
        return cls(actor, kind, start_s, rng.uniform(size=(PIECES, 9)), colours, floor_m)

    def at(self, time_s: float) -> Primitives:
        """All pieces at that instant; before the start they are too small to be seen."""
        model, draws = self.actor.model, self.draws
        extents = np.array([model.length, model.width, model.height])
        size = float(np.cbrt(extents.prod()))
        state = self.actor.trajectory.at(min(time_s, self.start_s)).to_world()
        body = (draws[:, :3] - 0.5) * 0.8 * extents
        body[:, 2] += 0.0 if self.actor.is_centred else 0.5 * extents[2]
        start = body @ state[:, :3].T + state[:, 3]
        middle = self.actor.middle(min(time_s, self.start_s))
        if time_s < self.start_s:
            maps = along(start, start - middle, np.full((PIECES, 3), TINY_M))
            return many_shapes(maps, Shape.BOX, self.colours)
        before = self.actor.middle(self.start_s - 5e-3)
        carried = (middle - before) / 5e-3
        if before[2] > middle[2] and middle[2] - 0.6 * extents[2] < self.floor_m:
            carried[2] *= -0.25  # it has just hit the ground
        age = time_s - self.start_s
        velocity = self._velocities(start - middle, size) + 0.6 * carried
        half = size * (0.05 + 0.10 * draws[:, 3:4]) * self._slimness()
        landed = self._landing(start[:, 2] - half.min(axis=1), velocity[:, 2])
        flown = np.minimum(age, landed)
        places = start + flight(flown, velocity, math.inf, _DOWN)
        spin = (draws[:, 4:7] - 0.5) * 22.0 * math.sqrt(GRAVITY / max(size, 0.02)) * 0.3
        angles = 6.0 * draws[:, 4:7] + spin * flown[:, None]
        shape = Shape.ELLIPSOID if self.kind == "burst" else Shape.BOX
        return many_shapes(tumbling(places, angles, half), shape, self.colours)

    def _velocities(self, away: Float64Array, size: float) -> Float64Array:
        out = away / np.maximum(np.linalg.norm(away, axis=1, keepdims=True), 1e-9)
        speed = _SPEEDS[self.kind] * math.sqrt(GRAVITY * size)
        lift = np.array([0.0, 0.0, 0.4 * speed])
        return np.asarray(speed * (0.4 + 0.9 * self.draws[:, 7:8]) * out + lift)

    def _slimness(self) -> Float64Array:
        """Half extents of pieces by their size: chips, flaps or lumps."""
        return np.array({"break": (1.0, 0.7, 0.25), "burst": (1.0, 0.7, 0.06)}.get(
            self.kind, (1.0, 0.8, 0.5)
        ))  # fmt: skip

    def _landing(self, above: Float64Array, upward: Float64Array) -> Float64Array:
        """When each piece comes to rest on the ground, s after the start."""
        if math.isinf(self.floor_m):
            return np.full(len(above), np.inf)
        fall = np.maximum(above - self.floor_m, 0.0)
        return np.asarray((upward + np.sqrt(upward**2 + 2.0 * GRAVITY * fall)) / GRAVITY)


@dataclass(frozen=True)
class Fireball(PuffEffect):
    """A flash that swells, cools into dark smoke and drifts off."""

    middle: Float64Array
    """[3] m."""
    size_m: float
    start_s: float
    draws: Float64Array
    """[n, 6] in 0..1."""

    @classmethod
    def of(
        cls, middle: Float64Array, size_m: float, start_s: float, rng: np.random.Generator
    ) -> Fireball:
        """An explosion of that size."""
        return cls(middle, size_m, start_s, rng.uniform(size=(40, 6)))

    def puffs(self, time_s: float) -> Float64Array:
        """[k, 19] its puffs at that instant."""
        age, size, draws = time_s - self.start_s, self.size_m, self.draws
        unit_s = math.sqrt(size / GRAVITY)
        if age <= 0.0:
            return puff_rows(
                np.tile(self.middle, (len(draws), 1)), np.full((len(draws), 3), TINY_M),
                (0.0, 0.0, 0.0), np.zeros(len(draws)),
            )  # fmt: skip
        swollen = 1.0 - math.exp(-age / (0.25 * unit_s))
        out = directions(draws, math.pi) * (0.2 + 0.8 * draws[:, 2:3])
        places = self.middle + 1.1 * size * swollen * out
        places[:, 2] += 0.55 * size * age / unit_s * (0.6 + 0.8 * draws[:, 3])
        places += 0.3 * size * swollen * turbulence(places, time_s, size, 0.2 / unit_s)
        radius = size * (0.15 + 0.5 * swollen + 0.12 * age / unit_s) * (0.7 + 0.6 * draws[:, 4])
        heat = math.exp(-age / (0.55 * unit_s))
        hot, cold = np.array([1.0, 0.45, 0.08]), np.array([0.10, 0.09, 0.085])
        colours = cold + (hot - cold) * min(1.0, 1.6 * heat * heat)
        thick = 2.4 * min(1.0, age / 0.03) * math.exp(-age / (4.0 * unit_s))
        glow = 7.0 * heat**1.5
        return puff_rows(
            places, np.tile(radius[:, None], (1, 3)), tuple(colours),
            np.full(len(draws), thick), emission=glow, detail=0.8,
            seeds=50.0 * draws[:, 5],
        )  # fmt: skip

    def lamps(self, time_s: float) -> Float64Array:
        """[1, 15] its flash."""
        age, size = time_s - self.start_s, self.size_m
        row = np.zeros((1, LAMP_COLUMNS))
        rise = min(max(age, 0.0) / 0.02, 1.0)
        level = rise * math.exp(-max(age, 0.0) / (0.35 * math.sqrt(size / GRAVITY)))
        row[0, :3] = self.middle + np.array([0.0, 0.0, 0.5 * size])
        row[0, 3:6] = 30.0 * size * size * level * np.array([1.0, 0.62, 0.28])
        row[0, 6], row[0, 10:12], row[0, 12] = 30.0 * size, -2.0, size
        return row


@dataclass(frozen=True)
class Splash(SolidEffect):
    """A crown of drops, a jet that rises after it, and a ring that runs away over the water."""

    middle: Float64Array
    """[3] where it happens, on the surface, m."""
    size_m: float
    start_s: float
    draws: Float64Array
    """[n, 4] in 0..1."""
    colour: Colour

    _RING = 44
    _COLUMN = 7

    @classmethod
    def of(
        cls, middle: Float64Array, size_m: float, start_s: float, rng: np.random.Generator,
        colour: Colour,
    ) -> Splash:  # fmt: skip
        """A splash as wide as what falls in."""
        return cls(middle, size_m, start_s, rng.uniform(size=(150, 4)), colour)

    def at(self, time_s: float) -> Primitives:
        """All its drops at that instant."""
        age = max(time_s - self.start_s, 0.0)
        size, draws = self.size_m, self.draws
        unit_m_s, unit_s = math.sqrt(GRAVITY * size), math.sqrt(size / GRAVITY)
        turn = 2.0 * math.pi * draws[:, 0]
        flat, up = 0.35 + 0.75 * draws[:, 1], 1.0 + 1.5 * draws[:, 2]
        velocity = unit_m_s * np.stack([flat * np.cos(turn), flat * np.sin(turn), up], axis=1)
        rim = 0.5 * size * np.stack([np.cos(turn), np.sin(turn), np.zeros_like(turn)], axis=1)
        ages = np.full(len(draws), age)
        places = self.middle + rim + flight(ages, velocity, math.inf, _DOWN)
        radius = size * (0.014 + 0.034 * draws[:, 3] ** 2) * min(1.0, age / 0.02)
        radius = np.where(places[:, 2] > self.middle[2] - radius, radius, 0.0)
        heading = flight_velocity(ages, velocity, math.inf, _DOWN)
        half = np.maximum(radius, TINY_M)[:, None] * [1.0, 1.0, 1.6]
        maps = [along(places, heading, half), self._ring(age, unit_s), self._column(age, unit_s)]
        return many_shapes(np.concatenate(maps), Shape.ELLIPSOID, self.colour)

    def _ring(self, age: float, unit_s: float) -> Float64Array:
        """A low wall of water that runs outwards and sinks."""
        turn = 2.0 * math.pi * np.arange(self._RING) / self._RING
        out = self.size_m * (0.5 + 0.9 * age / unit_s)
        heading = np.stack([-np.sin(turn), np.cos(turn), np.zeros_like(turn)], axis=1)
        places = self.middle + out * np.stack([np.cos(turn), np.sin(turn), 0.0 * turn], axis=1)
        level = min(1.0, age / 0.03) * math.exp(-age / (0.9 * unit_s))
        length = 1.1 * math.pi * out / self._RING
        half = np.maximum([0.02 * self.size_m * level, 0.07 * self.size_m * level, length], TINY_M)
        if level == 0.0:
            half[2] = TINY_M
        return along(places, heading, np.tile(half, (self._RING, 1)))

    def _column(self, age: float, unit_s: float) -> Float64Array:
        """The jet that rises in the middle once the hole has closed."""
        phase = np.clip((age / unit_s - 0.5) / 2.2, 0.0, 1.0)
        height = self.size_m * 1.5 * math.sin(math.pi * phase)
        share = (np.arange(self._COLUMN) + 0.5) / self._COLUMN
        places = self.middle + np.outer(share * height, [0.0, 0.0, 1.0])
        width = 0.12 * self.size_m * (1.2 - share) * math.sin(math.pi * phase)
        half = np.stack([width, width, 0.6 * height / self._COLUMN + 0.0 * share], axis=1)
        up = np.tile([0.0, 0.0, 1.0], (self._COLUMN, 1))
        return along(places, up, np.maximum(half, TINY_M))


_FIREWORK_COLOURS: tuple[Colour, ...] = (
    (1.0, 0.07, 0.04), (0.10, 0.28, 1.0), (0.10, 0.9, 0.14), (1.0, 0.45, 0.08), (0.85, 0.08, 0.7),
    (1.0, 0.25, 0.35),
)  # fmt: skip


@dataclass(frozen=True)
class Fireworks:
    """Shells that climb, burst into stars, and are followed by others."""

    middle: Float64Array
    """[3] around which they burst, m."""
    size_m: float
    """Radius of a burst, m."""
    draws: Float64Array
    """[shells, lives, 6] in 0..1."""
    stars: Float64Array
    """[n, 3] unit vectors."""

    PERIOD_S = 2.6
    _CLIMB_S = 0.8

    @classmethod
    def of(cls, middle: Float64Array, size_m: float, rng: np.random.Generator) -> Fireworks:
        """Three shells at a time, of 60 stars each."""
        stars = directions(rng.uniform(size=(60, 2)), math.pi)
        stars *= rng.uniform(0.85, 1.0, size=(60, 1))
        return cls(middle, size_m, rng.uniform(size=(3, 12, 6)), stars)

    def _shell(self, number: int, time_s: float) -> tuple[Float64Array, Colour, float]:
        """Where a shell bursts, its colour, and the time since it started to climb, s."""
        shells, lives, _ = self.draws.shape
        cycles = time_s / self.PERIOD_S + number / shells + 0.45
        draws = self.draws[number, math.floor(cycles) % lives]
        place = self.middle + self.size_m * (draws[:3] - 0.5) * [4.5, 1.0, 1.3]
        hue = int(draws[3] * len(_FIREWORK_COLOURS)) + 2 * number
        colour = _FIREWORK_COLOURS[hue % len(_FIREWORK_COLOURS)]
        return place, colour, (cycles % 1.0) * self.PERIOD_S

    def at(self, time_s: float) -> Primitives:
        """All stars at that instant."""
        maps, colours, glow = [], [], []
        thick = 0.026 * self.size_m
        for number in range(len(self.draws)):
            place, colour, since = self._shell(number, time_s)
            age = since - self._CLIMB_S
            left = 1.0 - min(max(since / self._CLIMB_S, 0.0), 1.0)
            climb = place - [0.0, 0.0, 3.2 * self.size_m * left * left]
            rising = thick if age < 0.0 else TINY_M
            maps.append(along(climb[None], np.array([[0.0, 0.0, 1.0]]),
                              np.array([[0.6 * rising, 0.6 * rising, 2.5 * rising]])))  # fmt: skip
            ages = np.full(len(self.stars), max(age, 0.0))
            pull = np.array([0.0, 0.0, -0.35 * self.size_m])
            velocity = self.stars * self.size_m / 0.35
            places = place + flight(ages, velocity, 0.35, pull)
            heading = flight_velocity(ages, velocity, 0.35, pull)
            fade = max(1.0 - age / 1.7, 0.0) if age > 0.0 else 0.0
            wide = max(thick * math.sqrt(fade), TINY_M)
            half = np.tile([wide, wide, wide * (1.0 + 2.0 * fade)], (len(ages), 1))
            maps.append(along(places, heading, half))
            colours.append(np.tile(colour, (1 + len(ages), 1)))
            glow.append(np.concatenate([[1.5], np.full(len(ages), 0.9 * fade + 1e-3)]))
        return many_shapes(
            np.concatenate(maps), Shape.ELLIPSOID, np.concatenate(colours), np.concatenate(glow)
        )

    def puffs(self, time_s: float) -> Float64Array:
        """No puffs."""
        return SolidEffect().puffs(time_s)

    def lamps(self, time_s: float) -> Float64Array:
        """[m, 15] the light of each burst."""
        rows = np.zeros((len(self.draws), LAMP_COLUMNS))
        for number, row in enumerate(rows):
            place, colour, since = self._shell(number, time_s)
            age = since - self._CLIMB_S
            level = min(max(age, 0.0) / 0.03, 1.0) * math.exp(-max(age, 0.0) / 0.45)
            row[:3], row[3:6] = place, 0.2 * self.size_m**2 * level * np.array(colour)
            row[6], row[10:12], row[12] = 8.0 * self.size_m, -2.0, self.size_m
        return rows

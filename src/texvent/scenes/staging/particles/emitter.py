"""Emitter: particles that leave a source, fly, and are gone; smoke, sparks, drops and pieces."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.models.effects import EmitterStyle
from texvent.scenes.scene import LAMP_COLUMNS, Colour, Float64Array, Primitives, Shape
from texvent.scenes.staging.particles.motion import (
    GRAVITY,
    Lives,
    Source,
    aimed,
    directions,
    flight,
    flight_velocity,
    turbulence,
)
from texvent.scenes.staging.particles.shapes import (
    TINY_M,
    ParticleEffect,
    along,
    many_shapes,
    puff_rows,
    tumbling,
)
from texvent.scenes.staging.surroundings.lighting import wave_level

_FLAME_HZ = 6.0
_FLAME_LIGHT = np.array([1.0, 0.5, 0.16])
_EDDY, _EDDY_HZ = 1.6, 0.16
"""Size and rate of eddies, in units of an effect."""
_INHERITED = 0.6
"""Share of the object's velocity that its pieces keep."""
_LONG_S = 1e4
"""Life of what has no end."""


class _Flown(NamedTuple):
    """Particles at an instant."""

    places: Float64Array
    """[n, 3] m."""
    heading: Float64Array
    """[n, 3] velocities, m/s."""
    age: Float64Array
    """[n] share of their lives, 0..1."""
    age_s: Float64Array
    """[n] how long they have flown, s."""
    draws: Float64Array
    """[n, 8] in 0..1."""
    is_there: NDArray[np.bool_]
    """[n]."""


@dataclass(frozen=True)
class Emitter(ParticleEffect):
    """Particles of a style from a source."""

    source: Source
    style: EmitterStyle
    lives: Lives
    colours: Float64Array
    """[k, 3] linear RGB."""
    start_s: float = -math.inf
    """When the first one is born, s."""
    floor_m: float = -math.inf
    """Height of the ground, m; -inf = none."""

    @classmethod
    def of(
        cls,
        style: EmitterStyle,
        source: Source,
        rng: np.random.Generator,
        *,
        colour: Colour | None = None,
        start_s: float | None = None,
        is_once: bool = False,
        floor_m: float = -math.inf,
    ) -> Emitter:
        """An emitter.

        Args:
            style: how its particles look and fly.
            source: where they come from.
            rng: tells one from the other.
            colour: of all, where the scene says one.
            start_s: when it begins, s; None = long ago.
            is_once: whether all of them leave at that instant.
            floor_m: height of the ground, m.
        """
        life_s = style.life * math.sqrt(source.size_m / GRAVITY) or _LONG_S
        if style.until_ground:
            height = float(source.at(np.zeros(1))[0, 2])
            height = max(height, 0.02) if math.isfinite(floor_m) else 3.0 * source.size_m
            life_s = 1.1 * math.sqrt(2.0 * height / GRAVITY)
        lives = Lives.of(style.count, life_s, rng, start_s if is_once else None, style.salvo)
        colours = np.array(style.colours)
        if colour is not None and not style.keeps_colour:
            colours = np.array([colour])
        elif not len(colours):
            colours = _colours_of(source, style.count, rng)
        start = -math.inf if start_s is None else start_s
        return cls(source, style, lives, colours, start, floor_m)

    def at(self, time_s: float) -> Primitives:
        """Its drops or chips at that instant."""
        style = self.style
        if style.body == "puff":
            return super().at(time_s)
        flown = self._fly(time_s)
        grown = _between(style.radius, flown.age) * (0.7 + 0.6 * flown.draws[:, 5])
        if style.body == "drop":
            grown *= np.clip(12.0 * flown.age, 0.0, 1.0) * np.clip(
                6.0 * (1.0 - flown.age), 0.0, 1.0
            )
        half = np.where(flown.is_there, self.source.size_m * grown, TINY_M)[:, None]
        half = np.maximum(half * style.proportions, TINY_M)
        which = (flown.draws[:, 6] * len(self.colours)).astype(np.int64)
        glow = _between(style.emission, flown.age)
        if style.body == "drop":
            maps = along(flown.places, flown.heading, half)
            return many_shapes(maps, Shape.ELLIPSOID, self.colours[which], glow)
        rate = style.turns * math.sqrt(GRAVITY / max(self.source.size_m, 0.02))
        angles = flown.draws[:, :3] * 6.0 + 6.6 * (flown.draws[:, :3] - 0.5) * (
            rate * flown.age_s[:, None]
        )
        return many_shapes(tumbling(flown.places, angles, half), Shape.BOX, self.colours[which])

    def puffs(self, time_s: float) -> Float64Array:
        """[k, 19] its puffs at that instant; those just born or about to go are thin."""
        style = self.style
        if style.body != "puff":
            return super().puffs(time_s)
        flown = self._fly(time_s)
        age, draws = flown.age, flown.draws
        radius = self.source.size_m * _between(style.radius, age) * (0.75 + 0.5 * draws[:, 5])
        first, last = self.colours[0], self.colours[-1]
        colours = (first + (last - first) * age[:, None]) * (0.72 + 0.56 * draws[:, 6:7])
        thick = _between(style.thickness, age) * (0.4 + 1.2 * draws[:, 5])
        return puff_rows(
            flown.places, radius[:, None] * style.proportions, colours,
            thick * _fade(age) * flown.is_there, emission=_between(style.emission, age),
            detail=style.detail, seeds=50.0 * draws[:, 6],
        )  # fmt: skip

    def lamps(self, time_s: float) -> Float64Array:
        """[m, 15] the light of its flames, or of its flash."""
        style, size = self.style, self.source.size_m
        if style.light == 0.0 or (time_s < self.start_s and self.lives.once_at_s is None):
            return super().lamps(time_s)
        row = np.zeros((1, LAMP_COLUMNS))
        row[0, :3] = self.source.at(np.array([time_s]))[0] + [0.0, 0.0, 0.6 * size]
        level, hue = wave_level("flame", _FLAME_HZ * time_s, phase=0.37), _FLAME_LIGHT
        if self.lives.once_at_s is not None or style.salvo is not None:
            age, draws = self.lives.at(time_s)
            age_s = max(float(age[0]), 0.0) * self.lives.life_s
            level = min(age_s / 0.02, 1.0) * math.exp(-age_s / (0.35 * math.sqrt(size / GRAVITY)))
            if style.salvo is not None:
                row[0, :3] += self._offsets(draws)[0]
                hue = self.colours[int(draws[0, 6] * len(self.colours))]
        row[0, 3:6] = level * style.light * size * size * hue
        row[0, 6], row[0, 10:12], row[0, 12] = 12.0 * size, -2.0, 0.4 * size
        return row

    def _fly(self, time_s: float) -> _Flown:
        """All particles at an instant."""
        style, size = self.style, self.source.size_m
        unit_s, unit_m_s = math.sqrt(size / GRAVITY), math.sqrt(size * GRAVITY)
        age, draws = self.lives.at(time_s)
        is_there = (age >= 0.0) & (age <= 1.0)
        age = np.clip(age, 0.0, 1.0)
        age_s = age * self.lives.life_s
        once_at_s = self.lives.once_at_s
        born_s = time_s - age_s if once_at_s is None else np.full(len(age), once_at_s)
        is_there &= born_s >= self.start_s
        turn = self.source.turn(time_s if once_at_s is None else once_at_s)
        offset = self._offsets(draws) @ turn.T
        velocity = self._headings(draws, offset, turn)
        velocity *= style.speed * unit_m_s * (0.8 + 0.4 * draws[:, 2:3])
        velocity[:, 2] += style.lift * style.speed * unit_m_s
        if once_at_s is not None:
            velocity += _INHERITED * self.source.velocity(once_at_s)
        pull = GRAVITY * np.array([style.wind, 0.0, -style.gravity])
        drag_s = math.inf if style.drag is None else style.drag * unit_s
        start = self.source.at(born_s) + offset
        flown_s = age_s
        if style.body == "chip":
            flown_s = np.minimum(age_s, self._landing_s(start[:, 2], velocity[:, 2]))
        places = start + flight(flown_s, velocity, drag_s, pull)
        if style.curl:
            apart = 9.0 * size * draws[:, 4:5] * (style.body != "puff")
            eddies = turbulence(places + apart, time_s, _EDDY * size, _EDDY_HZ / unit_s)
            places += style.curl * size * age[:, None] * eddies
        if style.body == "drop":
            is_there &= places[:, 2] > self.floor_m - style.radius[1] * size
        heading = flight_velocity(flown_s, velocity, drag_s, pull)
        return _Flown(places, heading, age, flown_s, draws, is_there)

    def _offsets(self, draws: Float64Array) -> Float64Array:
        """[n, 3] from the source's point to where particles start, in its body's axes, m."""
        style = self.style
        if style.fills is not None:
            return (draws[:, 3:6] - 0.5) * self.source.extents_m * style.fills
        around, out = 2.0 * math.pi * draws[:, 3], style.area * np.sqrt(draws[:, 4])
        spot = np.stack([out * np.cos(around), out * np.sin(around), 0.0 * out], axis=1)
        return self.source.size_m * spot

    def _headings(
        self, draws: Float64Array, offset: Float64Array, turn: Float64Array
    ) -> Float64Array:
        """[n, 3] unit vectors in which particles leave."""
        style = self.style
        if style.body == "chip" and style.fills is not None and style.fills[2] > 0.0:
            return np.asarray(
                offset / np.maximum(np.linalg.norm(offset, axis=1, keepdims=True), 1e-9)
            )
        return aimed(directions(draws, style.spread_rad), style.aim) @ turn.T

    def _landing_s(self, above: Float64Array, upward: Float64Array) -> Float64Array:
        """[n] when chips come to rest on the ground, s after their birth."""
        fall = np.maximum(above - self.floor_m - 0.03 * self.source.size_m, 0.0)
        pull = GRAVITY * self.style.gravity
        if pull > 0.0:
            return np.asarray((upward + np.sqrt(upward**2 + 2.0 * pull * fall)) / pull)
        return np.asarray(fall / np.maximum(-upward, 1e-6))


def _between(ends: tuple[float, float], age: Float64Array) -> Float64Array:
    """What goes from one value at birth to another at the end."""
    return ends[0] + (ends[1] - ends[0]) * age


def _fade(age: Float64Array) -> Float64Array:
    """From 0 at birth quickly to 1, then slowly to 0 at the end of a life."""
    rise = np.clip(age / 0.12, 0.0, 1.0)
    fall = np.clip((1.0 - age) / 0.5, 0.0, 1.0)
    return np.asarray(rise * rise * (3.0 - 2.0 * rise) * fall * fall * (3.0 - 2.0 * fall))


_PARTS = 6
"""Parts of an object whose colours its pieces have."""


def _colours_of(source: Source, count: int, rng: np.random.Generator) -> Float64Array:
    """[count, 3] colours of an object's largest parts, each as often as it is large."""
    if source.actor is None:
        return np.full((1, 3), 0.3)
    parts = source.actor.place(0.0).parts
    volume = np.array([abs(np.linalg.det(part.to_body[:, :3])) for part in parts])
    largest = np.argsort(-volume, kind="stable")[:_PARTS]
    share = np.cbrt(volume[largest]) ** 2
    palette = np.array([parts[number].colour for number in largest])
    return np.asarray(palette[rng.choice(len(largest), size=count, p=share / share.sum())])

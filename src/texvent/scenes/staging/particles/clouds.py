"""Smoke, steam, mist, fire, dust: plumes and clouds of translucent puffs."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.models.lamps import Lamp
from texvent.scenes.scene import LAMP_COLUMNS, Colour, Float64Array
from texvent.scenes.staging.particles.motion import (
    GRAVITY,
    Lives,
    Source,
    directions,
    flight,
    turbulence,
)
from texvent.scenes.staging.particles.shapes import PuffEffect, puff_rows
from texvent.scenes.staging.surroundings.light.lamps import wave_at

_FLAME = Lamp(1.0, wave="flame")
_FLAME_HZ = 6.0


@dataclass(frozen=True)
class PlumeStyle:
    """What a plume looks like.

    Lengths are multiples of the source's size s, speeds of √(g·s), times of √(s / g): small plumes
    are quick.
    """

    count: int
    life: float
    speed: float
    """Of rising."""
    spread_rad: float
    """Half angle within which puffs start."""
    area: float
    """Radius of the spot they start from."""
    radius: tuple[float, float]
    """At birth and at the end."""
    thickness: tuple[float, float]
    """Optical depth at birth and at the end."""
    colours: tuple[Colour, Colour]
    """At birth and at the end."""
    emission: tuple[float, float] = (0.0, 0.0)
    detail: float = 0.7
    upright: float = 1.0
    """Height of a puff by its width."""
    curl: float = 0.35
    """How far eddies carry it at the end."""
    wind: float = 0.12
    drag: float = 3.0
    light: float = 0.0
    """Light shed at 1 m per square metre of s²."""


_GREY: Colour = (0.20, 0.20, 0.21)
_SOOT: Colour = (0.10, 0.095, 0.09)
_WHITE: Colour = (0.92, 0.94, 0.96)
_EARTH: Colour = (0.50, 0.38, 0.25)
PLUMES: dict[str, PlumeStyle] = {
    "smoke": PlumeStyle(
        46, 7.0, 0.55, 0.25, 0.10, (0.16, 0.75), (1.6, 0.35), (_GREY, (0.38, 0.38, 0.40))
    ),
    "black smoke": PlumeStyle(
        40, 6.0, 0.6, 0.25, 0.35, (0.3, 0.9), (1.5, 0.3), (_SOOT, (0.22, 0.21, 0.21))
    ),
    "steam": PlumeStyle(
        34, 6.0, 0.35, 0.22, 0.22, (0.16, 0.5), (0.55, 0.1), (_WHITE, _WHITE), curl=0.45
    ),
    "fire": PlumeStyle(
        56, 2.4, 0.62, 0.22, 0.34, (0.26, 0.08), (1.1, 0.4), ((1.0, 0.36, 0.04), (0.9, 0.10, 0.01)),
        (1.9, 0.9), detail=1.0, upright=1.8, curl=0.20, wind=0.02, drag=4.0, light=1.5,
    ),
    "dust": PlumeStyle(
        36, 4.0, 0.22, 1.2, 0.35, (0.22, 0.65), (0.8, 0.1), (_EARTH, (0.62, 0.50, 0.36)), wind=0.05,
        drag=1.0,
    ),
    "spray": PlumeStyle(
        26, 2.2, 0.9, 0.5, 0.05, (0.06, 0.4), (0.5, 0.06), (_WHITE, _WHITE), curl=0.2
    ),
    "mist": PlumeStyle(
        64, 40.0, 0.02, 1.5, 6.0, (2.0, 2.4), (0.3, 0.3), ((0.74, 0.77, 0.79),) * 2, upright=0.35,
        curl=0.3, wind=0.05,
    ),
    "sand": PlumeStyle(
        60, 8.0, 0.05, 1.5, 6.0, (1.8, 2.2), (0.9, 0.8), ((0.70, 0.47, 0.24),) * 2, upright=0.7,
        curl=0.4, wind=0.9, drag=50.0,
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Plume(PuffEffect):
    """Puffs that rise from a source, grow, and thin out until they are gone."""

    source: Source
    style: PlumeStyle
    lives: Lives
    start_s: float = -math.inf
    """When the first puff is born, s."""

    @classmethod
    def of(
        cls,
        kind: str,
        source: Source,
        rng: np.random.Generator,
        *,
        colour: Colour | None = None,
        start_s: float | None = None,
    ) -> Plume:
        """A plume of a kind of `PLUMES`; `colour` replaces its colours."""
        style = PLUMES[kind]
        if colour is not None:
            style = replace(style, colours=(colour, colour))
        life = style.life * math.sqrt(source.size_m / GRAVITY)
        start = -math.inf if start_s is None else start_s
        return cls(source, style, Lives.of(style.count, life, rng), start)

    def unlit(self) -> Plume:
        """The same plume where the object's own lamp sheds its light."""
        return replace(self, style=replace(self.style, light=0.0))

    def puffs(self, time_s: float) -> Float64Array:
        """[k, 19] the puffs at that instant; those just born or about to go are thin."""
        style, size = self.style, self.source.size_m
        age, draws = self.lives.at(time_s)
        unit_s, unit_m_s = math.sqrt(size / GRAVITY), math.sqrt(size * GRAVITY)
        age_s = age * self.lives.life_s
        born = self.source.at(time_s - age_s)
        velocity = style.speed * unit_m_s * (0.75 + 0.5 * draws[:, 2:3])
        velocity = velocity * directions(draws, style.spread_rad)
        around, out = 2.0 * math.pi * draws[:, 3], style.area * size * np.sqrt(draws[:, 4])
        born[:, 0] += out * np.cos(around)
        born[:, 1] += out * np.sin(around)
        lift = style.speed * unit_m_s / (style.drag * unit_s)
        pull = np.array([style.wind * unit_m_s / (style.drag * unit_s), 0.0, 0.8 * lift])
        places = born + flight(age_s, velocity, style.drag * unit_s, pull)
        eddies = turbulence(places, time_s, 1.6 * size, 0.16 / unit_s)
        places += style.curl * size * age[:, None] * eddies
        start, stop = style.radius
        radius = size * (start + (stop - start) * age) * (0.75 + 0.5 * draws[:, 5])
        extents = radius[:, None] * [1.0, 1.0, style.upright]
        first, last = (np.array(colour) for colour in style.colours)
        colours = (first + (last - first) * age[:, None]) * (0.72 + 0.56 * draws[:, 6:7])
        thick = style.thickness[0] + (style.thickness[1] - style.thickness[0]) * age
        thick *= (0.4 + 1.2 * draws[:, 5]) * _fade(age) * (time_s - age_s >= self.start_s)
        glow = style.emission[0] + (style.emission[1] - style.emission[0]) * age
        return puff_rows(
            places, extents, colours, thick,
            emission=glow, detail=style.detail, seeds=50.0 * draws[:, 6],
        )  # fmt: skip

    def lamps(self, time_s: float) -> Float64Array:
        """[m, 15] the light of flames."""
        style, size = self.style, self.source.size_m
        if style.light == 0.0 or time_s < self.start_s:
            return np.zeros((0, LAMP_COLUMNS))
        row = np.zeros((1, LAMP_COLUMNS))
        row[0, :3] = self.source.at(np.array([time_s]))[0] + [0.0, 0.0, 0.6 * size]
        level = wave_at(_FLAME, _FLAME_HZ, time_s, 0.37, 0)
        row[0, 3:6] = level * style.light * size * size * np.array([1.0, 0.5, 0.16])
        row[0, 6], row[0, 10:12], row[0, 12] = 12.0 * size, -2.0, 0.4 * size
        return row


def _fade(age: Float64Array) -> Float64Array:
    """From 0 at birth quickly to 1, then slowly to 0 at the end of a life."""
    rise = np.clip(age / 0.12, 0.0, 1.0)
    fall = np.clip((1.0 - age) / 0.5, 0.0, 1.0)
    return np.asarray(rise * rise * (3.0 - 2.0 * rise) * fall * fall * (3.0 - 2.0 * fall))


@dataclass(frozen=True)
class Bank(PuffEffect):
    """A bank of mist or blowing sand over the ground: puffs that drift through a wide box."""

    middle: Float64Array
    """[3] m."""
    extent_m: float
    """Side of the box, m."""
    style: PlumeStyle
    draws: Float64Array
    """[n, 6] in 0..1."""

    def puffs(self, time_s: float) -> Float64Array:
        """[k, 19] the puffs at that instant; they fade at the ends of the box."""
        style, extent = self.style, self.extent_m
        size = extent / 12.0
        drift = style.wind * math.sqrt(size * GRAVITY) * time_s / extent
        along = np.mod(self.draws[:, 0] + drift * (0.8 + 0.4 * self.draws[:, 3]), 1.0)
        places = np.stack(
            [
                extent * (along - 0.5),
                extent * (self.draws[:, 1] - 0.5),
                0.5 * size * style.upright * (0.4 + 1.6 * self.draws[:, 2]),
            ],
            axis=1,
        )
        places += self.middle
        places += style.curl * size * turbulence(places, time_s, 3.0 * size, 0.15)
        radius = size * style.radius[0] * (0.7 + 0.6 * self.draws[:, 4])
        edge = np.sin(math.pi * along) ** 2
        return puff_rows(
            places, radius[:, None] * [1.3, 1.0, style.upright], style.colours[0],
            style.thickness[0] * edge * (0.4 + 1.2 * self.draws[:, 5]),
            detail=style.detail, seeds=50.0 * self.draws[:, 5],
        )  # fmt: skip


def make_bank(
    kind: str, middle: Float64Array, extent_m: float, rng: np.random.Generator,
    colour: Colour | None = None,
) -> Bank:  # fmt: skip
    """Mist or blowing sand over a square of that side, m."""
    style = PLUMES[kind]
    if colour is not None:
        style = replace(style, colours=(colour, colour))
    return Bank(middle, extent_m, style, rng.uniform(size=(style.count, 6)))

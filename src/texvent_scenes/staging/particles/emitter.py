"""Emitter: particles that leave a source, fly, and are gone; smoke, sparks, drops and pieces."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.models.effects import EmitterStyle
from texvent_scenes.rendered_scene import (
    LAMP_RECORD,
    MEDIUM_RECORD,
    Float64Array,
    Primitives,
    Shape,
)
from texvent_scenes.staging.particles.effect import (
    TINY_M,
    Setting,
    Source,
    along,
    many_shapes,
    tumbling,
)
from texvent_scenes.staging.surroundings.lighting import point_lamp, wave_level
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2

GENERATIONS = 16
"""Lives of a particle that differ; then they repeat."""
_FLAME_HZ = 6.0
_FLAME_LIGHT = np.array([1.0, 0.5, 0.16])
_EDDY, _EDDY_HZ = 1.6, 0.16
"""Size and rate of eddies, in units of an effect."""
_NEAREST = 0.3
"""Least distance of a flake to the camera, as a share of that to what it looks at."""
_GREY = (0.5, 0.5, 0.5)
"""Colour of pieces of nothing that is known."""
_LONG_S = 1e4
"""Life of what has no end."""


@dataclass(frozen=True)
class Lives:
    """Particles that are born one after the other, live, and are born again."""

    draws: Float64Array
    """[n, GENERATIONS, 8] in 0..1; the last one is never a new draw: when it is first born."""
    life_s: float

    @classmethod
    def of(
        cls, count: int, life_s: float, rng: np.random.Generator, salvo: float | None = None
    ) -> Lives:
        """`count` particles; those of a `salvo` have one place, and that age at time 0."""
        draws = rng.uniform(size=(count, GENERATIONS, 8))
        draws[:, :, 7] = ((np.arange(count) + 0.5) / count)[:, None]
        if salvo is not None:
            draws[:, :, 3:7], draws[:, :, 7] = draws[:1, :, 3:7], salvo
        return cls(draws, life_s)

    def at(self, time_s: float) -> tuple[Float64Array, Float64Array]:
        """Age of each particle, [n] in 0..1 of its life, and its draws in this life, [n, 8]."""
        cycles = time_s / self.life_s + self.draws[:, 0, 7]
        number = np.floor(cycles)
        rows = np.arange(len(cycles))
        return cycles - number, self.draws[rows, number.astype(np.int64) % GENERATIONS]


_STAYS = 0.2
"""Share of the extents of what comes down everywhere up to which the camera stays in it."""


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
class Emitter:
    """Particles of a style from a source, as a function of time."""

    source: Source
    style: EmitterStyle
    lives: Lives
    colours: Float64Array
    """[k, 3] linear RGB."""
    setting: Setting
    start_s: float = -math.inf
    """Birth of the first one, s."""
    pace: float = 1.0
    """Rate at which time goes on for them from then on: slow motion."""

    @classmethod
    def of(
        cls,
        style: EmitterStyle,
        source: Source,
        setting: Setting,
        rng: np.random.Generator,
        *,
        start_s: float | None = None,
        volley: int = 0,
        pace: float = 1.0,
    ) -> Emitter:
        """An emitter; `volley` is the number of the salvo that it is, where its style has some.

        It begins at `start_s`, None = long ago, of what is born at once the beginning of the clip.
        """
        life_s = style.life * math.sqrt(source.size_m / GRAVITY_M_S2) or _LONG_S
        if style.body == "drop" and style.life == 0.0:
            height = float(source.at(np.zeros(1))[0, 2])
            height = max(height, 0.02) if math.isfinite(setting.floor_m) else 3.0 * source.size_m
            life_s = 1.1 * math.sqrt(2.0 * height / GRAVITY_M_S2)
        salvo = volley / style.salvos if style.salvos else None
        lives = Lives.of(style.count, life_s, rng, salvo)
        usual = 0.0 if style.at_once else -math.inf
        start = usual if start_s is None else start_s
        if style.at_once:
            lives.draws[:, :, 7] = -start / life_s % 1.0
        colours = np.array(style.colours or (_GREY,))
        return cls(source, style, lives, colours, setting, start, pace)

    def thinned(self, times: float) -> Emitter:
        """The same with so many times fewer particles."""
        few = self.lives.draws[: max(round(len(self.lives.draws) / times), 1)]
        return replace(self, lives=Lives(few, self.lives.life_s))

    @property
    def floor_m(self) -> float:
        """Height of what its particles come down to, m."""
        return max(self.setting.floor_m, self.source.floor_m)

    def at(self, time_s: float) -> Primitives:
        """Its drops or flakes at that instant: always as many, in the same order."""
        style = self.style
        if style.body == "medium":
            return many_shapes(np.zeros((0, 3, 4)), Shape.ELLIPSOID, np.zeros((0, 3)))
        flown = self._fly(time_s)
        grown = _between(style.radius, flown.age) * (0.7 + 0.6 * flown.draws[:, 5])
        if style.body == "drop":
            grown *= np.clip(12.0 * flown.age, 0.0, 1.0)
            grown *= np.clip(6.0 * (1.0 - flown.age), 0.0, 1.0)
        half = np.where(flown.is_there, self.source.size_m * grown, TINY_M)[:, None]
        half = np.maximum(half * style.proportions, TINY_M)
        which = (flown.draws[:, 6] * len(self.colours)).astype(np.int64)
        glow = _between(style.emission, flown.age)
        if style.body == "drop":
            maps = along(flown.places, flown.heading, half)
            return many_shapes(maps, Shape.ELLIPSOID, self.colours[which], glow)
        half = np.maximum(self._seen(half, flown.places, time_s), TINY_M)
        rate = style.turns * math.sqrt(GRAVITY_M_S2 / max(self.source.size_m, 0.02))
        starts, turned = flown.draws[:, [0, 2]], rate * flown.age_s[:, None]
        angles = 6.0 * starts + 6.6 * (starts - 0.5) * turned
        shape = Shape.ELLIPSOID if style.is_oval else Shape.BOX
        return many_shapes(tumbling(flown.places, angles, half), shape, self.colours[which], glow)

    def _seen(self, half: Float64Array, places: Float64Array, time_s: float) -> Float64Array:
        """[n, 3] half extents that flakes are shown with: none right before the camera, m.

        Those of a size that stands for a smaller one, far off, are no larger nearby.
        """
        camera = self.setting.camera
        away = np.linalg.norm(places - camera.at(time_s).position, axis=1)[:, None]
        nearest_m = _NEAREST * camera.framing.distance_m
        shown = half * np.clip(away / nearest_m - 1.0, 0.0, 1.0)
        return np.asarray(np.minimum(shown, self.style.widest_rad * away))

    def media(self, time_s: float) -> NDArray[Any]:
        """[k] `MEDIUM_RECORD` at that instant."""
        style = self.style
        if style.body != "medium":
            return np.zeros(0, MEDIUM_RECORD)
        flown = self._fly(time_s)
        age, draws = flown.age, flown.draws
        radius = self.source.size_m * _between(style.radius, age) * (0.75 + 0.5 * draws[:, 5])
        first, last = self.colours[0], self.colours[-1]
        thick = _between(style.thickness, age) * (0.4 + 1.2 * draws[:, 5])
        half = np.maximum(radius[:, None] * style.proportions, TINY_M)
        media = np.zeros(len(age), MEDIUM_RECORD)
        media["to_world"][:, range(3), range(3)] = half
        media["to_world"][:, :, 3] = flown.places
        shade = 0.72 + 0.56 * draws[:, 6:7]
        media["colour"] = (first + (last - first) * age[:, None]) * shade
        there = _fade(age) if style.fades else np.clip(12.0 * np.minimum(age, 1.0 - age), 0.0, 1.0)
        media["optical_depth"] = thick * there * flown.is_there
        media["emission"] = _between(style.emission, age)
        media["detail"], media["seed"] = style.detail, 50.0 * draws[:, 6]
        return media

    def lamps(self, time_s: float) -> NDArray[Any]:
        """[m] `LAMP_RECORD`: the light of its flames, or of its salvo."""
        style, size = self.style, self.source.size_m
        if style.light == 0.0 or time_s < self.start_s:
            return np.zeros(0, LAMP_RECORD)
        place = self.source.at(np.array([time_s]))[0] + [0.0, 0.0, 0.6 * size]
        level, hue = wave_level("flame", _FLAME_HZ * time_s, phase=0.37), _FLAME_LIGHT
        if style.salvos:
            age, draws = self.lives.at(time_s)
            age_s = max(float(age[0]), 0.0) * self.lives.life_s
            level = min(age_s / 0.02, 1.0) * math.exp(
                -age_s / (0.35 * math.sqrt(size / GRAVITY_M_S2))
            )
            place += self._offsets(draws)[0]
            hue = self.colours[int(draws[0, 6] * len(self.colours))]
        light = level * style.light * size * size * hue
        return point_lamp(place, light, 12.0 * size, 0.4 * size)

    def _fly(self, time_s: float) -> _Flown:
        """All particles at an instant."""
        if self.pace != 1.0:
            time_s = self.start_s + self.pace * (time_s - self.start_s)
        style, size = self.style, self.source.size_m
        unit_s, unit_m_s = math.sqrt(size / GRAVITY_M_S2), math.sqrt(size * GRAVITY_M_S2)
        age, draws = self.lives.at(time_s)
        age_s = age * self.lives.life_s
        born_s = time_s - age_s
        is_there = born_s >= self.start_s
        if style.at_once:
            is_there[:] = 0.0 <= time_s - self.start_s < self.lives.life_s
        turn = self.source.turn(time_s)
        offset = self._offsets(draws) @ turn.T
        velocity = aimed(directions(draws, style.spread_rad), style.aim) @ turn.T
        velocity *= style.speed * unit_m_s * (0.8 + 0.4 * draws[:, 2:3])
        pull = GRAVITY_M_S2 * np.array([style.wind, 0.0, -style.gravity])
        drag_s = math.inf if style.drag is None else style.drag * unit_s
        start = self.source.at(born_s) + offset
        flown_s = age_s
        if style.body == "flake":
            fall = np.maximum(start[:, 2] - self.floor_m - 0.03 * size, 0.0)
            up, down = velocity[:, 2], max(GRAVITY_M_S2 * style.gravity, 1e-6)
            flown_s = np.minimum(age_s, (up + np.sqrt(up**2 + 2.0 * down * fall)) / down)
        displacement, heading = flight(flown_s, velocity, drag_s, pull)
        places = start + displacement
        if style.curl:
            apart = 9.0 * size * draws[:, 4:5] * (style.body != "medium")
            eddies = turbulence(places + apart, time_s, _EDDY * size, _EDDY_HZ / unit_s)
            places += style.curl * size * age[:, None] * eddies
        places = self._around_view(places, time_s)
        if style.body == "drop":
            is_there &= places[:, 2] > self.floor_m - style.radius[1] * size
        return _Flown(places, heading, age, flown_s, draws, is_there)

    def _around_view(self, places: Float64Array, time_s: float) -> Float64Array:
        """Places, [n, 3] m, of what comes down everywhere, around what the camera looks at then.

        Particles stay where they are in the world, and those that are left behind are ahead.
        """
        fills, size = self.style.fills, self.source.size_m
        if self.source.actor is not None or fills is None or min(fills[:2]) < 1.0:
            return places
        track, size_xy = self.setting.camera, size * np.array(fills[:2])
        camera = track.at(time_s)
        looked = camera.position + track.framing.distance_m * camera.rotation[2]
        moved = (looked - track.framing.target)[:2]
        if (np.abs(moved) < _STAYS * size_xy).all():
            return places
        off = places[:, :2] - self.source.fixed[:2] - moved
        places[:, :2] -= size_xy * np.round(off / size_xy)
        return places

    def _offsets(self, draws: Float64Array) -> Float64Array:
        """[n, 3] from the source's point to where particles start, in its body's axes, m."""
        style = self.style
        if style.fills is not None:
            return (draws[:, 3:6] - 0.5) * self.source.extents_m * style.fills
        around, out = 2.0 * math.pi * draws[:, 3], style.area * np.sqrt(draws[:, 4])
        spot = np.stack([out * np.cos(around), out * np.sin(around), 0.0 * out], axis=1)
        return self.source.size_m * spot


def _between(ends: tuple[float, float], age: Float64Array) -> Float64Array:
    """Linear interpolation from a value at birth to one at the end of life."""
    return ends[0] + (ends[1] - ends[0]) * age


def _fade(age: Float64Array) -> Float64Array:
    """From 0 at birth quickly to 1, then slowly to 0 at the end of a life."""
    rise = np.clip(age / 0.12, 0.0, 1.0)
    fall = np.clip((1.0 - age) / 0.5, 0.0, 1.0)
    return np.asarray(rise * rise * (3.0 - 2.0 * rise) * fall * fall * (3.0 - 2.0 * fall))


def flight(
    age_s: Float64Array, velocity: Float64Array, drag_s: float, pull: Float64Array
) -> tuple[Float64Array, Float64Array]:
    """Displacements [n, 3], m, and velocities [n, 3], m/s, of bodies with linear drag.

    Ages [n] are in s. Solution of dv/dt = pull - v / drag; `drag_s` may be inf, `pull` is in m/s².
    """
    age = age_s[:, None]
    if math.isinf(drag_s):
        return velocity * age + 0.5 * pull * age * age, velocity + pull * age
    left, final = np.exp(-age / drag_s), pull * drag_s
    displacement = final * age + (velocity - final) * drag_s * (1.0 - left)
    return displacement, final + (velocity - final) * left


def turbulence(place: Float64Array, time_s: float, scale_m: float, rate_hz: float) -> Float64Array:
    """[n, 3] displacement in eddies of that size, in multiples of it, about -1..1: sums of sines.

    Neighbours move alike, so that a plume bends and curls as a whole.
    """
    x, y, z = (place / scale_m).T
    turn = 2.0 * math.pi * rate_hz * time_s
    return np.stack(
        [
            0.6 * np.sin(0.9 * z - turn + 1.3) + 0.4 * np.sin(1.7 * z + 1.1 * y - 1.6 * turn),
            0.6 * np.sin(0.8 * z - 1.1 * turn + 4.0) + 0.4 * np.sin(1.9 * z - x - 1.7 * turn),
            0.5 * np.sin(1.1 * z + 0.7 * x - 0.9 * turn),
        ],
        axis=1,
    )


def directions(draws: Float64Array, angles: tuple[float, float]) -> Float64Array:
    """[n, 3] unit vectors between two angles (radians) to straight up, evenly over the sphere."""
    inner, outer = (math.cos(angle) for angle in angles)
    height = inner - draws[:, 0] * (inner - outer)
    around = 2.0 * math.pi * draws[:, 1]
    flat = np.sqrt(np.maximum(1.0 - height * height, 0.0))
    return np.stack([flat * np.cos(around), flat * np.sin(around), height], axis=1)


def aimed(upward: Float64Array, aim: tuple[float, float, float]) -> Float64Array:
    """[n, 3] directions around straight up, turned to be around `aim`."""
    z = np.array(aim) / np.linalg.norm(aim)
    helper = np.array([0.0, 1.0, 0.0]) if abs(z[1]) < 0.9 else np.array([1.0, 0.0, 0.0])
    x = np.cross(helper, z)
    x /= np.linalg.norm(x)
    return np.asarray(upward @ np.stack([x, np.cross(z, x), z]))

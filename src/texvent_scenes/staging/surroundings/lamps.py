"""Lamps of a scene: which are on, how they blink, and what light they shed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.colours import rgb_of
from texvent_scenes.description import SceneDescription
from texvent_scenes.models.effects import LAMPS, LampKind, lamp_of
from texvent_scenes.models.places import PlaceModel
from texvent_scenes.models.protocol import ModelPart, fraction
from texvent_scenes.models.shapes import rotation
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import LAMP_RECORD, Float64Array, Ground
from texvent_scenes.spec.scene import Lamp
from texvent_scenes.staging.actors import Actor, PlacedModel
from texvent_scenes.staging.camera.framing import Framing
from texvent_scenes.staging.surroundings.lighting import (
    FLAME_SHARES,
    hidden_lamp,
    is_unlit_room,
    point_lamp,
    wave_level,
)
from texvent_scenes.staging.surroundings.pieces import SceneryItem

MAINS_HZ = 20.0
"""From this frequency on, lamps on mains beat as a sine instead of going on and off."""
_UNLIT = (Ground.NONE, Ground.UNDERWATER, Ground.SEA)
"""Grounds of places without lamps out of sight."""
_LIGHTS_A_ROOM, _DIMMEST_CASTER, _FAINTEST = 0.1, 0.5, 0.004
"""Light at 1 m from which on a lamp without a beam lights its surroundings and from which on one
casts shadows; a lamp's light ends where it is the last."""
_LONG = 3.0
"""A part longer than this many thicknesses, such as a tube, is no spot of light."""
_MOST_CASTERS, _FAINTEST_SHARE = 3, 0.05
"""Number of lamps that cast shadows, as each costs time, and least light on the focus of one that
does, as a share of the brightest one's."""
_FARTHEST_M, _SCENE_LAMP_M = 120.0, 0.03
"""Farthest reach of a lamp's light, and radius of a lamp of the scene."""
_HALF, _GONE = 0.5, 1e-4
"""Light of a pattern below which it is not drawn; share of its size that is left of it then."""
_NO_LAMPS = np.zeros(0, LAMP_RECORD)
_LEVELS_S = np.linspace(0.0, 6.0, 24, endpoint=False)
"""Instants at which the brightest state of a part is sought."""


@dataclass(frozen=True)
class LitActor:
    """An object with lamps, and how they are switched."""

    actor: Actor
    is_lit: bool | None
    """As `SceneObject.is_lit`."""
    blink_hz: float | None
    """As `SceneObject.blink_hz`."""
    strength: float
    """Strength of artificial light, 0..1; above 0 it is so dark that lamps are on."""
    lamps: tuple[tuple[int, float, LampKind], ...]
    """Index and greatest emission of each glowing part, and what kind of lamp it is."""
    casts: bool = False
    """Whether its lamps cast shadows."""
    switch_s: float | None = None
    """As `SceneObject.switch_s`."""
    flashes: bool = False
    """Whether it has no lamp, and is drawn on a screen by turns: a square that blinks."""

    def is_on(self, lamp: LampKind) -> bool:
        """Whether a lamp is on, at some time."""
        if self.switch_s is not None:
            return True
        if self.is_lit is not None:
            return self.is_lit
        return lamp.always_on or self.strength > lamp.least_dark

    @property
    def shines(self) -> bool:
        """Whether any of its lamps is on."""
        return any(self.is_on(lamp) for _, _, lamp in self.lamps)

    @property
    def fastest_hz(self) -> float:
        """Highest frequency at which a lamp of it goes up and down, Hz; 0 = all are steady."""
        rates = [(self.blink_hz or 0.0) * self.flashes]
        for _, _, lamp in self.lamps:
            rate = max(self._blink_of(lamp) or 0.0, lamp.turns_hz, lamp.own_hz)
            rate *= FLAME_SHARES[-1][0] if lamp.wave == "flame" else 1.0
            rates.append(rate if self.is_on(lamp) else 0.0)
        return max(rates)

    def _blink_of(self, lamp: LampKind) -> float | None:
        return lamp.blink_hz if self.blink_hz is None else self.blink_hz

    def level(self, lamp: LampKind, time_s: float) -> float:
        """Light of a lamp of the object at that instant, as a share of its usual light."""
        if not self.is_on(lamp):
            return 0.0
        if self.switch_s is not None:
            return float((time_s >= self.switch_s) is (self.is_lit is not False))
        full = self.strength if self.is_lit is None and not lamp.always_on else 1.0
        rate = self._blink_of(lamp)
        if rate is None:
            return full
        wave = "square" if lamp.wave == "sine" and rate < MAINS_HZ else lamp.wave
        # Two candles do not flicker in step.
        phase = fraction(self.actor.instance, "flame")
        return full * wave_level(wave, rate * time_s, phase=phase)

    def glow(self, placed: PlacedModel, time_s: float) -> PlacedModel:
        """The object with its glowing parts as bright as its lamps are at that instant."""
        parts = list(placed.parts)
        if self.flashes and wave_level("square", (self.blink_hz or 0.0) * time_s) < _HALF:
            parts = [one.at(_GONE * one.to_body) for one in parts]
        for index, _, lamp in self.lamps:
            if self.is_on(lamp) or self.is_lit is not None:
                factor = lamp.boost * self.level(lamp, time_s)
                if lamp.wave == "flame" and factor == 0.0:  # it is out
                    parts[index] = parts[index].at(_GONE * parts[index].to_body)
                parts[index] = replace(parts[index], emission=parts[index].emission * factor)
        return replace(placed, parts=parts)

    def at(self, time_s: float) -> NDArray[Any]:
        """[m] `LAMP_RECORD` at that instant: always as many."""
        found = [_NO_LAMPS]
        done: set[LampKind] = set()
        placed = self.actor.place(time_s)
        for index, brightest, lamp in self.lamps:
            if lamp in done or not self.is_on(lamp):
                continue
            if lamp.is_single:
                done.add(lamp)
            part = placed.parts[index]
            level = self.level(lamp, time_s) * part.emission / brightest
            found.append(part_lamp(lamp, part, placed.to_world, level, time_s))
            found[-1]["casts"] = self.casts and lamp.intensity >= _DIMMEST_CASTER
        return np.concatenate(found)

    def steady_at(self, time_s: float) -> NDArray[Any]:
        """[m] `LAMP_RECORD` at that instant, as if no lamp blinked."""
        return replace(self, blink_hz=0.0, switch_s=None).at(time_s)


def part_lamp(
    lamp: LampKind, part: ModelPart, to_world: Float64Array, level: float, time_s: float = 0.0
) -> NDArray[Any]:
    """[1] `LAMP_RECORD` of a glowing part, without a shadow.

    The glowing part is in body coordinates; `level` is light as a share of its usual light, the
    instant turns beams that turn.
    """
    light = level * lamp.intensity * np.array(part.colour) / max(max(part.colour), 1e-9)
    reach = min(math.sqrt(lamp.intensity / _FAINTEST), _FARTHEST_M)
    half = np.sort(np.linalg.norm(part.to_body[:, :3], axis=0))
    is_long = half[2] > _LONG * half[1]
    radius = half[1] if lamp.is_panel else 0.5 * half[2] if is_long else half[0]
    found, centre = point_lamp(np.zeros(3), light, reach, radius), part.to_body[:, 3].copy()
    if lamp.direction is not None:
        beam = np.array(lamp.direction) / np.linalg.norm(lamp.direction)
        angle = 2.0 * math.pi * lamp.turns_hz * time_s
        beam = rotation("z", angle) @ beam
        centre += beam * np.abs(beam @ part.to_body[:, :3]).max()
        beam = to_world[:, :3] @ beam
        found["beam"] = beam / np.linalg.norm(beam)
        dark = math.radians(lamp.half_angle)
        found["full"] = math.cos(dark * (1.0 - lamp.soft_share))
        found["dark"] = math.cos(dark)
    found["place"] = to_world[:, :3] @ centre + to_world[:, 3]
    found["glows"] = lamp.glows and not lamp.is_panel and not is_long
    return found


def scene_lamp(lamp: Lamp, time_s: float) -> NDArray[Any]:
    """[1] `LAMP_RECORD` at a position that the scene gives; its period is 1 / frequency_hz."""
    light = lamp.strength * np.array(rgb_of(lamp.colour or "#ffffff", "light"))
    reach = math.sqrt(max(light.max(), 1e-9) / _FAINTEST)
    level = wave_level(lamp.wave, (lamp.frequency_hz or 0.0) * time_s)
    found = point_lamp(lamp.position_m, level * light, reach, _SCENE_LAMP_M)
    found["casts"] = lamp.has_shadows
    return found


@dataclass(frozen=True)
class LampPlan:
    """All lamps of a scene as functions of time."""

    scene: tuple[Lamp, ...]
    """Lamps at positions that the scene gives; first, as four at most cast shadows."""
    lit: tuple[LitActor, ...]
    still: NDArray[Any]
    """[m] `LAMP_RECORD`: lamps of the scenery, and light whose lamp is out of sight."""

    def place(self, actor: Actor, time_s: float) -> PlacedModel:
        """An object in the world, with its lamps as bright as they are at that instant."""
        placed = actor.place(time_s)
        own = (one for one in self.lit if one.actor.instance == actor.instance)
        lit = next(own, None)
        return placed if lit is None else lit.glow(placed, time_s)

    def at(self, time_s: float) -> NDArray[Any]:
        """[m] `LAMP_RECORD`: all lamps at that instant."""
        own = (scene_lamp(one, time_s) for one in self.scene)
        return np.concatenate([*own, *(one.at(time_s) for one in self.lit), self.still])

    @property
    def blink_hz(self) -> float | None:
        """Highest frequency at which a lamp goes up and down, Hz; None = all are steady."""
        rates = [one.fastest_hz for one in self.lit]
        rates += [one.frequency_hz or 0.0 for one in self.scene]
        return max(rates, default=0.0) or None


def plan_lamps(
    description: SceneDescription,
    actors: Sequence[Actor],
    *,
    place: PlaceModel,
    strength: float,
    instant_s: float,
    framing: Framing,
    items: Sequence[SceneryItem],
) -> LampPlan:
    """Lamps that are on, and those that cast shadows at that instant.

    `strength` is that of artificial light, 0..1: above 0 it is dark. Lamps that light most what the
    camera looks at cast shadows; where none lights it, one does that is out of sight.
    """
    lit = []
    for one in actors:
        said, lamps = description.objects[one.object_index], _list_lamps(one)
        each = LitActor(one, said.is_lit, said.blink_hz, strength, lamps, switch_s=said.switch_s)
        is_pattern = one.noun.name in nouns_with("flat pattern") and not lamps
        each = replace(each, flashes=is_pattern and said.blink_hz is not None)
        lit += [each] if lamps or each.flashes else []
    is_unlit = is_unlit_room(place, description)
    still = _still_lamps(() if is_unlit else items, strength)
    focus = np.asarray(framing.target, dtype=np.float64)
    is_dark = strength > 0.0 and place.ground not in _UNLIT and not is_unlit
    own = np.concatenate([_NO_LAMPS, *(one.steady_at(0.0) for one in lit)])
    is_lit = (own["full"] < -1.0) & (own["light"].max(axis=1, initial=0.0) >= _LIGHTS_A_ROOM)
    if is_dark and not len(still) and not is_lit.any():
        still = hidden_lamp(focus, framing.distance_m, strength)
    _choose_casters(lit, still, instant_s, focus)
    return LampPlan(description.light.lamps, tuple(lit), still)


def _list_lamps(actor: Actor) -> tuple[tuple[int, float, LampKind], ...]:
    """Its lamps, with the greatest emission of each over a few seconds, where that changes."""
    kinds = LAMPS.get(actor.noun.name, ())
    times = _LEVELS_S if any(lamp.own_hz > 0.0 for lamp in kinds) else _LEVELS_S[:1]
    found = []
    for index, states in enumerate(zip(*(actor.place(t).parts for t in times), strict=True)):
        brightest = max(states, key=lambda part: part.emission)
        lamp = lamp_of(actor.noun.name, brightest.colour) if brightest.emission > 0.0 else None
        found += [(index, brightest.emission, lamp)] if lamp is not None else []
    return tuple(found)


def _still_lamps(items: Sequence[SceneryItem], strength: float) -> NDArray[Any]:
    """[m] `LAMP_RECORD`: lamps of the scenery that are on."""
    found = [_NO_LAMPS]
    for item in items if strength > 0.0 else ():
        placed = item.place()
        for part in placed.parts:
            lamp = lamp_of(item.rule.noun, part.colour) if part.emission > 0.0 else None
            if lamp is not None and not lamp.hue:
                found.append(part_lamp(lamp, part, placed.to_world, strength))
    return np.concatenate(found)


def _choose_casters(
    lit: list[LitActor], still: NDArray[Any], instant_s: float, focus: Float64Array
) -> None:
    """Let the lamps that light the focus [3] most cast shadows, all of one object or none."""
    choices = [(*_light_at(focus, one.steady_at(instant_s)), n) for n, one in enumerate(lit)]
    choices += [(*_light_at(focus, still[k : k + 1]), len(lit) + k) for k in range(len(still))]
    left = _MOST_CASTERS
    least = _FAINTEST_SHARE * max((light for light, _, _ in choices), default=0.0)
    for light, count, index in sorted(choices, key=lambda choice: (-choice[0], choice[2])):
        if light <= least or count > left:
            continue
        left -= count
        if index < len(lit):
            lit[index] = replace(lit[index], casts=True)
        else:
            still["casts"][index - len(lit)] = 1.0


def _light_at(focus: Float64Array, lamps: NDArray[Any]) -> tuple[float, int]:
    """Light of lamps at a point, and how many of them are bright enough to cast shadows."""
    bright = lamps[lamps["light"].max(axis=1) >= _DIMMEST_CASTER]
    square = ((bright["place"] - focus) ** 2).sum(axis=1)
    return float((bright["light"].max(axis=1) / (square + 1.0)).sum()), len(bright)

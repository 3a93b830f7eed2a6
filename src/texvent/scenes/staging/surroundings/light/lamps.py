"""Lamps of the objects in a scene: which are on, how they blink, and what light they shed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.lamps import LAMPS, Lamp, lamp_of
from texvent.scenes.models.places import Place
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.variation import fraction
from texvent.scenes.scene import LAMP_COLUMNS, Float64Array, Ground
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.assemble import PlacedModel
from texvent.scenes.staging.camera.framing import Framing
from texvent.scenes.staging.surroundings.light.lighting import hidden_lamp, tint_of
from texvent.scenes.staging.surroundings.scenery import SceneryItem

MAINS_HZ = 20.0
"""From this frequency on, lamps on mains beat as a sine instead of going on and off."""
FLAME_SHARES = ((1.0, 0.13), (1.83, 0.09), (3.17, 0.06))
"""Sines that make a flame flicker: multiple of its frequency, and amplitude."""
_FLICKERING = 2.6
"""How much more a flame flickers that is said to."""
_UNLIT = (Ground.NONE, Ground.UNDERWATER, Ground.SEA)
"""Grounds of places without lamps out of sight."""
_LIGHTS_A_ROOM = 0.1
"""A lamp without a beam that is at least this bright lights its surroundings."""
_DIMMEST_CASTER = 0.5
"""Lamps whose light at 1 m is less than this cast no shadows."""
_LONG = 3.0
"""A part longer than this many thicknesses, such as a tube, is no spot of light."""
_MOST_CASTERS = 3
"""Each costs time: see docs/design/speed.md."""
_FAINTEST_SHARE = 0.05
"""Lamps that light the focus less than this share of what the best one does cast no shadows."""
_FAINTEST = 0.004
"""A lamp's light ends where it is this."""
_FARTHEST_M = 120.0
_LEVEL_INSTANTS = 24
_LEVEL_SPAN_S = 6.0
"""Instants and time over which a part's brightest state is looked for."""


def wave_at(lamp: Lamp, rate_hz: float, time_s: float, phase: float, number: int) -> float:
    """Share of its light that a blinking lamp gives off at an instant; at t = 0 it is on."""
    cycles = rate_hz * time_s
    if lamp.wave == "flame":
        turn = 2.0 * math.pi
        waves = (
            share * math.sin(turn * (multiple * cycles + phase * (1.0 + multiple)))
            for multiple, share in FLAME_SHARES
        )
        return 1.0 + sum(waves)
    if lamp.wave == "rotating":
        return max(math.cos(2.0 * math.pi * cycles + math.pi * number), 0.0) ** 2
    if lamp.wave == "sine" and rate_hz >= MAINS_HZ:
        return 0.5 + 0.5 * math.cos(2.0 * math.pi * cycles)
    return 1.0 if cycles % 1.0 < 0.5 else 0.0


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
    brightest: tuple[float, ...]
    """Greatest emission of each part over time; 0 = it does not glow."""
    casts: bool = False
    """Whether its lamps cast shadows."""

    def is_on(self, lamp: Lamp) -> bool:
        """Whether a lamp is on."""
        if self.is_lit is not None:
            return self.is_lit
        return lamp.always_on or self.strength > lamp.least_dark

    def blink_of(self, lamp: Lamp) -> float | None:
        """Frequency at which a lamp blinks, Hz; None = it is steady."""
        return lamp.blink_hz if self.blink_hz is None else self.blink_hz

    def level(self, lamp: Lamp, time_s: float, number: int) -> float:
        """Light of the object's lamp `number` at that instant, as a share of its usual light."""
        if not self.is_on(lamp):
            return 0.0
        full = self.strength if self.is_lit is None and not lamp.always_on else 1.0
        rate = self.blink_of(lamp)
        if rate is None:
            return full
        # Two candles do not flicker in step.
        wave = wave_at(lamp, rate, time_s, fraction(self.actor.instance, "flame"), number)
        if lamp.wave == "flame" and self.blink_hz is not None:
            wave = max(1.0 + _FLICKERING * (wave - 1.0), 0.05)
        return full * wave

    def glow(self, placed: PlacedModel, time_s: float) -> PlacedModel:
        """The object with its glowing parts as bright as its lamps are at that instant."""
        parts = list(placed.parts)
        for index, number, lamp in self.lamps_of(placed):
            part, level = parts[index], self.level(lamp, time_s, number)
            if self.is_on(lamp):
                parts[index] = replace(part, emission=part.emission * lamp.boost * level)
            elif self.is_lit is not None:
                parts[index] = replace(part, emission=0.0)
        return replace(placed, parts=parts)

    def lamps_of(self, placed: PlacedModel) -> list[tuple[int, int, Lamp]]:
        """Its lamps: index of the part, number among the lamps, and kind."""
        found: list[tuple[int, int, Lamp]] = []
        for index, part in enumerate(placed.parts):
            lamp = lamp_of(self.actor.noun.name, part.colour) if part.emission > 0.0 else None
            if lamp is not None:
                found.append((index, len(found), lamp))
        return found

    def rows(self, placed: PlacedModel, time_s: float) -> list[Float64Array]:
        """Its lamps at that instant, as in `Environment.lamps`: always as many."""
        rows: list[Float64Array] = []
        done: set[Lamp] = set()
        for index, number, lamp in self.lamps_of(placed):
            if lamp in done or not self.is_on(lamp):
                continue
            if lamp.is_single:
                done.add(lamp)
            part = placed.parts[index]
            level = self.level(lamp, time_s, number) * part.emission
            level /= max(self.brightest[index], 1e-9)
            casts = self.casts and lamp.intensity >= _DIMMEST_CASTER
            rows.append(lamp_row(lamp, part, placed.to_world, level, time_s, casts))
        return rows


def lamp_row(
    lamp: Lamp,
    part: ModelPart,
    to_world: Float64Array,
    level: float,
    time_s: float = 0.0,
    casts: bool = False,
) -> Float64Array:
    """A lamp's numbers, as in `Environment.lamps`.

    Args:
        lamp: what kind it is.
        part: the glowing part, in body coordinates.
        to_world: [3, 4] body → world.
        level: light as a share of its usual light.
        time_s: for beams that turn.
        casts: whether it casts shadows.
    """
    row = np.zeros(LAMP_COLUMNS)
    half = np.sort(np.linalg.norm(part.to_body[:, :3], axis=0))
    centre = part.to_body[:, 3].copy()
    row[10] = row[11] = -2.0
    if lamp.direction is not None:
        beam = np.array(lamp.direction) / np.linalg.norm(lamp.direction)
        angle = 2.0 * math.pi * lamp.turns_hz * time_s
        cosine, sine = math.cos(angle), math.sin(angle)
        beam = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]]) @ beam
        centre += beam * np.abs(beam @ part.to_body[:, :3]).max()
        row[7:10] = to_world[:, :3] @ beam
        row[7:10] /= np.linalg.norm(row[7:10])
        dark = math.radians(lamp.half_angle)
        row[10] = math.cos(dark * (1.0 - lamp.soft_share))
        row[11] = math.cos(dark)
    row[:3] = to_world[:, :3] @ centre + to_world[:, 3]
    row[3:6] = level * lamp.intensity * np.array(part.colour) / max(max(part.colour), 1e-9)
    row[6] = min(math.sqrt(lamp.intensity / _FAINTEST), _FARTHEST_M)
    is_long = half[2] > _LONG * half[1]
    row[12] = half[1] if lamp.is_panel else 0.5 * half[2] if is_long else half[0]
    row[13] = float(casts)
    row[14] = float(lamp.glows and not lamp.is_panel and not is_long)
    return row


@dataclass(frozen=True)
class LampPlan:
    """All lamps of a scene as functions of time."""

    lit: tuple[LitActor, ...]
    still: Float64Array
    """[m, 15] lamps of the scenery, and light whose lamp is out of sight."""

    def place(self, actor: Actor, time_s: float) -> PlacedModel:
        """An object in the world, with its lamps as bright as they are at that instant."""
        placed = actor.place(time_s)
        own = (one for one in self.lit if one.actor.instance == actor.instance)
        lit = next(own, None)
        return placed if lit is None else lit.glow(placed, time_s)

    def rows(self, time_s: float) -> Float64Array:
        """[m, 15] all lamps at that instant."""
        rows = [row for one in self.lit for row in one.rows(one.actor.place(time_s), time_s)]
        return np.concatenate([np.array(rows).reshape(-1, LAMP_COLUMNS), self.still])

    @property
    def is_moving(self) -> bool:
        """Whether objects of the scene, which may move, shed light."""
        return any(one.is_lit is not False for one in self.lit)

    @property
    def blink_hz(self) -> float | None:
        """Highest frequency at which a lamp goes up and down, Hz; None = all are steady."""
        rates = [0.0]
        for one in self.lit:
            for _, _, lamp in one.lamps_of(one.actor.place(0.0)):
                rate = max(one.blink_of(lamp) or 0.0, lamp.turns_hz, lamp.own_hz)
                rate *= FLAME_SHARES[-1][0] if lamp.wave == "flame" else 1.0
                rates.append(rate if one.is_on(lamp) else 0.0)
        return max(rates) or None


def plan_lamps(
    description: SceneDescription,
    actors: Sequence[Actor],
    *,
    place: Place,
    strength: float,
    instant_s: float,
    framing: Framing,
    looking: Float64Array,
    items: Sequence[SceneryItem],
) -> LampPlan:
    """Which lamps are on, and which of them cast shadows.

    Args:
        description: says which are lit and how they blink.
        actors: the objects.
        place: where they are.
        strength: of artificial light, 0..1; above 0 it is dark.
        instant_s: when the lamps that cast shadows are chosen, s.
        framing: what the camera looks at: the lamps that light it most cast shadows, and where
            none lights it, one does that is out of sight.
        looking: [3] unit vector that the camera looks along.
        items: the scenery, whose lamps are on at night.
    """
    lit = list(filter(None, (_lit_actor(one, description, strength) for one in actors)))
    rows = _still_lamps(items, strength)
    for row in rows:
        row[3:6] *= np.array(tint_of(description.light) or 1.0)
    focus = np.asarray(framing.target, dtype=np.float64)
    is_dark = strength > 0.0 and place.ground not in _UNLIT
    if is_dark and not rows and not any(map(_lights_around, lit)):
        light, reach = description.light, framing.distance_m
        rows.append(hidden_lamp(focus, reach, strength, light, looking))
    still = np.array(rows, dtype=np.float64).reshape(-1, LAMP_COLUMNS)
    if description.light.shadows is not False and description.light.hardness != "soft":
        _choose_casters(lit, still, instant_s, focus)
    return LampPlan(tuple(lit), still)


def _lit_actor(actor: Actor, description: SceneDescription, strength: float) -> LitActor | None:
    """The lamps of an object; None where it has none that are on or said to be off."""
    said, brightest = description.objects[actor.object_index], _brightest(actor)
    lit, placed = LitActor(actor, said.is_lit, said.blink_hz, strength, brightest), actor.place(0.0)
    is_seen = said.is_lit is False and any(brightest)
    return lit if is_seen or any(lit.is_on(one) for _, _, one in lit.lamps_of(placed)) else None


def _steady_rows(one: LitActor, time_s: float) -> Float64Array:
    """[m, 15] its lamps as if they did not blink."""
    steady = replace(one, blink_hz=1e-9)
    return np.array(steady.rows(one.actor.place(time_s), 0.0)).reshape(-1, LAMP_COLUMNS)


def _lights_around(one: LitActor) -> bool:
    """Whether an object has a lamp that lights what is around it."""
    rows = _steady_rows(one, 0.0)
    return any(row[10] < -1.0 and row[3:6].max() >= _LIGHTS_A_ROOM for row in rows)


def _still_lamps(items: Sequence[SceneryItem], strength: float) -> list[Float64Array]:
    """Lamps of the scenery that are on."""
    rows = []
    for item in items if strength > 0.0 else ():
        placed = item.place(0)
        for part in placed.parts:
            lamp = lamp_of(item.noun, part.colour) if part.emission > 0.0 else None
            if lamp is not None and not lamp.hue:
                rows.append(lamp_row(lamp, part, placed.to_world, strength))
    return rows


def _brightest(actor: Actor) -> tuple[float, ...]:
    """Greatest emission of each part of an object over a few seconds, where it is a lamp."""
    levels = []
    changes = any(lamp.own_hz > 0.0 for lamp in LAMPS.get(actor.noun.name, ()))
    for step in range(_LEVEL_INSTANTS if changes else 1):
        parts = actor.place(_LEVEL_SPAN_S * step / _LEVEL_INSTANTS).parts
        levels.append([
            part.emission if lamp_of(actor.noun.name, part.colour) is not None else 0.0
            for part in parts
        ])  # fmt: skip
    return tuple(max(column) for column in zip(*levels, strict=True))


def _choose_casters(
    lit: list[LitActor], still: Float64Array, instant_s: float, focus: Float64Array
) -> None:
    """Let the lamps that light the focus most cast shadows, all of one object or none.

    Args:
        lit: objects with lamps; changed.
        still: [m, 15] lamps of the scenery; changed.
        instant_s: when they are compared, s.
        focus: [3] what the camera looks at, m.
    """
    choices = [(*_light_at(focus, _steady_rows(one, instant_s)), n) for n, one in enumerate(lit)]
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
            still[index - len(lit), 13] = 1.0


def _light_at(focus: Float64Array, rows: Float64Array) -> tuple[float, int]:
    """Light of lamps at a point, and how many of them are bright enough to cast shadows."""
    bright = rows[rows[:, 3:6].max(axis=1) >= _DIMMEST_CASTER]
    square = ((bright[:, :3] - focus) ** 2).sum(axis=1)
    return float((bright[:, 3:6].max(axis=1) / (square + 1.0)).sum()), len(bright)

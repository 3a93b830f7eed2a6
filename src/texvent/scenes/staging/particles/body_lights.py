"""Small lights on a body that blink: strings of lights, beacons of vehicles, turn signals."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import LAMP_COLUMNS, Colour, Float64Array, Primitives, Shape
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.particles.shapes import PuffEffect, many_shapes

_AMBER: Colour = (1.0, 0.42, 0.03)
_BLUE: Colour = (0.06, 0.2, 1.0)
_STRING: tuple[Colour, ...] = (
    (1.0, 0.08, 0.05), (1.0, 0.65, 0.1), (0.1, 0.35, 1.0), (0.1, 0.9, 0.2),
)  # fmt: skip
_BULBS = 48
_CONICAL = frozenset({"pine", "tree", "cone"})
"""Bodies around which a string of lights winds in a spiral."""


@dataclass(frozen=True)
class BodyLights(PuffEffect):
    """Lights fixed to a body, or to the world, in groups that go on and off together."""

    actor: Actor | None
    places: Float64Array
    """[n, 3] m, in the body's coordinates."""
    group: Float64Array
    """[n] phase of each light, periods."""
    colours: Float64Array
    """[n, 3]."""
    radius_m: float
    blink_hz: float
    """How often each goes on and off; 0 = they are steady."""
    on_share: float = 0.5
    glow: float = 4.0
    """Emission of a light that is on."""
    intensity: float = 0.0
    """Light that each sheds at 1 m; 0 = none."""

    def at(self, time_s: float) -> Primitives:
        """The lights at that instant."""
        places = self._places(time_s)
        maps = np.zeros((len(places), 3, 4))
        maps[:, [0, 1, 2], [0, 1, 2]] = self.radius_m
        maps[:, :, 3] = places
        level = self._level(time_s)
        colours = self.colours * (0.15 + 0.85 * level[:, None])
        return many_shapes(maps, Shape.ELLIPSOID, colours, 0.02 + self.glow * level)

    def lamps(self, time_s: float) -> Float64Array:
        """[m, 15] the light they shed."""
        if self.intensity <= 0.0:
            return np.zeros((0, LAMP_COLUMNS))
        rows = np.zeros((len(self.places), LAMP_COLUMNS))
        rows[:, :3] = self._places(time_s)
        rows[:, 3:6] = self.intensity * self._level(time_s)[:, None] * self.colours
        rows[:, 6], rows[:, 10:12] = 12.0 * math.sqrt(self.intensity), -2.0
        rows[:, 12], rows[:, 14] = self.radius_m, 1.0
        return rows

    def puffs(self, time_s: float) -> Float64Array:
        """No puffs."""
        del time_s
        return np.zeros((0, 19))

    def _level(self, time_s: float) -> Float64Array:
        if self.blink_hz <= 0.0:
            return np.ones(len(self.places))
        phase = np.mod(self.blink_hz * time_s + self.group, 1.0)
        return np.asarray((phase < self.on_share).astype(np.float64))

    def _places(self, time_s: float) -> Float64Array:
        if self.actor is None:
            return self.places
        to_world = self.actor.trajectory.at(time_s).to_world()
        return np.asarray(self.places @ to_world[:, :3].T + to_world[:, 3])


_WITH_SIREN = frozenset({"car", "suv", "van", "motorcycle", "sports car", "limousine"})
_AMBER_HZ = 1.4


def make_beacons(actor: Actor, colour: Colour | None) -> BodyLights:
    """Two lights on top of a car that flash in turn; one amber light on trucks and machines."""
    model = actor.model
    low = -0.5 * model.height if actor.is_centred else 0.0
    y = 0.22 * model.width
    places = np.array([[0.0, y, low + 1.0 * model.height], [0.0, -y, low + 1.0 * model.height]])
    hues = np.array([colour or _BLUE] * 2)
    size = 0.07 * min(model.width, model.height)
    if actor.noun.name not in _WITH_SIREN:
        top = np.array([[0.0, 0.0, places[0, 2]]])
        amber = np.array([colour or _AMBER])
        return BodyLights(actor, top, np.array([0.0]), amber, size, _AMBER_HZ, intensity=6.0)
    return BodyLights(actor, places, np.array([0.0, 0.5]), hues, size, 2.0, intensity=6.0)


def make_turn_signals(actor: Actor, *, both: bool) -> BodyLights:
    """Amber lights at the corners of a vehicle: on one side, or on both."""
    model = actor.model
    x, y, z = 0.49 * model.length, 0.42 * model.width, 0.42 * model.height
    sides = (1.0, -1.0) if both else (-1.0,)
    corners = np.array([[way * x, side * y, z] for side in sides for way in (1.0, -1.0)])
    hues = np.tile(_AMBER, (len(corners), 1))
    size = 0.05 * min(model.width, model.height)
    return BodyLights(actor, corners, np.zeros(len(corners)), hues, size, 1.4, intensity=0.5)


def make_string(
    actor: Actor | None, place: Float64Array, side: Float64Array, reach_m: float, *,
    blink_hz: float, colour: Colour | None,
) -> BodyLights:  # fmt: skip
    """A string of lights: around a body, along its front, or hanging in two bows.

    Args:
        actor: the body; None = it hangs in the air.
        place: [3] middle of where it hangs, m.
        side: [3] horizontal unit vector along which it hangs.
        reach_m: its length in the air, m.
        blink_hz: 0 = steady.
        colour: of all lights; None = of several colours.
    """
    share = (np.arange(_BULBS) + 0.5) / _BULBS
    group = np.mod(0.25 * np.arange(_BULBS), 1.0)
    hues = np.array([colour or _STRING[k % len(_STRING)] for k in range(_BULBS)])
    if actor is None:
        drop = np.abs(np.sin(2.0 * math.pi * share)) * 0.10 * reach_m
        places = place + np.outer(reach_m * (share - 0.5), side) - np.outer(drop, [0.0, 0.0, 1.0])
        return BodyLights(None, places, group, hues, 0.010 * reach_m, blink_hz, glow=1.3)
    model = actor.model
    low = -0.5 * model.height if actor.is_centred else 0.0
    if actor.noun.name in _CONICAL:
        angle = 2.0 * math.pi * 5.5 * share
        out = 0.5 * (1.06 - share) * 0.92
        x, y = out * model.length * np.cos(angle), out * model.width * np.sin(angle)
        places = np.stack([x, y, low + model.height * (0.16 + 0.8 * share)], axis=1)
    else:
        places = _outline(share, model.length, model.width, model.height)
        places[:, 2] += low
    size = 0.019 * float(np.cbrt(model.length * model.width * model.height))
    return BodyLights(actor, places, group, hues, size, blink_hz, glow=1.3)


def _outline(share: Float64Array, long: float, wide: float, tall: float) -> Float64Array:
    """[n, 3] points around the top of a box, all the way round."""
    corners = 0.5 * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1], [1, 1]]) * [long, wide]
    way = 4.0 * share
    x = np.interp(way, np.arange(5.0), corners[:, 0])
    y = np.interp(way, np.arange(5.0), corners[:, 1])
    bow = 0.06 * tall * np.abs(np.sin(4.0 * math.pi * way))
    return np.stack([1.02 * x, 1.02 * y, 0.78 * tall - bow], axis=1)

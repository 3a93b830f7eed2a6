"""Small lights on a body that blink: beacons of vehicles, turn signals, strings of lights."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.models.traits import nouns_with
from texvent.scenes.scene import LAMP_COLUMNS, Colour, Float64Array, Primitives, Shape
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.particles.shapes import ParticleEffect, many_shapes

_AMBER: Colour = (1.0, 0.42, 0.03)
_BLUE: Colour = (0.06, 0.2, 1.0)
_STRING: tuple[Colour, ...] = (
    (1.0, 0.08, 0.05), (1.0, 0.65, 0.1), (0.1, 0.35, 1.0), (0.1, 0.9, 0.2),
)  # fmt: skip
_BULBS, _WINDINGS = 48, 5.5
_BEACON_HZ, _SIGNAL_HZ, _STRING_HZ = 2.0, 1.4, 1.1


@dataclass(frozen=True)
class BodyLights(ParticleEffect):
    """Lights fixed to a body, or to the world, that go on and off."""

    actor: Actor | None
    places: Float64Array
    """[n, 3] m, in the body's coordinates."""
    phase: Float64Array
    """[n] of each light, periods: those of one phase go on and off together."""
    colours: Float64Array
    """[n, 3]."""
    radius_m: float
    blink_hz: float
    """How often each goes on and off."""
    glow: float = 4.0
    """Emission of a light that is on."""
    intensity: float = 0.0
    """Light that each sheds at 1 m; 0 = none."""

    def at(self, time_s: float) -> Primitives:
        """The lights at that instant."""
        maps = np.zeros((len(self.places), 3, 4))
        maps[:, [0, 1, 2], [0, 1, 2]] = self.radius_m
        maps[:, :, 3] = self._places(time_s)
        level = self._level(time_s)
        colours = self.colours * (0.15 + 0.85 * level[:, None])
        return many_shapes(maps, Shape.ELLIPSOID, colours, 0.02 + self.glow * level)

    def lamps(self, time_s: float) -> Float64Array:
        """[m, 15] the light they shed."""
        if self.intensity <= 0.0:
            return super().lamps(time_s)
        rows = np.zeros((len(self.places), LAMP_COLUMNS))
        rows[:, :3] = self._places(time_s)
        rows[:, 3:6] = self.intensity * self._level(time_s)[:, None] * self.colours
        rows[:, 6], rows[:, 10:12] = 12.0 * math.sqrt(self.intensity), -2.0
        rows[:, 12], rows[:, 14] = self.radius_m, 1.0
        return rows

    def _level(self, time_s: float) -> Float64Array:
        return (np.mod(self.blink_hz * time_s + self.phase, 1.0) < 0.5).astype(np.float64)

    def _places(self, time_s: float) -> Float64Array:
        if self.actor is None:
            return self.places
        to_world = self.actor.trajectory.at(time_s).to_world()
        return np.asarray(self.places @ to_world[:, :3].T + to_world[:, 3])


def make_beacons(actor: Actor, colour: Colour | None) -> BodyLights:
    """Two lights on top that flash in turn: blue on some vehicles, amber on others."""
    model = actor.model
    side, top = 0.22 * model.width, lowest_m(actor) + model.height
    places = np.array([[0.0, side, top], [0.0, -side, top]])
    usual = _BLUE if actor.noun.name in nouns_with("blue beacon") else _AMBER
    size = 0.07 * min(model.width, model.height)
    phase = np.array([0.0, 0.5])
    hues = np.tile(colour or usual, (2, 1))
    return BodyLights(actor, places, phase, hues, size, _BEACON_HZ, intensity=6.0)


def make_turn_signals(actor: Actor, *, both: bool) -> BodyLights:
    """Amber lights at the corners of a vehicle: on one side, or on both."""
    model = actor.model
    x, y = 0.49 * model.length, 0.42 * model.width
    z = lowest_m(actor) + 0.42 * model.height
    sides = (1.0, -1.0) if both else (-1.0,)
    corners = np.array([[way * x, side * y, z] for side in sides for way in (1.0, -1.0)])
    hues = np.tile(_AMBER, (len(corners), 1))
    size = 0.05 * min(model.width, model.height)
    return BodyLights(actor, corners, np.zeros(len(corners)), hues, size, _SIGNAL_HZ, intensity=0.5)


def make_string(
    actor: Actor | None, place: Float64Array, side: Float64Array, reach_m: float,
    colour: Colour | None,
) -> BodyLights:  # fmt: skip
    """A string of lights that winds around a body, or hangs in two bows.

    Args:
        actor: the body; None = it hangs in the air.
        place: [3] middle of where it hangs, m.
        side: [3] horizontal unit vector along which it hangs.
        reach_m: its length in the air, m.
        colour: of all lights; None = of several colours.
    """
    share = (np.arange(_BULBS) + 0.5) / _BULBS
    phase = np.mod(0.25 * np.arange(_BULBS), 1.0)
    hues = np.array([colour or _STRING[k % len(_STRING)] for k in range(_BULBS)])
    if actor is None:
        drop = np.abs(np.sin(2.0 * math.pi * share)) * 0.10 * reach_m
        places = place + np.outer(reach_m * (share - 0.5), side) - np.outer(drop, [0.0, 0.0, 1.0])
        return BodyLights(None, places, phase, hues, 0.010 * reach_m, _STRING_HZ, glow=1.3)
    model = actor.model
    angle = 2.0 * math.pi * _WINDINGS * share
    tapers = actor.noun.name in nouns_with("tapers upwards")
    out = 0.49 * (1.06 - share) if tapers else np.full(_BULBS, 0.54)
    x, y = out * model.length * np.cos(angle), out * model.width * np.sin(angle)
    places = np.stack([x, y, lowest_m(actor) + model.height * (0.16 + 0.8 * share)], axis=1)
    size = 0.019 * float(np.cbrt(model.length * model.width * model.height))
    return BodyLights(actor, places, phase, hues, size, _STRING_HZ, glow=1.3)


def lowest_m(actor: Actor) -> float:
    """Height of a body's lowest point above its origin, m."""
    return -0.5 * actor.model.height if actor.is_centred else 0.0

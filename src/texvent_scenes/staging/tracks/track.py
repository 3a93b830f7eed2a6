"""Tracks: the place, heading and activity of a body over time, as keys.

Terms add constants, drifts and sines to single channels, and an anchor lets another body carry the
track.

Angles are radians, positions metres in world coordinates (x right, y away, z up), times seconds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from texvent_scenes.models.activities import TIMED
from texvent_scenes.models.shapes import affine, compose, point, shift
from texvent_scenes.models.shapes import rotation as about
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.tracks.keys import (
    Key,
    Knot,
    Vector,
    advance,
    hop_of,
    turn_round,
)

Grips = tuple[tuple[str, Vector], ...]
TO_CAMERA = -0.5 * math.pi
"""Yaw of what shows its front to the camera."""
_SAMPLES = 41
_KEPT = 512


@dataclass(frozen=True)
class BodyState:
    """A body at one instant."""

    position: Vector
    """World position of the body's origin before it is turned about its pivot, m."""
    yaw: float = 0.0
    """Turn about the vertical, from +x towards +y."""
    pitch: float = 0.0
    """Turn about its own y axis: positive puts the nose down."""
    roll: float = 0.0
    """Turn about its own x axis."""
    distance_m: float = 0.0
    """Path covered since t = 0, m."""
    speed_m_s: float = 0.0
    activity: str = "move"
    """`Pose.activity`."""
    pivot_m: float = 0.0
    """Height above the body's origin about which it turns, m."""
    act_s: float | None = None
    """`Pose.act_s`."""
    grips: Grips = ()
    """`Pose.grips`."""
    tempo: float = 1.0
    """Rate of its gestures, as a multiple of their usual rate."""
    run_s: float = 0.0
    """Time that is added to that of its parts, s: of what works and rests in turn."""
    scale: float = 1.0
    """Size, as a multiple of that of its model."""

    def with_fields(self, **fields: Any) -> BodyState:
        """The state with other values; several times as fast as `dataclasses.replace`."""
        state = object.__new__(BodyState)
        state.__dict__.update(self.__dict__, **fields)
        return state

    def to_world(self) -> Float64Array:
        """[3, 4] map from body to world coordinates."""
        turn = self.scale * rotation(self.yaw, self.pitch, self.roll)
        pivot = np.array([0.0, 0.0, self.pivot_m])
        offset = np.array(self.position) + pivot - turn @ pivot
        return affine(turn, offset)


def rotation(yaw: float, pitch: float, roll: float) -> Float64Array:
    """[3, 3] rotation: roll about x, then pitch about y, then yaw about z.

    Example:
        >>> rotation(math.pi / 2, 0.0, 0.0).round(6).tolist()[1]
        [1.0, 0.0, 0.0]
    """
    return np.asarray(about("z", yaw) @ about("y", pitch) @ about("x", roll))


_VERTICAL = 1.0 - 1e-9
"""Height of a unit axis that is vertical."""


def state_of(to_world: Float64Array, pivot_m: float = 0.0) -> BodyState:
    """The state whose map from body to world this is ([3, 4], a rotation and an offset)."""
    pitch = math.asin(min(max(-float(to_world[2, 0]), -1.0), 1.0))
    if abs(float(to_world[2, 0])) < _VERTICAL:
        yaw = math.atan2(float(to_world[1, 0]), float(to_world[0, 0]))
        roll = math.atan2(float(to_world[2, 1]), float(to_world[2, 2]))
    else:  # its x axis is vertical: yaw and roll turn about the same line
        yaw, roll = math.atan2(-float(to_world[0, 1]), float(to_world[1, 1])), 0.0
    pivot = np.array([0.0, 0.0, pivot_m])
    place = point(to_world[:, 3] + to_world[:, :3] @ pivot - pivot)
    return BodyState(place, yaw, pitch, roll, activity="stand", pivot_m=pivot_m)


class Term(NamedTuple):
    """A constant, a drift and a sine that are added to one channel."""

    channel: str
    """`BodyState`: "x", "y", "z", "yaw", "pitch", "roll", "tempo", "run_s", "scale"; cameras have
    their own."""
    amplitude: float = 0.0
    rate_hz: float = 0.0
    phase: float = 0.0
    drift: float = 0.0
    """Growth per second."""
    gain: float = 0.0
    """Growth of the drift per second."""
    offset: float = 0.0
    begin_s: float = -math.inf
    end_s: float = math.inf
    """It changes between these instants only."""

    def at(self, time_s: float) -> float:
        """Value at that instant."""
        time_s = min(max(time_s, self.begin_s), self.end_s)
        grown = self.offset + (self.drift + 0.5 * self.gain * time_s) * time_s
        angle = 2.0 * math.pi * self.rate_hz * time_s + self.phase
        return grown + self.amplitude * math.sin(angle)


class Lift(NamedTuple):
    """Height by which a body rises as it leans, so that its lowest point stays as high."""

    channel: str
    """"roll" or "pitch"."""
    angles: tuple[float, ...]
    heights_m: tuple[float, ...]


def add_up(terms: Iterable[Term], time_s: float) -> dict[str, float]:
    """Channel → sum of its terms at that instant."""
    found: dict[str, float] = {}
    for term in terms:
        found[term.channel] = found.get(term.channel, 0.0) + term.at(time_s)
    return found


@dataclass(frozen=True)
class Swing:
    """Turning of a body in the hand that holds it, as its own track has it where it stands."""

    track: Track
    pivot: Vector
    """Point about which it turns, body coordinates, m."""
    is_turned: bool = True
    """Whether it turns itself, not its holder with it."""

    @property
    def is_to_and_fro(self) -> bool:
        """Whether it comes back from its turns, so that two hands can go along."""
        is_turning = any(key.turn_rad_s for key in self.track.keys)
        return not is_turning and not any(one.drift for one in self.track.terms)

    def turned(self, time_s: float) -> Float64Array:
        """[3, 4] map to its body coordinates, from those that it had at rest."""
        if not self.is_turned:
            return shift(0.0, 0.0, 0.0)
        rest = TO_CAMERA if self.track.is_facing else self.track.yaw
        state = self.track.at(time_s)
        about = rotation(rest, 0.0, 0.0).T @ rotation(state.yaw, state.pitch, state.roll)
        pivot = np.array(self.pivot)
        return affine(about, pivot - about @ pivot)

    def looks(self, time_s: float) -> dict[str, Any]:
        """Fields of its state that are its own."""
        state = self.track.at(time_s)
        return {
            name: getattr(state, name) for name in ("activity", "act_s", "tempo", "run_s", "scale")
        }


@dataclass(frozen=True)
class Attachment:
    """Axes that another body carries: its own, those of a named place, or of a part."""

    carrier: Track
    axes: Callable[[float], Float64Array]
    """Instant, s → [3, 4] these axes in the world."""
    offset: Float64Array
    """[3, 4] body coordinates of what is carried, in these axes."""
    swing: Swing | None = None
    """Its own motion, where it is held."""

    def at(self, time_s: float) -> BodyState:
        """State of what is carried."""
        below, offset = self.carrier.at(time_s), self.offset
        if self.swing is not None:
            offset = compose(offset, self.swing.turned(time_s))
        state = state_of(compose(self.axes(time_s), offset))
        fields = {} if self.swing is None else self.swing.looks(time_s)
        return replace(
            state, **({"distance_m": below.distance_m, "speed_m_s": below.speed_m_s} | fields)
        )


@dataclass(frozen=True)
class Track:
    """Keys of a body: before the first it moves straight, after the last it goes on.

    A first key without duration holds the rates at t = 0; else the body starts from rest.
    """

    start: Vector
    """Position at t = 0, m."""
    yaw: float = 0.0
    keys: tuple[Key, ...] = (Key(1.0, activity="stand"),)
    terms: tuple[Term, ...] = ()
    usual_speed_m_s: float = 0.0
    floor_m: float = -math.inf
    """Height of its origin when it rests on the ground, m."""
    radius_m: float = 0.0
    """Radius at which it rolls without sliding, its middle so high above its origin; 0 = none."""
    pivot_m: float = 0.0
    """`BodyState.pivot_m` of what does not roll."""
    edge_m: float = 0.0
    """From its middle to the edge about which it falls over, on which it then lies."""
    is_facing: bool = False
    """Whether it shows its front to the camera all along."""
    is_upright: bool = False
    """Whether it stays upright on a slope: a body on two legs."""
    anchor: Attachment | None = None
    """Carries it from `grab_s` up to `release_s`."""
    grab_s: float = -math.inf
    release_s: float = math.inf
    activity: str | None = None
    """Takes the place of those of the keys."""
    grips: Grips = ()
    grips_turn: Callable[[float], Float64Array] | None = None
    """Instant, s → [3, 4] where what is gripped has taken the places of the hands."""
    contact_s: float | None = None
    """Instant of contact of a single act, s."""
    lifts: tuple[Lift, ...] = ()
    """Heights by which leaning raises it, so that it stays on what it stands on."""

    @property
    def duration_s(self) -> float:
        """Sum of its keys."""
        return self._knots[-1].time_s

    @property
    def is_resting(self) -> bool:
        """Whether nothing but its limbs moves."""
        is_still = not any(any(key.rates) or key.hop_m or key.restitution for key in self.keys)
        own = {one.channel for one in self.terms} - {"tempo", "run_s"}
        return is_still and self.anchor is None and not own

    @cached_property
    def _knots(self) -> list[Knot]:
        knot = Knot(0.0, self.start, self.yaw, 0.0, (0.0, 0.0, 0.0, 0.0))
        knots = [knot]
        for key in self.keys:
            knot = advance(knot, key, key.duration_s, self.floor_m)
            knots.append(knot)
        return knots

    @cached_property
    def _states(self) -> dict[float, BodyState]:
        """The last states that were asked for: cameras and checks ask for the same ones often."""
        return {}

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        found = self._states.get(time_s)
        if found is None:
            if len(self._states) >= _KEPT:
                self._states.clear()
            found = self._states[time_s] = self._state(time_s)
        return found

    def _state(self, time_s: float) -> BodyState:
        if self.anchor is not None and self.grab_s <= time_s < self.release_s:
            state = self.anchor.at(time_s)
        else:
            state = self._add_terms(self._follow_keys(time_s), time_s)
        return state.with_fields(
            activity=self.activity or state.activity,
            grips=self._gripped(time_s),
            act_s=state.act_s if self.contact_s is None else time_s - self.contact_s,
        )

    def _gripped(self, time_s: float) -> Grips:
        if self.grips_turn is None:
            return self.grips
        turn = self.grips_turn(time_s)
        return tuple((name, point(turn @ [*place, 1.0])) for name, place in self.grips)

    def _follow_keys(self, time_s: float) -> BodyState:
        knot, key, elapsed = self._find(time_s)
        now = advance(knot, key, elapsed, self.floor_m)
        speed, _, climb, pitch = now.rates
        (x, y, height), act_s = now.place, None
        if key.hop_m > 0.0 and 0.0 <= elapsed <= key.duration_s:
            hop, act_s = hop_of(key, elapsed)
            height += hop
        act_s = elapsed / min(key.duration_s or 1.0, 1.0) if key.activity in TIMED else act_s
        height += self.edge_m * abs(math.sin(pitch))
        slow = 0.3 * max(self.usual_speed_m_s, 0.1)
        if not self.is_upright:
            pitch -= math.atan(climb * abs(speed) / (speed**2 + slow**2))
        pitch = now.distance_m / self.radius_m if self.radius_m else pitch
        return BodyState(
            (x, y, height),
            TO_CAMERA if self.is_facing else now.heading + turn_round(key, elapsed),
            0.0 if self.is_facing else pitch,
            distance_m=now.distance_m,
            speed_m_s=math.hypot(speed, climb) if key.activity == "climb" else abs(speed),
            activity=key.activity,
            pivot_m=self.radius_m or self.pivot_m,
            act_s=act_s,
        )

    def _add_terms(self, state: BodyState, time_s: float) -> BodyState:
        if not self.terms:
            return state
        added = add_up(self.terms, time_s)
        x, y, z = (
            value + added.pop(axis, 0.0) for axis, value in zip("xyz", state.position, strict=True)
        )
        z += sum(
            float(np.interp(added.get(one.channel, 0.0), one.angles, one.heights_m))
            for one in self.lifts
        )
        others = {name: getattr(state, name) + value for name, value in added.items()}
        return state.with_fields(position=(x, y, z), **others)

    def _find(self, time_s: float) -> tuple[Knot, Key, float]:
        """The key that holds an instant: its beginning, itself, and time in it."""
        knots, first, last = self._knots, self.keys[0], len(self.keys) - 1
        if time_s < 0.0 and not first.duration_s:
            coasting = replace(first, duration_s=1.0, turn_rad_s=0.0)
            return knots[0]._replace(rates=coasting.rates), coasting, time_s
        number = next((n for n in range(last) if time_s < knots[n + 1].time_s), last)
        return knots[number], self.keys[number], time_s - knots[number].time_s


def steady(
    start: Vector, yaw: float, speed_m_s: float = 0.0, *, turn_rad_s: float = 0.0,
    climb: float = 0.0, activity: str = "move",
) -> Track:  # fmt: skip
    """Rest, a straight line or a circle; `climb` is metres up per metre along."""
    key = Key(1.0, speed_m_s, turn_rad_s, climb * speed_m_s, ramp_s=0.0, activity=activity)
    return Track(start, yaw, (replace(key, duration_s=0.0), key))


def ballistic(
    start: Vector, yaw: float, speed_m_s: float = 0.0, up_m_s: float = 0.0, *,
    floor_m: float, restitution: float, wait_s: float = 0.0,
) -> Track:  # fmt: skip
    """Free flight with bounces on a floor; what waits is flung off at once.

    Args:
        start: where it is before the flight, m.
        yaw: heading of the flight.
        speed_m_s: along the heading, all along.
        up_m_s: upward, as the flight begins.
        floor_m: height of its origin on the floor, m.
        restitution: share of the upward speed that each bounce keeps.
        wait_s: time at the start before the flight, s.
    """
    flight = Key(1.0, speed_m_s, climb_m_s=up_m_s, restitution=restitution)
    first = Key(wait_s) if wait_s else Key(0.0, speed_m_s)
    flight = replace(flight, ramp_s=0.0) if wait_s else flight
    return Track(start, yaw, (first, flight), floor_m=floor_m)


def attached(
    carrier: Track, offset: Float64Array, activity: str = "stand",
    axes: Callable[[float], Float64Array] | None = None, swing: Swing | None = None,
) -> Track:  # fmt: skip
    """A track fixed to axes that a body carries, else to its own: `offset` [3, 4] is in them.

    What swings there has activities of its own.
    """
    axes = axes or (lambda time_s: carrier.at(time_s).to_world())
    anchor = Attachment(carrier, axes, offset, swing)
    own = activity if swing is None else None
    return Track((0.0, 0.0, 0.0), anchor=anchor, activity=own)


def seated(carrier: Track, seat: Vector, activity: str) -> Track:
    """A track fixed to a point in the carrier's body coordinates, m."""
    return attached(carrier, shift(*seat), activity)


def lifted(track: Track, by_m: float) -> Track:
    """The track, and the floor below it, so much higher."""
    x, y, z = track.start
    return replace(track, start=(x, y, z + by_m), floor_m=track.floor_m + by_m)


def sample_places(track: Track, duration_s: float) -> np.ndarray:
    """[n, 3] places along a track over the clip, m."""
    times = np.linspace(0.0, duration_s, _SAMPLES)
    return np.array([track.at(float(time)).position for time in times])


def centred(track: Track, duration_s: float) -> Track:
    """The same track with its box over (0, 0)."""
    places = sample_places(track, duration_s)
    middle = 0.5 * (places.min(axis=0) + places.max(axis=0))
    return replace(track, start=(-float(middle[0]), -float(middle[1]), track.start[2]))

"""Trails: tracks of bodies that go along the way of another one, behind it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.tracks.track import BodyState, Track

_PER_S = 240
"""Instants per second at which the way of the leader is known; between them it is straight."""
_LEAST_M = 1e-6
_NOWHERE = Track((0.0, 0.0, 0.0))
_SLOPE_S = 1e-3
"""Half of the time over which a speed is measured, s."""


@dataclass(frozen=True)
class Way:
    """A way over the ground, by the distance gone along it."""

    gone_m: Float64Array
    """[n] rising, m."""
    places: Float64Array
    """[n, 3] m; it is straight before the first and after the last."""

    def at(self, gone_m: float) -> Float64Array:
        """[3] the place after so much of it."""
        low, high = self.gone_m[0], self.gone_m[-1]
        inside = min(max(gone_m, low), high)
        place = np.array([np.interp(inside, self.gone_m, axis) for axis in self.places.T])
        if gone_m != inside:
            ends = (0, 1) if gone_m < low else (-2, -1)
            step = self.places[ends[1]] - self.places[ends[0]]
            length = self.gone_m[ends[1]] - self.gone_m[ends[0]]
            place = place + (gone_m - inside) / max(float(length), _LEAST_M) * step
        return np.asarray(place)


def trace(track: Track, duration_s: float) -> tuple[Float64Array, Float64Array, Float64Array]:
    """Instants [n], s, a little beyond the clip too; distance gone [n], m; places [n, 3]."""
    count = max(math.ceil(_PER_S * duration_s), 2)
    times = np.linspace(0.0, 1.05 * duration_s, count + 1)
    places = np.array([track.at(float(at)).position for at in times])
    steps = np.linalg.norm(np.diff(places[:, :2], axis=0), axis=1)
    return times, np.concatenate([[0.0], np.cumsum(steps)]), places


@dataclass(frozen=True)
class Trail(Track):
    """The track of who follows: straight to where its leader begins, and along its way.

    What its limbs do is by its own keys.
    """

    leader: Track = _NOWHERE
    span_s: float = 1.0
    """Length of the clip, s."""
    length_m: float = 1.0
    """Its own length, over which it bends round corners."""
    is_aloft: bool = False
    """Whether it rises and sinks on the way too."""
    most_m: float | None = None
    """Most of its distance behind at the start that it may catch up; None: it goes as far as its
    leader does."""

    @cached_property
    def _led(self) -> tuple[Float64Array, Float64Array, Float64Array]:
        return trace(self.leader, self.span_s)

    @cached_property
    def _way(self) -> Way:
        _, gone, places = self._led
        start = np.array(super()._state(0.0).position)
        first = float(np.linalg.norm((places[0] - start)[:2]))
        gone, places = np.concatenate([[0.0], first + gone]), np.vstack([start, places])
        is_new = np.concatenate([[True], np.diff(gone) > _LEAST_M])
        return Way(gone[is_new], places[is_new])

    def _gone(self, time_s: float) -> float:
        """Distance that it has gone, m."""
        times, gone, _ = self._led
        led = float(np.interp(time_s, times, gone)) if time_s > 0.0 else 0.0
        if self.most_m is None:
            return led
        return min(super()._state(time_s).distance_m, led + self.most_m)

    def _state(self, time_s: float) -> BodyState:
        state, gone = super()._state(time_s), self._gone(time_s)
        x, y, z = self._way.at(gone)
        ahead = self._way.at(gone + 0.5 * self.length_m) - self._way.at(gone - 0.5 * self.length_m)
        speed = (self._gone(time_s + _SLOPE_S) - self._gone(time_s - _SLOPE_S)) / (2.0 * _SLOPE_S)
        return state.with_fields(
            position=(float(x), float(y), float(z) if self.is_aloft else state.position[2]),
            yaw=state.yaw if self.is_facing else math.atan2(float(ahead[1]), float(ahead[0])),
            pitch=gone / self.radius_m if self.radius_m else state.pitch,
            distance_m=gone,
            speed_m_s=speed,
        )

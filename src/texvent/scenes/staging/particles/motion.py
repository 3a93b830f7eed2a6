"""How particles are born and move: closed forms of time, so that any instant can be drawn."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor

GRAVITY = 9.81
_STEP_S = 5e-3
GENERATIONS = 16
"""Lives of a particle that differ; then they repeat."""


@dataclass(frozen=True)
class Source:
    """The point that particles come from: on an object, or fixed."""

    size_m: float
    """What lengths of the effect are multiples of."""
    fixed: Float64Array
    """[3] the point, m, where there is no object; else in the object's body coordinates."""
    actor: Actor | None = None

    @property
    def extents_m(self) -> Float64Array:
        """[3] length, width and height of the object, m; where there is none, a cube's."""
        if self.actor is None:
            return np.full(3, self.size_m)
        model = self.actor.model
        return np.array([model.length, model.width, model.height])

    def velocity(self, time_s: float) -> Float64Array:
        """[3] of the point just before a time, m/s; of what falls to the ground 0 downwards."""
        before, now = self.at(np.array([time_s - _STEP_S, time_s]))
        found = (now - before) / _STEP_S
        found[2] = max(found[2], 0.0)
        return np.asarray(found)

    def at(self, times_s: Float64Array) -> Float64Array:
        """[n, 3] where the point is at [n] times, m."""
        if self.actor is None:
            return np.tile(self.fixed, (len(times_s), 1))
        maps = [self.actor.trajectory.at(float(time)).to_world() for time in times_s]
        return np.array([one[:, :3] @ self.fixed + one[:, 3] for one in maps]).reshape(-1, 3)

    def turn(self, time_s: float) -> Float64Array:
        """[3, 3] axes of the object; of the world where there is none."""
        if self.actor is None:
            return np.eye(3)
        return np.asarray(self.actor.trajectory.at(time_s).to_world()[:, :3])


@dataclass(frozen=True)
class Lives:
    """Particles that are born one after the other, live, and are born again; or live once."""

    draws: Float64Array
    """[n, GENERATIONS, 8] in 0..1; the last one is never a new draw: when it is first born."""
    life_s: float
    once_at_s: float | None = None
    """When all are born, once; None = they are born at even steps of time."""

    @classmethod
    def of(
        cls, count: int, life_s: float, rng: np.random.Generator, once_at_s: float | None = None,
        salvo: float | None = None,
    ) -> Lives:  # fmt: skip
        """`count` particles; those of a `salvo` have one place, and that age at time 0."""
        draws = rng.uniform(size=(count, GENERATIONS, 8))
        draws[:, :, 7] = ((np.arange(count) + 0.5) / count)[:, None]
        if salvo is not None:
            draws[:, :, 3:7], draws[:, :, 7] = draws[:1, :, 3:7], salvo
        return cls(draws, life_s, once_at_s)

    def at(self, time_s: float) -> tuple[Float64Array, Float64Array]:
        """Age of each particle, [n] in 0..1 of its life, and its draws in this life, [n, 8].

        Of those that live once, it is below 0 before and above 1 after.
        """
        if self.once_at_s is not None:
            age = (time_s - self.once_at_s) / self.life_s
            return np.full(len(self.draws), age), self.draws[:, 0]
        cycles = time_s / self.life_s + self.draws[:, 0, 7]
        number = np.floor(cycles)
        rows = np.arange(len(cycles))
        return cycles - number, self.draws[rows, number.astype(np.int64) % GENERATIONS]


def flight(
    age_s: Float64Array, velocity: Float64Array, drag_s: float, pull: Float64Array
) -> tuple[Float64Array, Float64Array]:
    """Ways [n, 3], m, and velocities [n, 3], m/s, of bodies with linear drag.

    Args:
        age_s: [n] since they started, s.
        velocity: [n, 3] at the start, m/s.
        drag_s: time in which drag takes all but 37 % of a velocity, s; inf = no drag.
        pull: [3] constant acceleration, such as gravity, m/s².

    Solution of dv/dt = pull - v / drag.
    """
    age = age_s[:, None]
    if math.isinf(drag_s):
        return velocity * age + 0.5 * pull * age * age, velocity + pull * age
    left, final = np.exp(-age / drag_s), pull * drag_s
    way = final * age + (velocity - final) * drag_s * (1.0 - left)
    return way, final + (velocity - final) * left


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

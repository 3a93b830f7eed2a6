"""The moving water of a waterfall: streaks that fall ever faster, and foam where they land."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import Float64Array, Primitives, Shape
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.particles.shapes import SolidEffect, many_shapes

_STREAKS, _FOAM = 70, 14
_FALL_S = 1.1
_TALL, _WIDE = 6.0, 2.6
"""Height and width of the fall, in metres of the model at its usual size."""
_COLOURS = np.array([(0.70, 0.80, 0.86), (0.88, 0.92, 0.95), (0.90, 0.93, 0.95)])


@dataclass(frozen=True)
class FallingWater(SolidEffect):
    """Water of one waterfall."""

    actor: Actor
    draws: Float64Array
    """[n, 3] in 0..1."""

    @classmethod
    def of(cls, actor: Actor, rng: np.random.Generator) -> FallingWater:
        """The water of that waterfall."""
        return cls(actor, rng.uniform(size=(_STREAKS + _FOAM, 3)))

    def at(self, time_s: float) -> Primitives:
        """All streaks and all foam at that instant."""
        places, half = self._streaks(time_s)
        foam, size = self._foam(time_s)
        local, half = np.concatenate([places, foam]), np.concatenate([half, size])
        scale = self.actor.model.height / _TALL
        to_world = self.actor.trajectory.at(time_s).to_world()
        maps = np.zeros((len(local), 3, 4))
        maps[:, :, :3] = to_world[:, :3] * (scale * half)[:, None, :]
        maps[:, :, 3] = (scale * local) @ to_world[:, :3].T + to_world[:, 3]
        kinds = np.concatenate([np.arange(_STREAKS) % 2, np.full(_FOAM, 2)])
        return many_shapes(maps, Shape.ELLIPSOID, _COLOURS[kinds])

    def _streaks(self, time_s: float) -> tuple[Float64Array, Float64Array]:
        """[n, 3] places and half extents, m."""
        draws = self.draws[:_STREAKS]
        share = np.mod(time_s / _FALL_S + draws[:, 0], 1.0)
        long = 0.18 + 0.45 * share
        z = np.maximum(_TALL * (1.0 - share * (0.45 + 0.55 * share)), long)
        x = -0.06 + 0.45 * np.sqrt(share) * (0.6 + 0.4 * draws[:, 1])
        y = _WIDE * (draws[:, 2] - 0.5)
        thin = np.full(_STREAKS, 0.045)
        return np.stack([x, y, z], axis=1), np.stack([thin, 1.5 * thin, long], axis=1)

    def _foam(self, time_s: float) -> tuple[Float64Array, Float64Array]:
        """[n, 3] places and half extents, m."""
        draws = self.draws[_STREAKS:]
        beat = np.mod(1.7 * time_s + draws[:, 0], 1.0)
        z = 0.08 + 0.35 * np.sin(math.pi * beat)
        places = np.stack([0.55 + 0.9 * beat, 1.15 * _WIDE * (draws[:, 1] - 0.5), z], axis=1)
        size = (0.12 + 0.28 * beat) * np.minimum(1.0, 6.0 * (1.0 - beat)) + 1e-3
        return places, np.stack([size, size, 0.5 * size], axis=1)

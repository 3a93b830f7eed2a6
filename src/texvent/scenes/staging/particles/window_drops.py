"""Rain on a window: drops that cling to the pane, and some that run down it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import Float64Array, Primitives, Shape
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.particles.motion import Lives
from texvent.scenes.staging.particles.shapes import TINY_M, SolidEffect, many_shapes

_STILL, _RUNNING = 90, 30
_LOW, _HIGH, _HALF_WIDTH = 0.32, 0.88, 0.29
"""Pane of a window: its lower and upper end in heights, half its width in widths."""


@dataclass(frozen=True)
class WindowDrops(SolidEffect):
    """Drops on the pane of a window."""

    actor: Actor
    still: Float64Array
    """[n, 3] in 0..1: where drops cling, and how large they are."""
    lives: Lives

    @classmethod
    def of(cls, actor: Actor, rng: np.random.Generator) -> WindowDrops:
        """Drops on that window."""
        return cls(actor, rng.uniform(size=(_STILL, 3)), Lives.of(_RUNNING, 1.3, rng))

    def at(self, time_s: float) -> Primitives:
        """All drops at that instant."""
        model = self.actor.model
        age, draws = self.lives.at(time_s)
        across = np.concatenate([self.still[:, 0], draws[:, 0]])
        fallen = 1.0 - age * (0.35 + 0.65 * age) * (0.5 + 0.5 * draws[:, 1])
        up = np.concatenate([self.still[:, 1], np.maximum(fallen, 0.0)])
        size = (
            0.006
            * model.height
            * np.concatenate([0.5 + 0.9 * self.still[:, 2], 0.9 + 0.8 * draws[:, 2]])
        )
        tall = size * np.concatenate([np.ones(_STILL), 2.2 + 3.0 * age])
        low = -0.5 * model.height if self.actor.is_centred else 0.0
        local = np.stack(
            [
                np.full(len(up), 0.10 * model.length),
                model.width * _HALF_WIDTH * (2.0 * across - 1.0),
                low + model.height * (_LOW + (_HIGH - _LOW) * up),
            ],
            axis=1,
        )
        to_world = self.actor.trajectory.at(time_s).to_world()
        half = np.maximum(np.stack([0.4 * size, size, tall], axis=1), TINY_M)
        maps = np.zeros((len(up), 3, 4))
        maps[:, :, :3] = to_world[:, :3][None] * half[:, None, :]
        maps[:, :, 3] = local @ to_world[:, :3].T + to_world[:, 3]
        return many_shapes(maps, Shape.ELLIPSOID, (0.80, 0.87, 0.93))

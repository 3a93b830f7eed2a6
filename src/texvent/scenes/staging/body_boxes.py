"""Bodies as the staged scene has them at an instant: boxes of their parts, gaps between them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.scene import Float64Array, Shape
from texvent.scenes.staging.actors import Actor


class Boxes(NamedTuple):
    """Boxes around the parts of a body, along the world's axes, m."""

    low: Float64Array
    """[k, 3] least corners."""
    high: Float64Array
    """[k, 3] greatest corners."""

    @property
    def hull(self) -> tuple[Float64Array, Float64Array]:
        """Least and greatest corner [3] of all."""
        return self.low.min(axis=0), self.high.max(axis=0)


def part_boxes(actor: Actor, time_s: float) -> Boxes:
    """Boxes of an actor's parts and of what its activity needs; its rope or string is no part."""
    parts = own_parts(actor, time_s)
    to_world = actor.trajectory.at(time_s).to_world()
    return boxes_of(parts, to_world)


def own_parts(actor: Actor, time_s: float) -> list[ModelPart]:
    """The parts of an actor's model and props at an instant, body coordinates."""
    return actor.own_parts(actor.pose(time_s))


def boxes_of(parts: Sequence[ModelPart], to_world: Float64Array) -> Boxes:
    """Boxes of unit shapes in the world; those of cones are those of the cylinders around them.

    Args:
        parts: shapes in body coordinates.
        to_world: [3, 4] body → world.
    """
    to_body = np.array([part.to_body for part in parts], dtype=np.float64).reshape(-1, 3, 4)
    shape = np.array([part.shape for part in parts], dtype=np.int64)[:, None]
    linear = to_world[:, :3] @ to_body[:, :, :3]
    middle = to_body[:, :, 3] @ to_world[:, :3].T + to_world[:, 3]
    square = np.abs(linear).sum(axis=2)
    ball = np.linalg.norm(linear, axis=2)
    tube = np.hypot(linear[:, :, 0], linear[:, :, 1]) + np.abs(linear[:, :, 2])
    is_square = (shape == Shape.BOX) | (shape == Shape.MESH)
    reach = np.where(is_square, square, np.where(shape == Shape.ELLIPSOID, ball, tube))
    return Boxes(middle - reach, middle + reach)


def gap(first: Boxes, second: Boxes) -> float:
    """Least distance between a part of one body and a part of another, by their boxes, m."""
    apart = np.maximum(
        first.low[:, None] - second.high[None], second.low[None] - first.high[:, None]
    )
    return float(np.linalg.norm(np.maximum(apart, 0.0), axis=2).min())

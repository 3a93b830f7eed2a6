"""A closed box as an open one: a floor, four walls and flaps that hang out."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.models.articulated_model import STANDING_POSES
from texvent.scenes.models.materials import Material
from texvent.scenes.models.protocol import Model, ModelPart, Pose
from texvent.scenes.models.shapes import Point, box, moved, turn_x, turn_y
from texvent.scenes.models.wrapped_model import WrappedModel

HOLLOW = frozenset({"box"})
"""Nouns of closed boxes in which something can be."""
_CARD = Material((0.38, 0.23, 0.11))
_THICK = 0.04
"""Thickness of walls, as a share of the length."""
_FLAP, _TILT = 0.4, math.radians(35.0)
"""Length of flaps, as a share of the side that they hang from, and how far they hang down."""


class HollowModel(WrappedModel):
    """Walls with the surface of the first part of a model, which fills it."""

    def __init__(self, model: Model) -> None:
        super().__init__(model)
        self._skin = model.parts(STANDING_POSES[0])[0]
        self._walls = self._build()

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The same shapes at every pose."""
        return self._walls

    def _slab(self, centre: Point, size: Point) -> ModelPart:
        shape = box(_CARD, centre, size)
        return replace(self._skin, shape=shape.shape, to_body=shape.to_body)

    def _build(self) -> list[ModelPart]:
        long, wide, high = self.length, self.width, self.height
        thin = _THICK * long
        parts = [self._slab((0.0, 0.0, 0.5 * thin), (long, wide, thin))]
        for side in (1.0, -1.0):
            x, y = side * 0.5 * (long - thin), side * 0.5 * (wide - thin)
            parts.append(self._slab((x, 0.0, 0.5 * high), (thin, wide, high)))
            parts.append(self._slab((0.0, y, 0.5 * high), (long, thin, high)))
            out, down = _FLAP * long, side * _TILT
            leaf = self._slab((x + 0.5 * side * out, 0.0, high), (out, 0.96 * wide, 0.5 * thin))
            parts += moved([leaf], turn_y(down, (x, 0.0, high)))
            out = _FLAP * wide
            leaf = self._slab((0.0, y + 0.5 * side * out, high), (0.96 * long, out, 0.5 * thin))
            parts += moved([leaf], turn_x(-down, (0.0, y, high)))
        return parts

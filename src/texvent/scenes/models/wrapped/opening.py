"""A model whose door, drawer or lid opens or closes, once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from texvent.scenes.models.articulated_model import STANDING_POSES
from texvent.scenes.models.materials import Material, shade
from texvent.scenes.models.people.timing import ease
from texvent.scenes.models.protocol import Model, ModelPart, Pose
from texvent.scenes.models.shapes import Affine, Point, box, compose, shift, turn_y, turn_z
from texvent.scenes.models.wrapped.hanging import hanging
from texvent.scenes.models.wrapped.pulsing import pulsing
from texvent.scenes.models.wrapped_model import WrappedModel

OPENING: Mapping[str, str] = MappingProxyType(
    {
        "door": "own leaf",
        "refrigerator": "door",
        "wardrobe": "door",
        "microwave": "door",
        "safe": "door",
        "oven": "flap",
        "chest of drawers": "drawer",
        "chest": "lid",
        "box": "lid",
        "gift": "lid",
        "laptop": "own screen",
    }
)
"""Noun → what of it opens."""
OPENS = frozenset({"open", "close", "open and close", "close and open"})
"""Motions of these."""
_START_S, _STOP_S = 0.3, 1.5
_THERE_S, _BACK_S = (0.1, 0.8), (1.15, 1.85)
"""When what does both, one after the other, does the first and the second, s."""
_LEAF_SHADE = 0.78
"""Brightness of a leaf that is added, of the model's own."""
_INSIDE = Material((0.04, 0.035, 0.03))
_CLOSED_S = 3.5045
"""When a door that swings to and fro is shut, s."""
_Move = Callable[[float], Affine]
"""How far it is open, 0..1 → the map of what moves, in body coordinates."""


class OpeningModel(WrappedModel):
    """A model with a leaf that moves; all else is the model's own.

    Args:
        model: a model of the noun.
        noun: key of `OPENING`.
    """

    def __init__(self, model: Model, noun: str) -> None:
        super().__init__(model)
        self._kind = OPENING[noun]
        if self._kind == "lid":
            self.height += 0.9 * self.length
        parts = self._rest()
        self._skin = max(parts, key=lambda one: abs(float(np.linalg.det(one.to_body[:, :3]))))
        self._own = self._find_own(parts)
        self._leaf, self._fixed, self._move = self._build()

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose."""
        share = 0.0
        if pose.activity in OPENS:
            share = ease(pose.time_s, _START_S, _STOP_S)
            if " and " in pose.activity:
                share = ease(pose.time_s, *_THERE_S) - ease(pose.time_s, *_BACK_S)
            share = share if pose.activity.startswith("open") else 1.0 - share
        turn = self._move(share)
        rest = [
            part.at(compose(turn, part.to_body)) if index in self._own else part
            for index, part in enumerate(self._rest())
        ]
        return [*rest, *self._fixed, *(part.at(compose(turn, part.to_body)) for part in self._leaf)]

    def _rest(self) -> Sequence[ModelPart]:
        return self._model.parts(Pose(_CLOSED_S, 0.0, 0.0, "stand"))

    def _find_own(self, parts: Sequence[ModelPart]) -> frozenset[int]:
        """Parts of the model that are the leaf: those that swing, or a screen."""
        if self._kind == "own screen":
            low = 0.12 * self.height
            return frozenset(n for n, one in enumerate(parts) if one.to_body[2, 3] > low)
        if self._kind != "own leaf":
            return frozenset()
        drawn = [self._model.parts(pose) for pose in STANDING_POSES]
        return frozenset(
            n for n in range(len(parts))
            if any(not np.allclose(one[n].to_body, drawn[0][n].to_body) for one in drawn)
        )  # fmt: skip

    def _slab(self, centre: Point, size: Point) -> ModelPart:
        """A box with the surface of the model's largest part."""
        shape = box(_INSIDE, centre, size)
        colour = shade(self._skin.colour, _LEAF_SHADE)
        return replace(self._skin, shape=shape.shape, to_body=shape.to_body, colour=colour)

    def _build(self) -> tuple[list[ModelPart], list[ModelPart], _Move]:
        """The leaf that is added, what is seen inside, and how the leaf moves."""
        x, wide, high = 0.5 * self.length, self.width, self._model.height
        if self._kind == "own leaf":
            return [], [], lambda share: turn_z(-1.25 * share, (0.0, 0.43 * high / 2.12, 0.0))
        if self._kind == "own screen":
            pivot = (-0.44 * self.length, 0.0, 0.08 * high)
            return [], [], lambda share: turn_y(1.75 * (1.0 - share), pivot)
        if self._kind == "door":
            leaf = self._slab((x + 0.02, 0.0, 0.5 * high), (0.04, 0.94 * wide, 0.92 * high))
            inside = box(_INSIDE, (x, 0.0, 0.5 * high), (0.012, 0.86 * wide, 0.84 * high))
            return [leaf], [inside], lambda share: turn_z(1.75 * share, (x, 0.47 * wide, 0.0))
        if self._kind == "flap":
            leaf = self._slab((x + 0.02, 0.0, 0.46 * high), (0.04, 0.92 * wide, 0.62 * high))
            inside = box(_INSIDE, (x, 0.0, 0.46 * high), (0.012, 0.84 * wide, 0.54 * high))
            return [leaf], [inside], lambda share: turn_y(1.45 * share, (x, 0.0, 0.15 * high))
        if self._kind == "drawer":
            z, tall, out = 0.64 * high, 0.24 * high, 0.75 * self.length
            leaf = self._slab((x + 0.015, 0.0, z), (0.03, 0.86 * wide, tall))
            tray = box(_INSIDE, (x - 0.5 * out, 0.0, z - 0.02), (out, 0.78 * wide, 0.8 * tall))
            return [leaf, tray], [], lambda share: shift(x=out * share)
        leaf = self._slab((0.0, 0.0, high + 0.012), (self.length, wide, 0.03))
        inside = box(_INSIDE, (0.0, 0.0, high), (0.88 * self.length, 0.88 * wide, 0.012))
        return [leaf], [inside], lambda share: turn_y(-1.9 * share, (-x, 0.0, high))


def opens_after(before: str | None, kind: str) -> str:
    """The motion of what does one after the other, as in "opens and closes"."""
    both = f"{before} and {kind}"
    return both if both in OPENS else kind


def opening(models: list[Model], noun: str, kinds: set[str]) -> list[Model]:
    """The models with a leaf that moves, that beat, or hang, where the prompt says that they do."""
    models = hanging(pulsing(models, kinds), kinds)
    if noun not in OPENING or not kinds & OPENS:
        return models
    return [OpeningModel(one, noun) for one in models]

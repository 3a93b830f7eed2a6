"""Food that is drawn in a dish of its own, without it: for where the prompt has another dish."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from texvent.scenes.models.articulated_model import STANDING_POSES
from texvent.scenes.models.protocol import Model, ModelPart, Pose
from texvent.scenes.models.shapes import bounds, moved, shift
from texvent.scenes.models.wrapped_model import WrappedModel

OWN_DISH: Mapping[str, int] = MappingProxyType(
    {"noodles": 5, "salad": 6, "soup": 6, "pancake": 2, "steak": 2, "meal": 11}
)
"""Noun of food → how many of the first parts of its model are the plate or bowl."""


class ServedModel(WrappedModel):
    """The food alone, its foot where that of the dish was.

    Args:
        model: a model of the noun.
        noun: key of `OWN_DISH`.
    """

    def __init__(self, model: Model, noun: str) -> None:
        super().__init__(model)
        self._first = OWN_DISH[noun]
        low, high = bounds(model.parts(STANDING_POSES[0])[self._first :])
        self._drop = shift(z=-float(low[2]))
        self.length, self.width, self.height = (float(size) for size in high - low)

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose, without those of the dish."""
        return moved(self._model.parts(pose)[self._first :], self._drop)

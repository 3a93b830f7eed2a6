"""A model without the parts that would keep things out: a pane, a lid, what lies on it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

from texvent.scenes.models.articulated_model import STANDING_POSES
from texvent.scenes.models.protocol import Model, ModelPart, Pose

Box = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]

OPENED: Mapping[str, Box] = MappingProxyType(
    {
        "window": ((-1.0, 1.0), (-0.3, 0.3), (1.0, 1.6)),
        "jar": ((-1.0, 1.0), (-1.0, 1.0), (0.10, 1.0)),
        "conveyor belt": ((-3.0, 3.0), (-0.25, 0.25), (0.69, 2.0)),
    }
)
"""Noun → least and greatest x, y, z of the middles of the parts that are left out, m."""


class OpenedModel:
    """A model without its pane, lid or load; all else is the model's own.

    Args:
        model: a model of the noun.
        noun: key of `OPENED`.
    """

    def __init__(self, model: Model, noun: str) -> None:
        self._model = model
        scale = float(getattr(model, "scale", 1.0))
        box = [(scale * low, scale * high) for low, high in OPENED[noun]]
        drawn = [model.parts(pose) for pose in STANDING_POSES]
        self._left_out = {
            index for parts in drawn for index, part in enumerate(parts) if _is_in(part, box)
        }
        self.length, self.width, self.height = model.length, model.width, model.height

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or name == "_model":
            raise AttributeError(name)
        return getattr(self._model, name)

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose that are left."""
        parts = self._model.parts(pose)
        return [part for index, part in enumerate(parts) if index not in self._left_out]


def _is_in(part: ModelPart, box: Sequence[tuple[float, float]]) -> bool:
    middle = part.to_body[:, 3]
    return all(low < value < high for value, (low, high) in zip(middle, box, strict=True))

"""A model without the parts that would keep things out: a pane, a lid, what lies on it.

The leaf of a gate is swung open instead.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from texvent.scenes.models.articulated_model import STANDING_POSES
from texvent.scenes.models.protocol import Model, ModelPart, Pose
from texvent.scenes.models.shapes import Affine, moved
from texvent.scenes.models.wrapped_model import WrappedModel

Box = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]

OPENED: Mapping[str, Box] = MappingProxyType(
    {
        "window": ((-1.0, 1.0), (-0.3, 0.3), (1.0, 1.6)),
        "jar": ((-1.0, 1.0), (-1.0, 1.0), (0.10, 1.0)),
        "cage": ((-0.05, 0.05), (-0.05, 0.05), (0.2, 0.4)),
        "gate": ((-0.2, 0.2), (-1.5, 1.5), (0.0, 2.1)),
        "conveyor belt": ((-3.0, 3.0), (-0.25, 0.25), (0.69, 2.0)),
    }
)
"""Noun → least and greatest x, y, z of the middles of the parts that are left out, m."""


_HINGES: Mapping[str, float] = MappingProxyType({"gate": 1.45})
"""Noun → y of the upright about which those parts are turned instead, m."""
_SWUNG = math.radians(-78.0)


class OpenedModel(WrappedModel):
    """A model without its pane, lid or load; all else is the model's own.

    Args:
        model: a model of the noun.
        noun: key of `OPENED`.
    """

    def __init__(self, model: Model, noun: str) -> None:
        super().__init__(model)
        scale = float(getattr(model, "scale", 1.0))
        box = [(scale * low, scale * high) for low, high in OPENED[noun]]
        drawn = [model.parts(pose) for pose in STANDING_POSES]
        self._left_out = {
            index for parts in drawn for index, part in enumerate(parts) if _is_in(part, box)
        }
        hinge = _HINGES.get(noun)
        self._swing = None if hinge is None else _about_upright(scale * hinge, _SWUNG)

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose that are left."""
        parts = self._model.parts(pose)
        found = [part for index, part in enumerate(parts) if index not in self._left_out]
        if self._swing is not None:
            found += moved([parts[index] for index in sorted(self._left_out)], self._swing)
        return found


def _about_upright(y: float, angle: float) -> Affine:
    """[3, 4] a turn about the vertical through (0, y), m."""
    cosine, sine = math.cos(angle), math.sin(angle)
    turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    pivot = np.array([0.0, y, 0.0])
    return np.column_stack([turn, pivot - turn @ pivot])


def _is_in(part: ModelPart, box: Sequence[tuple[float, float]]) -> bool:
    middle = part.to_body[:, 3]
    return all(low < value < high for value, (low, high) in zip(middle, box, strict=True))

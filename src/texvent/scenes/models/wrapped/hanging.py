"""A model that hangs from a ceiling: all of it is lifted, with a cord to a piece of the ceiling."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.models.machine_acts import HANG
from texvent.scenes.models.materials import DARK, WHITE, Material
from texvent.scenes.models.protocol import Model, ModelPart, Pose
from texvent.scenes.models.shapes import Point, box, moved, rod, shift
from texvent.scenes.models.wrapped_model import WrappedModel

_CORD_M, _LEAST_M = 0.40, 0.75
"""Length of the cord, and height of what hangs above the floor at least, m."""
_CEILING: Point = (0.9, 0.9, 0.04)


class HangingModel(WrappedModel):
    """A model on a cord below a ceiling; all else is the model's own."""

    def __init__(self, model: Model) -> None:
        super().__init__(model)
        low = -0.5 * model.height if getattr(model, "is_centred", False) else 0.0
        self._lift = _LEAST_M
        top = _LEAST_M + low + model.height
        self.length, self.width = max(model.length, _CEILING[0]), max(model.width, _CEILING[1])
        self.height = top + _CORD_M + _CEILING[2]
        self._rest = (
            rod(DARK, (0.0, 0.0, top - 0.02), (0.0, 0.0, top + _CORD_M), 0.008),
            box(Material(WHITE), (0.0, 0.0, self.height - 0.5 * _CEILING[2]), _CEILING),
        )

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose."""
        return [*moved(self._model.parts(pose), shift(z=self._lift)), *self._rest]


def hanging(models: list[Model], kinds: set[str]) -> list[Model]:
    """The models on cords, where the prompt says that they hang from a ceiling."""
    return [HangingModel(one) for one in models] if HANG in kinds else models

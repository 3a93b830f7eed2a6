"""A model drawn larger than it is: small things that hands work on."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.models.protocol import Model, ModelPart, Pose


class Enlarged:
    """A model times a factor about its origin; a `Model` itself."""

    def __init__(self, model: Model, factor: float) -> None:
        """Keep the model and the factor, 1 = as large as it is."""
        self._model, self._factor = model, factor
        self.length = factor * model.length
        self.width = factor * model.width
        self.height = factor * model.height

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose."""
        return [part.at(self._factor * part.to_body) for part in self._model.parts(pose)]

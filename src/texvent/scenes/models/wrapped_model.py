"""A model that changes some of what another model draws."""

from __future__ import annotations

from typing import Any

from texvent.scenes.models.protocol import Model


class WrappedModel:
    """All that a subclass does not say is the other model's, its size included."""

    def __init__(self, model: Model) -> None:
        """`model` is the one that is changed."""
        self._model = model
        self.length, self.width, self.height = model.length, model.width, model.height

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):  # not yet set, as in a copy that is being made
            raise AttributeError(name)
        return getattr(self._model, name)

"""A model that beats: all of it swells and shrinks about its middle."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from texvent.scenes.models.machine_acts import PULSE
from texvent.scenes.models.protocol import Model, ModelPart, Pose
from texvent.scenes.models.shapes import compose
from texvent.scenes.models.wrapped_model import WrappedModel

_SWELLS = 0.14
"""How much larger it is at a beat, as a share of its size."""
_RATE_HZ = 1.1


class PulsingModel(WrappedModel):
    """A model that swells at each beat; all else is the model's own."""

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose."""
        parts = self._model.parts(pose)
        if pose.activity != PULSE:
            return parts
        size = 1.0 + _SWELLS * math.sin(math.pi * _RATE_HZ * pose.time_s) ** 2
        middle = 0.0 if getattr(self._model, "is_centred", False) else 0.5 * self.height
        shift = np.array([0.0, 0.0, (1.0 - size) * middle])
        swell = np.column_stack([size * np.eye(3), shift])
        return [part.at(compose(swell, part.to_body)) for part in parts]


def pulsing(models: list[Model], kinds: set[str]) -> list[Model]:
    """The models that beat, where the prompt says that they do."""
    return [PulsingModel(one) for one in models] if PULSE in kinds else models

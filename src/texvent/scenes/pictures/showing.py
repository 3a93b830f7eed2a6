"""A model one of whose faces shows a picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from texvent.scenes.description import Picture
from texvent.scenes.models.protocol import Model, ModelPart, Pose
from texvent.scenes.models.shapes import half_extents
from texvent.scenes.models.tables import nouns_with
from texvent.scenes.pictures.source import PAPER, load_picture
from texvent.scenes.scene import Colour, Shape, Texture

_DISPLAY_GLOW = 0.9
"""Light of a display, as a multiple of the picture's."""
_DARK: Colour = (0.01, 0.01, 0.01)
_FACE = 1
"""The side of the first part that shows the picture, +x; see `data/traits/pictures.toml`."""
_BESIDE = 1.001
"""What reaches farther than this from the middle of a face, in half sides, is no print on it."""


class PicturedModel:
    """A model with a picture where its noun shows one; all else is the model's own.

    What is usually printed on that face is left out.

    Args:
        model: a model of the noun.
        noun: one that shows a picture.
        picture: what it shows.

    Raises:
        InputError: as for `load_picture`.
    """

    def __init__(self, model: Model, noun: str, picture: Picture) -> None:
        self._model = model
        self.length, self.width, self.height = model.length, model.width, model.height
        self._source = load_picture(picture)
        self._margin: Colour | None = None if picture.kind == "file" else (PAPER, PAPER, PAPER)
        self._shines = noun in nouns_with("lit screen")
        if self._shines and self._margin is None:
            self._margin = _DARK

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):  # not yet set, as in a copy that is being made
            raise AttributeError(name)
        return getattr(self._model, name)

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose, the picture on one of them."""
        face, *others = self._model.parts(pose)
        shown = replace(
            face,
            image=self._source(pose.time_s),
            image_face=_FACE,
            texture=Texture.PLAIN,
            colour=face.colour if self._margin is None else self._margin,
            emission=_DISPLAY_GLOW if self._shines else 0.0,
        )
        return [shown, *(part for part in others if not _is_print(part, face, _FACE))]


def _is_print(part: ModelPart, face: ModelPart, number: int) -> bool:
    """Whether a part lies on a face of a box, within its borders."""
    linear = np.linalg.inv(face.to_body[:, :3])
    local = np.column_stack(
        [linear @ part.to_body[:, :3], linear @ (part.to_body[:, 3] - face.to_body[:, 3])]
    )
    shape = Shape.BOX if part.shape is Shape.CONE else part.shape
    low, high = half_extents(shape, local)
    axis, is_high = number // 2, number % 2 == 1
    reach = high[axis] if is_high else -low[axis]
    widest = np.maximum(np.abs(low), np.abs(high))
    return bool(reach > 0.9 and np.delete(widest, axis).max() <= _BESIDE)

"""Named places of any model at which other things are held: its own, or those of its box."""

from __future__ import annotations

import numpy as np

from texvent.scenes.models.protocol import Model, Pose
from texvent.scenes.models.shapes import Affine, Point

_ON_BOX: dict[str, Point] = {
    "mouth": (0.46, 0.0, 0.72), "right hand": (0.40, -0.20, 0.45), "left hand": (0.40, 0.20, 0.45),
    "hands": (0.48, 0.0, 0.45), "crown": (0.30, 0.0, 0.98), "face": (0.44, 0.0, 0.80),
    "head": (0.36, 0.0, 0.85), "neck": (0.30, 0.0, 0.70),
    "torso": (0.0, 0.0, 0.50), "seat": (0.0, 0.0, 0.30),
    "right foot": (0.40, -0.20, 0.05), "left foot": (0.40, 0.20, 0.05), "ground": (0.0, 0.0, 0.0),
    "trunk": (0.46, 0.0, 0.72), "tail": (-0.48, 0.0, 0.50), "top": (0.0, 0.0, 1.0),
}  # fmt: skip
"""Place → share of length, width and height of a box that stands on the ground."""


def locate(model: Model, name: str, pose: Pose) -> Affine:
    """Axes at a named place of a model.

    Args:
        model: any model.
        name: see `people.figure.locate_anchor`; also "tail" and "top".
        pose: of the model.

    Returns:
        [3, 4] map from the place's axes (x ahead, z up) to body coordinates, m. A model that names
        no places of its own has them at fixed shares of its box.
    """
    own = getattr(model, "anchor", None)
    axes = own(name, pose) if own is not None else None
    if axes is not None:
        return np.asarray(axes)
    along, across, up = _ON_BOX[name]
    low = -0.5 * model.height if getattr(model, "is_centred", False) else 0.0
    place = [along * model.length, across * model.width, low + up * model.height]
    return np.column_stack([np.eye(3), np.array(place)])


def has_places(model: Model) -> bool:
    """Whether a model names places of its own: a body with limbs."""
    own = getattr(model, "anchor", None)
    return own is not None and own("ground", Pose(0.0, 0.0, 0.0)) is not None

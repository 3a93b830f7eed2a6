"""Parts of models in body coordinates → the arrays of shapes that the renderer reads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.scene import Float64Array, Primitives


@dataclass(frozen=True)
class PlacedModel:
    """Parts of one object with the pose of its body in the world."""

    parts: Sequence[ModelPart]
    to_world: Float64Array
    """[3, 4] body → world."""
    instance: int
    """Ground-truth id; 0 = scenery."""


def assemble(placed: Sequence[PlacedModel]) -> Primitives:
    """All parts as one structure of arrays, in the order given.

    Args:
        placed: objects with their parts.

    Returns:
        n primitives, where n is the total number of parts; `to_world` is body-to-world times
        part-to-body.
    """
    parts = [part for model in placed for part in model.parts]
    sizes = [len(model.parts) for model in placed]
    to_body = np.array([part.to_body for part in parts], dtype=np.float64).reshape(-1, 3, 4)
    body = np.array([model.to_world for model in placed], dtype=np.float64).reshape(-1, 3, 4)
    body = np.repeat(body, sizes, axis=0)
    to_world = body[:, :, :3] @ to_body
    to_world[:, :, 3] += body[:, :, 3]
    colours = np.array([part.colour for part in parts], dtype=np.float32).reshape(-1, 3)
    seconds = np.array([part.second_colour for part in parts], dtype=np.float32).reshape(-1, 3)
    return Primitives(
        shape=np.array([part.shape for part in parts], dtype=np.int8),
        to_world=to_world,
        colour=colours,
        second_colour=seconds,
        texture=np.array([part.texture for part in parts], dtype=np.int8),
        texture_scale=np.array([part.texture_scale for part in parts], dtype=np.float32),
        emission=np.array([part.emission for part in parts], dtype=np.float32),
        instance=np.repeat(np.array([model.instance for model in placed], dtype=np.int32), sizes),
        mesh=_objects([part.mesh for part in parts]),
        image=_objects([part.image for part in parts]),
        image_face=np.array([part.image_face for part in parts], dtype=np.int8),
    )


def _objects(values: Sequence[object]) -> NDArray[np.object_] | None:
    """The values as an array; None where all are None."""
    if all(value is None for value in values):
        return None
    array = np.empty(len(values), dtype=np.object_)
    array[:] = values
    return array


def join_primitives(groups: Sequence[Primitives]) -> Primitives:
    """The shapes of all groups, in order."""
    names = [field.name for field in fields(Primitives)]
    return Primitives(**{name: _join(groups, name) for name in names})


def _join(groups: Sequence[Primitives], name: str) -> Any:
    """One field of all groups; what only some groups have is empty for the others."""
    values = [getattr(group, name) for group in groups]
    if all(value is None for value in values):
        return None
    empty = -1 if name == "image_face" else None
    return np.concatenate(
        [
            np.full(len(group.shape), empty) if value is None else value
            for group, value in zip(groups, values, strict=True)
        ]
    )

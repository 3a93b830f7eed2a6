"""A model made of another material than usual: a wooden car, a stone lion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.errors import InputError
from texvent.scenes.models.materials import MATERIALS, NamedMaterial, made_of, mix
from texvent.scenes.models.protocol import Model, ModelPart, Pose
from texvent.scenes.scene import Colour

_OWN_SHARE = 0.25
"""How much of a part's own brightness stays, so that parts can be told apart."""


class OverriddenModel:
    """A model whose parts are all of one material; lamps and glass that glows stay."""

    def __init__(self, model: Model, material: NamedMaterial, colour: Colour | None) -> None:
        """Keep the model.

        Args:
            model: as the noun builds it.
            material: what it is made of.
            colour: what the prompt says; None = the material's usual one, or each part's own.
        """
        self._model = model
        self._material = material
        self._colour = colour
        self.length, self.width, self.height = model.length, model.width, model.height

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The model's parts in the material."""
        return [self._made_of(each) for each in self._model.parts(pose)]

    def _made_of(self, part: ModelPart) -> ModelPart:
        if part.emission > 0.0:
            return part
        wanted = self._colour if self._colour is not None else self._material.colour
        own = sum(part.colour) / 3.0
        if self._colour is not None or wanted is None:
            colour = part.colour
        else:
            usual = sum(wanted) / 3.0
            factor = 1.0 + _OWN_SHARE * (min(own / max(usual, 1e-3), 2.0) - 1.0)
            colour = mix((0.0, 0.0, 0.0), wanted, factor)
        surface = made_of(self._material.texture, colour, self._material.second_colour)
        return replace(
            part,
            colour=surface.colour,
            second_colour=surface.second_colour,
            texture=surface.texture,
            texture_scale=1.0,
        )


def in_material(model: Model, name: str | None, colour: Colour | None) -> Model:
    """A model in the material that a prompt names.

    Args:
        model: as the noun builds it.
        name: key of `materials.MATERIALS`; None = as usual.
        colour: colour that the prompt says; it wins over the material's own.

    Raises:
        InputError: there is no such material.
    """
    if name is None:
        return model
    if name not in MATERIALS:
        raise InputError(f"unknown material {name!r}; known: {', '.join(MATERIALS)}")
    return OverriddenModel(model, MATERIALS[name], colour)

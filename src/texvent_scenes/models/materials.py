"""Surfaces of models: colours, textures, shared materials; models made of another material."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from texvent_scenes.mesh import mean_colour, recoloured
from texvent_scenes.models.protocol import Model, ModelPart, Pose
from texvent_scenes.rendered_scene import Colour, Texture


@dataclass(frozen=True)
class Material:
    """A surface: colour, and how it varies."""

    colour: Colour
    second_colour: Colour = (0.0, 0.0, 0.0)
    texture: Texture = Texture.WORN
    scale: float = 1.0
    """Fineness of a material, 1 = as in life; of the patterns MOTTLED, STRIPES and CHECKS, repeats
    per local unit (half the part's size)."""
    emission: float = 0.0


def made_of(
    texture: Texture, colour: Colour, second_colour: Colour | None = None, *, scale: float = 1.0
) -> Material:
    """A material in a colour; its second colour follows from the first unless it is given."""
    if second_colour is None:
        second_colour = shade(colour, _SECOND_SHADES.get(texture, 0.7))
    return Material(colour, second_colour, texture, scale)


_SECOND_SHADES = {
    Texture.FOLIAGE: 1.8,
    Texture.NEEDLES: 1.6,
    Texture.FUR: 0.65,
    Texture.FEATHERS: 0.6,
    Texture.STONE: 1.3,
    Texture.BARK: 1.5,
    Texture.CLOTH: 0.85,
    Texture.SKIN: 0.85,
    Texture.METAL: 1.7,
    Texture.CONCRETE: 0.75,
    Texture.PLASTER: 0.8,
    Texture.ROOFING: 0.8,
    Texture.WOOD: 0.65,
    Texture.SCALES: 1.4,
    Texture.SNOW: 0.85,
}
"""Second colour of a material as a multiple of the first."""


def fur(colour: Colour) -> Material:
    """Hairs along the part's local z."""
    return made_of(Texture.FUR, colour)


def cloth(colour: Colour) -> Material:
    """Woven, with folds."""
    return made_of(Texture.CLOTH, colour)


def skin(colour: Colour) -> Material:
    """Skin of people."""
    return made_of(Texture.SKIN, colour)


@dataclass(frozen=True)
class NamedMaterial:
    """A material as a prompt names it."""

    texture: Texture
    colour: Colour | None = None
    """Its usual colour; None = the object's own."""
    second_colour: Colour | None = None
    """None = follows from the colour; of a pattern, it contrasts with it."""
    scale: float = 1.0
    """As of `Material`."""

    def in_colour(self, colour: Colour, other: Colour | None = None) -> Material:
        """It in a colour, with another one, or one that contrasts, in a pattern."""
        second = (other or _contrast(colour)) if self.texture in _PATTERNS else self.second_colour
        return made_of(self.texture, colour, second, scale=self.scale)


MATERIALS: dict[str, NamedMaterial] = {
    "wood": NamedMaterial(Texture.WOOD, (0.30, 0.15, 0.06)),
    "stone": NamedMaterial(Texture.STONE, (0.26, 0.25, 0.23)),
    "marble": NamedMaterial(Texture.STONE, (0.62, 0.61, 0.58), (0.40, 0.40, 0.41)),
    "brick": NamedMaterial(Texture.BRICK, (0.34, 0.11, 0.07), (0.42, 0.40, 0.36)),
    "concrete": NamedMaterial(Texture.CONCRETE, (0.38, 0.37, 0.35)),
    "metal": NamedMaterial(Texture.METAL, (0.34, 0.35, 0.37)),
    "brass": NamedMaterial(Texture.METAL, (0.50, 0.33, 0.08)),
    "ceramic": NamedMaterial(Texture.WORN, (0.70, 0.67, 0.62)),
    "rust": NamedMaterial(Texture.RUST, None, (0.26, 0.09, 0.03)),
    "glass": NamedMaterial(Texture.PANE, (0.16, 0.27, 0.3)),
    "plastic": NamedMaterial(Texture.WORN, (0.70, 0.72, 0.74)),
    "rubber": NamedMaterial(Texture.WORN, (0.030, 0.030, 0.032)),
    "cloth": NamedMaterial(Texture.CLOTH),
    "leather": NamedMaterial(Texture.LEATHER, (0.20, 0.09, 0.04)),
    "paper": NamedMaterial(Texture.PAPER, (0.70, 0.68, 0.62)),
    "ice": NamedMaterial(Texture.SNOW, (0.62, 0.74, 0.82)),
    "striped": NamedMaterial(Texture.STRIPES, scale=3.0),
    "checkered": NamedMaterial(Texture.CHECKS, scale=3.0),
    "spotted": NamedMaterial(Texture.MOTTLED, scale=4.0),
}


def striped(colour: Colour, second_colour: Colour, scale: float) -> Material:
    """Bands along the part's local z."""
    return Material(colour, second_colour, Texture.STRIPES, scale)


def shade(colour: Colour, factor: float) -> Colour:
    """A darker (factor < 1) or lighter (factor > 1) colour, kept inside 0..1."""
    r, g, b = (min(1.0, max(0.0, factor * channel)) for channel in colour)
    return (r, g, b)


def mix(first: Colour, second: Colour, weight: float) -> Colour:
    """`weight` of the second colour, the rest of the first."""
    r, g, b = (a + weight * (b - a) for a, b in zip(first, second, strict=True))
    return (r, g, b)


WHITE: Colour = (0.80, 0.80, 0.78)
BLACK: Colour = (0.015, 0.015, 0.017)
RED: Colour = (0.55, 0.03, 0.02)
ORANGE: Colour = (0.75, 0.18, 0.01)
YELLOW: Colour = (0.75, 0.45, 0.02)
BLUE: Colour = (0.03, 0.10, 0.45)

STEEL = made_of(Texture.METAL, (0.32, 0.33, 0.35))
DARK = Material((0.030, 0.030, 0.033))
SKIN_TONES: tuple[Colour, ...] = (
    (0.66, 0.42, 0.31),
    (0.50, 0.28, 0.17),
    (0.26, 0.13, 0.075),
    (0.11, 0.055, 0.032),
)
HAIR_COLOURS: tuple[Colour, ...] = (
    (0.020, 0.014, 0.010),
    (0.080, 0.040, 0.018),
    (0.32, 0.19, 0.060),
    (0.18, 0.050, 0.018),
)
CLOTH_COLOURS: tuple[Colour, ...] = (
    (0.45, 0.05, 0.04),
    (0.05, 0.14, 0.42),
    (0.65, 0.62, 0.56),
    (0.06, 0.26, 0.12),
    (0.62, 0.33, 0.03),
    (0.25, 0.05, 0.25),
)


_PATTERNS = frozenset({Texture.STRIPES, Texture.CHECKS, Texture.MOTTLED})
PATTERNED = tuple(name for name, one in MATERIALS.items() if one.texture in _PATTERNS)
"""Materials of two colours."""
_BRIGHT = 0.3


def _contrast(colour: Colour) -> Colour:
    """The second colour of a pattern: white on what is dark, dark on what is bright."""
    return shade(colour, 0.12) if sum(colour) / 3.0 > _BRIGHT else WHITE


_OWN_SHARE = 0.25
"""Share of a part's own brightness that stays, so that parts can be told apart."""


class OverriddenModel:
    """A model whose parts are all of one material; lamps and glass that glows stay."""

    def __init__(
        self, model: Model, material: NamedMaterial, colour: Colour | None,
        other: Colour | None = None,
    ) -> None:  # fmt: skip
        """Keep the model.

        Args:
            model: as the noun builds it.
            material: what it is made of.
            colour: what the prompt says; None = the material's usual one, or each part's own.
            other: of a pattern; None = one that contrasts.
        """
        self._model = model
        self._material = material
        self._colour, self._other = colour, other
        self.length, self.width, self.height = model.length, model.width, model.height

    def __getattr__(self, name: str) -> Any:
        """Scale, anchors and whatever else the model has."""
        if name == "_model":
            raise AttributeError(name)
        return getattr(self._model, name)

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The model's parts in the material."""
        return [self._made_of(each) for each in self._model.parts(pose)]

    def _made_of(self, part: ModelPart) -> ModelPart:
        if part.emission > 0.0:
            return part
        wanted = self._colour if self._colour is not None else self._material.colour
        if part.mesh is not None:  # it has no grain or pattern, and is painted already
            is_painted = self._colour is not None or wanted is None
            return part if is_painted else replace(part, mesh=recoloured(part.mesh, wanted))
        own = sum(part.colour) / 3.0
        if self._colour is not None or wanted is None:
            colour = part.colour
        else:
            usual = sum(wanted) / 3.0
            factor = 1.0 + _OWN_SHARE * (min(own / max(usual, 1e-3), 2.0) - 1.0)
            colour = mix((0.0, 0.0, 0.0), wanted, factor)
        surface = self._material.in_colour(colour, self._other)
        return replace(
            part,
            colour=surface.colour,
            second_colour=surface.second_colour,
            texture=surface.texture,
            texture_scale=surface.scale,
        )


def in_material(
    model: Model, name: str | None, colour: Colour | None, other: Colour | None = None
) -> Model:
    """A model in one of `MATERIALS`; a colour wins over the material's own, None is as usual.

    `other` is the second colour of a pattern.
    """
    return model if name is None else OverriddenModel(model, MATERIALS[name], colour, other)


_NEAR, _HUED, _LEAST_PART = 0.28, 0.12, 0.06
"""Distance of cube roots of linear RGB within which two colours have one name, and its standard
deviation over the channels: a dark pane is not green; least share of a body's surface that has a
colour."""
_REPAINTED = 0.25
"""Share of a surface from which on the parts of one colour are painted in another."""


def share_of(parts: Sequence[ModelPart], is_counted: Callable[[ModelPart], bool]) -> float:
    """Share of the surface of some parts that those have which count, 0 of nothing."""
    counted = whole = 0.0
    for part in parts:
        sides = np.sort(np.linalg.norm(part.to_body[:, :3], axis=0))
        whole += sides[1] * sides[2]
        counted += sides[1] * sides[2] * is_counted(part)
    return float(counted / max(whole, 1e-12))


def has_colour(parts: Sequence[ModelPart], colour: Colour, least: float = _LEAST_PART) -> bool:
    """Whether enough of the surface of some parts has about that colour.

    Args:
        parts: of a body.
        colour: linear-light RGB.
        least: share of the surface.
    """
    return colour_share(parts, colour) >= least


def colour_share(parts: Sequence[ModelPart], colour: Colour) -> float:
    """Share of the surface of some parts that has about that colour, linear-light RGB."""

    def is_like(part: ModelPart) -> bool:
        both = [part.colour] if part.mesh is None else [mean_colour(part.mesh)]
        both += [] if part.texture is Texture.PLAIN else [part.second_colour]
        gaps = (np.cbrt(one) - np.cbrt(colour) for one in both)
        return any(np.linalg.norm(one) <= _NEAR and one.std() <= _HUED for one in gaps)

    return share_of(parts, is_like)


def _is_alike(one: ModelPart, other: ModelPart) -> bool:
    return one.colour == other.colour


def repaint(parts: Sequence[ModelPart], colour: Colour) -> list[ModelPart]:
    """The parts, those of their main colours in another one."""
    main = {one.colour for one in parts if share_of(parts, partial(_is_alike, one)) >= _REPAINTED}
    return [replace(one, colour=colour) if one.colour in main else one for one in parts]

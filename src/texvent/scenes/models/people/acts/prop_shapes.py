"""What is drawn with an activity, and the shapes that such things are made of."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from texvent.scenes.models.materials import Material
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, blade, rod

Draw = Callable[[float], Sequence[ModelPart]]


@dataclass(frozen=True)
class Prop:
    """Something that goes with a place of the body."""

    anchor: str
    """Place of `anchors.locate_anchor`; "ground" = body coordinates."""
    draw: Draw
    """Its shapes at a time, s, in the axes of that place, m."""
    nouns: tuple[str, ...] = ()
    """Nouns that are the same thing: where the prompt shows one, the prop is left out."""
    is_own: bool = False
    """Whether it is drawn in place of a named one, not left out for it."""
    is_shared: bool = False
    """Whether several who do the same have one of it."""
    furniture: str = ""
    """Its name, where the prompt may show another one too: a table to work at."""


def still(*parts: ModelPart) -> Draw:
    """Shapes that do not move in their place."""
    return lambda _: parts


def stick(material: Material, low: float, high: float, radius: float) -> ModelPart:
    """A rod along what the hand holds."""
    return rod(material, (0.0, 0.0, low), (0.0, 0.0, high), radius)


def disc(material: Material, middle: Point, size: tuple[float, float], thick: float) -> ModelPart:
    """A flat ellipse that stands in the x-z plane of the hand: width, length."""
    x, y, z = middle
    wide, long = size
    return blade(material, (x, y, z - 0.5 * long), (x, y, z + 0.5 * long), chord=(wide, 0.0, 0.0),
                 thickness=(0.0, thick, 0.0))  # fmt: skip

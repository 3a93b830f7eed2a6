"""Surfaces of models: linear-light colours, textures and the materials that models share."""

from __future__ import annotations

from dataclasses import dataclass

from texvent.scenes.scene import Colour, Texture


@dataclass(frozen=True)
class Material:
    """A surface: colour, and how it varies."""

    colour: Colour
    second_colour: Colour = (0.0, 0.0, 0.0)
    texture: Texture = Texture.PLAIN
    scale: float = 1.0
    """Repeats of the texture per local unit (half the part's size)."""
    emission: float = 0.0


def mottled(colour: Colour, *, contrast: float = 0.45, scale: float = 3.0) -> Material:
    """Patches of a darker shade: foliage, fur, rock."""
    return Material(colour, shade(colour, 1.0 - contrast), Texture.MOTTLED, scale)


def striped(colour: Colour, second_colour: Colour, scale: float) -> Material:
    """Bands along the part's local z."""
    return Material(colour, second_colour, Texture.STRIPES, scale)


def checked(colour: Colour, second_colour: Colour, scale: float) -> Material:
    """A 3-D checker pattern."""
    return Material(colour, second_colour, Texture.CHECKS, scale)


def glowing(colour: Colour, emission: float) -> Material:
    """A lamp: gives off `emission` times its colour."""
    return Material(colour, emission=emission)


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
GREY: Colour = (0.22, 0.22, 0.23)
RED: Colour = (0.55, 0.03, 0.02)
ORANGE: Colour = (0.75, 0.18, 0.01)
YELLOW: Colour = (0.75, 0.45, 0.02)
GREEN: Colour = (0.05, 0.30, 0.05)
BLUE: Colour = (0.03, 0.10, 0.45)

RUBBER = Material((0.018, 0.018, 0.020))
STEEL = Material((0.36, 0.37, 0.39))
CHROME = Material((0.58, 0.59, 0.61))
GLASS = Material((0.035, 0.050, 0.065))
DARK = Material((0.030, 0.030, 0.033))
WOOD = mottled((0.30, 0.15, 0.06), contrast=0.35, scale=2.0)
BARK = mottled((0.11, 0.065, 0.035), contrast=0.4, scale=5.0)
CONCRETE = mottled((0.38, 0.37, 0.35), contrast=0.15, scale=4.0)
HEADLIGHT = glowing((0.95, 0.92, 0.75), 1.2)
TAILLIGHT = glowing((0.70, 0.02, 0.02), 0.6)
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
CAR_COLOURS: tuple[Colour, ...] = (
    (0.50, 0.03, 0.03),
    (0.04, 0.13, 0.42),
    (0.55, 0.56, 0.58),
    (0.03, 0.20, 0.12),
    (0.68, 0.67, 0.63),
)

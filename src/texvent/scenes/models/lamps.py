"""Lamps of objects: which glowing parts of a model give off light, where to, and how they blink.

A lamp is a part with emission: it stands where the part stands, has its colour, and gets brighter
and darker with it. `data/traits/lamps.toml` says what kind of lamp it is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from texvent.scenes.models.tables import frozen, trait_values

Wave = Literal["square", "sine", "flame"]
"""How a lamp's light goes up and down: on and off; as mains light does; as a flame does."""


@dataclass(frozen=True)
class Lamp:
    """One kind of lamp."""

    intensity: float
    """Light it casts on a surface that faces it at 1 m, where full daylight is 1."""
    direction: tuple[float, float, float] | None = None
    """Where a beam points, in body coordinates; None = to all sides."""
    half_angle: float = 180.0
    """From the middle of the beam to where it has faded, degrees."""
    soft_share: float = 0.5
    """Share of the half angle over which it fades."""
    is_panel: bool = False
    """Whether it is a flat area that shines to one side by its cosine, without a halo: a screen."""
    glows: bool = True
    """Whether the camera sees a bright spot with a halo: not where flames are drawn."""
    always_on: bool = True
    """Whether it is usually on by day as well."""
    least_dark: float = 0.0
    """For what is not always on: strength of artificial light above which it is usually on."""
    blink_hz: float | None = None
    """How often it usually blinks; None = steady."""
    wave: Wave = "square"
    """How it blinks."""
    hue: str = ""
    """Which of a model's glowing parts it is: "white", "red", "blue", "amber", "green"; empty =
    any."""
    boost: float = 1.0
    """The glowing part is drawn this much brighter when the lamp is on."""
    is_single: bool = False
    """Whether only the first of its parts sheds light: the parts of one flame are one lamp."""
    own_hz: float = 0.0
    """How often the model itself lets its part shine up and down each second."""
    turns_hz: float = 0.0
    """How often its beam turns round the upright axis each second."""


def _read_lamps() -> dict[str, tuple[Lamp, ...]]:
    kinds = {kind: Lamp(**row) for kind, row in frozen(trait_values("lamp kind")).items()}
    return {noun: tuple(kinds[one] for one in own) for noun, own in trait_values("lamps").items()}


LAMPS: Mapping[str, tuple[Lamp, ...]] = MappingProxyType(_read_lamps())
"""Noun → its lamps; a part takes the first whose hue suits its colour."""


def hue_of(colour: tuple[float, float, float]) -> str:
    """Name of a lamp colour: "white", "red", "amber", "green" or "blue".

    Example:
        >>> hue_of((0.95, 0.92, 0.75)), hue_of((0.7, 0.02, 0.02)), hue_of((0.9, 0.5, 0.05))
        ('white', 'red', 'amber')
    """
    red, green, _ = colour
    top = max(colour)
    if min(colour) > 0.35 * top:
        return "white"
    if red == top:
        return "amber" if green > 0.35 * red else "red"
    return "green" if green == top else "blue"


def lamp_of(noun: str, colour: tuple[float, float, float]) -> Lamp | None:
    """The lamp that a glowing part of that colour is, if any."""
    hue = hue_of(colour)
    return next((lamp for lamp in LAMPS.get(noun, ()) if lamp.hue in ("", hue)), None)

"""Effects made of many small things, as smoke, sparks and drops, and lamps of objects.

The tables are `data/effects.toml` and the traits "lamps"; `staging` shows both.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Literal

from texvent_scenes.models.tables import frozen, read_table, trait_values
from texvent_scenes.rendered_scene import Colour

Vector = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class EmitterStyle:
    """Particles that leave a source one after the other, or all at once.

    Lengths are multiples of the effect's size s, speeds of √(g·s), times of √(s / g): small effects
    are quick.
    """

    body: Literal["medium", "drop", "flake"]
    """Translucent media, drops that are stretched along their flight, or tumbling solid flakes that
    come to rest on the ground."""
    count: int
    life: float = 0.0
    """Lifetime of a particle; 0 = without end, and of drops until they reach the ground."""
    at_once: bool = False
    """Whether all are born when the effect begins, as the pieces of what breaks."""
    salvos: int = 0
    """Number of volleys that follow one another: in each all are born at once, from a new place and
    of one colour in each life; 0 = one after the other."""
    speed: float = 0.0
    """Speed at birth."""
    spread_rad: tuple[float, float] = (0.0, 0.0)
    """Least and greatest angle to `aim`."""
    aim: Vector = (0.0, 0.0, 1.0)
    """Middle of the directions at birth, in the coordinates of the source's body."""
    area: float = 0.0
    """Radius of the spot that particles start from."""
    fills: Vector | None = None
    """Instead, shares of the body's length, width and height that they start in."""
    gravity: float = 0.0
    """Share of gravity that acts; below 0 particles rise."""
    wind: float = 0.0
    """Acceleration to the right, in g."""
    drag: float | None = None
    """Time in which drag takes all but 37 % of a velocity; None = no drag."""
    curl: float = 0.0
    """Distance that eddies carry a particle by the end of its life."""
    radius: tuple[float, float] = (0.1, 0.1)
    """Radii at birth and at the end."""
    proportions: Vector = (1.0, 1.0, 1.0)
    """Half extents by the radius; the last one is upright, of drops along the flight."""
    turns: float = 1.0
    """Rate at which flakes tumble."""
    is_oval: bool = False
    """Whether flakes are oval, as leaves are, not pieces of paper."""
    widest_rad: float = math.inf
    """Greatest half extent of flakes in the image: in life they are smaller than those far off."""
    colours: tuple[Colour, ...] = ()
    """Colours of media at birth and at the end; of solid bodies those that occur, none = those of
    the object."""
    emission: tuple[float, float] = (0.0, 0.0)
    """Light given off at birth and at the end, as a multiple of the colour."""
    thickness: tuple[float, float] = (1.0, 0.0)
    """Optical depth of a medium at birth and at the end."""
    fades: bool = True
    """Whether media thin out in the second half of their lives; else only at the very end."""
    detail: float = 0.0
    """Fine structure of media, 0..1."""
    light: float = 0.0
    """Light shed at 1 m per square metre of s²."""


@dataclass(frozen=True, kw_only=True)
class EffectWords:
    """An effect: its names, where it comes from, and what shows it."""

    nouns: tuple[str, ...] = ()
    """Singular or mass nouns that name it, such as "smoke": "smoke rises from a chimney"."""
    verbs: tuple[str, ...] = ()
    """Base forms said of the object it comes from, such as "smoke": "a chimney smokes"."""
    size: float = 1.0
    """Its size by that of the object it comes from."""
    rise: float = 0.0
    """Height above its object that must be in the image, in mean sizes of that."""
    alone: Vector = (0.15, 0.0, 0.0)
    """Its size without an object, its height above what the camera looks at (0 = on the ground)
    and its distance behind that; by the distance of the camera."""
    anchor: Vector = (0.0, 0.0, 1.0)
    """Point where it leaves its object: x and y in half extents, z in heights from below."""
    anchor_traits: tuple[str, ...] = ()
    """Traits that say so for some nouns, tried in order."""
    from_work: bool = False
    """Whether it leaves a tool at the part of it that goes round, such as a disc."""
    emitters: tuple[EmitterStyle, ...] = ()


_BODIES: Mapping[str, Literal["medium", "drop", "flake"]] = MappingProxyType(
    {"flakes": "flake", "drops": "drop", "media": "medium"}
)
"""Kind of particles in the table → their bodies."""


def _effect(row: dict[str, Any], usual: Mapping[str, dict[str, Any]]) -> EffectWords:
    """An effect from its table; what its particles leave open is usual for their kind."""
    row["emitters"] = tuple(
        EmitterStyle(**{"body": body, **usual[kind], **one})
        for kind, body in _BODIES.items()
        for one in row.pop(kind, ())
    )
    return EffectWords(**row)


_TABLE = frozen(read_table("effects"))
_USUAL = _TABLE.pop("usual particles")
EFFECTS: Mapping[str, EffectWords] = MappingProxyType(
    {kind: _effect(row, _USUAL) for kind, row in _TABLE.items()}
)
"""Every effect the generator shows."""


Wave = Literal["square", "sine", "flame"]
"""Modulation of a lamp's light: on and off; as mains light; as a flame."""


@dataclass(frozen=True)
class LampKind:
    """One kind of lamp."""

    intensity: float
    """Light it casts on a surface that faces it at 1 m, where full daylight is 1."""
    direction: tuple[float, float, float] | None = None
    """Direction of a beam, in body coordinates; None = to all sides."""
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
    """Usual frequency at which it blinks; None = steady."""
    wave: Wave = "square"
    """Waveform with which it blinks."""
    hue: str = ""
    """Glowing part of a model: "white", "red", "blue", "amber", "green"; empty = any."""
    boost: float = 1.0
    """The glowing part is drawn this much brighter when the lamp is on."""
    is_single: bool = False
    """Whether only the first of its parts sheds light: the parts of one flame are one lamp."""
    own_hz: float = 0.0
    """Frequency at which the model itself modulates its part."""
    turns_hz: float = 0.0
    """Turns of its beam round the upright axis each second."""
    name: str = ""
    """Such as "headlight"."""


_KINDS = {
    kind: LampKind(name=kind, **row) for kind, row in frozen(trait_values("lamp kind")).items()
}
LAMPS: Mapping[str, tuple[LampKind, ...]] = MappingProxyType(
    {noun: tuple(_KINDS[one] for one in own) for noun, own in trait_values("lamps").items()}
)
"""Noun → its lamps; a part takes the first whose hue suits its colour."""


def hue_of(colour: tuple[float, float, float]) -> str:
    """Name of a lamp colour: "white", "red", "amber", "green" or "blue".

    Example:
        >>> hue_of((0.95, 0.92, 0.75)), hue_of((0.7, 0.02, 0.02)), hue_of((0.9, 0.5, 0.05))
        ('white', 'red', 'amber')
        >>> hue_of((0.1, 0.9, 0.2)), hue_of((0.1, 0.2, 0.9))
        ('green', 'blue')
    """
    red, green, _ = colour
    top = max(colour)
    if min(colour) > 0.35 * top:
        return "white"
    if red == top:
        return "amber" if green > 0.35 * red else "red"
    return "green" if green == top else "blue"


def lamp_of(noun: str, colour: tuple[float, float, float]) -> LampKind | None:
    """The lamp that a glowing part of that colour is, if any."""
    hue = hue_of(colour)
    return next((lamp for lamp in LAMPS.get(noun, ()) if lamp.hue in ("", hue)), None)

"""Effects made of many small things: smoke, sparks, drops, leaves; and the words for them.

The table is `data/effects.toml`; `staging.particles` shows what it says. Readers need only names.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Literal

from texvent.scenes.models.tables import frozen, read_table
from texvent.scenes.scene import Colour

Vector = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class EmitterStyle:
    """Particles that leave a source one after the other, or all at once.

    Lengths are multiples of the effect's size s, speeds of √(g·s), times of √(s / g): small effects
    are quick.
    """

    body: Literal["puff", "drop", "chip"]
    """Translucent puffs, drops that are stretched along their flight, or tumbling solid chips that
    come to rest on the ground."""
    count: int
    life: float = 0.0
    """Of a particle; 0 = without end, and of drops until they reach the ground."""
    salvos: int = 0
    """Number of volleys that follow one another: in each all are born at once, from a new place and
    of one colour in each life; 0 = one after the other."""
    speed: float = 0.0
    """At birth."""
    lift: float = 0.0
    """Part of the speed that is added upwards."""
    spread_rad: tuple[float, float] = (0.0, 0.0)
    """Least and greatest angle to `aim`."""
    aim: Vector = (0.0, 0.0, 1.0)
    """Middle of the directions at birth, in the coordinates of the source's body."""
    area: float = 0.0
    """Radius of the spot that particles start from."""
    fills: Vector | None = None
    """Instead, shares of the body's length, width and height that they start in; where it has a
    height, chips fly outwards from its middle."""
    gravity: float = 0.0
    """Share of gravity that acts; below 0 particles rise."""
    wind: float = 0.0
    """Acceleration to the right, in g."""
    drag: float | None = None
    """Time in which drag takes all but 37 % of a velocity; None = no drag."""
    curl: float = 0.0
    """Distance that eddies carry a particle by the end of its life."""
    radius: tuple[float, float] = (0.1, 0.1)
    """At birth and at the end."""
    proportions: Vector = (1.0, 1.0, 1.0)
    """Half extents by the radius; the last one is upright, of drops along the flight."""
    turns: float = 1.0
    """Rate at which chips tumble."""
    colours: tuple[Colour, ...] = ()
    """Of puffs at birth and at the end; of solid bodies those that occur; empty: the object's."""
    keeps_colour: bool = False
    """Whether it has them whatever colour the effect is said to have."""
    emission: tuple[float, float] = (0.0, 0.0)
    """Light given off at birth and at the end, as a multiple of the colour."""
    thickness: tuple[float, float] = (1.0, 0.0)
    """Optical depth of a puff at birth and at the end."""
    detail: float = 0.0
    """Fine structure of puffs, 0..1."""
    light: float = 0.0
    """Light shed at 1 m per square metre of s²."""


@dataclass(frozen=True, kw_only=True)
class EffectWords:
    """An effect: its names, where it comes from, and what shows it."""

    nouns: tuple[str, ...] = ()
    """Singular or mass nouns that name it, such as "smoke": "smoke rises from a chimney"."""
    verbs: tuple[str, ...] = ()
    """Base forms said of the object it comes from, such as "smoke": "a chimney smokes"."""
    happens_once: bool = False
    """Whether it begins at one instant (a burst) rather than going on."""
    ends_source: bool = False
    """Whether it happens once and the object it comes from is gone afterwards."""
    breathed: bool = False
    """Whether it comes from the mouth of a person."""
    size: float = 1.0
    """Its size by that of the object it comes from."""
    alone: Vector = (0.15, 0.0, 0.0)
    """Its size without an object, its height above what the camera looks at (0 = on the ground)
    and its distance behind that; by the distance of the camera."""
    anchor: Vector = (0.0, 0.0, 1.0)
    """Where it leaves its object: x and y in half extents, z in heights from below."""
    anchor_traits: tuple[str, ...] = ()
    """Traits that say so for some nouns, tried in order."""
    headroom: float = 0.0
    """Room that it needs in the image above its object, by its size."""
    emitters: tuple[EmitterStyle, ...] = ()


_BODIES: Mapping[str, Literal["puff", "drop", "chip"]] = MappingProxyType(
    {"chips": "chip", "flakes": "chip", "drops": "drop", "puffs": "puff"}
)
"""Kind of particles in the table → their bodies."""


def _effect(row: dict[str, Any], usual: Mapping[str, dict[str, Any]]) -> EffectWords:
    """An effect from its table; what its particles leave open is usual for their kind."""
    row["emitters"] = tuple(
        EmitterStyle(**{"body": body, **usual[kind], **one})
        for kind, body in _BODIES.items()
        for one in row.pop(kind, ())
    )
    row["happens_once"] = row.get("happens_once", False) or row.get("ends_source", False)
    return EffectWords(**row)


_TABLE = frozen(read_table("effects"))
LIQUID_COLOURS: Mapping[str, Colour] = MappingProxyType(_TABLE.pop("liquid colours"))
"""Name of a liquid → its colour."""
_USUAL = _TABLE.pop("usual particles")
EFFECTS: Mapping[str, EffectWords] = MappingProxyType(
    {kind: _effect(row, _USUAL) for kind, row in _TABLE.items()}
)
"""Every effect the generator shows."""

"""Effects made of many small things: smoke, sparks, drops, leaves; and the words for them.

The table is `data/effects.toml`; `staging.particles` shows what it says. Readers need only names.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
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
    """Of a particle; 0 = without end."""
    salvo: float | None = None
    """Whether all are born at once, from a new place and of one colour in each life: the share of
    a life at time 0; None = one after the other."""
    until_ground: bool = False
    """Whether a particle lives until it reaches the ground instead."""
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
    turns: float = 0.0
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
class LightStyle:
    """Small lights on a body that go on and off."""

    places: tuple[Vector, ...] = ()
    """x and y in half extents, z in heights from below; empty: a string that winds around it."""
    phases: tuple[float, ...] = (0.0,)
    """When each goes on, in periods; repeated."""
    colours: tuple[Colour, ...]
    """Repeated."""
    size: float
    """Radius by that of a ball as large as the body."""
    blink_hz: float
    glow: float = 4.0
    """Emission of a light that is on."""
    intensity: float = 0.0
    """Light that each sheds at 1 m; 0 = none."""


@dataclass(frozen=True, kw_only=True)
class EffectWords:
    """An effect: its names, where it comes from, and what shows it."""

    nouns: tuple[str, ...] = ()
    """Singular or mass nouns that name it, such as "smoke": "smoke rises from a chimney"."""
    verbs: tuple[str, ...] = ()
    """Base forms said of the object it comes from, such as "smoke": "a chimney smokes"."""
    adjectives: tuple[str, ...] = ()
    """Said of the object it comes from, such as "steaming"."""
    happens_once: bool = False
    """Whether it begins at one instant (a burst) rather than going on."""
    ends_source: bool = False
    """Whether the object it comes from is gone afterwards."""
    breathed: bool = False
    """Whether it comes from the mouth of a person."""
    size: float = 0.5
    """Its size by that of the object it comes from."""
    alone: float = 0.15
    """Its size where it comes from no object, by the distance of the camera."""
    alone_height: float = 0.0
    """Height at which it then is, above what the camera looks at; 0 = on the ground."""
    alone_behind: float = 0.0
    """Distance behind what the camera looks at, by the camera's."""
    anchor: Vector = (0.0, 0.0, 1.0)
    """Where it leaves its object: x and y in half extents, z in heights from below."""
    anchor_traits: tuple[str, ...] = ()
    """Traits that say so for some nouns, tried in order."""
    headroom: float = 0.0
    """Room that it needs in the image above its object, by its size."""
    emitters: tuple[EmitterStyle, ...] = ()
    lights: LightStyle | None = None


def _effect(row: Mapping[str, Any]) -> EffectWords:
    """An effect from its table."""
    fields = {name: frozen(value) for name, value in row.items()}
    fields["emitters"] = tuple(
        emitter for one in row.get("emitters", ()) for emitter in _emitters(one)
    )
    if "lights" in row:
        fields["lights"] = LightStyle(**{n: frozen(value) for n, value in row["lights"].items()})
    return EffectWords(**fields)


def _emitters(row: Mapping[str, Any]) -> Iterator[EmitterStyle]:
    """The emitter of a table, one for each of its salvos."""
    fields = {name: frozen(value) for name, value in {**_USUAL[row["body"]], **row}.items()}
    for salvo in fields.pop("salvo", (None,)):
        yield EmitterStyle(**fields, salvo=salvo)


_TABLE = dict(read_table("effects"))
_USUAL: Mapping[str, dict[str, Any]] = {
    body: _TABLE.pop(f"usual {body}") for body in ("puff", "drop", "chip")
}
"""Body → what its emitters usually have."""
LIQUID_COLOURS: Mapping[str, Colour] = MappingProxyType(
    {name: frozen(rgb) for name, rgb in _TABLE.pop("liquid colours").items()}
)
"""Name of a liquid → its colour."""
EFFECTS: Mapping[str, EffectWords] = MappingProxyType(
    {kind: _effect(row) for kind, row in _TABLE.items()}
)
"""Every effect the generator shows."""

"""All nouns of the embedded generator.

Origins: a noun with habitat "ground" or "fixed" stands on z = 0 below its middle (a ball too: it
rolls; a throw lifts it). One with habitat "air" or "water" has its origin at its
middle, except that what floats (`AFLOAT`) has it on the waterline: put it at the water's surface.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import chain
from types import MappingProxyType

from texvent_scenes.models.parts import read_nouns
from texvent_scenes.models.people import person
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import list_data, trait_values

MOTIONS = frozenset(
    {"move", "drive", "walk", "run", "fly", "swim", "sail", "paddle", "roll", "slide",
     "float",
     "hover", "blow", "turn", "reverse",
     "spin", "rotate", "orbit", "sway", "tilt", "bounce", "jump", "fall", "rise", "sink", "throw",
     "topple", "climb", "break", "grow", "plunge",
     "shrink", "work", "hang", "stand", "sit", "lie"}
)  # fmt: skip
"""Travel, manoeuvres, and motions in place; "move" is the usual motion of a noun, "work" that of a
machine, "stand" rest."""


def _with_speed(nouns: Iterable[Noun]) -> tuple[Noun, ...]:
    speeds = trait_values("speeds")
    return tuple(
        replace(one, speed_m_s=speeds[one.name][one.motion]) if one.name in speeds else one
        for one in nouns
    )


FAMILIES: Mapping[str, tuple[Noun, ...]] = MappingProxyType(
    {"people": _with_speed(chain(person.NOUNS, *map(read_nouns, list_data("people"))))}
    | {file.name.removesuffix(".toml"): _with_speed(read_nouns(file))
       for file in chain(list_data("bodies"), list_data("nouns"))}
)  # fmt: skip
"""Nouns by family, such as "vehicles": people, and the files of `data/bodies` and `data/nouns`."""


def _with_acts(nouns: Mapping[str, Noun]) -> Iterable[Noun]:
    """Nouns, with the acts of their variants: an owl glides as it flies."""
    for one in nouns.values():
        flying = nouns.get(f"flying {one.name}")
        yield replace(one, acts=one.acts | flying.acts) if flying else one


NOUNS: Mapping[str, Noun] = MappingProxyType(
    {one.name: one for one in _with_acts({noun.name: noun for family in FAMILIES.values()
                                          for noun in family})}
)  # fmt: skip
"""Every noun by its singular name."""

VARIANTS: Mapping[str, str] = MappingProxyType(
    {name: rest for name in NOUNS for word, _, rest in [name.partition(" ")]
     if word in ("parked", "flying") and rest in NOUNS}
)  # fmt: skip
"""Variants of nouns, which no sentence names: it says that a bicycle stands, that a goose flies."""

SCENERY_ONLY: frozenset[str] = frozenset(noun.name for noun in FAMILIES["extra_scenery"])
"""Nouns that only scenery uses: no prompt means them."""

AFLOAT: frozenset[str] = frozenset(
    name for name in NOUNS if NOUNS[VARIANTS.get(name, name)].motion in ("sail", "paddle")
)
"""Names of the nouns that float on the surface: boats and ducks."""

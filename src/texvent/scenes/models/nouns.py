"""All nouns of the embedded generator.

Origins: a noun with habitat "ground" or "fixed" stands on z = 0 below its middle (a ball too: it
rolls; a throw lifts it). One with habitat "air" or "water" has its origin at its
middle, except that what floats (`AFLOAT`) has it on the waterline: put it at the water's surface.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib.resources import files
from types import MappingProxyType

from texvent.scenes.models.animals import (
    breeds,
    coloured_birds,
    crawlers,
    flying_birds,
    more_quadrupeds,
    night_animals,
    other_bodies,
    quadrupeds,
    rare_quadrupeds,
    sea_life,
    small_animals,
    walking_birds,
)
from texvent.scenes.models.objects import bending, nature, plants
from texvent.scenes.models.objects.outdoors import flowing, vegetation, wild
from texvent.scenes.models.parts import read_nouns
from texvent.scenes.models.people import hand, person, wearables
from texvent.scenes.models.people.creatures import nouns as creatures
from texvent.scenes.models.people.roles import clothes
from texvent.scenes.models.people.roles import nouns as roles
from texvent.scenes.models.protocol import Noun

_MODULES = (
    person,
    roles,
    hand,
    wearables,
    clothes,
    quadrupeds,
    more_quadrupeds,
    breeds,
    rare_quadrupeds,
    other_bodies,
    night_animals,
    crawlers,
    walking_birds,
    flying_birds,
    sea_life,
    small_animals,
    plants,
    nature,
    flowing,
    wild,
    bending,
    coloured_birds,
    vegetation,
    creatures,
)


def _read_families() -> dict[str, tuple[Noun, ...]]:
    """Nouns of the files of `data/nouns`, by the files' names."""
    folder = files("texvent.scenes.models") / "data" / "nouns"
    found = sorted((one for one in folder.iterdir() if one.name.endswith(".toml")),
                   key=lambda one: one.name)  # fmt: skip
    return {one.name.removesuffix(".toml"): read_nouns(one) for one in found}


FAMILIES: Mapping[str, tuple[Noun, ...]] = MappingProxyType(
    {" ".join(one.__name__.split(".")[3:]).replace("_", " "): one.NOUNS for one in _MODULES}
    | _read_families()
)
"""Nouns by family, such as "vehicles"."""

NOUNS: Mapping[str, Noun] = MappingProxyType(
    {noun.name: noun for family in FAMILIES.values() for noun in family}
)
"""Every noun by its singular name."""

DRESSING: frozenset[str] = frozenset(noun.name for noun in FAMILIES["dressing"])
"""Set dressing of places: no prompt means it."""

AFLOAT: frozenset[str] = frozenset(
    name for name, noun in NOUNS.items() if noun.motion in ("sail", "paddle")
)
"""Names of the nouns that float on the surface: boats and ducks."""

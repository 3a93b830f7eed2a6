"""All nouns of the embedded generator.

Origins: a noun with habitat "ground" or "fixed" stands on z = 0 below its middle (a ball too: it
rolls; a throw lifts it). One with habitat "air" or "water" has its origin at its
middle, except that what floats (`AFLOAT`) has it on the waterline: put it at the water's surface.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models import solids
from texvent.scenes.models.bodies.nouns import BODY_FAMILIES
from texvent.scenes.models.objects import (
    buildings,
    furniture,
    household,
    patterns,
    street,
    toys,
)
from texvent.scenes.models.objects.home import (
    belongings,
    electronics,
    furnishing,
    house_and_games,
    lights,
    personal,
    screens,
    small_things,
)
from texvent.scenes.models.objects.kitchen import appliances, dishes, food, helpings, tableware
from texvent.scenes.models.objects.outdoors import (
    estates,
    landmarks,
    street_furniture,
    structures,
    vegetation,
    wild,
)
from texvent.scenes.models.objects.places import enclosures, grounds, halls, interiors, rooms
from texvent.scenes.models.objects.play import music, toppling
from texvent.scenes.models.objects.play import toys as playthings
from texvent.scenes.models.objects.sport import balls, equipment, gear
from texvent.scenes.models.objects.work import (
    escalator,
    experiments,
    machines,
    rare_vehicles,
    robots,
    targets,
    tools,
)
from texvent.scenes.models.people import hand, person, wearables
from texvent.scenes.models.people.roles import clothes
from texvent.scenes.models.people.roles import nouns as roles
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.vehicles import (
    aircraft,
    boats,
    cars,
    construction,
    cycles,
    heavy,
    ships_and_planes,
    trucks_and_carriages,
)

_MODULES = (
    cars,
    heavy,
    cycles,
    aircraft,
    boats,
    construction,
    person,
    roles,
    hand,
    wearables,
    clothes,
    buildings,
    street,
    toys,
    solids,
    furniture,
    household,
    food,
    appliances,
    screens,
    electronics,
    furnishing,
    lights,
    personal,
    balls,
    music,
    tools,
    machines,
    robots,
    toppling,
    escalator,
    street_furniture,
    structures,
    wild,
    patterns,
    playthings,
    gear,
    tableware,
    small_things,
    rare_vehicles,
    trucks_and_carriages,
    ships_and_planes,
    vegetation,
    experiments,
    targets,
    dishes,
    house_and_games,
    rooms,
    grounds,
    belongings,
    equipment,
    landmarks,
    halls,
    enclosures,
    interiors,
    estates,
    helpings,
)
FAMILIES: Mapping[str, tuple[Noun, ...]] = MappingProxyType(
    {" ".join(one.__name__.split(".")[3:]).replace("_", " "): one.NOUNS for one in _MODULES}
    | dict(BODY_FAMILIES)
)
"""Nouns by family, such as "vehicles cars"."""

NOUNS: Mapping[str, Noun] = MappingProxyType(
    {noun.name: noun for family in FAMILIES.values() for noun in family}
)
"""Every noun by its singular name."""

AFLOAT: frozenset[str] = frozenset(
    name for name, noun in NOUNS.items() if noun.motion in ("sail", "paddle")
)
"""Names of the nouns that float on the surface: boats and ducks."""

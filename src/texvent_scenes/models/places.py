"""Places as data: the ground of each, its scenery, and the words that name it.

`data/places.toml` says what its fields mean; an entry there is all that a new place takes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Literal

from texvent_scenes.models.tables import frozen, read_table
from texvent_scenes.rendered_scene import Colour, Ground, Texture

Where = Literal["around", "walls", "under", "water", "far", "route", "kerb", "bays"]
"""Regions of a place for scenery."""
_SCALES: Mapping[str, tuple[float, float]] = {
    "walls": (0.95, 1.1), "under": (1.0, 1.0), "kerb": (0.95, 1.05),
    "bays": (0.95, 1.05),
}  # fmt: skip
"""Usual multiples of its size, of what does not stand around."""


@dataclass(frozen=True)
class Scenery:
    """Pieces of scenery of one noun, with the region that they are scattered over."""

    noun: str
    count: int = 1
    where: Where = "around"
    reach: tuple[float, float] = (0.0, 0.0)
    """Nearest and farthest: in camera distances behind what the camera looks at, or metres from
    the camera of what is far off; of what lies under all, how far before the first of them."""
    scale: tuple[float, float] = (0.8, 1.2)
    """Least and greatest multiple of its usual size."""
    colours: tuple[Colour | None, ...] = (None,)
    faces: bool = False
    """Whether its front is turned to the camera."""
    grows: bool = False
    """Whether its size follows the distance of the camera, so that it neither towers nor
    vanishes."""

    @property
    def is_structure(self) -> bool:
        """Whether it is part of a place that is empty, too: lines on the ground."""
        return self.where == "under"


@dataclass(frozen=True)
class PlaceModel:
    """The ground of a place, its walls, and its scenery."""

    names: tuple[str, ...]
    ground: Ground
    colours: tuple[Colour, Colour]
    """Colours of the ground's pattern, or of land and of road or water."""
    surface: Texture | None = None
    """Material of the ground; None = the usual one of its kind."""
    walls: Texture = Texture.PLASTER
    wall_colour: Colour = (0.75, 0.69, 0.61)
    has_ceiling_panels: bool = False
    """Whether a room's ceiling hangs in panels."""
    road_m: float = 3.4
    """Half the width of its road or river."""
    corridor_m: float = 0.0
    """Half its width, of a room that is a corridor; 0 = it is none."""
    hall_m: float = 0.0
    """Half its least side, of a room that is a hall, m; 0 = it is none."""
    light: str = ""
    """Its daylight, where that is not that of the open air."""
    flight_m: float = 0.0
    """Additional height of things that fly."""
    is_backdrop: bool = False
    """Whether it is a background without horizon and stars."""
    is_cleared: bool = False
    """Whether nothing stands in it where it is empty; else only people, animals and traffic go."""
    scenery: tuple[Scenery, ...] = field(default=())

    @property
    def is_room(self) -> bool:
        """Whether it has walls and a ceiling."""
        return self.ground is Ground.FLOOR

    @property
    def has_road(self) -> bool:
        """Whether a road or a street runs through it."""
        return self.ground in (Ground.ROAD, Ground.DIRT_ROAD, Ground.CITY)

    @property
    def has_shore(self) -> bool:
        """Whether water lies beside land."""
        return self.ground in (Ground.RIVER, Ground.LAKE)

    @property
    def has_surface(self) -> bool:
        """Whether there is water on which something may float."""
        return self.has_shore or self.ground is Ground.SEA


def _place_of(fields: dict[str, Any]) -> PlaceModel:
    ground, walls = fields.pop("ground"), fields.pop("walls", None)
    if "surface" in ground:
        fields["surface"] = Texture[ground["surface"].upper()]
    if walls is not None:
        fields["walls"] = Texture[walls["surface"].upper()]
        fields["wall_colour"] = walls["colour"]
    fields["scenery"] = tuple(
        Scenery(**{"scale": _SCALES.get(row.get("where"), Scenery.scale), **row})
        for row in fields.get("scenery", ())
    )
    kind = Ground[ground["kind"].upper().replace(" ", "_")]
    fields.setdefault("light", "room" if kind is Ground.FLOOR else "")
    return PlaceModel(ground=kind, colours=ground["colours"], **fields)


PLACES: Mapping[str, PlaceModel] = MappingProxyType(
    {name: _place_of(row) for name, row in frozen(read_table("places")).items()}
)


SEEN_FROM_AFAR: Mapping[str, str] = MappingProxyType({"city": "skyline"})
"""Place that is a backdrop → the place that it is from outside."""
_MOST_ROOMS = 5
"""Rooms that a piece of furniture may stand in which tells one of them: a chair stands in more."""


def list_telling(place: str) -> frozenset[str]:
    """Nouns of the scenery by which one tells a room: those that few rooms have."""
    rooms = Counter(
        noun for one in PLACES.values() if one.is_room
        for noun in {each.noun for each in one.scenery}
    )  # fmt: skip
    own = {one.noun: rooms[one.noun] for one in PLACES[place].scenery}
    most = max(_MOST_ROOMS, min(own.values(), default=0))
    return frozenset(noun for noun, count in own.items() if count <= most)


def is_room(place: str) -> bool:
    """Whether a place has walls and a ceiling."""
    return PLACES[place].is_room

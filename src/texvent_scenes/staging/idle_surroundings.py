"""Fields of the light and the place of a scene that change nothing."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields
from typing import NamedTuple

from texvent.errors import few, shown
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES, PlaceModel
from texvent_scenes.rendered_scene import Ground
from texvent_scenes.spec.scene import Place, Scene, SceneObject

MOST_NAMED = 6
"""Most words that an error names."""


class Idle(NamedTuple):
    """A field without effect."""

    path: str
    why: str
    is_usual: bool = False
    """Whether it says only what is so anyway: no file is refused for that."""


def idle_light(scene: Scene) -> Iterator[Idle]:
    """Fields of the light that change nothing."""
    if scene.light.wave != "sine" and scene.light.flicker_hz is None:
        yield Idle("light.wave", "it is that of light that flickers; give flicker_hz")
    for number, lamp in enumerate(scene.light.lamps):
        if lamp.wave != "sine" and lamp.frequency_hz is None:
            yield Idle(f"light.lamps[{number}].wave", "it is that of a lamp with a frequency; "
                       "give frequency_hz")  # fmt: skip


_WATER = (Ground.SEA, Ground.LAKE, Ground.RIVER, Ground.UNDERWATER)
_WETTED = (Ground.PLAIN, Ground.ROAD, Ground.CITY)
_OF_PLACES: Mapping[str, tuple[Callable[[PlaceModel], bool], str]] = {
    "road": (lambda place: place.has_road, "a road"),
    "crossing_m": (lambda place: place.has_road, "a road"),
    "road_m": (lambda place: place.has_road, "a road"),
    "road_heading_deg": (lambda place: place.has_road, "a road"),
    "wave_height": (lambda place: place.ground in _WATER, "water"),
    "is_lit": (lambda place: place.is_room, "lamps of its own"),
    "sky": (lambda place: not place.is_room, "a sky"),
    "clouds": (lambda place: not place.is_room, "a sky"),
    "backdrops": (lambda place: not place.is_room, "a horizon"),
    "colour": (lambda place: place.ground is not Ground.NONE, "a ground"),
    "is_wet": (lambda place: place.ground in _WETTED, "a road or a paved ground"),
}
"""Field of a place → whether a place reads it, and what it needs."""


def idle_place(scene: Scene, name: str) -> Iterator[Idle]:
    """Fields that change nothing in a place."""
    said = scene.place
    for each in fields(said):
        reads, needed = _OF_PLACES.get(each.name, (None, ""))
        value = getattr(said, each.name)
        if reads is None or value in (each.default, ()) or reads(PLACES[name]):
            continue
        if value is False:  # it is not wet
            yield Idle(f"place.{each.name}", f"the place {shown(name)} is not", is_usual=True)
            continue
        known = few([other for other, place in PLACES.items() if reads(place)], MOST_NAMED)
        yield Idle(f"place.{each.name}", f"the place {shown(name)} has not {needed}; "
                   f"these have: {known}")  # fmt: skip
    if said.is_lit and scene.light.kind not in ("night", "moonlight"):
        yield Idle("place.is_lit", "it says so of a room at night or by moonlight", is_usual=True)
    if said.weather_amount != Place.weather_amount and said.weather is None:
        yield Idle("place.weather_amount", "it is that of a weather; give weather")
    if said.is_wet and said.weather == "rain" and PLACES[name].ground in _WETTED:
        yield Idle("place.is_wet", "rain wets the ground anyway", is_usual=True)
    is_lane = [one.placement == "lane" and not _is_above_water(one, PLACES[name])
               for one in scene.objects]  # fmt: skip
    travels = any(one.kind == "travel" for one in scene.camera.moves)
    for road_field in ("road_m", "road_heading_deg") if travels else ():
        if getattr(said, road_field) is not None:
            why = "travel goes along a road of its own, in its right lane; a dolly goes along any"
            yield Idle(f"place.{road_field}", why)
    if any(is_lane) and not (PLACES[name].has_road or travels):
        yield Idle(f"objects[{is_lane.index(True)}].placement", f"{shown(name)} has no lane")


def _is_above_water(one: SceneObject, place: PlaceModel) -> bool:
    """Whether an object flies above the water of a river or lake, which is its lane."""
    return place.has_shore and one.noun in NOUNS and NOUNS[one.noun].habitat == "air"

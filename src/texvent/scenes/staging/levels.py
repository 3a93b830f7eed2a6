"""How high things float, swim and fly at a place."""

from __future__ import annotations

from collections.abc import Mapping

from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.models.nouns import AFLOAT
from texvent.scenes.models.places import Place
from texvent.scenes.models.protocol import Noun
from texvent.scenes.scene import Ground

_OFF_THE_BED = 0.5
"""How high people swim above the bed of the sea, as a multiple of their height."""
_SUNK = -0.18
"""Height of the origin of what swims at the surface, in its sizes."""


def choose_levels(
    place: Place, description: SceneDescription, nouns: Mapping[str, Noun]
) -> dict[str, float]:
    """Height of origins above the ground: habitat or noun → multiple of an object's size.

    "clear" is in metres, on top of that, for what flies.
    """
    if place.ground is Ground.NONE:
        everything = {nouns[scene_object.noun].name: 0.0 for scene_object in description.objects}
        return {"air": 2.0, "water": 0.0, **everything}
    levels = {"air": 1.5, "water": 0.5, "clear": place.flight_m}
    if place.ground is Ground.UNDERWATER:
        divers = [one.noun for one in description.objects if _swims_from_land(one, nouns)]
        return {**levels, "water": 0.9, **dict.fromkeys(divers, _OFF_THE_BED)}
    if place.ground is Ground.SEA or place.has_shore:
        swimmers = {noun.name: _SUNK for noun in nouns.values() if noun.habitat == "water"}
        return {**levels, "water": 0.0, **swimmers, **dict.fromkeys(AFLOAT, 0.0)}
    return {**levels, **dict.fromkeys(AFLOAT, 0.25)}


def _swims_from_land(one: SceneObject, nouns: Mapping[str, Noun]) -> bool:
    """As a diver does: what lives in the water is high enough anyway."""
    is_of_land = nouns[one.noun].habitat == "ground"
    return is_of_land and one.motion is not None and one.motion.kind == "swim"

"""How high things float, swim and fly at a place."""

from __future__ import annotations

from collections.abc import Mapping

from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.models.nouns import AFLOAT
from texvent.scenes.models.protocol import Noun
from texvent.scenes.staging.surroundings.waterside import WATERSIDE

_HIGH_PLACES = ("mountain", "forest", "city")
"""Where what flies does so above the trees and streets."""
_OFF_THE_BED = 0.5
"""How high people swim above the bed of the sea, as a multiple of their height."""


def choose_levels(
    place: str, description: SceneDescription, nouns: Mapping[str, Noun]
) -> dict[str, float]:
    """Height of origins above the ground: habitat or noun → multiple of an object's size.

    "clear" is in metres, on top of that, for what flies.
    """
    if place in ("sky", "space"):
        everything = {nouns[scene_object.noun].name: 0.0 for scene_object in description.objects}
        return {"air": 2.0, "water": 0.0, **everything}
    levels = {
        "air": 1.5,
        "water": 0.0,
        "clear": 8.0 if place in _HIGH_PLACES else 0.0,
        "laser dot": 0.0,
    }
    if place == "underwater":
        levels["water"] = 0.9
        divers = [one.noun for one in description.objects if _swims_from_land(one, nouns)]
        levels.update(dict.fromkeys(divers, _OFF_THE_BED))
    elif place == "sea" or place in WATERSIDE:
        levels.update({noun.name: -0.18 for noun in nouns.values() if noun.habitat == "water"})
        levels.update(dict.fromkeys(AFLOAT, 0.0))
    else:
        levels["water"] = 0.5
        levels.update(dict.fromkeys(AFLOAT, 0.25))
    return levels


def _swims_from_land(one: SceneObject, nouns: Mapping[str, Noun]) -> bool:
    """As a diver does: what lives in the water is high enough anyway."""
    is_of_land = nouns[one.noun].habitat == "ground"
    return is_of_land and one.motion is not None and one.motion.kind == "swim"

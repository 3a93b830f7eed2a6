"""How high things float, swim and fly at a place."""

from __future__ import annotations

from collections.abc import Mapping

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.nouns import AFLOAT
from texvent.scenes.models.protocol import Noun
from texvent.scenes.staging.surroundings.waterside import WATERSIDE

_HIGH_PLACES = ("mountain", "forest", "city")
"""Where what flies does so above the trees and streets."""


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
    }
    if place == "underwater":
        levels["water"] = 0.9
    elif place == "sea" or place in WATERSIDE:
        levels.update({noun.name: -0.18 for noun in nouns.values() if noun.habitat == "water"})
        levels.update(dict.fromkeys(AFLOAT, 0.0))
    else:
        levels["water"] = 0.5
        levels.update(dict.fromkeys(AFLOAT, 0.25))
    return levels

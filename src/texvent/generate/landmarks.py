"""What a place of the prompt is known by: trees of a forest, water of a river, a sky of clouds."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.description import SceneDescription
from texvent.scenes.inflection import list_plurals
from texvent.scenes.language.vocabulary.scene import PLACES, STEEP
from texvent.scenes.scene import Environment, Float64Array, Ground
from texvent.scenes.staging.surroundings.built_places import BUILT_MARKS
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.scenes.staging.surroundings.scenery.tables import SCENERY

SKY, WATER, ROAD = "sky", "water", "road"
"""Marks that are no nouns of scenery."""
LEAST_MARK = 0.003
"""Share of the picture that a thing covers by which a place is told."""
_LEAST = {WATER: 0.02, SKY: 0.05, ROAD: 0.02, "mountain": 0.02}
"""The same of other marks."""
_SKY = ("sky", "skies", "clouds", "overcast")
_SKY_WORDS = frozenset({"stars", "starry", "starry sky", "sunset", "sunrise"})
_NOUNS = {
    "forest": frozenset({"pine", "tree", "palm"}),
    "mountain": frozenset({"mountain", "volcano"}),
    "city": frozenset({"building", "house", "skyscraper"}),
}
_CITY_WORDS = frozenset({"city", "town", "downtown", "urban"})
"""Words of a city that say more than its street."""
_ROOMS = ("living room", "kitchen", "bedroom", "office", "workshop", "warehouse", "gym",
          "construction site")  # fmt: skip
_GROUNDS = {
    "sea": WATER, "river": WATER, "lake": WATER, "beach": WATER, "road": ROAD,
        "dirt road": ROAD, "space": SKY,
}  # fmt: skip


class Landmark(NamedTuple):
    """A word of the prompt, and what it is known by: one of it must come into view."""

    word: str
    marks: frozenset[str]
    """Nouns of scenery or of things, `SKY`, `WATER`, `ROAD`."""


def list_landmarks(description: SceneDescription) -> list[Landmark]:
    """What of the prompt's place and sky must be seen in the picture."""
    said = description.surroundings
    found = []
    for place in dict.fromkeys((said.place or "", *said.backdrops)):
        words = [word for word in description.shown if _is_word_for(place, word)]
        words += [one.said for one in description.substituted if _is_word_for(place, one.shown)]
        marks = _marks_of(place, is_empty=said.is_empty and place not in said.backdrops)
        found += [Landmark(word, marks) for word in words if marks]
    if said.sky is not None or said.clouds is not None:
        words = [word for word in description.shown if word.split()[-1] in _SKY]
        found.append(Landmark(words[0] if words else "sky", frozenset({SKY})))
    return found + [
        Landmark(word, frozenset({SKY})) for word in description.shown if _names_the_sky(word)
    ]


def _names_the_sky(word: str) -> bool:
    return word in _SKY_WORDS or "stars" in word.split()


def _is_word_for(place: str, word: str) -> bool:
    if place == "city" and word not in _CITY_WORDS:
        return False
    names = (*PLACES.get(place, ()), *(STEEP if place == "mountain" else ()))
    return any(word == one or word in list_plurals(one) for one in names)


def _marks_of(place: str, *, is_empty: bool) -> frozenset[str]:
    if place in _GROUNDS:
        return frozenset({_GROUNDS[place]})
    if is_empty:
        return frozenset()
    if place in BUILT_MARKS:
        return BUILT_MARKS[place]
    if place in _ROOMS:
        return frozenset(rule.noun for rule in SCENERY.get(place, ()))
    return _NOUNS.get(place, frozenset())


def least_share(mark: str) -> float:
    """Share of the picture that a mark covers at least for its place to be told."""
    return _LEAST.get(mark, LEAST_MARK)


def is_marked(environment: Environment, spots: Float64Array) -> tuple[str, NDArray[np.bool_]]:
    """Which ground points are water or road.

    Args:
        environment: surroundings of the scene.
        spots: [n, 2] x and y on the ground, m.

    Returns:
        `WATER`, `ROAD` or "" for a ground without either, and [n] whether each point is that.
    """
    ground = environment.ground
    if ground in (Ground.SEA, Ground.UNDERWATER):
        return WATER, np.ones(len(spots), dtype=np.bool_)
    offset = (float(environment.road_offset[0]), float(environment.road_offset[1]))
    line = RoadLine(environment.road_angle, offset, environment.road_curvature)
    if ground is Ground.LAKE:
        return WATER, np.array([line.across(spot) > 0.0 for spot in spots], dtype=np.bool_)
    if ground in (Ground.RIVER, Ground.ROAD, Ground.DIRT_ROAD, Ground.CITY):
        kind = WATER if ground is Ground.RIVER else ROAD
        return kind, np.asarray(line.distance(spots) < environment.road_half_width)
    return "", np.zeros(len(spots), dtype=np.bool_)

"""Scenery on both sides of the route of a camera that travels: as much at its end as before."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.models.places import Scenery
from texvent.scenes.models.protocol import Model, Noun
from texvent.scenes.models.traits import nouns_with, trait_value
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.camera.journey import VIEW_M, TravelPlan
from texvent.scenes.staging.surroundings.scenery import (
    SceneryItem,
    ViewClearance,
    build,
    is_free,
    list_bodies,
)

_USUAL_SPACING_M = 12.0
"""From one to the next on a side of the route."""
_USUAL_ASIDE_M = (0.8, 9.0)
"""Least and most from the free strip to its edge."""
_BEFORE_M = 4.0
"""How far before its beginning it starts."""
_MOST_ITEMS = 90


def is_placed_by_view(rule: Scenery) -> bool:
    """Whether it stands where the camera looks, not beside the route."""
    return rule.where == "far" or rule.is_structure


@dataclass(frozen=True)
class _Strip:
    """A line with scenery on both sides."""

    point: Callable[[float, float], tuple[float, float, float]]
    """Metres along and to the right → x, y and heading."""
    length_m: float
    clear_m: tuple[float, float]
    """Metres that stay free to the left and to the right."""


def line_route(
    rules: Sequence[Scenery],
    view: ViewClearance,
    travel: TravelPlan,
    actors: Sequence[Actor],
    nouns: Mapping[str, Noun],
    rng: np.random.Generator,
) -> list[SceneryItem]:
    """Scenery along a route, on both sides, from behind its beginning to beyond its end.

    Args:
        rules: what belongs to the place; those that say metres stand far off and are left out.
        view: the camera over the clip, and the road, which stays free.
        travel: the route.
        actors: the objects of the scene, which nothing may stand in.
        nouns: table of models; a noun that is missing is left out.
        rng: decides places, sizes and turns.
    """
    known = [rule for rule in rules if rule.noun in nouns and not is_placed_by_view(rule)]
    strips = [_Strip(travel.point, travel.length_m + VIEW_M, travel.clear_m)]
    reach = sum(strip.length_m + _BEFORE_M for strip in strips)
    stretch = max(1.0, sum(2.0 * reach / _spacing_of(rule.noun) for rule in known) / _MOST_ITEMS)
    bodies, line = list_bodies(actors), travel.places(0.5)
    items: list[SceneryItem] = []
    for rule, strip, side in itertools.product(known, strips, (1.0, -1.0)):
        spacing = stretch * _spacing_of(rule.noun)
        for number in range(math.ceil((strip.length_m + _BEFORE_M) / spacing)):
            along = spacing * (number + float(rng.uniform(0.1, 0.9))) - _BEFORE_M
            model = build(rule, nouns[rule.noun], number, rng)
            item = _place(rule, model, strip, along, side, rng)
            if nouns[rule.noun].habitat == "air":
                height = travel.journey.height_m + float(rng.uniform(-5.0, 4.0))
                item = replace(item, height_m=height)
            away = float(np.min(np.hypot(*(line - item.position).T))) - item.radius_m
            if away >= min(travel.clear_m) and is_free(item, rule, view, bodies, items):
                items.append(item)
    return items


def _spacing_of(noun: str) -> float:
    return float(trait_value("spacing along a road", noun) or _USUAL_SPACING_M)


def _place(
    rule: Scenery,
    model: Model,
    strip: _Strip,
    along_m: float,
    side: float,
    rng: np.random.Generator,
) -> SceneryItem:
    near, far = trait_value("distance from a road", rule.noun) or _USUAL_ASIDE_M
    radius = 0.5 * max(model.length, model.width)
    clear = strip.clear_m[1 if side > 0.0 else 0]
    aside = clear + radius + near + (far - near) * float(rng.uniform()) ** 2
    x, y, heading = strip.point(along_m, side * aside)
    yaw = heading + side * 0.5 * math.pi
    if rule.noun not in nouns_with("parallel to road"):
        yaw = float(rng.uniform(0.0, 2.0 * math.pi))
    return SceneryItem(rule.noun, model, (x, y), yaw)

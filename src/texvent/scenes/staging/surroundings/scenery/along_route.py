"""Scenery on both sides of a route: as much at its end as at its beginning."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from texvent.scenes.models.protocol import Model, Noun
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.camera.journey import VIEW_M, TravelPlan
from texvent.scenes.staging.surroundings.scenery.scatter import SceneryItem, list_bodies
from texvent.scenes.staging.surroundings.scenery.scatter_rule import ScatterRule, is_structure

SPACING_M = {"building": 17.0, "house": 24.0, "street lamp": 14.0, "tree": 9.0, "pine": 7.0,
             "palm": 11.0, "bush": 7.0, "flower": 5.0, "rock": 12.0, "barrier": 15.0,
             "box": 12.0, "cloud": 16.0}  # fmt: skip
"""Noun → metres from one to the next on a side of the route."""
_USUAL_SPACING_M = 12.0
BRANCH_M = 45.0
"""How far scenery goes along a road that leaves the route."""
MOST_ITEMS = 90
_ASIDE = {"building": (2.5, 5.0), "house": (3.0, 10.0), "street lamp": (0.2, 0.4),
          "barrier": (0.3, 0.8), "flower": (0.2, 2.5), "bush": (0.4, 6.0)}  # fmt: skip
"""Noun → least and most metres from the free strip to its edge."""
_USUAL_ASIDE = (0.8, 9.0)
_SQUARE = ("building", "house", "barrier", "street lamp")


def is_placed_by_view(rule: ScatterRule) -> bool:
    """Whether it stands where the camera looks, not beside the route."""
    return rule.is_metres or is_structure(rule)


def line_route(
    rules: Sequence[ScatterRule],
    travel: TravelPlan,
    actors: Sequence[Actor],
    nouns: Mapping[str, Noun],
    *,
    rng: np.random.Generator,
    road_half_m: float | None = None,
) -> list[SceneryItem]:
    """Scenery along a route, on both sides, from behind its beginning to beyond its end.

    Args:
        rules: what belongs to the place; those that say metres stand far off and are left out.
        travel: the route.
        actors: the objects of the prompt, which nothing may stand in.
        nouns: table of models; a noun that is missing is left out.
        rng: decides places, sizes and turns.
        road_half_m: half width of the road, which stays free; None = there is none.
    """
    known = [rule for rule in rules if rule.noun in nouns and not is_placed_by_view(rule)]
    strips = [_strip_of(travel)]
    half = road_half_m or 0.0
    strips += [
        _Strip(partial(_on_straight, branch), BRANCH_M, (half, half))
        for branch in travel.branches()
    ]
    reach = sum(strip.length_m + 4.0 for strip in strips)
    wanted = sum(2.0 * reach / SPACING_M.get(rule.noun, _USUAL_SPACING_M) for rule in known)
    stretch = max(1.0, wanted / MOST_ITEMS)
    bodies = list_bodies(actors)
    line = travel.places(0.5)
    items: list[SceneryItem] = []
    for rule, strip, side in itertools.product(known, strips, (1.0, -1.0)):
        spacing = stretch * SPACING_M.get(rule.noun, _USUAL_SPACING_M)
        for number in range(math.ceil((strip.length_m + 4.0) / spacing)):
            along = -4.0 + spacing * (number + float(rng.uniform(0.1, 0.9)))
            model = nouns[rule.noun].build(
                colour=rule.colours[number % len(rule.colours)],
                scale=float(rng.uniform(*rule.scale)), seed=int(rng.integers(2**31)),
            )  # fmt: skip
            item = _place(rule, model, strip, (along, side), rng)
            if rule.noun == "cloud":
                height = travel.journey.height_m + float(rng.uniform(-5.0, 4.0))
                item = replace(item, height_m=height)
            if _is_free(item, travel, line, bodies, items, road_half_m):
                items.append(item)
    return items


@dataclass(frozen=True)
class _Strip:
    """A line with scenery on both sides."""

    point: Callable[[float, float], tuple[float, float, float]]
    """Metres along and to the right → x, y and heading."""
    length_m: float
    clear_m: tuple[float, float]
    """Metres that stay free to the left and to the right."""


def _strip_of(travel: TravelPlan) -> _Strip:
    return _Strip(travel.point, travel.length_m + VIEW_M, travel.clear_m)


def _on_straight(
    start: tuple[float, float, float], along_m: float, right_m: float
) -> tuple[float, float, float]:
    x, y, heading = start
    x += along_m * math.cos(heading) + right_m * math.sin(heading)
    y += along_m * math.sin(heading) - right_m * math.cos(heading)
    return x, y, heading


def _place(
    rule: ScatterRule,
    model: Model,
    strip: _Strip,
    where: tuple[float, float],
    rng: np.random.Generator,
) -> SceneryItem:
    along, side = where
    near, far = _ASIDE.get(rule.noun, _USUAL_ASIDE)
    radius = 0.5 * max(model.length, model.width)
    clear = strip.clear_m[1 if side > 0.0 else 0]
    aside = clear + radius + near + (far - near) * float(rng.uniform()) ** 2
    x, y, heading = strip.point(along, side * aside)
    yaw = heading + side * 0.5 * math.pi
    if rule.noun not in _SQUARE:
        yaw = float(rng.uniform(0.0, 2.0 * math.pi))
    return SceneryItem(rule.noun, model, (x, y), yaw)


def _is_free(
    item: SceneryItem,
    travel: TravelPlan,
    line: Float64Array,
    bodies: Float64Array,
    items: Sequence[SceneryItem],
    road_half_m: float | None,
) -> bool:
    spot, radius = np.array(item.position), item.radius_m
    if float(np.min(np.hypot(*(line - spot).T))) < min(travel.clear_m) + radius:
        return False
    if road_half_m is not None:
        distance = float(travel.road.distance(spot[None])[0])
        if distance < road_half_m + radius:
            return False
    if len(bodies) and np.any(np.hypot(*(bodies[:, :2] - spot).T) < bodies[:, 2] + radius + 0.2):
        return False
    return all(
        np.hypot(*(spot - other.position)) >= 0.8 * (radius + other.radius_m) for other in items
    )

"""Scenery: trees along a road, houses in a city, pines on a mountain.

It stands where the camera looks, or on both sides of the route of a camera that travels; never
between the camera and the objects of the scene, on the road, or in another's place.
"""

from __future__ import annotations

import itertools
import math
from collections import defaultdict
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from texvent.camera import PosedCamera
from texvent_scenes.models.places import Scenery
from texvent_scenes.models.protocol import Model, Noun
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.camera.journey import NORTH, VIEW_M, TravelPlan
from texvent_scenes.staging.surroundings.markings import (
    Laid,
    is_off,
    lay_lines,
    list_bays,
    list_rows,
)
from texvent_scenes.staging.surroundings.pieces import ASPECT, SceneryItem, ViewClearance

_BANK_M = 1.0
"""Land that scenery leaves free beside water, m."""
_FAR_SHORE_M = 100.0
"""Distance from which on scenery may stand beyond the water."""
_ROOM_M = 0.4
"""Between scenery and the way of an object, m."""
_KERB_M = 0.3
"""Distance of roadside objects from the edge of a road, m."""
_USUAL_DISTANCE_M = 16.0
_NEAR_CITY_M, _MOST_CITY = 30.0, 6.0
"""Distance of the camera from which on more buildings stand in its view, and how many times so."""
_ATTEMPTS = 40
"""Places tried for each piece before it is left out."""
_SPACING_M, _INDOORS_M, _ASIDE_M = 12.0, 3.0, (0.8, 9.0)
"""Along a route: usually from one to the next, the same in a room, and least and most from the
free strip."""
_CROP, _FIELD_M, _CROP_ASIDE_M = 20, 12.0, (0.1, 4.0)
"""Number of copies from which on a plant makes a field; how far that goes beyond the end of a
route, and beside it, m."""
_STEEP_RAD = 0.25
"""Angle below the horizon of an image's upper edge from which on it shows the ground around the
subject only."""
_ALONG_ROAD = 0.35
"""Sine of the angle to the road below which a camera looks along it."""
_WALL_SHARES = (-0.1, 0.1, -0.3, 0.3)
"""Places of furniture that would be out of the image, in widths from its middle."""
_LEAST_STEPS, _FINER = 4, 25
"""Instants of an object's way that must be free, and how many times as many at most."""
_BEFORE_M, _MOST_ITEMS = 4.0, 90
"""Start of scenery before a route's beginning, and greatest number of pieces."""
_BEYOND, _NOSE_IN = 1.3, 0.7
"""Distance of what is far beyond a subject that moves, in camera distances; share of vehicles in
bays whose nose is at the closed end."""
_ALONG_LINES = ("kerb", "bays")
"""Regions in which pieces stand along lines, close to others."""


Draw: TypeAlias = Callable[..., np.random.Generator]
"""Role → the generator of its draws; the same role has the same."""


def scatter(
    rules: Sequence[Scenery],
    view: ViewClearance,
    actors: Sequence[Actor],
    nouns: Mapping[str, Noun],
    *,
    draw: Draw,
    telling: Collection[str] = (),
) -> list[SceneryItem]:
    """Scatter scenery where the camera sees it and it hides and blocks nothing.

    Args:
        rules: what, how many and how far.
        view: the camera over the clip, its route, and what it must see.
        actors: the objects of the scene.
        nouns: table of models; a noun that is missing is left out.
        draw: decides places, sizes and turns: a generator for each role of each piece, so that
            none depends on which others find room.
        telling: nouns of which one should be in the image.

    Returns:
        The pieces that found a place; fewer than wanted where it is crowded.
    """
    rules = [rule for rule in rules if rule.noun in nouns]
    work = _Scatterer(view, actors, nouns, draw)
    beside: list[Scenery] = []
    if view.travel is not None:
        apart = ("far", "walls")
        beside = [rule for rule in rules if rule.where not in apart and not rule.is_structure]
        work.line_route(beside, view.travel)
    for rule in rules:
        if rule.where == "under":
            work.lay_under(rule)
        elif rule.where != "route" and rule not in beside:
            work.stand_in_view(rule)
    if telling:
        work.fill_view([one for one in rules if one.noun in telling and not one.is_structure])
    return work.items


class _Scatterer:
    """Puts up one piece after the other, clear of the view, the objects and the other pieces."""

    def __init__(
        self,
        view: ViewClearance,
        actors: Sequence[Actor],
        nouns: Mapping[str, Noun],
        draw: Draw,
    ) -> None:
        self.items: list[SceneryItem] = []
        self._stands: Mapping[str, Callable[[Scenery, Model, PosedCamera], SceneryItem | None]]
        self._stands = defaultdict(
            lambda: self._stand_around,
            walls=self._stand_at_wall,
            kerb=self._stand_at_kerb,
            bays=self._stand_in_bay,
        )
        self._view, self._nouns, self._draw, self._actors = view, nouns, draw, actors
        self._rng = draw()
        self._rules: dict[str, int] = defaultdict(int)
        """Noun → rules of it that are done, for several of a place are of one noun."""
        self._yaw = actors[0].track.at(0.0).yaw if actors else 0.0
        """Heading of the first object."""
        self._has_mover = any(one.is_mover for one in actors)
        rows = [
            (*one.middle(float(time_s))[:2], 0.5 * max(one.model.length, one.model.width))
            for one in actors
            for time_s in _list_times(one, view.clip_s)
        ]
        self._bodies = np.array(rows, dtype=np.float64).reshape(-1, 3)
        """[n, 3]: x, y and radius of the objects all along their ways, m."""
        boxes = [
            one.corners(time_s)[:, :2] for one in actors for time_s in _list_times(one, view.clip_s)
        ]
        self._corners = np.array(boxes, dtype=np.float64).reshape(-1, 8, 2)
        """[n, 8, 2]: x and y of the corners of their boxes, m."""

    def _build(self, rule: Scenery, copy: int, scale: float = 1.0) -> Model:
        """A copy of a piece, with its own size and seed."""
        return self._nouns[rule.noun].build(
            colour=rule.colours[copy % len(rule.colours)],
            scale=float(self._rng.uniform(*rule.scale)) * scale,
            seed=int(self._rng.integers(2**31)),
        )

    def stand_in_view(self, rule: Scenery) -> None:
        """Pieces somewhere in what the camera sees."""
        fit = min(max(self._view.distance_m / _USUAL_DISTANCE_M, 0.15), 1.5) if rule.grows else 1.0
        is_tall = rule.noun in nouns_with("towering")
        more = min(max(self._view.distance_m / _NEAR_CITY_M, 1.0), _MOST_CITY) if is_tall else 1.0
        role = self._role_of(rule)
        for copy in range(round(more * rule.count)):
            self._rng = self._draw(*role, copy)
            model = self._build(rule, copy, fit)
            for attempt in range(_ATTEMPTS):
                self._rng = self._draw(*role, copy, attempt)
                camera = self._view.cameras[int(self._rng.integers(len(self._view.cameras)))]
                item = self._stands[rule.where](rule, model, camera)
                if item is not None and self._is_free(item):
                    self.items.append(item)
                    break

    def _role_of(self, rule: Scenery) -> tuple[str, int]:
        """A rule among those of its noun."""
        self._rules[rule.noun] += 1
        return rule.noun, self._rules[rule.noun]

    def line_route(self, rules: Sequence[Scenery], travel: TravelPlan) -> None:
        """Pieces on both sides of a route, from behind its beginning to beyond its end.

        Of a field of one plant, these are near the route: farther off one would be too small.
        """
        length = travel.length_m + VIEW_M + _BEFORE_M
        usual_m = _SPACING_M if math.isinf(self._view.room_m) else _INDOORS_M
        spacing = {
            rule: float(trait_value("spacing along a road", rule.noun) or usual_m) for rule in rules
        }
        crops = {rule for rule in rules if rule.count >= _CROP}
        field_m = travel.length_m + _FIELD_M + _BEFORE_M
        spacing |= {rule: 2.0 * field_m / rule.count for rule in crops}
        ends_m = {rule: field_m if rule in crops else length for rule in rules}
        stretch = sum(2.0 * ends_m[one] / step for one, step in spacing.items()) / _MOST_ITEMS
        for rule, side in itertools.product(spacing, (1.0, -1.0)):
            role, step = self._role_of(rule), max(1.0, stretch) * spacing[rule]
            for number in range(math.ceil(ends_m[rule] / step)):
                self._rng = self._draw(*role, number)
                along = step * (number + float(self._rng.uniform(0.1, 0.9))) - _BEFORE_M
                item = self._stand_beside(rule, number, travel, along, side)
                if self._is_free(item):
                    self.items.append(item)

    def _stand_beside(
        self, rule: Scenery, copy: int, travel: TravelPlan, along_m: float, side: float
    ) -> SceneryItem:
        """At the side of a route, 1 = right, so far along it."""
        model = self._build(rule, copy)
        usual_m = _CROP_ASIDE_M if rule.count >= _CROP else _ASIDE_M
        near, far = trait_value("distance from a road", rule.noun) or usual_m
        is_at_kerb = rule.where == "kerb"
        across = model.width if is_at_kerb else max(model.length, model.width)
        aside = travel.clear(side) + 0.5 * across
        far = min(far, max(near, self._view.room_m - aside - 0.5 * across))
        aside += near + (far - near) * float(self._rng.uniform()) ** 2
        height = 0.0
        if self._nouns[rule.noun].habitat == "air":
            height = travel.journey.height_m + float(self._rng.uniform(-5.0, 4.0))
        yaw = self._turn(rule, NORTH if is_at_kerb else NORTH + side * 0.5 * math.pi)
        return SceneryItem(rule, model, travel.point(along_m, side * aside), yaw, height)

    def fill_view(self, rules: Sequence[Scenery]) -> None:
        """Pieces at the wall that the image shows, if none of these is in it yet."""
        camera = self._view.cameras[len(self._view.cameras) // 2]
        nouns = {rule.noun for rule in rules}
        if any(one.rule.noun in nouns and one.share_of(camera) for one in self.items):
            return
        forward, right = _axes(camera)
        for rule, share in itertools.product(rules, _WALL_SHARES):
            self._rng = self._draw(rule.noun, "telling")
            way = forward + share / camera.focal * right
            item = self._stand_before(rule, self._build(rule, 0), way)
            if item.share_of(camera) and self._is_free(item):
                self.items.append(item)

    def _stand_before(self, rule: Scenery, model: Model, way: Float64Array) -> SceneryItem:
        """At the wall that a ray [2] from the camera meets, with its back to it."""
        room = self._view.room_m
        start = self._view.cameras[len(self._view.cameras) // 2].position[:2]
        with np.errstate(divide="ignore"):
            reach = np.where(way > 0.0, room - start, -room - start) / way
        axis = int(np.argmin(np.where(np.isfinite(reach), reach, np.inf)))
        side = 1.0 if way[axis] >= 0.0 else -1.0
        spot = start + float(reach[axis]) * way
        spot[axis] = side * (room - 0.5 * model.length - 0.04)
        yaw = math.pi * (0.5 * axis + (1.0 if side > 0.0 else 0.0))
        return SceneryItem(rule, model, (float(spot[0]), float(spot[1])), yaw)

    def _turn(self, rule: Scenery, along_road: float) -> float:
        """Heading of a piece: along the road, or any."""
        is_parallel = rule.noun in nouns_with("parallel to road")
        return along_road if is_parallel else float(self._rng.uniform(0.0, 2.0 * math.pi))

    def lay_under(self, rule: Scenery) -> None:
        """Lines on the ground, fitted to the objects; see `markings.lay_lines`."""
        x, y = self._bodies[:, :2].mean(axis=0) if len(self._bodies) else (0.0, 0.0)
        ahead = rule.reach[0]
        spot = (float(x + ahead * math.cos(self._yaw)), float(y + ahead * math.sin(self._yaw)))
        usual = Laid(spot, self._view.road.angle)
        for one in lay_lines(rule.noun, usual, self._actors, self._view):
            self._rng = self._draw(rule.noun, "under")
            model = self._build(rule, 0, one.scale)
            self.items.append(SceneryItem(rule, model, one.spot, one.angle))

    def _stand_in_bay(self, rule: Scenery, model: Model, camera: PosedCamera) -> SceneryItem | None:
        """In a free bay that the camera sees, its nose at the closed end or at the way."""
        bays = [
            (row, place) for cells, row in list_rows(self.items) for place in list_bays(cells, row)
        ]
        if not bays:
            return None
        row, place = bays[int(self._rng.integers(len(bays)))]
        spot = row.point(*map(float, place))
        yaw = row.angle + math.pi * float(self._rng.uniform() < _NOSE_IN)
        item = SceneryItem(rule, model, spot, yaw)
        is_taken = any(one.rule.where == "bays" and one.position == spot for one in self.items)
        return item if item.share_of(camera) and not is_taken else None

    def _stand_around(self, rule: Scenery, model: Model, camera: PosedCamera) -> SceneryItem:
        """Somewhere in what the camera sees, as far off as the rule says."""
        share = float(self._rng.uniform(-0.62, 0.62))
        reach = self._draw_reach(rule, camera)
        forward, right = _axes(camera)
        depth = reach if _sees_far(camera) else math.hypot(reach, float(camera.position[2]))
        x, y = camera.position[:2] + reach * forward + depth * share / camera.focal * right
        if rule.faces:
            yaw = math.atan2(-float(forward[1]), -float(forward[0]))
            yaw += float(self._rng.uniform(-0.2, 0.2))
        else:
            yaw = self._turn(rule, self._view.road.angle - 0.5 * math.pi)
        return SceneryItem(rule, model, (float(x), float(y)), yaw)

    def _draw_reach(self, rule: Scenery, camera: PosedCamera) -> float:
        """Metres from the camera; below one that sees no horizon, on the ground that it sees."""
        near, far = rule.reach
        if not _sees_far(camera):
            low, high = (float(camera.position[2]) / math.tan(one) for one in _edges(camera))
            return float(self._rng.uniform(high, low))
        if rule.where == "far":
            is_beyond = near >= _FAR_SHORE_M and self._has_mover
            more = max(1.0, _BEYOND * self._view.distance_m / near) if is_beyond else 1.0
            return more * float(self._rng.uniform(near, far))
        pitch = math.asin(min(max(-float(camera.rotation[2, 2]), -1.0), 1.0))
        flat = self._view.distance_m * math.cos(pitch)
        return flat * (1.0 + float(self._rng.uniform(near, far)))

    def _stand_at_wall(self, rule: Scenery, model: Model, camera: PosedCamera) -> SceneryItem:
        """Somewhere along a wall that the camera sees, with its back to it."""
        forward, room = camera.rotation[2, :2], self._view.room_m
        shares = np.abs(forward) / max(float(np.abs(forward).sum()), 1e-9)
        axis = 0 if self._rng.uniform() < shares[0] else 1
        side = 1.0 if forward[axis] >= 0.0 else -1.0
        spot = [0.0, 0.0]
        spot[axis] = side * (room - 0.5 * model.length - 0.04)
        spot[1 - axis] = float(self._rng.uniform(-0.9, 0.9)) * (room - 0.5 * model.width)
        yaw = math.pi * (0.5 * axis + (1.0 if side > 0.0 else 0.0))
        return SceneryItem(rule, model, (spot[0], spot[1]), yaw)

    def _stand_at_kerb(
        self, rule: Scenery, model: Model, camera: PosedCamera
    ) -> SceneryItem | None:
        """Beside the road, along it, on the side that the camera looks at."""
        road, half_m = self._view.road, self._view.road_half_width
        if half_m is None:
            return None
        spot = np.array(self._stand_around(rule, model, camera).position)
        along = np.array([math.cos(road.angle), math.sin(road.angle)])
        left = np.array([-along[1], along[0]])
        forward, _ = _axes(camera)
        side = math.copysign(1.0, float(forward @ left))
        if abs(float(forward @ left)) < _ALONG_ROAD:  # it looks along the road
            side = float(self._rng.choice([-1.0, 1.0]))
        place = np.array(road.offset) + along * float((spot - road.offset) @ along)
        near, far = trait_value("distance from a road", rule.noun) or (_KERB_M, _KERB_M)
        aside = half_m + 0.5 * model.width + float(self._rng.uniform(near, far))
        place += side * aside * left
        heading = self._turn(rule, road.angle + (math.pi if side > 0.0 else 0.0))
        return SceneryItem(rule, model, (float(place[0]), float(place[1])), heading)

    def _meets_body(self, item: SceneryItem, deep_m: float) -> bool:
        """Whether an object comes near: to its circle, or to its box if it stands along a road."""
        if item.rule.where not in _ALONG_LINES:
            apart = np.hypot(*(self._bodies[:, :2] - item.position).T)
            return bool(np.any(apart < self._bodies[:, 2] + deep_m + _ROOM_M))
        cosine, sine = math.cos(item.yaw), math.sin(item.yaw)
        corners = (self._corners - item.position) @ [[cosine, -sine], [sine, cosine]]
        half = np.array([item.radius_m, deep_m]) + _ROOM_M
        is_near = (corners.min(axis=1) < half) & (corners.max(axis=1) > -half)
        return bool(is_near.all(axis=1).any())

    def _is_free(self, item: SceneryItem) -> bool:
        """Whether an item has room, hides nothing, and stands where it may: on land or afloat."""
        spot, radius, view = np.array(item.position), item.radius_m, self._view
        if view.road_half_width is not None:
            is_at_kerb = item.rule.where == "kerb"
            clear = view.road_half_width + (0.5 * _KERB_M if is_at_kerb else radius + 0.4)
            if float(view.road.distance(spot[None])[0]) < clear:
                return False
        is_at_wall = item.rule.where == "walls"
        room = view.room_m + (radius if is_at_wall else 0.0)
        if np.max(np.abs(spot)) + radius > room or not _is_on_its_side(item, view):
            return False
        # What stands at a wall is as deep as it is long, not as it is wide.
        deep = min(0.5 * item.model.length + 0.3, radius) if is_at_wall else radius
        if item.rule.where in _ALONG_LINES:
            deep = 0.5 * item.model.width + 0.3
        if self._meets_body(item, deep):
            return False
        is_parked = item.rule.where == "bays"
        if not (
            is_parked or all(is_off(*row, item.position, radius) for row in list_rows(self.items))
        ):
            return False
        others = (one for one in self.items
                  if not one.is_flat and not (is_parked and one.rule.where == "bays"))  # fmt: skip
        if any(np.hypot(*(spot - one.position)) < 0.8 * (radius + one.radius_m) for one in others):
            return False
        return not _hides(spot, radius, deep, view)


def _list_times(actor: Actor, clip_s: float) -> Float64Array:
    """Instants between which an object goes no further than its own length, as far as possible."""
    few = np.linspace(0.0, clip_s, _LEAST_STEPS + 1)
    steps = np.diff([actor.middle(float(time_s)) for time_s in few], axis=0)
    lengths = float(np.linalg.norm(steps, axis=1).max()) / actor.size_m
    return np.linspace(0.0, clip_s, _LEAST_STEPS * min(math.ceil(lengths) or 1, _FINER) + 1)


def _axes(camera: PosedCamera) -> tuple[Float64Array, Float64Array]:
    """[2] which way a camera looks over the ground, and [2] to its right."""
    forward = np.asarray(camera.rotation[2, :2], dtype=np.float64)
    forward = forward / max(float(np.hypot(*forward)), 1e-9)
    return forward, np.array([forward[1], -forward[0]])


def _edges(camera: PosedCamera) -> tuple[float, float]:
    """Angles below the horizon of the upper and the lower edge of an image, radians."""
    pitch = math.asin(min(max(-float(camera.rotation[2, 2]), -1.0), 1.0))
    half = math.atan(0.5 * ASPECT / camera.focal)
    return pitch - half, pitch + half


def _sees_far(camera: PosedCamera) -> bool:
    """Whether the ground in the upper part of an image is far off."""
    return _edges(camera)[0] < _STEEP_RAD


def _is_on_its_side(item: SceneryItem, view: ViewClearance) -> bool:
    """Whether what floats is in the water, and what stands is on land or far beyond the water."""
    rule, ashore = item.rule, -float(view.road.across(np.array([item.position]))[0])
    if rule.where == "water":
        return view.has_shore and -ashore > item.radius_m + 0.5
    is_beyond = rule.where == "far" and rule.reach[0] >= _FAR_SHORE_M
    return not view.has_shore or is_beyond or ashore >= item.radius_m + _BANK_M


def _hides(spot: Float64Array, radius_m: float, deep_m: float, view: ViewClearance) -> bool:
    """Whether an object there stands before something the camera must see, or at the camera."""
    for camera, points in zip(view.cameras, view.points, strict=True):
        start = camera.position[:2]
        if np.hypot(*(spot - start)) < radius_m + 1.0:
            return True
        rays = points[:, :2] - start
        lengths = np.maximum(np.hypot(rays[:, 0], rays[:, 1]), 1e-9)
        along = np.clip((rays @ (spot - start)) / lengths**2, 0.0, 1.0)
        nearest = start + along[:, None] * rays
        if np.any(np.hypot(*(nearest - spot).T) < deep_m + 0.15):
            return True
    return False

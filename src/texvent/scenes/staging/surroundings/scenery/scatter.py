"""Scenery: trees along a road, houses in a city, pines on a mountain.

Scenery never stands between the camera and the objects of the prompt, on the road, or in
another's place; nouns that the prompt excludes are left out.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from texvent.scenes.models.protocol import Model, Noun, Pose
from texvent.scenes.scene import Camera, Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.assemble import PlacedModel
from texvent.scenes.staging.camera.journey import TravelPlan
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.scenes.staging.surroundings.scenery.scatter_rule import ScatterRule
from texvent.scenes.staging.surroundings.scenery.walls import stand_across, stand_along
from texvent.scenes.staging.trajectories.trajectory import BodyState


@dataclass(frozen=True)
class ViewClearance:
    """What scenery must keep clear of."""

    cameras: Sequence[Camera]
    """The camera at some instants."""
    points: Sequence[Float64Array]
    """[n, 3] what it must see at those instants, m."""
    distance_m: float
    road_half_width: float | None
    """Half width of the strip to keep free, m; None = no road."""
    road: RoadLine
    room_m: float = math.inf
    travel: TravelPlan | None = None
    """The route of a camera that travels."""
    has_shore: bool = False
    """Whether water lies to the left of the road's line."""


_BANK_M = 1.0
"""Land that scenery leaves free beside water, m."""
_FAR_SHORE_M = 100.0
"""What stands further away than that may stand beyond the water."""
_USUAL_DISTANCE_M = 16.0
_IN_VIEW = 0.42
"""Half of what the image shows, but for its edges, as a multiple of the distance at focal 1."""
ATTEMPTS = 40
"""Places tried for each piece before it is left out."""


@dataclass(frozen=True)
class SceneryItem:
    """One piece of scenery; it stands still."""

    noun: str
    model: Model
    position: tuple[float, float]
    yaw: float
    height_m: float = 0.0
    """Of its origin, m."""
    is_at_wall: bool = False
    is_flat: bool = False
    """Whether it is paint on the ground, on which others stand."""

    @property
    def radius_m(self) -> float:
        """Of the ground it stands on."""
        return 0.5 * max(self.model.length, self.model.width)

    def place(self, instance: int) -> PlacedModel:
        """Its parts in the world."""
        state = BodyState((*self.position, self.height_m), self.yaw, activity="stand")
        parts = self.model.parts(Pose(0.0, 0.0, 0.0, "stand"))
        return PlacedModel(parts, state.to_world(), instance)


_FROM_NET_M = 1.2
"""Who is nearer to the middle of a court than that stands in its net."""


def scatter(
    rules: Sequence[ScatterRule],
    view: ViewClearance,
    actors: Sequence[Actor],
    nouns: Mapping[str, Noun],
    *,
    rng: np.random.Generator,
    taken: Sequence[SceneryItem] = (),
) -> list[SceneryItem]:
    """Scatter scenery where the camera sees it and it hides and blocks nothing.

    Args:
        rules: what, how many and how far.
        view: the camera over the clip, and what it must see.
        actors: the objects of the prompt.
        nouns: table of models; a noun that is missing is left out.
        rng: decides places, sizes and turns.
        taken: scenery that stands already.

    Returns:
        The pieces that found a place; fewer than wanted where it is crowded.
    """
    items = list(taken)
    everyone = list_bodies(actors)
    for rule in rules:
        noun = nouns.get(rule.noun)
        if noun is None:
            continue
        bodies = _move_ahead(everyone, actors, rule.ahead_m) if rule.ahead_m else everyone
        for number in range(rule.count):
            colour = rule.colours[number % len(rule.colours)]
            model = noun.build(
                colour=colour,
                scale=float(rng.uniform(*rule.scale)) * _fit_scale(rule, view),
                seed=int(rng.integers(2**31)),
            )
            item = _find_place(rule, model, view, bodies, items, rng)
            if item is not None:
                items.append(item)
    return items[len(taken) :]


def _fit_scale(rule: ScatterRule, view: ViewClearance) -> float:
    if not rule.fits_view:
        return 1.0
    return min(max(view.distance_m / _USUAL_DISTANCE_M, 0.15), 1.5)


def list_bodies(actors: Sequence[Actor]) -> Float64Array:
    """[n, 3]: x, y and radius of the actors at some instants, m."""
    rows = []
    for actor in actors:
        radius = 0.5 * max(actor.model.length, actor.model.width)
        for time_s in np.linspace(0.0, 2.0, 5):
            x, y, _ = actor.middle(float(time_s))
            rows.append((x, y, radius))
    return np.array(rows, dtype=np.float64).reshape(-1, 3)


def _move_ahead(bodies: Float64Array, actors: Sequence[Actor], ahead_m: float) -> Float64Array:
    """Bodies that stand in their middle, moved to where the first one looks."""
    if not len(bodies):
        return bodies
    away = np.linalg.norm(bodies[:, :2] - bodies[:, :2].mean(axis=0), axis=1)
    if away.min() > _FROM_NET_M:
        return bodies
    yaw = actors[0].trajectory.at(0.0).yaw
    return bodies + ahead_m * np.array([math.cos(yaw), math.sin(yaw), 0.0])


def _find_place(
    rule: ScatterRule,
    model: Model,
    view: ViewClearance,
    bodies: Float64Array,
    items: Sequence[SceneryItem],
    rng: np.random.Generator,
) -> SceneryItem | None:
    if rule.is_under:
        middle = bodies[:, :2].mean(axis=0) if len(bodies) else np.zeros(2)
        place = (float(middle[0]), float(middle[1]))
        return SceneryItem(rule.noun, model, place, view.road.angle, is_flat=True)
    if rule.encloses or rule.is_beyond:
        return _close_off(rule, model, view, bodies, items)
    for attempt in range(ATTEMPTS):
        camera = view.cameras[int(rng.integers(len(view.cameras)))]
        if rule.is_at_wall:
            item = _stand_at_wall(rule, model, camera, view.room_m, rng)
            may_hide = not rule.is_telling or 2 * attempt >= ATTEMPTS
            if (may_hide or _is_in_view(item, camera)) and _is_free(item, view, bodies, items):
                return item
            continue
        share = float(rng.uniform(-0.62, 0.62))
        reach = _draw_reach(rule, camera, view, rng)
        forward = camera.rotation[2, :2]
        forward = forward / max(float(np.hypot(*forward)), 1e-9)
        right = np.array([forward[1], -forward[0]])
        spot = camera.position[:2] + reach * (forward + share / camera.focal * right)
        item = SceneryItem(
            rule.noun, model, (float(spot[0]), float(spot[1])), _face(rule, view, rng, -forward)
        )
        is_across = rule.is_metres and rule.near >= _FAR_SHORE_M
        if _is_free(item, view, bodies, items, is_afloat=rule.is_afloat, is_across=is_across):
            return item
    return None


def _is_in_view(item: SceneryItem, camera: Camera) -> bool:
    """Whether its middle is between the left and the right edge of the image, and ahead."""
    offset = np.array(item.position) - camera.position[:2]
    forward = camera.rotation[2, :2] / max(float(np.hypot(*camera.rotation[2, :2])), 1e-9)
    ahead = float(offset @ forward)
    aside = abs(float(offset @ np.array([forward[1], -forward[0]])))
    return ahead > 0.0 and aside * camera.focal < _IN_VIEW * ahead


def _close_off(
    rule: ScatterRule,
    model: Model,
    view: ViewClearance,
    bodies: Float64Array,
    items: Sequence[SceneryItem],
) -> SceneryItem | None:
    """Walls beside or beyond everything; of several widths the first that has room."""
    if any(item.noun == rule.noun for item in items):
        return None
    if rule.encloses:
        spot = stand_along(model, view.cameras, bodies)
    else:
        spot = stand_across(view.cameras, bodies)
    if spot is None:
        return None
    return SceneryItem(rule.noun, model, spot[:2], spot[2], is_flat=True)


def _stand_at_wall(
    rule: ScatterRule, model: Model, camera: Camera, room_m: float, rng: np.random.Generator
) -> SceneryItem:
    """Somewhere along a wall that the camera sees, with its back to it."""
    forward = camera.rotation[2, :2]
    sizes = np.abs(forward) / max(float(np.abs(forward).sum()), 1e-9)
    axis = 0 if rng.uniform() < sizes[0] else 1
    side = 1.0 if forward[axis] >= 0.0 else -1.0
    spot = [0.0, 0.0]
    spot[axis] = side * (room_m - 0.5 * model.length - 0.04)
    spot[1 - axis] = float(rng.uniform(-0.9, 0.9)) * (room_m - 0.5 * model.width)
    yaw = math.pi * (0.5 * axis + (1.0 if side > 0.0 else 0.0))
    return SceneryItem(rule.noun, model, (spot[0], spot[1]), yaw, is_at_wall=True)


def _draw_reach(
    rule: ScatterRule, camera: Camera, view: ViewClearance, rng: np.random.Generator
) -> float:
    """Metres over the ground from the camera, no further than the top of the image shows."""
    if rule.is_metres:
        return float(rng.uniform(rule.near, rule.far))
    pitch = -float(camera.rotation[2, 2])
    flat = view.distance_m * math.cos(math.asin(min(max(pitch, -1.0), 1.0)))
    near, far = rule.near, rule.far
    top = math.asin(min(max(pitch, -1.0), 1.0)) - math.atan(0.33 / camera.focal)
    if top > 0.02:
        seen = float(camera.position[2]) / math.tan(top) / max(flat, 1e-6) - 1.0
        if far > seen:
            near, far = min(near, 0.1 - 0.8 * seen), seen
    return flat * (1.0 + float(rng.uniform(near, far)))


def _face(
    rule: ScatterRule, view: ViewClearance, rng: np.random.Generator, back: Float64Array
) -> float:
    """Street furniture and houses stand square to the road; the rest as it grows.

    `back` leads over the ground to the camera.
    """
    if rule.faces_camera:
        return math.atan2(float(back[1]), float(back[0])) + float(rng.uniform(-0.2, 0.2))
    if rule.noun in ("building", "house", "barrier", "street lamp"):
        return view.road.angle - 0.5 * math.pi
    return float(rng.uniform(0.0, 2.0 * math.pi))


def _is_free(
    item: SceneryItem,
    view: ViewClearance,
    bodies: Float64Array,
    items: Sequence[SceneryItem],
    *,
    is_afloat: bool = False,
    is_across: bool = False,
) -> bool:
    """Whether an item has room, hides nothing, and stands where it may: afloat, across water."""
    spot, radius = np.array(item.position), item.radius_m
    if view.road_half_width is not None:
        clear = view.road_half_width + radius + 0.4
        if float(view.road.distance(spot[None])[0]) < clear:
            return False
    room = view.room_m + (radius if item.is_at_wall else 0.0)
    if np.max(np.abs(spot)) + radius > room:
        return False
    if is_afloat and not (view.has_shore and view.road.across(spot) > radius + 0.5):
        return False
    is_ashore = is_afloat or is_across
    if view.has_shore and not is_ashore and view.road.across(spot) > -radius - _BANK_M:
        return False
    # What stands at a wall is as deep as it is long, not as it is wide.
    deep = 0.5 * item.model.length + 0.3 if item.is_at_wall else radius
    near = bodies[:, 2] + min(deep, radius) + 0.4
    if len(bodies) and np.any(np.hypot(*(bodies[:, :2] - spot).T) < near):
        return False
    for other in items:
        if not other.is_flat and np.hypot(*(spot - other.position)) < 0.8 * (
            radius + other.radius_m
        ):
            return False
    return not _hides(spot, (radius, min(deep, radius)), view)


def _hides(spot: Float64Array, radii: tuple[float, float], view: ViewClearance) -> bool:
    """Whether an object there stands before something the camera must see.

    `radii` are its radius, and that of what it takes of the view.
    """
    radius, narrow = radii
    for camera, points in zip(view.cameras, view.points, strict=True):
        start = camera.position[:2]
        if np.hypot(*(spot - start)) < radius + 1.0:
            return True
        if len(points) == 0:
            continue
        rays = points[:, :2] - start
        lengths = np.maximum(np.hypot(rays[:, 0], rays[:, 1]), 1e-9)
        along = np.clip((rays @ (spot - start)) / lengths**2, 0.0, 1.0)
        nearest = start + along[:, None] * rays
        if np.any(np.hypot(*(nearest - spot).T) < narrow + 0.15):
            return True
    return False

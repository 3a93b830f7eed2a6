"""Scenery: trees along a road, houses in a city, pines on a mountain.

Scenery never stands between the camera and the objects of the scene, on the road, or in another's
place.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.models.places import Scenery
from texvent.scenes.models.protocol import Model, Noun, Pose
from texvent.scenes.models.traits import nouns_with
from texvent.scenes.scene import Camera, Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.assemble import PlacedModel
from texvent.scenes.staging.camera.journey import TravelPlan
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.scenes.staging.trajectories.trajectory import BodyState

_BANK_M = 1.0
"""Land that scenery leaves free beside water, m."""
_FAR_SHORE_M = 100.0
"""What stands further away than that may stand beyond the water."""
_USUAL_DISTANCE_M = 16.0
_IN_VIEW = 0.42
"""Half of what the image shows, but for its edges, as a multiple of the distance at focal 1."""
ATTEMPTS = 40
"""Places tried for each piece before it is left out."""
_GAP_M = 0.35
"""From what must not touch it to a wall along the view."""


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
    """Whether others may stand on it or in it: paint on the ground, walls around."""

    @property
    def radius_m(self) -> float:
        """Of the ground it stands on."""
        return 0.5 * max(self.model.length, self.model.width)

    def place(self, instance: int) -> PlacedModel:
        """Its parts in the world."""
        state = BodyState((*self.position, self.height_m), self.yaw, activity="stand")
        parts = self.model.parts(Pose(0.0, 0.0, 0.0, "stand"))
        return PlacedModel(parts, state.to_world(), instance)


def under_snow(rules: Iterable[Scenery]) -> list[Scenery]:
    """The same where snow lies: nothing blooms, and evergreens stand for trees in leaf."""
    (evergreen,) = nouns_with("evergreen")
    rules = [one for one in rules if one.noun not in nouns_with("in bloom")]
    leafy = nouns_with("in leaf")
    return [replace(one, noun=evergreen) if one.noun in leafy else one for one in rules]


def scatter(
    rules: Sequence[Scenery],
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
        actors: the objects of the scene.
        nouns: table of models; a noun that is missing is left out.
        rng: decides places, sizes and turns.
        taken: scenery that stands already.

    Returns:
        The pieces that found a place; fewer than wanted where it is crowded.
    """
    items = list(taken)
    bodies = list_bodies(actors)
    for number, rule in enumerate(rules):
        noun = nouns.get(rule.noun)
        if noun is None or rule.where == "route":
            continue
        if rule.where == "under":
            model = build(rule, noun, 0, rng)
            items.append(_lay_under(rule, model, view, actors, bodies))
            continue
        if rule.where == "both sides":
            items.append(_enclose(rule, noun, view, bodies, rng))
            continue
        must_show = number == 0 and rule.where == "walls"
        for copy in range(rule.count):
            model = build(rule, noun, copy, rng, _fit_scale(rule, view))
            item = _find_place(rule, model, view, bodies, items, rng, must_show=must_show)
            items += [item] if item is not None else []
    return items[len(taken) :]


def build(
    rule: Scenery, noun: Noun, copy: int, rng: np.random.Generator, scale: float = 1.0
) -> Model:
    """A copy of a piece of scenery, with its own size and seed."""
    return noun.build(
        colour=rule.colours[copy % len(rule.colours)],
        scale=float(rng.uniform(*rule.scale)) * scale,
        seed=int(rng.integers(2**31)),
    )


def _fit_scale(rule: Scenery, view: ViewClearance) -> float:
    if not rule.grows:
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


def _lay_under(
    rule: Scenery,
    model: Model,
    view: ViewClearance,
    actors: Sequence[Actor],
    bodies: Float64Array,
) -> SceneryItem:
    """Under the middle of all, along the road, so far on as the first of them looks."""
    x, y = bodies[:, :2].mean(axis=0) if len(bodies) else (0.0, 0.0)
    yaw = actors[0].trajectory.at(0.0).yaw if actors else 0.0
    spot = (x + rule.reach[0] * math.cos(yaw), y + rule.reach[0] * math.sin(yaw))
    return SceneryItem(rule.noun, model, spot, view.road.angle, is_flat=True)


def _enclose(
    rule: Scenery, noun: Noun, view: ViewClearance, bodies: Float64Array, rng: np.random.Generator
) -> SceneryItem:
    """Walls on both sides of the view, as far apart as all between them needs."""
    forward = _flat(view.cameras[len(view.cameras) // 2])
    right = np.array([forward[1], -forward[0]])
    eyes = np.array([camera.position[:2] for camera in view.cameras])
    aside = np.append(bodies[:, :2], eyes, axis=0) @ right
    radii = np.append(bodies[:, 2], np.full(len(eyes), _GAP_M))
    low, high = float((aside - radii).min()), float((aside + radii).max())
    # Each wall is a tenth of their distance thick at most.
    usual_m = 0.78 * build(rule, noun, 0, rng).width
    model = build(rule, noun, 0, rng, max((high - low) / usual_m, 1.0))
    middle = eyes.mean(axis=0)
    x, y = middle + (0.5 * (high + low) - float(middle @ right)) * right
    yaw = math.atan2(float(forward[1]), float(forward[0]))
    return SceneryItem(rule.noun, model, (float(x), float(y)), yaw, is_flat=True)


def _flat(camera: Camera) -> Float64Array:
    """[2] which way a camera looks over the ground."""
    forward = np.asarray(camera.rotation[2, :2], dtype=np.float64)
    return forward / max(float(np.hypot(*forward)), 1e-9)


def _find_place(
    rule: Scenery,
    model: Model,
    view: ViewClearance,
    bodies: Float64Array,
    items: Sequence[SceneryItem],
    rng: np.random.Generator,
    *,
    must_show: bool,
) -> SceneryItem | None:
    """A free place for a piece; one that must show is in view, if it can be."""
    for attempt in range(ATTEMPTS):
        camera = view.cameras[int(rng.integers(len(view.cameras)))]
        if rule.where == "walls":
            item = _stand_at_wall(rule, model, camera, view.room_m, rng)
            if must_show and 2 * attempt < ATTEMPTS and not _is_in_view(item, camera):
                continue
        else:
            item = _stand_around(rule, model, camera, view, rng)
        if is_free(item, rule, view, bodies, items):
            return item
    return None


def _stand_around(
    rule: Scenery, model: Model, camera: Camera, view: ViewClearance, rng: np.random.Generator
) -> SceneryItem:
    """Somewhere in what the camera sees, as far off as the rule says."""
    share = float(rng.uniform(-0.62, 0.62))
    reach = _draw_reach(rule, camera, view, rng)
    forward = _flat(camera)
    right = np.array([forward[1], -forward[0]])
    x, y = camera.position[:2] + reach * (forward + share / camera.focal * right)
    if rule.faces:
        yaw = math.atan2(-float(forward[1]), -float(forward[0])) + float(rng.uniform(-0.2, 0.2))
    elif rule.noun in nouns_with("parallel to road"):
        yaw = view.road.angle - 0.5 * math.pi
    else:
        yaw = float(rng.uniform(0.0, 2.0 * math.pi))
    return SceneryItem(rule.noun, model, (float(x), float(y)), yaw)


def _is_in_view(item: SceneryItem, camera: Camera) -> bool:
    """Whether its middle is between the left and the right edge of the image, and ahead."""
    offset, forward = np.array(item.position) - camera.position[:2], _flat(camera)
    ahead = float(offset @ forward)
    aside = abs(float(offset @ np.array([forward[1], -forward[0]])))
    return ahead > 0.0 and aside * camera.focal < _IN_VIEW * ahead


def _stand_at_wall(
    rule: Scenery, model: Model, camera: Camera, room_m: float, rng: np.random.Generator
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
    rule: Scenery, camera: Camera, view: ViewClearance, rng: np.random.Generator
) -> float:
    """Metres over the ground from the camera, no further than the top of the image shows."""
    near, far = rule.reach
    if rule.where == "far":
        return float(rng.uniform(near, far))
    pitch = math.asin(min(max(-float(camera.rotation[2, 2]), -1.0), 1.0))
    flat = view.distance_m * math.cos(pitch)
    top = pitch - math.atan(0.33 / camera.focal)
    if top > 0.02:
        seen = float(camera.position[2]) / math.tan(top) / max(flat, 1e-6) - 1.0
        if far > seen:
            near, far = min(near, 0.1 - 0.8 * seen), seen
    return flat * (1.0 + float(rng.uniform(near, far)))


def is_free(
    item: SceneryItem,
    rule: Scenery,
    view: ViewClearance,
    bodies: Float64Array,
    items: Sequence[SceneryItem],
) -> bool:
    """Whether an item has room, hides nothing, and stands where it may: on land or afloat."""
    spot, radius = np.array(item.position), item.radius_m
    if view.road_half_width is not None:
        clear = view.road_half_width + radius + 0.4
        if float(view.road.distance(spot[None])[0]) < clear:
            return False
    room = view.room_m + (radius if item.is_at_wall else 0.0)
    if np.max(np.abs(spot)) + radius > room or not _is_on_its_side(rule, spot, radius, view):
        return False
    # What stands at a wall is as deep as it is long, not as it is wide.
    deep = min(0.5 * item.model.length + 0.3, radius) if item.is_at_wall else radius
    if len(bodies) and np.any(np.hypot(*(bodies[:, :2] - spot).T) < bodies[:, 2] + deep + 0.4):
        return False
    others = (other for other in items if not other.is_flat)
    if any(np.hypot(*(spot - one.position)) < 0.8 * (radius + one.radius_m) for one in others):
        return False
    return not _hides(spot, radius, deep, view)


def _is_on_its_side(
    rule: Scenery, spot: Float64Array, radius_m: float, view: ViewClearance
) -> bool:
    """Whether what floats is in the water, and what stands is on land or far beyond the water."""
    if rule.where == "water":
        return view.has_shore and view.road.across(spot) > radius_m + 0.5
    is_beyond = rule.where == "far" and rule.reach[0] >= _FAR_SHORE_M
    return not view.has_shore or is_beyond or view.road.across(spot) <= -radius_m - _BANK_M


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

"""Where a river or a lake lies: through what floats on it, or behind what stands beside it."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import replace

from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.scene import Ground
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.attached import HeldAt
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.scenes.staging.trajectories.trajectory import Stationary

STRIPS = (Ground.ROAD, Ground.DIRT_ROAD, Ground.CITY, Ground.RIVER)
"""Grounds with a strip that scenery keeps off."""
WATERSIDE = ("river", "lake", "harbour", "swimming pool", "beach")
"""Places with water beside land."""
_IN_WATER = ("swim", "surf", "swim breaststroke")
_GAP = 0.22
"""Land between what the camera looks at and the water, as a share of the camera's distance."""


def water_line(
    place: str,
    actors: Sequence[Actor],
    path: CameraPath,
    half_width: float,
    *,
    goes_over_shore: bool = False,
    waders: Collection[int] = (),
) -> RoadLine:
    """The middle of a river, or the shore of a lake with the water on its left.

    Args:
        place: one of `WATERSIDE`.
        actors: the objects of the prompt.
        path: the camera's.
        half_width: of the river, m.
        goes_over_shore: whether anyone goes into the water or comes out of it.
        waders: indices of objects that are in the water though they live on land.
    """
    forward = path.at(0.0).rotation[2, :2]
    angle = math.atan2(float(forward[1]), float(forward[0])) - 0.5 * math.pi
    x, y = float(path.framing.target[0]), float(path.framing.target[1])
    swimmers = [
        actor
        for actor in actors
        if (actor.noun.habitat == "water" and not isinstance(actor.trajectory, HeldAt))
        or actor.trajectory.at(0.0).activity in _IN_WATER
        or actor.object_index in waders
    ]
    distance = path.framing.distance_m
    if goes_over_shore or not actors:
        # It is met half way, or all that there is to see.
        gap = half_width if place == "river" else 0.0
    elif not swimmers and (drinkers := [one for one in actors if _drinks(one)]):
        reach = min(_edge_of(one, angle, (x, y)) for one in drinkers)
        gap = reach + (half_width if place == "river" else 0.0)
    elif not swimmers:
        gap = _GAP * distance + (half_width if place == "river" else 0.0) + 1.0
    elif place == "river":
        gap = 0.0
        state = swimmers[0].trajectory.at(0.0)
        if swimmers[0].is_mover:
            angle = state.yaw
        x, y = float(state.position[0]), float(state.position[1])
    else:
        gap = -0.45 * distance
    across = angle + 0.5 * math.pi
    return RoadLine(angle, (x + gap * math.cos(across), y + gap * math.sin(across)))


def turn_to_water(actors: Sequence[Actor], place: str) -> list[Actor]:
    """Animals that drink where they stand face the water, which lies behind them.

    Args:
        actors: the objects of the prompt, as they are placed.
        place: where they are.
    """
    if place not in WATERSIDE:
        return list(actors)
    return [_turned(actor) if _drinks(actor) else actor for actor in actors]


_AWAY_RAD = 0.5
"""Heading of who drinks: to the right or the left, and away from the camera."""
_WET_SHARE = 0.08
"""How far the water reaches before the mouth, as a share of the animal's length."""


def _drinks(actor: Actor) -> bool:
    path = actor.trajectory
    is_animal = actor.noun.name not in PERSON_NOUNS
    return is_animal and isinstance(path, Stationary) and path.activity == "drink"


def _turned(actor: Actor) -> Actor:
    path = actor.trajectory
    if not isinstance(path, Stationary):
        return actor
    yaw = _AWAY_RAD if math.cos(path.yaw) >= 0.0 else math.pi - _AWAY_RAD
    return replace(actor, trajectory=replace(path, yaw=yaw))


def _edge_of(actor: Actor, angle: float, middle: tuple[float, float]) -> float:
    """How far behind a point the water begins at which an animal drinks, m."""
    x, y, _ = (float(value) for value in actor.anchor("mouth", 0.0)[:, 3])
    across = angle + 0.5 * math.pi
    way = (x - middle[0]) * math.cos(across) + (y - middle[1]) * math.sin(across)
    return way - _WET_SHARE * actor.model.length

"""From where the camera looks: azimuth and elevation."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from texvent.scenes.description import CameraMove, SceneDescription
from texvent.scenes.models.objects.receptacles import SERVED_IN_VIEW
from texvent.scenes.models.places import PLACES, is_room
from texvent.scenes.staging.actors import Actor, seeded
from texvent.scenes.staging.placement.at_wall import list_at_wall
from texvent.scenes.staging.still_life import is_still_life

FLAT = 0.3
"""What stays in place and is flatter than this share of its length is looked down upon."""
ELEVATIONS = {"aerial": 0.80, "top": 1.45, "low": 0.02, "first person": 0.05, "level": 0.03,
               "shoulder": 0.16, "rising": 0.5, "high": 0.5}  # fmt: skip
"""View → elevation of the camera, rad."""
_IN_SKY = frozenset({"fireworks", "lightning"})
"""Effects that are looked up at, from a bridge too."""
_BEARINGS = {"side": 0.0, "front": 0.5 * math.pi, "back": -0.5 * math.pi, "shoulder": -1.25}
"""View → azimuth of the camera from the side of what it looks at, to its right; radians."""
_FLAT_MOST_M = 3.0
"""What extends further is not looked down upon: a bridge."""
_FLAT_ELEVATION = 0.85
_LEVEL_ELEVATION = 0.38
_FOLLOW_ELEVATIONS = {"behind": 0.22, "front": 0.22, "above": 0.7}
_PLACE_ELEVATIONS = {"sky": -0.42, "space": -0.1, "underwater": 0.04}
_ROOM_ELEVATION = 0.24
_BETWEEN_WALLS = 0.06
"""Azimuth of a camera between two walls, which looks along them."""


_ELONGATED, _ALONG_IT = 4.5, 0.75
"""What is so many times as long as high is seen at an angle to its side, from nearer its front."""
_HERD, _HERD_ELEVATION = 6, 0.3
"""From so many copies on, and in a traffic jam, the camera stands higher, so that those behind are
seen too."""


def choose_angles(
    description: SceneDescription,
    main: Actor,
    moves: Sequence[CameraMove],
    place: str,
    seed: int,
) -> tuple[float, float]:
    """Azimuth and elevation of the camera, radians."""
    rng = seeded(seed, "camera")
    wander = float(rng.uniform(-0.14, 0.14))
    state = main.trajectory.at(0.0)
    later = main.trajectory.at(0.5)
    step = np.subtract(later.position, state.position)
    goes_in_depth = abs(step[1]) > 1.2 * abs(step[0]) and abs(step[1]) > 0.05
    azimuth = wander
    if goes_in_depth:
        azimuth = math.copysign(0.42, wander)
    said = description.objects[main.object_index]
    is_jammed = said.motion is not None and said.motion.is_stuck
    if (_is_elongated(main) or is_jammed) and not goes_in_depth:
        azimuth = math.copysign(_ALONG_IT, math.cos(state.yaw))
    follow = next((move for move in moves if move.kind == "follow"), None)
    is_tied = follow is not None and follow.direction in ("behind", "front")
    if follow is not None and is_tied:
        heading = state.yaw if follow.direction == "behind" else state.yaw + math.pi
        azimuth = heading - 0.5 * math.pi + 0.1 * wander
    elif follow is not None and goes_in_depth:
        azimuth = state.yaw + math.copysign(0.5, wander)
    if not is_tied and any(rule.where == "both sides" for rule in PLACES[place].scenery):
        azimuth = math.copysign(_BETWEEN_WALLS, wander)
    if list_at_wall(description, place):
        azimuth = 0.5 * wander
    view = description.shot.view
    if view in _BEARINGS and not (view == "front" and is_still_life(description)):
        azimuth = _face(view, state.yaw)
    elevation = ELEVATIONS.get(view or "")
    is_in_sky = view == "high" and any(one.kind in _IN_SKY for one in description.effects)
    if elevation is None or is_in_sky:
        elevation = _choose_elevation(main, follow, place, goes_in_depth)
        elevation = max(elevation, _into_dish(description, main.object_index))
        if said.count >= _HERD or is_jammed:
            elevation = max(elevation, _HERD_ELEVATION) if elevation > 0.0 else elevation
    return azimuth, elevation


def level_out(description: SceneDescription, elevation: float) -> float:
    """A front, side or rear view does not look down steeply, on what lies flat neither."""
    is_level = description.shot.view in ("front", "side", "back")
    return min(elevation, _LEVEL_ELEVATION) if is_level else elevation


_INTO_DISH = 0.55
"""Elevation from which one sees what is in a bowl."""


def _into_dish(description: SceneDescription, index: int) -> float:
    """Least elevation for a bowl, a tray or a pan that something is in, else nothing to heed."""
    is_filled = description.objects[index].noun in SERVED_IN_VIEW and any(
        one.kind in ("in", "on") and one.targets == (index,) for one in description.relations
    )
    return _INTO_DISH if is_filled else -math.inf


def _choose_elevation(
    main: Actor, follow: CameraMove | None, place: str, goes_in_depth: bool
) -> float:
    """Height of the camera above what it looks at, radians."""
    if follow is not None and follow.direction in _FOLLOW_ELEVATIONS:
        return _FOLLOW_ELEVATIONS[follow.direction]
    widest = max(main.model.length, main.model.width)
    is_flat = widest < _FLAT_MOST_M and main.model.height < FLAT * widest
    if is_flat and not main.is_mover and main.noun.habitat in ("fixed", "ground"):
        return _FLAT_ELEVATION
    if place in _PLACE_ELEVATIONS:
        return _PLACE_ELEVATIONS[place]
    if is_room(place):
        return _ROOM_ELEVATION
    if main.noun.habitat == "air":
        return -0.03
    if not main.is_mover and main.model.height > 5.0:
        return 0.03
    if main.model.height < 0.7:
        return 0.24
    return 0.2 if goes_in_depth else 0.12


def _is_elongated(main: Actor) -> bool:
    """Whether it is a train or a ship: all of it from the side would be a thin line."""
    model = main.model
    is_large = model.length > _FLAT_MOST_M and main.noun.motion in ("drive", "sail")
    return is_large and model.length > _ELONGATED * model.height


def _face(view: str, yaw: float) -> float:
    """Azimuth from which an object of that heading is seen from the front, from behind ..."""
    azimuth = yaw + _BEARINGS[view]
    if view == "side" and math.cos(azimuth) < 0.0:
        azimuth += math.pi  # its other side, which faces the default viewer
    return azimuth

"""From where the camera looks: azimuth and elevation."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from texvent.scenes.description import CameraMove, SceneDescription
from texvent.scenes.models.places import PLACES, is_room
from texvent.scenes.staging.actors import Actor, seeded

ELEVATIONS = {"aerial": 0.80, "top": 1.45, "low": 0.02, "first person": 0.05, "level": 0.03,
              "shoulder": 0.16, "high": 0.5}  # fmt: skip
"""View → elevation of the camera, rad."""
_BEARINGS = {"side": 0.0, "front": 0.5 * math.pi, "back": -0.5 * math.pi, "shoulder": -1.25}
"""View → azimuth of the camera from the side of what it looks at, to its right; radians."""
_FOLLOW_ELEVATIONS = {"behind": 0.22, "front": 0.22, "above": 0.7}
_PLACE_ELEVATIONS = {"sky": -0.42, "space": -0.1, "underwater": 0.04}
_ROOM_ELEVATION = 0.24
_FLAT, _FLAT_MOST_M, _FLAT_ELEVATION = 0.3, 3.0, 0.85
"""What stays in place, is flatter than this share of its length and not longer than that, is looked
down upon."""
_LEVEL_ELEVATION = 0.38
"""Greatest elevation of a view from the front, the side or behind."""
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
    wander = float(seeded(seed, "camera").uniform(-0.14, 0.14))
    yaw = main.trajectory.at(0.0).yaw
    step = np.subtract(main.trajectory.at(0.5).position, main.trajectory.at(0.0).position)
    goes_in_depth = bool(abs(step[1]) > 1.2 * abs(step[0]) and abs(step[1]) > 0.05)
    said, view = description.objects[main.object_index], description.shot.view
    is_jammed = said.motion is not None and said.motion.is_stuck
    follow = next((move.direction or "" for move in moves if move.kind == "follow"), None)
    is_tied = follow in ("behind", "front")
    azimuth = math.copysign(0.42, wander) if goes_in_depth else wander
    if (_is_elongated(main) or is_jammed) and not goes_in_depth:
        azimuth = math.copysign(_ALONG_IT, math.cos(yaw))
    if is_tied:
        azimuth = yaw + 0.1 * wander + (0.5 if follow == "front" else -0.5) * math.pi
    elif follow is not None and goes_in_depth:
        azimuth = yaw + math.copysign(0.5, wander)
    if not is_tied and any(rule.where == "both sides" for rule in PLACES[place].scenery):
        azimuth = math.copysign(_BETWEEN_WALLS, wander)
    if view in _BEARINGS:
        azimuth = yaw + _BEARINGS[view]
        if view == "side" and math.cos(azimuth) < 0.0:
            azimuth += math.pi  # its other side, which faces the default viewer
    elevation = ELEVATIONS.get(view or "")
    if elevation is None:
        elevation = _choose_elevation(main, follow, place, goes_in_depth)
        if (said.count >= _HERD or is_jammed) and elevation > 0.0:
            elevation = max(elevation, _HERD_ELEVATION)
    return azimuth, min(elevation, _LEVEL_ELEVATION) if view in _BEARINGS else elevation


def _choose_elevation(main: Actor, follow: str | None, place: str, goes_in_depth: bool) -> float:
    """Height of the camera above what it looks at, radians."""
    if follow in _FOLLOW_ELEVATIONS:
        return _FOLLOW_ELEVATIONS[follow]
    model = main.model
    widest = max(model.length, model.width)
    is_flat = widest < _FLAT_MOST_M and model.height < _FLAT * widest
    if is_flat and not main.is_mover and main.noun.habitat in ("fixed", "ground"):
        return _FLAT_ELEVATION
    if place in _PLACE_ELEVATIONS:
        return _PLACE_ELEVATIONS[place]
    if is_room(place):
        return _ROOM_ELEVATION
    if main.noun.habitat == "air":
        return -0.03
    if not main.is_mover and model.height > 5.0:
        return 0.03
    if model.height < 0.7:
        return 0.24
    return 0.2 if goes_in_depth else 0.12


def _is_elongated(main: Actor) -> bool:
    """Whether it is a train or a ship: all of it from the side would be a thin line."""
    model = main.model
    is_large = model.length > _FLAT_MOST_M and main.noun.motion in ("drive", "sail")
    return is_large and model.length > _ELONGATED * model.height

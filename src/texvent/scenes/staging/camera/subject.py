"""The subject: which object the camera is about, and from where it looks at it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from texvent.scenes.description import CameraMove, SceneDescription
from texvent.scenes.models.anchors import has_places
from texvent.scenes.models.people.activities import HAND_NOUNS, PERSON_NOUNS
from texvent.scenes.models.places import PLACES, is_room
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor, seeded
from texvent.scenes.staging.trajectories.trajectory import Stationary

_RESTS = 0.05
"""How far, in its heights, the lower body of a person on the spot may move."""
_BELOW = ("left foot", "right foot", "seat")
_OF_WHOLE_BODY = frozenset(
    {"sit", "kneel", "crouch", "squat", "lie", "push-up", "dribble", "sweep", "row", "surf"}
)
"""Activities of which the legs, or what is at the feet, tell."""
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


def choose_main(description: SceneDescription, actors: Sequence[Actor]) -> Actor:
    """The object the camera is about: as said, or the first that moves or could."""
    target = description.shot.target
    asked = [one for one in actors if target is not None and one.object_index == target]
    coming = [one for one in actors if one.enters or one.leaves]
    able = [one for one in actors if one.is_mover or _is_able(one)]
    return [*asked[:1], *coming[:1], *able[:1], actors[0]][0]


def _is_able(actor: Actor) -> bool:
    return actor.noun.speed_m_s > 0.0 and actor.noun.habitat != "fixed"


def goes_in_depth(description: SceneDescription, main: Actor) -> bool:
    """Whether the scene says that it comes towards the camera or goes away from it."""
    motion = description.objects[main.object_index].motion
    return motion is not None and motion.direction in ("towards", "away")


def acts_with_arms(actor: Actor, times: Float64Array) -> bool:
    """Whether it is a hand that stays, or a person who acts on the spot with arms and head."""
    if actor.noun.name in HAND_NOUNS:
        return isinstance(actor.trajectory, Stationary)
    if actor.noun.name not in PERSON_NOUNS or not has_places(actor.model) or not actor.is_mover:
        return False
    if actor.pose(float(times[0])).activity in _OF_WHOLE_BODY:
        return False
    places = np.array([[actor.anchor(one, float(t))[:, 3] for one in _BELOW] for t in times])
    return float(np.ptp(places, axis=0).max()) < _RESTS * actor.model.height


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
    is_in_depth = bool(abs(step[1]) > 1.2 * abs(step[0]) and abs(step[1]) > 0.05)
    said, view = description.objects[main.object_index], description.shot.view
    is_jammed = said.motion is not None and said.motion.is_stuck
    follow = next((move.direction or "" for move in moves if move.kind == "follow"), None)
    if follow in ("behind", "front"):
        azimuth = yaw + 0.1 * wander + (0.5 if follow == "front" else -0.5) * math.pi
    elif any(rule.where == "both sides" for rule in PLACES[place].scenery):
        azimuth = math.copysign(_BETWEEN_WALLS, wander)
    elif is_in_depth:
        azimuth = math.copysign(0.42, wander)
        azimuth = azimuth if follow is None else yaw + math.copysign(0.5, wander)
    elif _is_elongated(main) or is_jammed:
        azimuth = math.copysign(_ALONG_IT, math.cos(yaw))
    else:
        azimuth = wander
    if view in _BEARINGS:
        azimuth = yaw + _BEARINGS[view]
        if view == "side" and math.cos(azimuth) < 0.0:
            azimuth += math.pi  # its other side, which faces the default viewer
    elevation = ELEVATIONS.get(view or "")
    if elevation is None:
        elevation = _choose_elevation(main, follow, place, is_in_depth)
        if (said.count >= _HERD or is_jammed) and elevation > 0.0:
            elevation = max(elevation, _HERD_ELEVATION)
    return azimuth, min(elevation, _LEVEL_ELEVATION) if view in _BEARINGS else elevation


def _choose_elevation(main: Actor, follow: str | None, place: str, is_in_depth: bool) -> float:
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
    return 0.2 if is_in_depth else 0.12


def _is_elongated(main: Actor) -> bool:
    """Whether it is a train or a ship: all of it from the side would be a thin line."""
    model = main.model
    is_large = model.length > _FLAT_MOST_M and main.noun.motion in ("drive", "sail")
    return is_large and model.length > _ELONGATED * model.height

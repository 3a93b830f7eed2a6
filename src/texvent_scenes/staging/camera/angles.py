"""Angles from which the camera looks at its subject: azimuth and elevation."""

from __future__ import annotations

import math

import numpy as np

from texvent_scenes.defaults import NO_PLACE
from texvent_scenes.description import SceneDescription
from texvent_scenes.models.places import PLACES, is_room
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.staging.actors import Actor, seeded

ELEVATIONS = {"aerial": 0.80, "top": 1.45, "low": -0.25, "first person": 0.05}
"""View → elevation of the camera, rad; a low one ends at the ground."""
_PLACE_ELEVATIONS = {"sky": -0.42, "space": -0.1, "underwater": 0.04, "lake bed": 0.04}
_ROOM_ELEVATION, _INTO_IT, _ONTO_STRIP, _ONTO_FLAT, _FLAT_IN_ROOM = 0.24, 0.6, 0.16, 0.5, 0.3
"""Elevation in rooms, from which one sees into an open container, a runway as a strip, what lies
flat, and that with a wall of the room that is said, rad."""
_UP_TO_CEILING = -0.2
"""Height of the camera above what hangs from a ceiling, rad: it is below."""
_FLAT, _MOST_FLAT_M = 0.2, 1.0
"""Height over length, and length in m, up to which what rests lies flat: a pencil."""
_ELONGATED, _LEAST_M, ALONG_IT = 4.5, 3.0, 0.75
"""Length over height, and length in m, from which on a subject is seen at an angle to its side."""


def goes_in_depth(actor: Actor) -> bool:
    """Whether it goes away from the camera or towards it, rather than across the picture."""
    step = np.subtract(actor.track.at(0.5).position, actor.track.at(0.0).position)
    return bool(abs(step[1]) > 1.2 * abs(step[0]) and abs(step[1]) > 0.05)


def is_said_room(description: SceneDescription, place: str) -> bool:
    """Whether the place is a room that is said, of which a wall should be in view."""
    return is_room(place) and not any(one.startswith(NO_PLACE) for one in description.notes)


def is_in_container(description: SceneDescription, index: int) -> bool:
    """Whether an object is in an open container, into which one sees from above."""
    kept = {description.objects[one.targets[0]].noun for one in description.relations
            if one.kind == "in" and one.subject == index}  # fmt: skip
    return any(trait_value("container", noun) for noun in kept - nouns_with("see-through"))


def face(yaw: float, view: str | None) -> float | None:
    """Azimuth of the camera that sees a side of what heads for a yaw, radians; None: any."""
    ways = {"front": yaw + 0.5 * math.pi, "back": yaw - 0.5 * math.pi}
    if view in ways:
        return math.remainder(ways[view], 2.0 * math.pi)
    return math.remainder(yaw, math.pi) if view == "side" else None


def choose_angles(
    description: SceneDescription,
    main: Actor,
    place: str,
    seed: int,
) -> tuple[float, float]:
    """Azimuth and elevation of the camera, radians."""
    wander = float(seeded(seed, "camera").uniform(-0.14, 0.14))
    yaw, is_in_depth = main.track.at(0.0).yaw, goes_in_depth(main)
    length = main.model.length  # all of a train or a ship from the side would be a thin line
    is_long = length > max(_LEAST_M, _ELONGATED * main.model.height)
    follows = any(one.kind == "follow" for one in description.camera.moves)
    is_amid = any(one.kind == "between" and one.subject == main.object_index
                  for one in description.relations)  # fmt: skip
    if is_amid:
        azimuth = 0.5 * wander  # what is on both sides stays there
    elif is_in_depth:
        azimuth = yaw + math.copysign(0.5, wander) if follows else math.copysign(0.42, wander)
    elif is_long and main.noun.motion in ("drive", "sail"):
        azimuth = math.copysign(ALONG_IT, math.cos(yaw))
    else:
        azimuth = wander
    if PLACES[place].corridor_m:
        azimuth = 0.5 * wander
    facing = face(yaw, description.camera.view)
    azimuth = azimuth if facing is None else facing
    elevation = ELEVATIONS.get(description.camera.view or "")
    if elevation is None:
        elevation = _choose_elevation(main, place, is_in_depth)
        if is_said_room(description, place):
            elevation = min(elevation, _FLAT_IN_ROOM)
        if is_in_container(description, main.object_index):
            elevation = max(elevation, _INTO_IT)
    return azimuth, elevation


def _choose_elevation(main: Actor, place: str, is_in_depth: bool) -> float:
    """Height of the camera above what it looks at, radians."""
    model = main.model
    if place in _PLACE_ELEVATIONS:
        return _PLACE_ELEVATIONS[place]
    if main.noun.name in nouns_with("hangs from a ceiling"):
        return _UP_TO_CEILING
    is_flat = model.height < _FLAT * model.length < _FLAT * _MOST_FLAT_M
    if is_flat and main.track.is_resting and main.noun.habitat != "air":
        return _ONTO_FLAT
    if is_room(place):
        return _ROOM_ELEVATION
    if main.noun.name in nouns_with("takes off") and place == "runway":
        return _ONTO_STRIP
    if main.noun.name in nouns_with("out of clouds"):
        return ELEVATIONS["low"]
    if main.noun.habitat == "air":
        return -0.03
    if not main.is_mover and model.height > 5.0:
        return 0.03
    if model.height < 0.7:
        return 0.24
    return 0.2 if is_in_depth else 0.12

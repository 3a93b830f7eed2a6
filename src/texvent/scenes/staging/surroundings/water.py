"""Water beside land: where a river or a lake lies."""

from __future__ import annotations

import math
from collections.abc import Sequence

from texvent.scenes.models.places import Place
from texvent.scenes.scene import Ground
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import HeldAt
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.surroundings.road import RoadLine

_AFLOAT = ("swim", "surf")
"""What people do in water, or on it."""
_GAP, _LEAST_GAP_M = 0.22, 1.0
"""Land between what the camera looks at and the water: a share of the camera's distance, and m."""
_NEARER = 0.45
"""How far before what floats on it a lake begins, as a share of the camera's distance."""


def water_line(place: Place, actors: Sequence[Actor], path: CameraPath) -> RoadLine:
    """The middle of a river, or the shore of a lake with the water on its left.

    It runs through what floats or swims, and behind what stands beside it.
    """
    forward = path.at(0.0).rotation[2, :2]
    angle = math.atan2(float(forward[1]), float(forward[0])) - 0.5 * math.pi
    x, y = float(path.framing.target[0]), float(path.framing.target[1])
    half = place.road_m if place.ground is Ground.RIVER else 0.0
    swimmers = [one for one in actors if _is_in_water(one)]
    if not actors:
        gap = half
    elif swimmers and place.ground is Ground.RIVER:
        gap, state = 0.0, swimmers[0].trajectory.at(0.0)
        angle = state.yaw if swimmers[0].is_mover else angle
        x, y = float(state.position[0]), float(state.position[1])
    elif swimmers:
        gap = -_NEARER * path.framing.distance_m
    else:
        gap = half + _GAP * path.framing.distance_m + _LEAST_GAP_M
    across = angle + 0.5 * math.pi
    return RoadLine(angle, (x + gap * math.cos(across), y + gap * math.sin(across)))


def _is_in_water(actor: Actor) -> bool:
    is_of_water = actor.noun.habitat == "water" and not isinstance(actor.trajectory, HeldAt)
    return is_of_water or actor.trajectory.at(0.0).activity in _AFLOAT

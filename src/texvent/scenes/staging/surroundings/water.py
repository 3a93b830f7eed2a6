"""Water beside land: where a river or a lake lies, and how deep those are who go into it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.places import Place
from texvent.scenes.scene import Ground
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.attached import HeldAt
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.scenes.staging.trajectories.trajectory import BodyState, Trajectory

_AFLOAT = ("swim", "surf")
"""What people do in water, or on it."""
_OVER_SHORE = ("into", "out of")
_GAP = 0.22
"""Land between what the camera looks at and the water, as a share of the camera's distance."""
_DEPTH_SHARE, _DEPTH_OF_BIRDS = 0.4, 0.1
"""Share of the height of a body that is under water at most; of birds, as high as their spread
wings reach."""


def water_line(
    description: SceneDescription, place: Place, actors: Sequence[Actor], path: CameraPath
) -> RoadLine:
    """The middle of a river, or the shore of a lake with the water on its left.

    It runs through what floats or swims, behind what stands beside it, and is met half way by who
    goes over the shore.
    """
    forward = path.at(0.0).rotation[2, :2]
    angle = math.atan2(float(forward[1]), float(forward[0])) - 0.5 * math.pi
    x, y = float(path.framing.target[0]), float(path.framing.target[1])
    half = place.road_m if place.ground is Ground.RIVER else 0.0
    distance = path.framing.distance_m
    swimmers = [one for one in actors if _is_in_water(one, description)]
    if not actors or any(set(_OVER_SHORE) & _ways(description, one) for one in actors):
        gap = half
    elif swimmers and place.ground is Ground.RIVER:
        gap, state = 0.0, swimmers[0].trajectory.at(0.0)
        angle = state.yaw if swimmers[0].is_mover else angle
        x, y = float(state.position[0]), float(state.position[1])
    elif swimmers:
        gap = -0.45 * distance
    else:
        gap = half + _GAP * distance + 1.0
    across = angle + 0.5 * math.pi
    return RoadLine(angle, (x + gap * math.cos(across), y + gap * math.sin(across)))


def _is_in_water(actor: Actor, description: SceneDescription) -> bool:
    is_of_water = actor.noun.habitat == "water" and not isinstance(actor.trajectory, HeldAt)
    is_afloat = actor.trajectory.at(0.0).activity in _AFLOAT
    return is_of_water or is_afloat or "in" in _ways(description, actor)


def _ways(description: SceneDescription, actor: Actor) -> set[str | None]:
    """How its motions go with respect to the shore."""
    one = description.objects[actor.object_index]
    return {motion.shore for motion in (one.motion, *one.then) if motion is not None}


@dataclass(frozen=True)
class Wading:
    """A path over a shore, lower the farther it is in the water."""

    path: Trajectory
    line: RoadLine
    """With the water on its left."""
    start_m: float
    """Where the water begins, from the line to its left."""
    depth_m: float
    """How far it sinks at most."""
    reach_m: float
    """Distance from the shore at which it has sunk."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        state = self.path.at(time_s)
        x, y, z = state.position
        over = (self.line.across(np.array([x, y])) - self.start_m) / self.reach_m
        share = min(max(over, 0.0), 1.0)
        sunk = self.depth_m * share * share * (3.0 - 2.0 * share)
        return replace(state, position=(x, y, z - sunk))


def wade(
    description: SceneDescription, actors: Sequence[Actor], place: Place, line: RoadLine
) -> list[Actor]:
    """The actors, of whom those sink in who go over the shore or are in the water.

    Args:
        description: what they do.
        actors: on their paths over the ground.
        place: nothing is changed where it has no shore.
        line: from `water_line`.
    """
    if not place.has_shore:
        return list(actors)
    start_m = -place.road_m if place.ground is Ground.RIVER else 0.0
    found = []
    for actor in actors:
        is_wet = _ways(description, actor) & {*_OVER_SHORE, "in"}
        if is_wet and actor.trajectory.at(0.0).activity not in _AFLOAT:
            share = _DEPTH_OF_BIRDS if actor.noun.habitat == "air" else _DEPTH_SHARE
            depth, reach = share * actor.model.height, 0.5 * actor.size_m
            actor = replace(actor, trajectory=Wading(actor.trajectory, line, start_m, depth, reach))
        found.append(actor)
    return found

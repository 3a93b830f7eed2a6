"""Furniture that stands with its back to a wall of a room: fitted, hung or plumbed in."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.places import is_room
from texvent.scenes.models.traits import nouns_with
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor, corners_over
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.placement.object_groups import ObjectGroup

_BESIDE = frozenset({"at", "beside", "with", "left of", "right of", "front"})
"""Relations that leave their subject at the wall."""
_CEILING = 0.6
"""Height of a ceiling as a share of half the room's side."""
_LEAST_ROOM_M, _GAP_M = 3.2, 0.02


def list_at_wall(description: SceneDescription, place: str) -> tuple[int, ...]:
    """Indices of the objects that stand at the wall; none where the camera goes or looks down."""
    shot = description.shot
    goes = any(move.kind in ("travel", "orbit") for move in shot.moves)
    if not is_room(place) or goes or shot.view not in (None, "front", "level", "low"):
        return ()
    elsewhere = {one.subject for one in description.relations if one.kind not in _BESIDE}
    return tuple(
        index
        for index, one in enumerate(description.objects)
        if index not in elsewhere
        and one.noun in nouns_with("at a wall")
        and one.side not in ("near", "far", "ring")
        and all(m is None or m.kind in ("stand", "work") for m in (one.motion, *one.then))
    )


def stand_before_wall(
    description: SceneDescription,
    groups: Mapping[int, ObjectGroup],
    move: Callable[[Mapping[int, Float64Array]], list[Actor]],
    film: Callable[[Sequence[Actor]], CameraPath],
    place: str,
) -> tuple[list[Actor], CameraPath]:
    """Actors and camera in a room whose far wall is right behind its furniture.

    `move` moves objects by metres and returns the actors; what is on or in furniture goes with it.
    `film` places the camera before actors.
    """
    row = [groups[index] for index in list_at_wall(description, place) if index in groups]
    for group in row:
        group.go(yaw=-0.5 * math.pi)
    wall = max(float(group.centre[1] + group.half[1]) for group in groups.values())
    shifts = {one.index: np.array([0.0, wall - one.centre[1] - one.half[1], 0.0]) for one in row}
    for one in description.relations:
        if one.kind not in _BESIDE and one.subject in groups and one.targets[0] in shifts:
            shifts.setdefault(one.subject, shifts[one.targets[0]])
    actors = move(shifts)
    room = _size_room(film(actors), actors, wall)
    actors = move(dict.fromkeys(groups, np.array([0.0, room - _GAP_M - wall, 0.0])))
    return actors, replace(film(actors), room_m=room)


def _size_room(path: CameraPath, actors: Sequence[Actor], wall: float) -> float:
    """Half the side of a room, m, that holds all and the camera, with its far wall at that y."""
    times = np.linspace(0.0, path.duration_s, 5)
    eyes = np.array([path.at(float(time)).position for time in times])
    points = np.vstack([eyes + np.array([0.0, 0.0, 0.2]), corners_over(actors, times)])
    wide, high = float(np.abs(points[:, 0]).max()), float(points[:, 2].max())
    deep = wall - float(points[:, 1].min())
    return max(0.5 * (deep + 0.6), wide + 0.5, (high + 0.15) / _CEILING, _LEAST_ROOM_M)

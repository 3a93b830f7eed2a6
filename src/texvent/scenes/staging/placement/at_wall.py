"""Furniture that stands with its back to a wall of a room: fitted, hung or plumbed in."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.description import AMID, SceneDescription
from texvent.scenes.models.places import is_room
from texvent.scenes.models.traits import nouns_with
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor, corners_over
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.placement.object_groups import ObjectGroup

_BESIDE = frozenset({"at", "beside", "with", "left of", "right of", "front"})
"""Relations that leave their subject at the wall."""
_APART_M, _BEFORE_M = 0.22, 0.45
"""Room between what stands at the wall, and before it."""
_CEILING = 0.6
"""Height of a ceiling as a share of half the room's side."""
_LEAST_ROOM_M, _GAP_M = 3.2, 0.02


def list_at_wall(description: SceneDescription, place: str) -> tuple[int, ...]:
    """Indices of the objects that stand at the wall; none where the camera goes or looks down."""
    shot = description.shot
    is_free = any(move.kind in ("travel", "orbit") for move in shot.moves)
    if not is_room(place) or is_free or shot.view not in (None, "front", "level", "low"):
        return ()
    elsewhere = {one.subject for one in description.relations if one.kind not in _BESIDE}
    for one in description.relations:
        elsewhere |= set(one.targets) if one.kind in AMID | {"through"} else set()
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

    Args:
        description: the scene.
        groups: its objects as placed, by index.
        move: moves objects by metres and returns the actors.
        film: places the camera before actors.
        place: key of `PLACES`.
    """
    actors = move(_line_up(groups, list_at_wall(description, place), description))
    room = _size_room_behind(film(actors), actors)
    actors = move(dict.fromkeys(groups, np.array([0.0, room - _GAP_M, 0.0])))
    return actors, replace(film(actors), room_m=room)


def _line_up(
    groups: Mapping[int, ObjectGroup], at_wall: Sequence[int], description: SceneDescription
) -> dict[int, Float64Array]:
    """Turn what stands at the wall to the camera and set it in a row whose backs are at y = 0.

    Returns:
        Index of every object → how far it moves, m: what is on, in or beside something of the row
        goes with it, all else stays in front.
    """
    row = sorted((i for i in at_wall if i in groups), key=lambda i: float(groups[i].centre[0]))
    widths = [_stand_in_row(groups[i]) for i in row]
    left, shifts = -0.5 * (sum(widths) + _APART_M * (len(row) - 1)), {}
    for index, wide in zip(row, widths, strict=True):
        goal = np.array([left + 0.5 * wide, -0.5 * groups[index].models[0].length, 0.0])
        shifts[index] = (goal - groups[index].centre) * [1.0, 1.0, 0.0]
        left += wide + _APART_M
    for one in (*description.relations, *description.relations):
        if one.subject in groups and one.targets[0] in shifts:
            shifts.setdefault(one.subject, shifts[one.targets[0]])
    rest = [i for i in groups if i not in shifts]
    deep = max(groups[i].models[0].length for i in row)
    for index in rest:
        back = max(float(groups[i].centre[1] + groups[i].half[1]) for i in rest)
        shifts[index] = np.array([0.0, -deep - _BEFORE_M - back, 0.0])
    return shifts


def _stand_in_row(group: ObjectGroup) -> float:
    """Turn the copies to the camera, side by side; returns how wide they are together, m."""
    group.plan = replace(group.plan, yaw=-0.5 * math.pi)
    group.yaws = None
    wide, count = max(model.width for model in group.models), len(group.models)
    step = wide + 0.6 * _APART_M
    group.offsets = [(step * (k - 0.5 * (count - 1)), 0.0, 0.0) for k in range(count)]
    group.fit()
    return wide + step * (count - 1)


def _size_room_behind(path: CameraPath, actors: Sequence[Actor]) -> float:
    """Half the side of a room, m, that holds all where what stands at y = 0 now is at its wall."""
    times = np.linspace(0.0, path.duration_s, 5)
    eyes = np.array([path.at(float(time)).position for time in times])
    points = np.vstack([eyes + np.array([0.0, 0.0, 0.2]), corners_over(actors, times)])
    wide, high = float(np.abs(points[:, 0]).max()), float(points[:, 2].max())
    deep = -float(points[:, 1].min())
    return max(0.5 * (deep + 0.6), wide + 0.5, (high + 0.15) / _CEILING, _LEAST_ROOM_M)

"""Furniture that stands with its back to a wall of a room: fitted, hung or plumbed in."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.models.places import is_room
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor, corners_over
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.placement.object_groups import ObjectGroup, half_extents_over_clip

AT_WALL = frozenset(
    {"toilet", "sink", "bathtub", "shower", "shower curtain", "wash stand", "mirror",
     "refrigerator", "oven", "washing machine", "kitchen cabinet", "kitchen counter",
     "kitchen sink", "window", "curtain", "blind", "door", "heater", "fireplace", "wardrobe",
     "bookshelf", "shelf", "chest of drawers", "blackboard", "wall blackboard", "whiteboard",
     "large painting", "grandfather clock", "bread shelf", "medicine shelf", "film screen"}
)  # fmt: skip
"""Nouns of what has its place at a wall, its front to the room."""
_ELSEWHERE = frozenset({"on", "in", "above", "under", "between", "behind", "around", "through",
                        "hold", "carry", "follow", "push", "pull"})  # fmt: skip
"""Relations whose subject is where its target is, not at the wall."""
_AROUND = ("through", "surround", "among")
_BOUND = frozenset({"on", "in", "above", "under", "behind", "at", "beside", "with", "work on"})
"""Relations whose subject goes to the wall with its target."""
_BEFORE_WINDOWS = frozenset({"curtain", "blind"})
"""What hangs before a window where there is one, to be seen beyond its own frame."""
_BEFORE_PANE_M = 0.14
_ASIDE = 0.6
"""How far beside its middle one stands at a thing that is seen from the front, in its widths."""
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
    elsewhere = {one.subject for one in description.relations if one.kind in _ELSEWHERE}
    around = [one.targets for one in description.relations if one.kind in _AROUND]
    elsewhere |= {index for targets in around for index in targets}
    return tuple(
        index
        for index, one in enumerate(description.objects)
        if index not in elsewhere and _rests(one)
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
        description: what the prompt says.
        groups: its objects as placed, by index.
        move: moves objects by metres and returns the actors.
        film: places the camera before actors.
        place: key of `PLACES`.
    """
    at_wall = list_at_wall(description, place)
    actors = move(line_up(groups, at_wall, description))
    room = size_room_behind(film(actors), actors)
    actors = move(dict.fromkeys(groups, np.array([0.0, room - _GAP_M, 0.0])))
    return actors, replace(film(actors), room_m=room)


def _rests(one: SceneObject) -> bool:
    kinds = {motion.kind for motion in (one.motion, *one.then) if motion is not None}
    return (
        one.noun in AT_WALL
        and kinds <= {"stand", "work"}
        and one.side not in ("near", "far", "ring")
    )


def line_up(
    groups: Mapping[int, ObjectGroup], at_wall: Sequence[int], description: SceneDescription
) -> dict[int, Float64Array]:
    """Turn what stands at the wall to the camera and set it in a row whose backs are at y = 0.

    Returns:
        Index of every object → how far it moves, m: what is on, in or beside something of the row
        goes with it, all else stays in front.
    """
    row = sorted((i for i in at_wall if i in groups), key=lambda i: float(groups[i].centre[0]))
    panes = [i for i in row if groups[i].noun.name == "window"]
    drapes = [i for i in row if groups[i].noun.name in _BEFORE_WINDOWS] if panes else []
    row = [i for i in row if i not in drapes]
    widths = [_stand_in_row(groups[i]) for i in row]
    total = sum(widths) + _APART_M * (len(row) - 1)
    left, shifts = -0.5 * total, {}
    for index, wide in zip(row, widths, strict=True):
        goal = np.array([left + 0.5 * wide, -0.5 * groups[index].models[0].length, 0.0])
        shifts[index] = goal - groups[index].centre
        left += wide + _APART_M
    for index in drapes:
        _stand_in_row(groups[index])
        before = groups[panes[0]].centre + shifts[panes[0]] - [0.0, _BEFORE_PANE_M, 0.0]
        shifts[index] = before - groups[index].centre
    _take_along(groups, description, shifts)
    rest = [i for i in groups if i not in shifts]
    if rest:
        deep = max(groups[i].models[0].length for i in row)
        back = max(float(groups[i].centre[1] + groups[i].half[1]) for i in rest)
        aside = _keep_clear(groups, rest, description, total)
        shifts |= dict.fromkeys(rest, np.array([aside, -deep - _BEFORE_M - back, 0.0]))
    return shifts


def _take_along(
    groups: Mapping[int, ObjectGroup],
    description: SceneDescription,
    shifts: dict[int, Float64Array],
) -> None:
    """Let what is on, in or beside something that is moved move with it; adds to `shifts`."""
    for _ in groups:
        for one in description.relations:
            known = [shifts[i] for i in one.targets if i in shifts]
            is_free = one.subject in groups and one.subject not in shifts
            if one.kind in _BOUND and is_free and known:
                is_at = groups[one.subject].noun.habitat == "ground" and one.kind == "at"
                aside = _ASIDE * groups[one.targets[0]].models[0].width if is_at else 0.0
                shifts[one.subject] = known[0] + [aside, 0.0, 0.0]


def _keep_clear(
    groups: Mapping[int, ObjectGroup],
    rest: Sequence[int],
    description: SceneDescription,
    total_m: float,
) -> float:
    """How far to the right goes what would stand before the row for no reason, m."""
    ends = [{one.subject, *one.targets} for one in description.relations]
    if any(one & set(rest) and one - set(rest) for one in ends):
        return 0.0
    if all(groups[i].noun.habitat == "ground" for i in rest):
        return 0.0
    return 0.5 * total_m + 0.4 - min(float(groups[i].centre[0] - groups[i].half[0]) for i in rest)


def _stand_in_row(group: ObjectGroup) -> float:
    """Turn the copies to the camera, side by side; returns how wide they are together, m."""
    group.plan = replace(group.plan, yaw=-0.5 * math.pi)
    group.yaws = None
    wide = max(model.width for model in group.models)
    step, count = wide + 0.6 * _APART_M, len(group.models)
    group.offsets = [(step * (k - 0.5 * (count - 1)), 0.0, 0.0) for k in range(count)]
    group.half = half_extents_over_clip(group.models, group.offsets, group.plan)
    return wide + step * (count - 1)


def size_room_behind(path: CameraPath, actors: Sequence[Actor]) -> float:
    """Half the side of a room, m, that holds all where what stands at y = 0 now is at its wall."""
    times = np.linspace(0.0, path.duration_s, 5)
    eyes = np.array([path.at(float(time)).position for time in times])
    corners = corners_over(actors, times)
    deep = -min(float(eyes[:, 1].min()), float(corners[:, 1].min()))
    wide = max(float(np.abs(eyes[:, 0]).max()), float(np.abs(corners[:, 0]).max()))
    high = max(float(eyes[:, 2].max()) + 0.35, float(corners[:, 2].max()) + 0.15)
    return max(0.5 * (deep + 0.6), wide + 0.5, high / _CEILING, _LEAST_ROOM_M)

"""Places of things on the way of who goes through, out of or up to them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from texvent_scenes.models.protocol import Model, ModelPart, Pose
from texvent_scenes.models.shapes import moved, shift
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.staging.placement.object_groups import Goal, ObjectGroup
from texvent_scenes.staging.placement.zones import are_driven
from texvent_scenes.staging.tracks.phases import ends_at_rest

_FIXED, _AWAY = np.zeros(3), np.array([0.0, 1.0, 0.0])
_AT_START = ("from", "away from")
"""Relations to the thing that a body leaves."""
_ALONG, _PANEL = 0.8, 0.96
"""Share of the way along a fence that is beside it; from panel to panel, in widths of one."""
_LEFT_M, _ASIDE = 0.05, 0.5
"""Gap between who goes away and what it leaves, m; least cosine of a way across the picture."""
_EDGE_M, _AHEAD_M = 0.2, 2.0
"""Gap between a train and its platform, whose middle is so far ahead of that of the train, m."""
_PASSED = 0.7
"""Share of a way between the first and the last of several gates on it."""
_AT_DOOR_M, _QUEUE_M = 0.3, 1.2
"""From the wall of a house to the middle of who has come out of it; gap between those who wait or
stop one before the other, m."""


def place_on_way(group: ObjectGroup, kind: str, subject: ObjectGroup, height: float) -> Goal | None:
    """Position of a target on the way of its subject, which is placed already; None: elsewhere.

    `height` is that of the target's origin, m.
    """
    if kind == "through" and subject.plan.is_path:
        return _lead_through(group, subject, height)
    has_door = group.noun.name in nouns_with("has a door")
    if kind == "from" and has_door and subject.plan.motion.direction == "towards":
        return _lead_out(group, subject, height)
    if kind in ("beside", *_AT_START, "past") and group.noun.name in nouns_with("alongside"):
        return _lay_alongside(group, kind, subject, height)
    if kind in _AT_START and subject.plan.is_path and group.noun.motion == "stand":
        return _stay_behind(group, subject, height)
    if kind == "past" and subject.plan.is_path and group.noun.name in nouns_with("runs on"):
        _lay_out(group, subject)
    if kind in ("behind", "front", "beside"):
        return _place_in_queue(group, kind, subject, height)
    return None


class RepeatedModel:
    """A model several times in one row along its width, as the panels of a fence are."""

    def __init__(self, model: Model, count: int) -> None:
        self._model, self._count = model, count
        self._apart_m = _PANEL * model.width
        self.length, self.height = model.length, model.height
        self.width = model.width + (count - 1) * self._apart_m

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):  # not yet set, as in a copy that is being made
            raise AttributeError(name)
        return getattr(self._model, name)

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The parts of every panel."""
        first = -0.5 * (self._count - 1)
        places = [shift(0.0, (first + n) * self._apart_m) for n in range(self._count)]
        return [each for one in places for each in moved(self._model.parts(pose), one)]


def _lay_out(group: ObjectGroup, subject: ObjectGroup) -> None:
    """Lay what has panels along most of the way of who goes by, parallel to it."""
    count = math.ceil(_ALONG * subject.plan.travel_m / group.models[0].width)
    if count > 1 and len(group.models) == 1 and group.scene_object.heading_deg is None:
        group.models = [RepeatedModel(group.models[0], count)]
        group.plan = replace(group.plan, yaw=subject.plan.yaw - 0.5 * math.pi)
        group.fit()


def _lead_through(group: ObjectGroup, subject: ObjectGroup, height: float) -> Goal:
    """Along the way of who goes through, who is out at about half of that way."""
    if group.noun.name in nouns_with("passage"):
        group.plan = replace(group.plan, yaw=subject.plan.yaw)
        group.fit()
    extent = 2.0 * float(max(subject.half[:2])) - subject.models[0].length
    if len(group.models) > 1 and group.noun.name in nouns_with("passage"):
        _line_up(group, subject, extent)
        return Goal(subject.to_world(0.0, 0.0, height - subject.centre[2]), _FIXED)
    back = min(0.1 * extent + 0.5 * group.models[0].length, 0.45 * extent)
    return Goal(subject.to_world(-back, 0.0, height - subject.centre[2]), _FIXED)


def _line_up(group: ObjectGroup, subject: ObjectGroup, extent_m: float) -> None:
    """Line up passages along the way of who goes through one after the other."""
    count, yaw = len(group.models), subject.plan.yaw
    apart_m = _PASSED * extent_m / (count - 1)
    places = [(number - 0.5 * (count - 1)) * apart_m for number in range(count)]
    group.offsets = [(one * math.cos(yaw), one * math.sin(yaw), 0.0) for one in places]
    group.fit()


def _lead_out(group: ObjectGroup, subject: ObjectGroup, height: float) -> Goal:
    """Behind who comes out, its front turned the same way."""
    group.plan = replace(group.plan, yaw=subject.plan.yaw)
    group.fit()
    back = 0.5 * (subject.plan.travel_m + group.models[0].length) + _AT_DOOR_M
    return Goal(subject.to_world(-back, 0.0, height - subject.centre[2]), _FIXED)


def _stay_behind(group: ObjectGroup, subject: ObjectGroup, height: float) -> Goal:
    """Start of who goes away: behind, or aside of those who go along the line of sight."""
    x = float((group.half_at_rest() + subject.half_at_rest())[0]) + _LEFT_M
    along = math.cos(subject.plan.yaw)
    start = subject.to_world(-0.5 * subject.plan.travel_m, 0.0, height - subject.centre[2])
    is_aside = abs(along) > _ASIDE
    away = np.array([-math.copysign(x, along) if is_aside else x, 0.0, 0.0])
    return Goal(start + away, _FIXED)


def _lay_alongside(group: ObjectGroup, kind: str, subject: ObjectGroup, height: float) -> Goal:
    """Along the way of a subject where it stops or begins, beyond it if it would hide it."""
    yaw, path = subject.plan.yaw, subject.plan.path
    place = np.array(subject.centre)
    if path is not None:
        state = path.at(0.0 if kind in _AT_START else subject.plan.duration_s)
        place, yaw = place + np.array(state.position), state.yaw
    elif kind in _AT_START:
        ahead = np.array([math.cos(yaw), math.sin(yaw), 0.0])
        place -= 0.5 * subject.plan.travel_m * ahead
    group.plan = replace(group.plan, yaw=yaw)
    group.fit()
    apart = 0.5 * (subject.models[0].width + group.models[0].width) + _EDGE_M
    side = -1.0 if math.cos(yaw) > 0.0 else 1.0
    side *= -1.0 if group.models[0].height > subject.models[0].height else 1.0
    aside = side * apart * np.array([-math.sin(yaw), math.cos(yaw)])
    along = _AHEAD_M * np.array([math.cos(yaw), math.sin(yaw)])
    return Goal(np.array([*(place[:2] + aside + along), height]), _FIXED)


def _place_in_queue(
    group: ObjectGroup, kind: str, subject: ObjectGroup, height: float
) -> Goal | None:
    """Before or behind a subject that comes to rest there, or vehicles at rest in one lane."""
    path, yaw = subject.plan.path, subject.plan.yaw
    is_stopping = path is not None and ends_at_rest(subject.scene_object.motions)
    are_waiting = not (subject.plan.motion.is_moving or group.plan.motion.is_moving)
    is_lane = are_driven(subject.noun.name, group.noun.name)
    is_crossing = group.noun.name in nouns_with("across a road")
    if not (is_stopping or is_crossing or (are_waiting and is_lane and kind != "beside")):
        return None
    place, apart = subject.centre, _QUEUE_M + 0.5 * subject.models[0].length
    if path is not None and is_stopping:
        state = path.at(subject.plan.duration_s)
        place, yaw = place + np.array(state.position), state.yaw
    apart += 0.5 * float(group.models[0].length if is_lane else max(group.half[:2]))
    if is_lane:
        group.plan = replace(group.plan, yaw=yaw)
        group.fit()
        apart *= -1.0 if kind == "front" and not is_stopping else 1.0
    along = apart * np.array([math.cos(yaw), math.sin(yaw)])
    slide = _FIXED if is_lane or is_crossing else _AWAY
    return Goal(np.array([*(place[:2] + along), height]), slide)

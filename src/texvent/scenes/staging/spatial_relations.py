"""Relations as positions: on, under, between, beside, past, behind and so on."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.choose_trajectory import PEOPLE
from texvent.scenes.staging.object_groups import GAP_M, ObjectGroup, measure_room


def place_on_targets(
    group: ObjectGroup, kind: str, targets: list[ObjectGroup], height: float, neighbours: list[int]
) -> tuple[Float64Array, Float64Array]:
    """A subject's place with respect to objects that stand already."""
    target = targets[0]
    top = target.models[0].height * (0.5 if is_centred(target.noun) else 1.0)
    lift = 0.5 * group.models[0].height if is_centred(group.noun) else 0.0
    still = np.zeros(3)
    if kind == "around":
        group.orbits = target
        level = target.centre[2] if group.noun.habitat != "air" else target.centre[2] + 0.8 * top
        return np.array([target.centre[0], target.centre[1], max(level, 0.0)]), still
    if kind == "on":
        if target.plan.motion.is_moving:
            group.carrier = target
        seat = _seat_height(target, group) + lift
        _sit_in_row(group, target, neighbours)
        return target.centre + np.array([0.0, 0.0, seat]), still
    if kind == "above" and group.plan.motion.kind == "jump":
        group.clear_m = min(top, 2.0 * group.models[0].height)
        return target.centre * [1.0, 1.0, 0.0], still
    if kind == "above" and group.noun.habitat == "fixed" and group.models[0].height > top:
        # A street lamp over a car stands on the ground and reaches over it.
        back = target.half[1] + group.half[1] + 0.3
        return target.centre * [1.0, 1.0, 0.0] + [0.0, back, height], np.array([0.0, 1.0, 0.0])
    if kind == "above":
        clear = top + 0.7 * group.models[0].height + 0.3
        return target.centre + np.array([0.0, 0.0, max(clear + lift, height)]), still
    if kind == "under":
        return target.centre * [1.0, 1.0, 0.0] + [0.0, -0.9, height], np.array([0.0, -1.0, 0.0])
    if kind == "between":
        middle = np.mean([other.centre for other in targets], axis=0)
        if len(targets) == 1 and len(target.offsets) > 1:
            middle = target.centre
        return np.array([middle[0], middle[1], height]), np.array([0.0, -1.0, 0.0])
    behind = target.half[:2] + group.half[:2]
    heading = np.array([math.cos(target.plan.yaw), math.sin(target.plan.yaw)])
    reach = 0.5 * (target.models[0].length + group.models[0].length)
    wanted = target.centre[:2] - heading * min(1.6 * reach + 0.4, float(behind.max()) + reach)
    group.half = 0.5 * np.array(
        [group.models[0].length, group.models[0].width, group.models[0].height]
    )
    return np.array([*wanted, height]), still


def _sit_in_row(group: ObjectGroup, target: ObjectGroup, neighbours: list[int]) -> None:
    """Spread what is on an object along its longer side, facing as it faces.

    `neighbours` are the indices of all objects on it: each group takes its part of the row.
    """
    body, own = target.models[0], len(group.offsets)
    count, first = own * len(neighbours), own * neighbours.index(group.index)
    is_wide = body.width > body.length
    room = 0.8 * max(body.width, body.length) / count
    size = max(group.models[0].width, group.models[0].length)
    spacing = max(min(room, 1.3 * size), 1.05 * size if group.noun.name not in PEOPLE else 0.5)
    yaw = target.plan.yaw + (0.5 * math.pi if is_wide else 0.0)
    group.offsets = [
        (a * math.cos(yaw), a * math.sin(yaw), 0.0)
        for a in (spacing * (number - 0.5 * (count - 1)) for number in range(first, first + own))
    ]
    if group.plan.motion.kind in ("sit", "stand") and group.noun.name in PEOPLE:
        group.plan = replace(group.plan, yaw=target.plan.yaw)
    group.half = measure_room(group.models, group.offsets, group.plan)


def _seat_height(target: ObjectGroup, group: ObjectGroup) -> float:
    """Height above the target's origin at which the object on it has its own origin, m."""
    is_sitting = group.plan.motion.kind in ("sit", "drive", "sail") or group.carrier is not None
    shares = _SADDLES if is_sitting and group.noun.name in PEOPLE else _TOPS
    inside = 0.02 if shares is _SADDLES and target.noun.motion == "drive" else 1.0
    share = shares.get(target.noun.name, inside)
    return (share - (0.5 if is_centred(target.noun) else 0.0)) * target.models[0].height


_TOPS = {"chair": 0.5, "sofa": 0.5, "bed": 0.5, "bench": 0.5, "boat": 0.35, "horse": 0.62,
         "sailboat": 0.15, "bridge": 0.338}  # fmt: skip
"""Share of an object's height at which others lie on it; 1 where nothing is said."""
_SADDLES = {"chair": 0.02, "sofa": 0.02, "bench": 0.02, "bed": 0.05, "horse": 0.40, "boat": 0.2,
            "elephant": 0.78, "sailboat": 0.1, "zebra": 0.40, "cow": 0.6}  # fmt: skip
"""The same for people who sit: their origin is under their feet."""


def place_by_subject(
    group: ObjectGroup, kind: str, subject: ObjectGroup, height: float
) -> tuple[Float64Array, Float64Array]:
    """A target's place with respect to the subject that the prompt relates to it."""
    clear = subject.half + group.half + GAP_M * min(subject.size_m, group.size_m)
    sideways = abs(math.cos(subject.plan.yaw)) > 0.5 or not subject.plan.is_path
    here = subject.centre * [1.0, 1.0, 0.0] + [0.0, 0.0, height]
    away, along = np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])
    if kind == "with" and subject.plan.is_path and sideways:
        ahead = 0.55 * (subject.models[0].length + group.models[0].length) + 0.2
        return _shift(here, ahead * math.cos(subject.plan.yaw), clear[1] + 0.1), away
    if kind in ("past", "beside", "with") and subject.plan.is_path and sideways:
        return _shift(here, 0.0, clear[1] + 0.3), away
    if kind == "past" or (subject.plan.is_path and kind == "beside"):
        return _shift(here, clear[0] + 0.3, 0.0), along
    if kind == "behind":
        return _shift(here, -0.55 * clear[0], -clear[1]), -away
    if kind == "front":
        return _shift(here, 0.0, clear[1]), away
    if kind == "left of":
        return _shift(here, clear[0], 0.0), along
    if kind == "right of":
        return _shift(here, -clear[0], 0.0), -along
    if kind == "towards":
        yaw = subject.plan.yaw
        return _shift(here, clear[0] * math.cos(yaw), clear[1] * math.sin(yaw)), away
    return _shift(here, clear[0], 0.0), along


def _shift(place: Float64Array, x: float, y: float) -> Float64Array:
    return np.asarray(place + np.array([x, y, 0.0]))

"""Copies in formation: in a row, in a ring, or turned to each other."""

from __future__ import annotations

import math

import numpy as np

from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.shapes import bounds
from texvent.scenes.staging.placement.object_groups import ObjectGroup, half_extents_over_clip

FACE_TO_FACE = frozenset({"talk", "shake hands", "high five", "hug", "fence", "box"})
"""What two people do turned to each other, and more in a half ring."""
_AT_EASE = frozenset({"stand", "sit", "talk", "laugh", "smile", "walk", "run", "pose"})
"""What people do who need no more room than their shoulders have."""
_SHOULDERS_M, _BUSY_M = 0.56, 0.95
"""Room from shoulder to shoulder, and of who does something with the arms, m."""
_CLOSE, _AHEAD, _ONE_ROW, _FEW = 1.12, 0.75, 6, 3
"""From one to the next, in widths; how far one is ahead of the other, in lengths; most
people, and others, of a row."""
_TO_CAMERA = 0.35
"""How far who faces another is turned to the camera, radians."""


def form_up(group: ObjectGroup) -> None:
    """Set the copies in the formation that the prompt says, or that what they do asks for."""
    count, side = len(group.models), group.scene_object.side
    if count < 2:
        return
    if side == "row":
        _stand_in_row(group)
    elif side == "together":
        _stand_together(group)
    elif side == "ring":
        _stand_in_ring(group)
    elif group.noun.name in PERSON_NOUNS and group.plan.motion.kind in FACE_TO_FACE:
        if group.plan.path is None and not group.scene_object.then:
            _face_each_other(group)
    else:
        return
    group.half = half_extents_over_clip(group.models, group.offsets, group.plan)


def _stand_in_row(group: ObjectGroup) -> None:
    """Side by side across the image; what goes away from the camera or comes, one by one."""
    count, model = len(group.models), group.models[0]
    goes_away = group.plan.is_path and abs(math.sin(group.plan.yaw)) > 0.7
    is_along = group.plan.is_path
    step = 1.25 * (model.length if is_along else max(model.length, model.width)) + 0.15
    places = [step * (number - 0.5 * (count - 1)) for number in range(count)]
    group.offsets = [(0.0, at, 0.0) if goes_away else (at, 0.0, 0.0) for at in places]


def _stand_together(group: ObjectGroup) -> None:
    """Shoulder to shoulder, in two rows where they are many; who goes along, nearly abreast."""
    count, model = len(group.models), group.models[0]
    scale = float(getattr(model, "scale", 1.0))
    low, high = bounds(model.parts(Pose(0.0, 0.0, 0.0, "stand")))
    long, wide = (float(size) for size in (high - low)[:2])
    if group.noun.name in PERSON_NOUNS and group.plan.motion.kind != "lie":
        busy = group.plan.motion.kind not in _AT_EASE
        long = wide = (_BUSY_M if busy else _SHOULDERS_M) * scale
    if group.plan.is_path:
        step, abreast = _AHEAD * long, 1.25 * wide + 0.05 * scale
        turn = group.plan.yaw
        group.offsets = [
            (step * at * math.cos(turn) - abreast * at * math.sin(turn),
             step * at * math.sin(turn) + abreast * at * math.cos(turn), 0.0)
            for at in (number - 0.5 * (count - 1) for number in range(count))
        ]  # fmt: skip
        return
    cosine, sine = abs(math.cos(group.plan.yaw)), abs(math.sin(group.plan.yaw))
    across, deep = cosine * long + sine * wide, sine * long + cosine * wide
    most = _ONE_ROW if group.noun.name in PERSON_NOUNS else _FEW
    columns = count if count <= most else math.ceil(count / 2)
    group.offsets = []
    for number in range(count):
        row, column = divmod(number, columns)
        at = column - 0.5 * (columns - 1) + 0.5 * row
        group.offsets.append((_CLOSE * across * at, 1.1 * deep * row, 0.0))


def _stand_in_ring(group: ObjectGroup) -> None:
    count, model = len(group.models), group.models[0]
    size = max(model.length, model.width)
    radius = max(1.1 * size, 1.3 * size * count / (2.0 * math.pi))
    angles = [2.0 * math.pi * (number + 0.5) / count for number in range(count)]
    group.offsets = [(radius * math.cos(a), radius * math.sin(a), 0.0) for a in angles]
    if not group.plan.is_path:
        group.yaws = [a + math.pi for a in angles]


def _face_each_other(group: ObjectGroup) -> None:
    """Two side by side in the image; more in a half ring that is open to the camera."""
    count, model = len(group.models), group.models[0]
    scale = float(getattr(model, "scale", 1.0))
    if count == 2:
        group.offsets = [(-0.55 * scale, 0.0, 0.0), (0.55 * scale, 0.0, 0.0)]
        group.yaws = [-_TO_CAMERA, math.pi + _TO_CAMERA]
        return
    radius = max(0.7, 0.8 * (count - 1) / math.pi) * scale
    angles = np.linspace(0.0, math.pi, count)
    group.offsets = [(radius * math.cos(a), 0.7 * radius * math.sin(a), 0.0) for a in angles]
    group.yaws = [_towards_middle(float(a)) for a in angles]


def _towards_middle(angle: float) -> float:
    """The heading to the middle of the half ring, a little to the camera."""
    x, y = -math.cos(angle), -0.7 * math.sin(angle) - 0.35
    return math.atan2(y, x)

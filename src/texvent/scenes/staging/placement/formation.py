"""Copies of one object in formation: staggered, in a row, or in a ring."""

from __future__ import annotations

import math

import numpy as np

from texvent.scenes.models.people.activities import HAND_NOUNS, PERSON_NOUNS
from texvent.scenes.models.protocol import Model, Noun
from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.placement.object_groups import ObjectGroup
from texvent.scenes.staging.trajectories.motion_plan import MotionPlan
from texvent.scenes.staging.trajectories.trajectory import Vector

_RESTING = frozenset({"stand", "sit", "lie", "slide"})
_SHOULDERS_M, _BUSY_M = 0.56, 0.95
"""Room from shoulder to shoulder, and of who does something with the arms, m."""
_AT_EASE = frozenset({"stand", "sit", "talk", "walk", "run"})
_APART = 0.3
"""Space between copies of small things, in their sizes: apples do not lie half a metre apart."""


def rests(noun: Noun, kind: str) -> bool:
    """Whether it is on something while it does that."""
    return kind in _RESTING or kind in noun.acts


def stagger(
    models: list[Model], plan: MotionPlan, noun: Noun, rng: np.random.Generator
) -> list[Vector]:
    """Places of the copies about the middle of their group, m, staggered so none hides another."""
    count, is_driven = len(models), noun.motion == "drive"
    if count == 1:
        return [(0.0, 0.0, 0.0)]
    along, across = _spacing(models, plan, noun)
    is_lifting = plan.motion.kind in ("rise", "sink") and noun.motion == "fly"
    is_on_ground = noun.habitat == "air" and rests(noun, plan.motion.kind)
    is_deep = is_centred(noun) and noun.name not in HAND_NOUNS and not (is_lifting or is_on_ground)
    tall = max(model.height for model in models) if is_deep else 0.0
    columns = count if count <= 3 else math.ceil(math.sqrt(1.6 * count))
    columns = math.ceil(count / 2) if is_driven else columns
    in_depth = plan.is_path and abs(math.sin(plan.yaw)) > 0.5 >= abs(math.cos(plan.yaw))
    offsets: list[Vector] = []
    for number in range(count):
        row, column = divmod(number, columns)
        in_row = min(columns, count - row * columns)
        a = (column - 0.5 * (in_row - 1) + 0.3 * (row % 2)) * along
        b = (row - 0.5 * ((count - 1) // columns)) * across
        a += float(rng.uniform(-0.12, 0.12)) * along
        stray = float(rng.uniform(-0.08, 0.08)) * across
        if not is_driven:  # vehicles keep to their lanes
            b = b + 0.6 * across * (number % 2) + stray
        up = (0.9 * (-1.0) ** number + float(rng.uniform(-0.35, 0.35))) * tall if is_deep else 0.0
        offsets.append((b * 1.6, a, up) if in_depth else (a, b, up))
    return offsets


def _spacing(models: list[Model], plan: MotionPlan, noun: Noun) -> tuple[float, float]:
    """Metres from one copy to the next, along the heading and across it."""
    length = max(model.length for model in models)
    width = max(model.width for model in models)
    size = max(length, width)
    if plan.motion.direction == "circle":
        return 4.0 * size, 4.0 * size
    if noun.motion == "drive":
        return 1.45 * length + 0.5, max(width + 0.9, 2.9)
    if plan.is_facing or noun.name in HAND_NOUNS:
        return 1.6 * width, 0.2 * width  # in one row, as the camera sees them
    apart = min(0.3, _APART * size)
    across = 1.4 * width + apart + min(0.1, 0.1 * size)
    if is_centred(noun):
        return 0.8 * length + apart, across
    return 1.2 * (length if plan.is_path else size) + apart, across


def form_up(group: ObjectGroup) -> None:
    """Set the copies in the formation that the scene asks for."""
    side = group.scene_object.side
    if len(group.models) < 2:
        return
    if side in ("row", "together"):
        _stand_in_row(group, is_close=side == "together")
    elif side == "ring":
        model = group.models[0]
        size = max(model.length, model.width)
        stand_in_ring(group, max(1.1 * size, 1.3 * size * len(group.models) / (2.0 * math.pi)))
    else:
        return
    group.fit()


def _stand_in_row(group: ObjectGroup, *, is_close: bool) -> None:
    """Side by side across the image; who goes along, one by one or, if close, nearly abreast."""
    count, model, plan = len(group.models), group.models[0], group.plan
    long, wide = model.length, model.width
    cosine, sine = math.cos(plan.yaw), math.sin(plan.yaw)
    if is_close and group.noun.name in PERSON_NOUNS and plan.motion.kind != "lie":
        room = _SHOULDERS_M if plan.motion.kind in _AT_EASE else _BUSY_M
        long = wide = room * float(getattr(model, "scale", 1.0))
    if is_close and plan.is_path:
        ahead, aside = 0.75 * long, 1.25 * wide
        step = (ahead * cosine - aside * sine, ahead * sine + aside * cosine)
    elif is_close:
        step = (1.12 * (abs(cosine) * long + abs(sine) * wide), 0.0)
    else:
        apart = 1.25 * (long if plan.is_path else max(long, wide)) + 0.15
        step = (0.0, apart) if plan.is_path and abs(sine) > 0.7 else (apart, 0.0)
    places = [number - 0.5 * (count - 1) for number in range(count)]
    group.offsets = [(step[0] * at, step[1] * at, 0.0) for at in places]


def stand_in_ring(group: ObjectGroup, radius_m: float, *, is_open: bool = False) -> None:
    """In a ring, turned to its middle; an open one leaves the camera's side free."""
    count, phase = len(group.models), 0.5
    if not is_open:
        angles = [2.0 * math.pi * (number + phase) / count for number in range(count)]
    elif count <= 2:
        angles = [math.pi * number for number in range(count)]
    else:
        angles = [float(a) for a in np.linspace(-0.7, math.pi + 0.7, count)]
    group.offsets = [(radius_m * math.cos(a), radius_m * math.sin(a), 0.0) for a in angles]
    if not group.plan.is_path:
        group.yaws = [a + math.pi for a in angles]


def part_in_midst(group: ObjectGroup, room_m: float) -> None:
    """Set the copies of a group in two rows, left and right of a gap of twice that room."""
    count, model = len(group.models), group.models[0]
    if count < 2:
        return
    size = max(model.length, model.width)
    group.offsets = []
    for number in range(count):
        row, side = number // 2, -1.0 if number % 2 == 0 else 1.0
        rows = (count + 1 - number % 2) // 2
        deep = (row - 0.5 * (rows - 1)) * 1.3 * size
        group.offsets.append((side * (room_m + 0.5 * size), deep, 0.0))
    group.fit()

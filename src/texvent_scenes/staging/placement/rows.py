"""Rows of what rests on one thing: on a table, a bench, a belt, in a container; what stands."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.anchors import Support
from texvent_scenes.models.protocol import Model, Pose
from texvent_scenes.models.shapes import point
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.staging.actors import lowest_point
from texvent_scenes.staging.placement.along_surface import carried_way
from texvent_scenes.staging.placement.apart import Spacing
from texvent_scenes.staging.placement.object_groups import ObjectGroup

_PERSON_M = 0.5
"""Room for one of several people on something."""
_ON_GROUND_M = 0.01
"""Height of its foot up to which a thing stands on the ground."""
_ENDS = 0.87
"""From one end to the other of what is sat on at its ends, of its length."""


def _slope_of(body: Model) -> float:
    """Rise of the last part of a body at rest, along its length."""
    turn = body.parts(Pose(0.0, 0.0, 0.0, "stand"))[-1].to_body
    return float(turn[2, 0] / math.hypot(turn[0, 0], turn[1, 0]))


def stands(
    group: ObjectGroup, model: Model, height_m: float, levels: Mapping[str, float]
) -> bool:  # fmt: skip
    """Whether a copy is on the ground or on a thing, not in the air, in water or on a wall.

    Args:
        group: the object.
        model: the copy.
        height_m: height of its origin, m.
        levels: heights of what lives in the air and in the water.
    """
    is_hung = group.noun.name in nouns_with("hangs from a ceiling")
    is_wet = "afloat" in levels and group.noun.habitat == "water"
    if group.scene_object.height_m is not None or is_hung or is_wet:
        return False
    is_borne = group.row_m is not None and group.bearer is not None
    foot_m = max(-lowest_point(model), 0.0)  # what is let into the ground stands on it too
    return is_borne or -_ON_GROUND_M <= height_m <= foot_m + _ON_GROUND_M


def line_up(
    group: ObjectGroup,
    target: ObjectGroup,
    support: Support,
    neighbours: Sequence[int],
    reach_m: float | None = None,
) -> None:
    """Spread the copies along the longer side of the surface; several carriers share them out.

    Small things for which a row is too long stand in several. `reach_m` is the extent of one along
    that side; None: that of its longer side.
    """
    group.bearer = (target, support) if len(target.offsets) == 1 else None
    body, own, several = target.models[0], len(group.offsets), len(target.offsets)
    is_apart = group.spacing is not None and several == 1
    neighbours = [group.index] * own if is_apart else neighbours
    first = neighbours.index(group.index)
    axis = 1 if body.width > body.length else 0
    extent, deep = (support.high[one] - support.low[one] for one in (axis, 1 - axis))
    if extent <= 0.0:
        extent = 0.8 * max(body.width, body.length)
    is_person = group.noun.name in PERSON_NOUNS
    size = _PERSON_M if is_person else max(group.models[0].width, group.models[0].length)
    size = size if reach_m is None else reach_m
    count = math.ceil(len(neighbours) / several)
    rows = math.ceil(1.05 * size * count / extent) if reach_m is None and not is_person else 1
    rows = max(min(rows, int(deep / (1.05 * size))), 1)
    count = math.ceil(count / rows)
    way_m = abs(sum(span_s * speed for span_s, speed in carried_way(target)))
    widest = min(0.95 * extent / count, 1.4 * size, (extent - size - way_m) / max(count - 1, 1))
    spacing, climb = max(widest, min(1.05 * size, extent)), 0.0
    if is_person and target.noun.name in nouns_with("sat on at its ends") and count > 1:
        spacing, climb = _ENDS * body.length / (count - 1), _slope_of(body)
    yaw = target.plan.yaw + 0.5 * math.pi * axis
    group.offsets = []
    for number in range(first, first + own):
        x, y, z = target.offsets[number % several] if several > 1 else (0.0, 0.0, 0.0)
        row, place = divmod(number // several, count)
        along = spacing * (place - 0.5 * (count - 1))
        aside = 1.05 * size * (row - 0.5 * (rows - 1))
        x, y = x + along * math.cos(yaw), y + along * math.sin(yaw)
        z += climb * along
        group.offsets.append((x - aside * math.sin(yaw), y + aside * math.cos(yaw), z))
    group.row_m = spacing * (count - 1) + size
    if group.spacing is not None and is_apart:
        _keep_apart(group, target, support, group.spacing)


def _keep_apart(
    group: ObjectGroup, target: ObjectGroup, support: Support, spacing: Spacing
) -> None:
    """Put the row of a group's copies where distances have it on the support."""
    spot = spacing.place(group.index, target, support)
    group.row_m = spot.length_m
    offsets = np.array(group.offsets)
    offsets[:, :2] += spot.place - offsets[:, :2].mean(axis=0)
    group.offsets = [point(one) for one in offsets]
    if spacing.fixed:
        middle = target.to_world(*support.middle, 0.0)[:2]
        group.begins = np.asarray(middle + target.lag_m + spot.place)
        group.ends_m = spot.ends_m

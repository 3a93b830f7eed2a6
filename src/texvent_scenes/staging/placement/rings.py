"""People and animals before a thing or in a ring around it, turned to it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import size_of
from texvent_scenes.staging.placement.object_groups import ObjectGroup

STANDING_M = 0.35
"""From the edge of a thing to the middle of who stands at it, m."""
_LEGS_M, _TURNS, _RING_SHARE = 0.45, 24, 0.16
"""From the hips to the feet of who sits on the ground; turns of a ring that are compared; least
radius of a ring for each of its bodies, in their heights."""
_HANDLE_M = 0.36
"""From the middle of a door to its handle."""


def stand_before(group: ObjectGroup, target: ObjectGroup) -> Float64Array:
    """[3] the middle of a person before what opens, turned to it, beside its handle, m."""
    body, scale = target.models[0], size_of(group.models[0])
    group.plan = replace(group.plan, yaw=target.plan.yaw + math.pi)
    group.fit()
    aside = min(0.4 * body.width, _HANDLE_M) + 0.3 * scale
    return target.to_world(0.5 * body.length + 0.4 * scale, -aside, group.origin_m)


def stand_in_ring(
    group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]
) -> Float64Array:
    """[3] the middle of a ring around a target, all turned to it and none right behind it, m."""
    legs_m = _LEGS_M if "sit" in {one.kind for one in group.scene_object.motions} else 0.0
    near = np.minimum(target.half_at_rest(), target.reach_below(group.top_m))
    own, count, first = group.models[0], len(neighbours), neighbours.index(group.index)
    is_person = group.noun.name in PERSON_NOUNS
    near = near + ((STANDING_M + legs_m) * size_of(own) if is_person else 0.6 * own.length)
    near = np.maximum(near, _RING_SHARE * count * own.height)
    shares = np.arange(count) / count
    turns = 2.0 * math.pi * (shares + np.arange(_TURNS)[:, None] / (_TURNS * count))
    sides = np.sort(np.cos(turns), axis=1)
    rooms = np.hstack([np.abs(sides), np.diff(sides, axis=1)]).min(axis=1)
    angles = turns[int(np.argmax(rooms.round(6)))]
    group.offsets = [(float(near[0] * math.cos(one)), float(near[1] * math.sin(one)), 0.0)
                     for one in angles[first : first + len(group.models)]]  # fmt: skip
    group.yaws = [math.atan2(-y, -x) for x, y, _ in group.offsets]
    group.fit()
    return np.array([target.centre[0], target.centre[1], group.origin_m])

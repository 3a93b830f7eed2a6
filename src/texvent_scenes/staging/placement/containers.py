"""Things in containers: places below the rim, ways inside."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent_scenes.models.anchors import Support, find_support
from texvent_scenes.models.protocol import Model
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.staging.placement.object_groups import ObjectGroup
from texvent_scenes.staging.tracks.keys import Key, arc
from texvent_scenes.staging.tracks.phases import activity_of
from texvent_scenes.staging.tracks.track import Track, centred

_TURN_SHARE = 0.16
"""Share of the clip in which what goes to and fro in a container turns round."""
_LEAST_RING = 0.4
"""Least radius of the ring in which swimmers follow each other, in their lengths."""
SEEN_SHARE, _ALIVE_SHARE = 0.6, 0.75
"""Share of the height of what is in something that looks out of it; of an animal, whose ears reach
above its head."""


def swims(group: ObjectGroup) -> bool:
    """Whether it keeps in the midst of water: a fish, a person who swims."""
    kinds = {one.kind for one in group.scene_object.motions}
    return group.noun.habitat == "water" or "swim" in kinds


def reach_of(model: Model, count: int) -> float:
    """Extent along a row, in which several stand side by side, m."""
    sides = model.length, model.width
    return min(sides) if count > 1 else max(sides)


def hollow_of(target: ObjectGroup) -> Support:
    """The floor of a container, body coordinates, m."""
    long, wide, floor, *_ = trait_value("container", target.noun.name)
    body = target.models[0]
    half = 0.5 * long * body.length, 0.5 * wide * body.width
    return Support(floor * body.height, (-half[0], -half[1]), half)


def depth_in(group: ObjectGroup, target: ObjectGroup) -> float:
    """Height of a thing's lowest point above the foot of what it is in, m.

    It looks out of what cannot be seen into, stands on the floor of the rest, and swims above it.
    """
    body, own = target.models[0], group.models[0]
    hollow = trait_value("container", target.noun.name)
    floor_m = (hollow[2] if hollow else 0.08) * body.height
    is_open = trait_value("drawn open", target.noun.name) is not None
    if target.noun.name in nouns_with("see-through"):
        tall_m = own.height if group.noun.habitat == "water" else own.width  # who swims lies
        return 0.5 * (body.height - tall_m) if swims(group) else floor_m
    if is_open:
        return floor_m
    seen = SEEN_SHARE if group.noun.habitat == "fixed" else _ALIVE_SHARE
    return max(find_support(body).height - (1.0 - seen) * own.height, floor_m)


def go_inside(group: ObjectGroup, target: ObjectGroup, support: Support) -> None:
    """Have what goes somewhere go to and fro in the container along its longer side."""
    plan, own = group.plan, group.models[0]
    if group.noun.habitat == "water":  # one behind the other in a ring
        group.orbits, group.offsets = target, [(0.0, 0.0, 0.0)] * len(group.models)
        half_m = 0.5 * float(np.subtract(support.high, support.low).min())
        group.ring_m = max(half_m - 0.5 * own.width, _LEAST_RING * own.length)
        group.plan = replace(plan, motion=replace(plan.motion, kind="orbit"))
        return
    sides = np.subtract(support.high, support.low)
    own_m = max(own.length, own.width, own.height if swims(group) else 0.0)
    way_m = max(float(sides.max()) - 1.1 * own_m, 0.02)
    speed = way_m / (0.5 * (1.0 - _TURN_SHARE) * plan.duration_s)
    turn_s, activity = _TURN_SHARE * plan.duration_s, activity_of(plan.motion.kind)
    going = Key(way_m / speed, speed, ramp_s=0.1 * plan.duration_s, activity=activity)
    turn = [replace(key, activity=activity) for key in arc(turn_s, 0.1 * speed, math.pi, 0.0)]
    yaw = target.plan.yaw + 0.5 * math.pi * int(np.argmax(sides))
    path = Track((0.0, 0.0, 0.0), yaw, (replace(going, duration_s=0.0), going, *turn, going))
    path = centred(replace(path, radius_m=plan.radius_m), plan.duration_s)
    if len(group.models) == 1:  # before those that stay
        group.offsets = [(0.0, 0.0, 0.0)]
    group.plan = replace(plan, yaw=yaw, path=path, speed_m_s=speed)
    group.fit()

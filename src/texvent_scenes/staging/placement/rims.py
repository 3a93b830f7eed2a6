"""Ways down into what is open above: a hoop, a bin, a cup, a hole in the ground."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent_scenes.models.anchors import Rim
from texvent_scenes.models.protocol import Model
from texvent_scenes.models.tables import trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.placement.containers import SEEN_SHARE
from texvent_scenes.staging.placement.object_groups import ObjectGroup
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2, Key
from texvent_scenes.staging.tracks.phases import YAWS
from texvent_scenes.staging.tracks.track import Track, centred

_ASLANT = 0.4
"""Angle to the picture of the way to a rim that faces one side, rad."""
_FLIGHT_S, _ROLL_S = 1.0, 0.9
"""Time to a rim of what is lobbed, and of what rolls, at most; s."""
_DROP, _LEAST_DROP_M, _MOST_DROP_M = 5.0, 0.2, 0.8
"""Height above a rim from which things fall into it, in their own, and in m."""
_LOB_M, _LEAST_LOB_M, _HAND_M = 2.8, 5.0, 1.9
"""Way of what is lobbed to a high rim, m; to a low one, in sizes of the thing that has it; height
from which a high one is aimed at, m."""
_HIGH_M = 1.8
"""Height from which on a rim is high, m."""
_KEPT = 0.12
"""Share of its speed along that is left behind a rim."""
_ROOM = 0.98
"""Share of the width of a rim up to which a body goes through."""
_FALLING = ("fall", "sink")


def fits(model: Model, rim: Rim) -> bool:
    """Whether a body goes through a rim: upright, or on its side."""
    across = sorted((model.length, model.width, model.height))[1]
    return across <= _ROOM * 2.0 * rim.radius


def flight_to(start_m: float, end_m: float, duration_s: float) -> float:
    """Upward speed with which a body is at a height after that time, m/s."""
    return (end_m - start_m) / duration_s + 0.5 * GRAVITY_M_S2 * duration_s


def go_through(group: ObjectGroup, target: ObjectGroup, rim: Rim) -> Float64Array:
    """[3] the middle of a group that comes down through a rim; its plan has the path then."""
    plan, base_m = group.plan, float(target.centre[2])
    yaw = YAWS["right"] if math.cos(plan.yaw) >= 0.0 else YAWS["left"]
    if rim.x and target.scene_object.heading_deg is None:
        target.plan = replace(target.plan, yaw=yaw + math.pi + (_ASLANT if yaw else -_ASLANT))
        target.fit()
    yaw = target.plan.yaw + math.pi if rim.x else yaw
    low = -group.origin_m if group.origin_m else 0.0
    floor_m = rim.floor
    if trait_value("container", target.noun.name) is not None:
        floor_m = max(floor_m, rim.height - (1.0 - SEEN_SHARE) * group.models[0].height)
    keys, behind_m, height_m = _keys_to(group, target, rim)
    start = (-(rim.x if rim.x else 0.0) - behind_m, 0.0)
    cosine, sine = math.cos(yaw), math.sin(yaw)
    place = (start[0] * cosine, start[0] * sine, base_m + height_m)
    path = Track(place, yaw, tuple(keys), floor_m=base_m + floor_m, radius_m=plan.radius_m)
    placed = centred(path, plan.duration_s)
    group.plan = replace(plan, yaw=yaw, path=placed, gesture=None)
    group.fit()
    shift = np.subtract(place, placed.start)
    middle = np.array([*target.centre[:2], group.origin_m]) + shift
    return np.asarray(middle - [0.0, 0.0, low if low > 0.0 else 0.0])


def _keys_to(
    group: ObjectGroup, target: ObjectGroup, rim: Rim
) -> tuple[Sequence[Key], float, float]:
    """Keys of a way through a rim, and where it begins: metres before it, and height."""
    plan, own = group.plan, group.models[0]
    kind, duration_s = plan.motion.kind, plan.duration_s
    last = Key(duration_s, restitution=0.4 if rim.floor == 0.0 else 0.15, activity="stand")
    if kind in _FALLING:
        above_m = min(max(_DROP * own.height, _LEAST_DROP_M), _MOST_DROP_M)
        return [Key(0.15 * duration_s, activity="stand"), last], 0.0, rim.height + above_m
    if kind == "roll" and rim.height <= 0.0:
        going_s = min(_ROLL_S, 0.45 * duration_s)
        speed = max(0.35 * rim.radius / math.sqrt(2.0 * own.height / GRAVITY_M_S2), own.length)
        roll = Key(going_s, speed, ramp_s=going_s)
        begin = 2.0 * speed
        way_m = 0.5 * (begin + speed) * going_s
        drop = replace(last, speed_m_s=0.0, ramp_s=0.12)
        return [Key(0.0, begin), roll, drop], way_m - 0.3 * rim.radius, 0.0
    flown_s = min(_FLIGHT_S, 0.45 * duration_s)
    is_high = rim.height >= _HIGH_M
    start_m = _HAND_M if is_high else 1.6 * rim.height
    way_m = _LOB_M if is_high else _LEAST_LOB_M * max(own.length, rim.radius)
    if not is_high:
        flown_s = min(flown_s, max(math.sqrt(way_m / GRAVITY_M_S2) * 1.6, 0.25))
    speed, up = way_m / flown_s, flight_to(start_m, rim.height, flown_s)
    fly = Key(flown_s, speed, climb_m_s=up, restitution=0.0, ramp_s=0.0, activity="stand")
    after = replace(last, speed_m_s=_KEPT * speed * (rim.floor == 0.0), ramp_s=0.03,
                    climb_m_s=up - GRAVITY_M_S2 * flown_s)  # fmt: skip
    return [Key(0.0, speed), fly, after], way_m, start_m

"""Sending: what is kicked or thrown ends in a bin, a hoop or a net, which is put on its way."""

from __future__ import annotations

import math
from dataclasses import replace

from texvent_scenes.models.anchors import find_rim
from texvent_scenes.models.tables import trait_value
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2, ahead

_ABOVE_M = 0.35
"""Height above a rim that what is thrown up to it reaches, m."""
_LOB_S, _FAR_M, _NEAR_M, _LOW_NET, _NET_M, _IN_NET = 0.9, 4.5, 2.4, 0.4, 0.3, 0.25
"""Time and ways to what something is sent into, at most, the second to a rim below who throws;
share of its height at which a net is hit; from a goal's line to the net; share of the
speed that a bounce in there keeps."""


def send_into(
    thing: Actor, goal: Actor, duration_s: float, *, is_turned: bool
) -> tuple[Actor, Actor]:
    """Both, the thing flying through a rim or into a net, which is put on its way.

    Args:
        thing: what is kicked or thrown.
        goal: what it is sent into.
        duration_s: length of the clip, s.
        is_turned: whether the goal may be turned to face it.
    """
    track, level_m = thing.track, goal.track.at(0.0).position[2]
    rim, opening = find_rim(goal.noun.name, goal.model), trait_value("opening", goal.noun.name)
    sent_s = sum(key.duration_s for key in track.keys[:-1])
    flown_s = min(max(0.5 * (duration_s - sent_s), 0.3), _LOB_S)
    x, y, z = track.start
    is_near = rim is not None and level_m + rim.height < z
    if rim is not None and not is_near:  # up over the rim, and down through it
        risen_m = level_m + rim.height - thing.lift_m - z + _ABOVE_M
        flown_s = math.sqrt(2.0 * risen_m / GRAVITY_M_S2) + math.sqrt(2.0 * _ABOVE_M / GRAVITY_M_S2)
    speed = min(track.keys[-1].speed_m_s, (_NEAR_M if is_near else _FAR_M) / flown_s)
    if rim is not None:  # down through it
        way_m, met_m = speed * flown_s, level_m + rim.height
        place_m = way_m + (rim.x if rim.x else 0.0)
        floor_m = level_m + rim.floor
    else:
        way_m, met_m = speed * flown_s, level_m + _LOW_NET * goal.model.height
        place_m, floor_m = way_m - _NET_M, track.floor_m
    yaw = (
        goal.track.yaw if not (is_turned and (opening or (rim and rim.x))) else track.yaw + math.pi
    )
    put = replace(goal.track, start=ahead((x, y, level_m), track.yaw, place_m, level_m), yaw=yaw)
    up = (met_m - thing.lift_m - z) / flown_s + 0.5 * GRAVITY_M_S2 * flown_s
    fly = replace(track.keys[-1], duration_s=flown_s, speed_m_s=speed, climb_m_s=up, ramp_s=0.0)
    after = replace(fly, duration_s=1.0, speed_m_s=0.0, ramp_s=0.02, restitution=_IN_NET,
                    climb_m_s=min(up - GRAVITY_M_S2 * flown_s, 0.0))  # fmt: skip
    terms = (one._replace(end_s=sent_s + flown_s) if one.drift else one for one in track.terms)
    sent = replace(track, keys=(*track.keys[:-1], fly, after), terms=tuple(terms), floor_m=floor_m)
    return replace(thing, track=sent), replace(goal, track=put)

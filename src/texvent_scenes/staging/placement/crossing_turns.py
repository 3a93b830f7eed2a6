"""Turns of several vehicles at one crossing: each comes from another arm of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent_scenes.description import SceneDescription
from texvent_scenes.models.places import PlaceModel
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.placement.zones import zone_of
from texvent_scenes.staging.tracks.flight_keys import QUARTER
from texvent_scenes.staging.tracks.keys import Key, arc
from texvent_scenes.staging.tracks.phases import least_radius
from texvent_scenes.staging.tracks.track import Track

_LEAST_TURN = 0.9
"""Turn from which on it is one into another road, rad."""
_RAMP_S, _MOST_SHARE, _MOST_HASTE = 0.25, 0.9, 1.8
"""Time in which a wheel is turned, s; most of the clip that a quarter of a circle takes; and by how
much it may be faster than otherwise for that."""
_CUT = 0.3
"""From the middle of a vehicle to the kerb that it may come near to, in its widths."""
_LENGTHS, _GAP_M = 1.0, 3.0
"""From one vehicle to the next behind it: in their lengths, and on top of that, m."""


def part_turns(
    description: SceneDescription, place: PlaceModel, actors: Sequence[Actor]
) -> list[Actor]:
    """The actors; copies that turn into another road come from several arms of one crossing.

    Those that turn to their right do so from all four at once; others follow one behind the other.
    """
    found = [*actors]
    for index, said in enumerate(description.objects):
        numbers = [n for n, one in enumerate(actors) if one.object_index == index]
        first = found[numbers[0]] if numbers else None
        if first is None or not place.has_road or said.position_m is not None:
            continue
        if len(numbers) < 2 or not _turns_off(first):
            continue
        first = replace(first, track=_squared(first))
        is_open = said.motions[0].direction is None
        tracks = _list_tracks(first, len(numbers), 0.5 * place.road_m, is_open=is_open)
        for number, track in zip(numbers, tracks, strict=True):
            found[number] = replace(found[number], track=track)
    return found


def _turns_off(one: Actor) -> bool:
    """Whether a vehicle of the road turns from one road into another, by itself."""
    track = one.track
    if zone_of(one.noun) != "road" or track.anchor is not None or track.terms:
        return False
    turn = abs(track.at(track.duration_s).yaw - track.at(0.0).yaw)
    is_going = not track.keys[0].duration_s and track.keys[0].speed_m_s > 0.0
    return is_going and _LEAST_TURN < turn < QUARTER + _LEAST_TURN


def _squared(one: Actor) -> Track:
    """Its track with a turn by a right angle, which leads into a road at right angles."""
    track, first = one.track, one.track.keys[0]
    turn = math.copysign(QUARTER, track.at(track.duration_s).yaw - track.yaw)
    radius_m = max(least_radius(one.model, one.noun), 0.5 * one.model.length)
    most_s = _MOST_SHARE * track.duration_s
    fast = QUARTER * radius_m / (most_s - _RAMP_S)
    speed = min(max(first.speed_m_s, fast), _MOST_HASTE * first.speed_m_s)
    span_s = QUARTER * radius_m / speed + _RAMP_S
    lead_s = 0.5 * max(track.duration_s - span_s, 0.0)
    straight = Key(lead_s, speed, ramp_s=0.0, activity=first.activity)
    turning = [replace(key, activity=first.activity) for key in arc(span_s, speed, turn, radius_m)]
    return replace(track, keys=(replace(first, speed_m_s=speed), straight, *turning, straight))


def _list_tracks(one: Actor, count: int, lane_m: float, *, is_open: bool) -> list[Track]:
    """Tracks of so many copies about one crossing."""
    right = _turned_right(one.track)
    is_right = right is one.track or (is_open and _keeps_to_road(one, right, lane_m))
    track = right if is_right else one.track
    middle, arms = _find_crossing(track, lane_m), (0, 2, 1, 3) if is_right else (0,)
    found = []
    for number in range(count):
        behind_m = (number // len(arms)) * (_LENGTHS * one.model.length + _GAP_M)
        late = _started_behind(track, behind_m)
        found.append(_turned_about(late, middle, arms[number % len(arms)] * QUARTER))
    return found


def _turned_right(track: Track) -> Track:
    """The track itself if it turns to the right, else its mirror image about its first heading."""
    if track.at(track.duration_s).yaw < track.at(0.0).yaw:
        return track
    return replace(track, keys=tuple(replace(k, turn_rad_s=-k.turn_rad_s) for k in track.keys))


def _keeps_to_road(one: Actor, track: Track, lane_m: float) -> bool:
    """Whether a vehicle does not cut the corner of two roads, each two lanes to a side."""
    middle, times = _find_crossing(track, lane_m), np.linspace(0.0, track.duration_s, 25)
    spots = np.array([track.at(float(time)).position[:2] for time in times]) - middle
    yaw = track.yaw
    along = spots @ [math.cos(yaw), math.sin(yaw)]
    across = spots @ [-math.sin(yaw), math.cos(yaw)]
    off = np.minimum(np.abs(along), np.abs(across)) + _CUT * one.model.width
    return bool((off <= 2.0 * lane_m).all())


def _find_crossing(track: Track, lane_m: float) -> Float64Array:
    """[2] where the middles of both roads cross, each a lane to the left of the way along it, m."""
    ends = [track.at(time) for time in (0.0, track.duration_s)]
    left = [np.array([-math.sin(one.yaw), math.cos(one.yaw)]) for one in ends]
    offsets = [float(np.array(one.position[:2]) @ way) + lane_m
               for one, way in zip(ends, left, strict=True)]  # fmt: skip
    return np.asarray(np.linalg.solve(np.array(left), np.array(offsets)))


def _started_behind(track: Track, behind_m: float) -> Track:
    """The track of one that comes the same way, so much later."""
    first, *others = track.keys
    if behind_m == 0.0 or first.speed_m_s <= 0.0:
        return track
    lead = Key(behind_m / first.speed_m_s, first.speed_m_s, ramp_s=0.0, activity=first.activity)
    x, y, z = track.start
    start = (x - behind_m * math.cos(track.yaw), y - behind_m * math.sin(track.yaw), z)
    return replace(track, start=start, keys=(first, lead, *others))


def _turned_about(track: Track, middle: Float64Array, angle: float) -> Track:
    """The track, turned about the middle of a crossing."""
    x, y = np.array(track.start[:2]) - middle
    cosine, sine = math.cos(angle), math.sin(angle)
    place = middle + np.array([cosine * x - sine * y, sine * x + cosine * y])
    start = (float(place[0]), float(place[1]), track.start[2])
    return replace(track, start=start, yaw=track.yaw + angle)

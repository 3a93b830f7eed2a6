"""Rally: two players who hit a ball to and fro over a net, each once in a stroke of both."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from texvent_scenes.description import IndexedRelation, SceneDescription
from texvent_scenes.models.activities import ACTIVITIES, Activity
from texvent_scenes.models.anchors import find_support
from texvent_scenes.models.shapes import point
from texvent_scenes.models.tables import trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor, size_of
from texvent_scenes.staging.interactions.holding import moving
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2, Key
from texvent_scenes.staging.tracks.track import Track, steady

PERIOD_S = 1.7
"""From one stroke of a player to the next: that of their activity."""
_LEAD_M = 0.5 * PERIOD_S / 0.37
"""Head start of the second player, m, by which half a period has gone (`Actor.pose`)."""
_NONE = Activity()
_MOST_KEPT = 0.88
"""Share of its upward speed that a bounce keeps, at most."""
_FLIGHTS, _LEAST_M = 40, 0.1
"""Flights of a ball that are told apart; least height above what it bounces on where it is hit, m.
"""


def play(cast: dict[int, Actor], act: IndexedRelation, description: SceneDescription) -> None:
    """Put players, ball and net where they play; a net or a table stays where it is."""
    said = [one.kind for one in description.objects[act.subject].motions]
    activity = next((one for one in said if ACTIVITIES.get(one, _NONE).reach_m), "net rally")
    who = {one.subject for one in description.relations
           if (one.kind, one.targets) == (act.kind, act.targets)}  # fmt: skip
    players = [n for n, one in cast.items() if one.object_index in who]
    others = {one.noun.name: n for n, one in cast.items() if one.object_index in act.targets}
    court = next((n for name, n in others.items() if trait_value("rally", name)), None)
    ball = next((n for name, n in others.items() if n != court), None)
    if len(players) < 2 or court is None or ball is None:
        return
    row: Mapping[str, float] = trait_value("rally", cast[court].noun.name)
    x, y, z = cast[court].track.at(0.0).position
    cast[court] = moving(cast[court], steady((x, y, z), row["turn"], activity="stand"))
    for number, side in zip(players[:2], (-1.0, 1.0), strict=True):
        one = cast[number]
        place = (x + side * row["from"], y, one.track.at(0.0).position[2])
        yaw = 0.0 if side < 0.0 else math.pi
        props = one.props
        one = moving(one, steady(place, yaw, activity=activity))
        cast[number] = replace(one, lead_m=_LEAD_M if side > 0.0 else 0.0, props=props)
    first, second = (cast[number] for number in players[:2])
    begin_s = ACTIVITIES[activity].contact_s or 0.5 * PERIOD_S
    ends = [_hit(first, begin_s, activity), _hit(second, begin_s + 0.5 * PERIOD_S, activity)]
    thing = cast[ball]
    low_m = z + (find_support(cast[court].model).height if row["bounces"] else 0.0)
    cast[ball] = moving(thing, _fly(thing, ends, low_m, begin_s, bounces=bool(row["bounces"])))


def _hit(player: Actor, time_s: float, activity: str) -> Float64Array:
    """[3] where what a player swings meets the ball, m."""
    reach_m = ACTIVITIES[activity].reach_m * size_of(player.model)
    return np.asarray(player.anchor("right hand", time_s) @ [0.0, 0.0, reach_m, 1.0])


def _fly(
    ball: Actor, ends: list[Float64Array], low_m: float, begin_s: float, *, bounces: bool
) -> Track:
    """To and fro between both ends, from the flight that has begun before the clip."""
    half_s, floor_m = 0.5 * PERIOD_S, low_m + ball.foot_m
    places = [end - [0.0, 0.0, ball.lift_m] for end in ends]
    for place in places:  # a child reaches over a table
        place[2] = max(float(place[2]), floor_m + _LEAST_M)
    way = (places[1] - places[0])[:2]
    speed = float(np.linalg.norm(way)) / half_s
    keys = []
    number = -1 if begin_s < half_s else -2
    for flight in range(number, _FLIGHTS):
        start, end = (places[(flight + step) % 2] for step in (0, 1))
        sign = 1.0 if flight % 2 == 0 else -1.0
        up, kept = _arc(float(start[2]) - floor_m, float(end[2]) - floor_m, half_s, bounces=bounces)
        keys.append(Key(half_s, sign * speed, climb_m_s=up, restitution=kept, ramp_s=0.0))
    first = places[number % 2]
    late_s = -(begin_s + number * half_s)
    yaw = math.atan2(float(way[1]), float(way[0]))
    track = Track(point(first), yaw, tuple(keys), floor_m=floor_m)
    return _later(track, late_s)


def _later(track: Track, by_s: float) -> Track:
    """The track from so much later on: its first flight is shorter."""
    at = track.at(by_s)
    rise = (track.at(by_s + 1e-4).position[2] - at.position[2]) / 1e-4
    first, *rest = track.keys
    rest_s = max(first.duration_s - by_s, 1e-3)
    cut = replace(first, duration_s=rest_s, climb_m_s=rise)
    return replace(track, start=at.position, keys=(cut, *rest))


def _arc(from_m: float, to_m: float, flown_s: float, *, bounces: bool) -> tuple[float, float]:
    """Upward speed and share of it that the bounce keeps, between two heights above the floor."""
    if not bounces:
        return 0.5 * GRAVITY_M_S2 * flown_s + (to_m - from_m) / flown_s, 0.0
    for share in np.linspace(0.4, 0.9, 51):
        down_s = float(share) * flown_s
        after_s = flown_s - down_s
        up = 0.5 * GRAVITY_M_S2 * down_s - from_m / down_s
        kept = (to_m + 0.5 * GRAVITY_M_S2 * after_s**2) / (after_s * (GRAVITY_M_S2 * down_s - up))
        if kept <= _MOST_KEPT:
            return up, kept
    return up, _MOST_KEPT

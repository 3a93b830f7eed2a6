"""Followers: those whose leader turns go along its way, not beside it at the same times."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import fields, replace

import numpy as np

from texvent_scenes.description import SceneDescription
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.tracks.track import Track
from texvent_scenes.staging.tracks.trail import Trail, trace

_BEND_RAD, _BACK_RAD = 0.15, 2.6
"""Turn of a leader from which on its way bends, and from which on it comes back."""
_LEAST_STEP_M = 0.02
"""Length of the steps between which its way is looked at."""
_AS_FAST = 0.05
"""Most difference of ways, as a share, of who goes as fast as its leader."""


def follow_ways(
    description: SceneDescription, actors: Sequence[Actor], duration_s: float
) -> list[Actor]:
    """The actors, of which those that follow another one go along its way.

    A leader that turns back leads who follows as it did: they turn together.
    """
    found = list(actors)
    pending = [one for one in description.relations if one.kind == "follow"]
    while pending:
        waiting = {one.subject for one in pending}
        ready = [one for one in pending if one.targets[0] not in waiting] or pending[:1]
        for one in ready:
            pending.remove(one)
            leaders = [each for each in found if each.object_index == one.targets[0]]
            for number, each in enumerate(found):
                if each.object_index == one.subject and leaders:
                    found[number] = _led_by(each, leaders, duration_s)
    return found


def _apart_m(one: Actor, other: Actor) -> float:
    return math.dist(one.track.at(0.0).position[:2], other.track.at(0.0).position[:2])


def _led_by(one: Actor, leaders: Sequence[Actor], duration_s: float) -> Actor:
    """A follower behind the nearest of its leaders, on its way if that bends."""
    leader = min(leaders, key=lambda led: _apart_m(one, led))
    is_free = one.track.anchor is None and not one.track.is_resting
    _, gone, places = trace(leader.track, duration_s)
    turns = _list_turns(places[:, :2])
    if not is_free or not len(turns) or np.abs(turns).max() > _BACK_RAD:
        return one
    start = np.array(one.track.at(0.0).position[:2])
    off = places[0, :2] - start
    first = places[int(np.searchsorted(gone, _LEAST_STEP_M)), :2] - places[0, :2]
    is_behind = off @ first > 0.0
    is_bent = np.abs(np.cumsum(turns)).max() > _BEND_RAD or isinstance(leader.track, Trail)
    if not (is_behind and is_bent):
        return one
    whole = one.track.at(duration_s).distance_m, float(gone[round((len(gone) - 1) / 1.05)])
    is_as_fast = abs(whole[0] - whole[1]) <= _AS_FAST * max(whole)
    room_m = float(np.linalg.norm(off)) - 0.5 * (one.model.length + leader.model.length)
    values = {each.name: getattr(one.track, each.name) for each in fields(Track)}
    trail = Trail(
        **values, leader=leader.track, span_s=duration_s, length_m=one.model.length,
        is_aloft=one.noun.habitat == leader.noun.habitat == "air",
        most_m=None if is_as_fast else max(room_m, 0.0),
    )  # fmt: skip
    return replace(one, track=trail)


def _list_turns(places: np.ndarray) -> np.ndarray:
    """Turns between steps of a way [n, 2] over the ground, rad."""
    kept = [places[0]]
    for place in places[1:]:
        if math.dist(place, kept[-1]) >= _LEAST_STEP_M:
            kept.append(place)
    steps = np.diff(kept, axis=0)
    if len(steps) < 2:
        return np.zeros(0)
    headings = np.arctan2(steps[:, 1], steps[:, 0])
    return np.asarray((np.diff(headings) + math.pi) % (2.0 * math.pi) - math.pi)

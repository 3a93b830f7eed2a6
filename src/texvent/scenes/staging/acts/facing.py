"""Who turns to whom: two who do something together, who looks at something, who climbs it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.description import Relation
from texvent.scenes.models.people.activities import PAIR_GAPS
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import Cast, is_person, size_of
from texvent.scenes.staging.body_boxes import part_boxes
from texvent.scenes.staging.trajectories.steered_path import Piece, SteeredPath
from texvent.scenes.staging.trajectories.trajectory import Stationary, ahead

_TIED = frozenset({"at", "on", "in", "ride", "ride along", "push", "pull"})
"""Relations that give their subject its heading."""
_REACH_M, _START_M, _CLIMB_M_S, _BELOW_TOP_M = 0.27, 0.12, 0.45, 1.2
"""From the middle of a climber to what the hands hold, height and speed at the start, and how far
below the top a climber stops, for an adult."""


def face_each_other(cast: Cast, numbers: Sequence[int]) -> None:
    """What two people do together they do before each other.

    Args:
        cast: the actors; those of pairs are replaced.
        numbers: positions of the actors that no other act moves.
    """
    waiting: dict[str, int] = {}
    for number in numbers:
        actor = cast.get(number)
        path = actor.trajectory
        if not isinstance(path, Stationary) or not is_person(actor):
            continue
        apart_m = PAIR_GAPS.get(path.activity)
        if apart_m is None:
            continue
        first = waiting.pop(path.activity, None)
        if first is None:
            waiting[path.activity] = number
            continue
        one, other = _face(cast.get(first), actor, apart_m)
        cast.put(first, one)
        cast.put(number, other)


def _face(one: Actor, other: Actor, apart_m: float) -> tuple[Actor, Actor]:
    """Left and right of the middle between them, as they are placed; fronts to each other."""
    places = [np.array(actor.trajectory.at(0.0).position) for actor in (one, other)]
    x, y, z = (float(value) for value in 0.5 * (places[0] + places[1]))
    half = 0.25 * apart_m * (size_of(one.model) + size_of(other.model))
    is_left = places[0][0] <= places[1][0]
    pair = []
    for actor, is_first in ((one, True), (other, False)):
        yaw = 0.0 if is_first == is_left else math.pi
        path = actor.trajectory
        if isinstance(path, Stationary):
            path = replace(path, home=ahead((x, y, z), yaw, -half, z), yaw=yaw)
        pair.append(replace(actor, trajectory=path, lead_m=0.0, is_mover=True))
    return pair[0], pair[1]


def look_at(cast: Cast, relations: Sequence[Relation], duration_s: float) -> None:
    """Who stays in its place turns to what it looks at, where that is at mid clip.

    Args:
        cast: the actors, as they are placed; those who look are replaced.
        relations: of the scene.
        duration_s: length of the clip, s.
    """
    tied = {one.subject for one in relations if one.kind in _TIED}
    for relation in relations:
        is_facing = relation.kind == "look at" or relation.way == "opposite"
        goals = [number for target in relation.targets for number in cast.copies(target)]
        if not is_facing or relation.subject in tied or not goals:
            continue
        if relation.targets == (relation.subject,):
            goals = goals[1:] + goals[:1]
        for turn, number in enumerate(cast.copies(relation.subject)):
            goal = goals[turn % len(goals)]
            x, y, _ = cast.get(number).trajectory.at(0.0).position
            to = cast.get(goal).middle(0.5 * duration_s)
            yaw = math.atan2(to[1] - y, to[0] - x)
            _turn(cast, number, yaw)
            if relation.way == "opposite" and cast.get(goal).noun.habitat == "ground":
                _turn(cast, goal, yaw + math.pi)


def _turn(cast: Cast, number: int, yaw: float) -> None:
    actor, path = cast.get(number), cast.get(number).trajectory
    if isinstance(path, Stationary):
        cast.put(number, replace(actor, trajectory=replace(path, yaw=yaw)))


def climb_all(cast: Cast, relations: Sequence[Relation]) -> None:
    """Who climbs and is on or at a thing goes up its side."""
    for relation in relations:
        things = cast.copies(relation.targets[0])
        if relation.kind not in ("on", "at") or not things:
            continue
        for number in cast.copies(relation.subject):
            actor, thing = cast.get(number), cast.get(things[0])
            if actor.trajectory.at(0.0).activity == "climb" and not thing.is_mover:
                cast.put(number, _climb(actor, thing))


def _climb(subject: Actor, target: Actor) -> Actor:
    """Up the left side of a thing that stays: a ladder, a tree."""
    boxes, size = part_boxes(target, 0.0), size_of(subject.model)
    low, high = boxes.hull

    def side(height_m: float) -> float:
        level = (boxes.low[:, 2] <= height_m) & (boxes.high[:, 2] >= height_m)
        return float(boxes.low[level, 0].min()) if level.any() else float(low[0])

    first, second = side(1.4 * size), side(2.0 * size)
    slope = min(max((second - first) / (0.6 * size), 0.0), 0.8)
    rise_s = max(float(high[2]) - _BELOW_TOP_M * size - _START_M, 0.0) / _CLIMB_M_S
    pieces = (
        Piece(rise_s + 1e-3, slope * _CLIMB_M_S, climb_m_s=_CLIMB_M_S, activity="climb"),
        Piece(0.1, activity="climb"),
    )
    start = (first - _REACH_M * size, float(0.5 * (low[1] + high[1])), _START_M)
    # It stays upright however steep its way is.
    path = SteeredPath(start, 0.0, pieces, slope * _CLIMB_M_S, usual_speed_m_s=math.inf)
    return replace(subject, trajectory=path, is_mover=True, lead_m=0.0)

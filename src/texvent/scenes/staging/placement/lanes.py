"""Traffic: vehicles that drive both ways queue in the two lanes of a road."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import cast

from texvent.scenes.description import CREEPING_M_S
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.trajectories.trajectory import Straight

FEWEST = 4
"""Vehicles from which on they are traffic."""
GAP = 0.55
"""Gap behind a vehicle, in its lengths."""


def queue_in_lanes(actors: Sequence[Actor], lane_m: float) -> list[Actor]:
    """The actors, with vehicles that drive both ways one behind the other, on the right.

    Args:
        actors: all objects.
        lane_m: from the centre line of the road, y = 0, to the middle of a lane.
    """
    lanes = find_lanes(actors)
    if not all(lanes) or sum(map(len, lanes)) < FEWEST:
        return list(actors)
    moved: dict[int, Actor] = {}
    for queue, way in zip(lanes, (1.0, -1.0), strict=True):
        lane = _amid_jam(queue)
        ends = [0.0]
        for one in lane:
            ends.append(ends[-1] + one.model.length * (1.0 + GAP))
        speed = max(_path(one).speed_m_s for one in lane)
        for one, start in zip(lane, ends, strict=False):
            x = way * (0.5 * ends[-1] - start - 0.5 * one.model.length)
            path = replace(_path(one), home=(x, -way * lane_m, 0.0), speed_m_s=speed)
            moved[one.instance] = replace(one, trajectory=path)
    return [moved.get(one.instance, one) for one in actors]


def _amid_jam(lane: Sequence[Actor]) -> list[Actor]:
    """A lane whose first vehicle has others before and behind it, if they hardly move.

    What is smaller stays at the head of its lane, where nothing hides it.
    """
    first, *others = lane
    is_small = bool(others) and first.model.length < others[0].model.length
    if is_small or _path(first).speed_m_s > CREEPING_M_S:
        return list(lane)
    half = (len(others) + 1) // 2
    return [*others[:half], first, *others[half:]]


def find_lanes(actors: Sequence[Actor]) -> tuple[list[Actor], list[Actor]]:
    """Vehicles that drive straight to the right in the picture, and to the left."""
    drivers = [
        one
        for one in actors
        if one.noun.motion == "drive" and one.is_mover and isinstance(one.trajectory, Straight)
    ]
    ways = [math.cos(_path(one).yaw) for one in drivers]
    rightward = [one for one, way in zip(drivers, ways, strict=True) if way > 0.9]
    leftward = [one for one, way in zip(drivers, ways, strict=True) if way < -0.9]
    return rightward, leftward


def _path(one: Actor) -> Straight:
    return cast("Straight", one.trajectory)

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
        first, *others = queue
        is_jam = bool(others) and _path(first).speed_m_s <= CREEPING_M_S
        half = (len(others) + 1) // 2 if is_jam else 0  # amid a jam
        lane = [*others[:half], first, *others[half:]]
        rooms = [one.model.length * (1.0 + GAP) for one in lane]
        speed, end = max(_path(one).speed_m_s for one in lane), 0.5 * sum(rooms)
        for one, room in zip(lane, rooms, strict=True):
            x = way * (end - 0.5 * one.model.length)
            path = replace(_path(one), home=(x, -way * lane_m, 0.0), speed_m_s=speed)
            moved[one.instance] = replace(one, trajectory=path)
            end -= room
    return [moved.get(one.instance, one) for one in actors]


def find_lanes(actors: Sequence[Actor]) -> tuple[list[Actor], list[Actor]]:
    """Vehicles that drive straight to the right in the picture, and to the left."""
    drivers = [
        one
        for one in actors
        if one.noun.motion == "drive" and one.is_mover and isinstance(one.trajectory, Straight)
    ]
    rightward = [one for one in drivers if math.cos(_path(one).yaw) > 0.9]
    leftward = [one for one in drivers if math.cos(_path(one).yaw) < -0.9]
    return rightward, leftward


def _path(one: Actor) -> Straight:
    return cast("Straight", one.trajectory)

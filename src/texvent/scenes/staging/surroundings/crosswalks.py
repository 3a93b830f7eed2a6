"""Crosswalks lie on the road, their stripes side by side across it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import SceneDescription
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.surroundings.road_choice import find_road
from texvent.scenes.staging.trajectories.trajectory import Stationary

_AHEAD_M = 0.6
"""Between a vehicle and the stripes before it."""


def lay_crosswalks(
    description: SceneDescription, actors: Sequence[Actor], half_m: float, duration_s: float
) -> list[Actor]:
    """The actors, with each crosswalk on the road: before a vehicle, or under who crosses there.

    Args:
        description: what the prompt says.
        actors: all objects.
        half_m: from the centre line of the road to its edge.
        duration_s: of the clip, s.
    """
    stripes = [one for one in actors if one.noun.name == "crosswalk"]
    others = [one for one in actors if one.noun.name != "crosswalk" and one.noun.habitat != "air"]
    if not stripes or not others:
        return list(actors)
    related = {
        one for relation in description.relations for one in (relation.subject, *relation.targets)
    }
    others.sort(key=lambda one: (one.noun.motion != "drive", one.object_index not in related))
    goal = others[0]
    road = find_road(others, 0.0, 0.5 * half_m)
    state = goal.trajectory.at(duration_s)
    x, y, _ = state.position
    if goal.noun.motion == "drive":
        ahead = 0.5 * (goal.model.length + stripes[0].model.width) + _AHEAD_M
        x, y = x + ahead * math.cos(state.yaw), y + ahead * math.sin(state.yaw)
    elif goal.is_mover:
        x, y = road.offset
    dx, dy = x - road.offset[0], y - road.offset[1]
    along = dx * math.cos(road.angle) + dy * math.sin(road.angle)
    x, y, angle = road.at(along)
    moved = {
        one.instance: replace(one, trajectory=Stationary((x, y, 0.0), angle + 0.5 * math.pi))
        for one in stripes[:1]
    }
    return [moved.get(one.instance, one) for one in actors]

"""Who goes from a shore into the water sinks in up to the middle; who comes out rises."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.scenes.staging.surroundings.waterside import WATERSIDE
from texvent.scenes.staging.trajectories.trajectory import BodyState, Trajectory

_DEPTH_SHARE = 0.4
"""Share of the height of a body that is under water at most."""
_DEPTH_OF_BIRDS = 0.1
"""The same of birds, as high as their spread wings reach."""
_OVER_SHORE = ("into", "out of")


@dataclass(frozen=True)
class Wading:
    """A path over a shore, lower the farther it is in the water."""

    path: Trajectory
    line: RoadLine
    """With the water on its left."""
    start_m: float
    """Where the water begins, from the line to its left."""
    depth_m: float
    """How far it sinks at most."""
    reach_m: float
    """Distance from the shore at which it has sunk."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        state = self.path.at(time_s)
        x, y, z = state.position
        over = (self.line.across(np.array([x, y])) - self.start_m) / self.reach_m
        share = min(max(over, 0.0), 1.0)
        sunk = self.depth_m * share * share * (3.0 - 2.0 * share)
        return replace(state, position=(x, y, z - sunk))


def goes_over_shore(description: SceneDescription) -> bool:
    """Whether anyone goes into the water of the place or comes out of it."""
    return any(
        motion is not None and motion.shore in _OVER_SHORE
        for one in description.objects
        for motion in (one.motion, *one.then)
    )


def list_waders(description: SceneDescription) -> frozenset[int]:
    """Indices of the objects that stand or go about in the water of the place."""
    return frozenset(
        index
        for index, one in enumerate(description.objects)
        if one.motion is not None and one.motion.shore == "in"
    )


_ON_BOARDS = frozenset({"skate", "surf"})
"""Postures of who stands on a board, which floats."""


def find_water(place: str, half_width_m: float) -> float:
    """Where the water begins, from the line of `water_line` to its left, m."""
    return -half_width_m if place == "river" else 0.0


def wade(
    description: SceneDescription,
    actors: Sequence[Actor],
    place: str,
    line: RoadLine,
    half_width_m: float,
) -> list[Actor]:
    """The actors, of whom those sink in who go over the shore.

    Args:
        description: what they do.
        actors: on their paths over the ground.
        place: where they are; nothing is changed where it has no shore.
        line: from `water_line`.
        half_width_m: of a river.
    """
    if place not in WATERSIDE:
        return list(actors)
    start_m = find_water(place, half_width_m)
    found = []
    for actor in actors:
        one = description.objects[actor.object_index]
        ways = {motion.shore for motion in (one.motion, *one.then) if motion is not None}
        is_on_board = actor.trajectory.at(0.0).activity in _ON_BOARDS
        if ways & {*_OVER_SHORE, "in"} and not is_on_board:
            share = _DEPTH_OF_BIRDS if actor.noun.habitat == "air" else _DEPTH_SHARE
            depth, reach = share * actor.model.height, 0.5 * actor.size_m
            path = Wading(actor.trajectory, line, start_m, depth, reach)
            actor = replace(actor, trajectory=path)
        found.append(actor)
    return found

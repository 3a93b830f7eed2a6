"""Where the top of a thing ends, and how high it is along a line."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from texvent.scenes.models.support_surface import find_support, top_heights
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor, lowest_point
from texvent.scenes.staging.body_boxes import own_parts, part_boxes
from texvent.scenes.staging.trajectories.trajectory import Vector

_LEVEL_M, _LEVEL_SHARE = 0.04, 0.06
"""How uneven a level top may be: metres, and share of the thing's height."""
_SAMPLES = 161


class Top(NamedTuple):
    """The top of a thing along a heading."""

    middle: Float64Array
    """[3] where it is measured from, m."""
    edge_m: float
    """How far ahead of there it ends."""
    side_m: float
    """How far ahead of there the whole thing ends."""


def rest_height(subject: Actor) -> float:
    """Height of a body's origin above what it stands on, m."""
    return -lowest_point(subject.model) if subject.is_centred else 0.0


def half_along(subject: Actor) -> float:
    """Half of a body's length, m."""
    return 0.5 * subject.model.length


def heights_along(target: Actor, spots: Float64Array) -> Float64Array:
    """[n] heights of an upright thing's highest surface over ground points [n, 2], m."""
    to_world = target.trajectory.at(0.0).to_world()
    flat = np.column_stack([spots, np.zeros(len(spots))]) - to_world[:, 3]
    own = flat @ to_world[:, :3]
    return np.asarray(top_heights(own_parts(target, 0.0), own[:, 0], own[:, 1]) + to_world[2, 3])


def find_top(target: Actor, yaw: float) -> Top:
    """The supporting surface of a thing that stands upright, along a heading."""
    support = find_support(target.model)
    to_world = target.trajectory.at(0.0).to_world()
    middle = to_world @ np.array([*support.middle, support.height, 1.0])
    low, high = part_boxes(target, 0.0).hull
    heading = np.array([math.cos(yaw), math.sin(yaw)])
    reach = float(np.abs(heading) @ (high - low)[:2])
    steps = np.linspace(0.0, reach, _SAMPLES)
    tops = heights_along(target, middle[:2] + steps[:, None] * heading)
    level = np.abs(tops - middle[2]) < _LEVEL_M + _LEVEL_SHARE * target.model.height
    off = np.flatnonzero(~level)
    edge = float(steps[off[0] - 1]) if len(off) and off[0] > 0 else 0.0
    side = float(steps[np.flatnonzero(np.isfinite(tops))[-1]]) if np.isfinite(tops).any() else edge
    return Top(middle, edge, max(side, edge))


def height_at(target: Actor, top: Top, yaw: float, along_m: float) -> float:
    """Height of the top so far ahead of its middle, m."""
    spot = np.array(ahead_of(top.middle, yaw, along_m, 0.0)[:2])
    found = float(heights_along(target, spot[None])[0])
    return found if math.isfinite(found) else float(top.middle[2])


def ahead_of(place: Float64Array, yaw: float, along_m: float, height_m: float) -> Vector:
    """The point so far along a heading, at a height, m."""
    x, y = place[0] + along_m * math.cos(yaw), place[1] + along_m * math.sin(yaw)
    return (float(x), float(y), float(height_m))

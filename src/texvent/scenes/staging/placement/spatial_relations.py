"""Relations as positions: on, under, between, beside, past, behind and so on.

Each is a place beside the box of what is placed already, and a direction to look for room in.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from texvent.scenes.description import Relation
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.shapes import bounds
from texvent.scenes.models.tables import nouns_with
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.placement.object_groups import GAP_M, ObjectGroup, stand_in_ring
from texvent.scenes.staging.placement.resting import place_at, rest_in, rest_on
from texvent.scenes.staging.trajectories.phases import PATH_KINDS
from texvent.scenes.staging.trajectories.trajectory import Circle, Trajectory


class Goal(NamedTuple):
    """Where a group should be."""

    position: Float64Array
    """[3] middle of the group, m."""
    slide: Float64Array
    """[3] direction in which it may move from there to find room; zero = it stays."""


ON_TARGET = frozenset({"at", "on", "in", "above", "around", "under", "between", "follow"})
"""Relations in which the subject's place follows from the target's; in the others the target's
follows from the subject's."""
INVERSE: Mapping[str, str] = {
    "behind": "front", "front": "behind", "left of": "right of", "right of": "left of",
    "beside": "beside",
}  # fmt: skip
"""Relation of a subject to its target → that of the target to the subject."""
_FIXED, _AWAY, _ALONG_X = np.zeros(3), np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])
_SIDES = {"left of": (-1.0, 0.0), "right of": (1.0, 0.0), "behind": (0.0, 1.0),
          "front": (0.0, -1.0), "beside": (1.0, 0.0)}  # fmt: skip
"""Relation with a distance → where its subject is, seen from the target, on the ground."""
_COVERED = 0.55
"""Share of what stands behind that may be hidden where it stands right behind."""
_ASIDE_RAD, _CLEAR_M = 0.25, 0.3
"""How far the camera may see past an edge, and room beside what one passes."""


def place_on_targets(
    group: ObjectGroup,
    kind: str,
    targets: Sequence[ObjectGroup],
    height: float,
    neighbours: Sequence[int],
) -> Goal:
    """A subject's position with respect to objects that are placed already, by one of `ON_TARGET`.

    What it does may change: it rides, orbits or jumps over the target. `height` is that of its
    origin where the relation does not decide it, m; `neighbours` are as for `rest_on`.
    """
    if kind == "at" and targets[0].noun.name not in nouns_with("table"):
        return place_by_subject(group, "beside", targets[0], height)
    rest = {"on": rest_on, "in": rest_in, "at": place_at}.get(kind)
    if rest is not None:
        return Goal(rest(group, targets[0], neighbours), _FIXED)
    return _PLACE_BY_KIND[kind](group, targets, height)


def _place_around(group: ObjectGroup, targets: Sequence[ObjectGroup], height: float) -> Goal:
    """What moves circles its target; what stays stands in a ring and faces it."""
    target, own = targets[0], group.models[0]
    x, y, level = target.centre
    if group.plan.motion.kind not in PATH_KINDS | {"orbit", "spin"}:
        within = float(max(target.half_at_rest()[:2]))
        wide = 0.5 * len(group.models) * 1.15 * own.width / math.pi
        stand_in_ring(group, max(within + 0.6 * own.length + 0.1, wide))
        group.fit()
        return Goal(np.array([x, y, height]), _FIXED)
    group.orbits = target
    level += 0.8 * target.top_m if group.noun.habitat == "air" else 0.0
    return Goal(np.array([x, y, max(level, 0.0)]), _FIXED)


def _place_above(group: ObjectGroup, targets: Sequence[ObjectGroup], height: float) -> Goal:
    target, own = targets[0], group.models[0].height
    if group.plan.motion.kind == "jump":
        group.clear_m = min(target.top_m, 2.0 * own)
        return Goal(_on_ground(target, 0.0), _FIXED)
    clear = target.top_m + 0.7 * own + _CLEAR_M + (0.5 * own if is_centred(group.noun) else 0.0)
    return Goal(target.centre + np.array([0.0, 0.0, max(clear, height)]), _FIXED)


def _place_under(group: ObjectGroup, targets: Sequence[ObjectGroup], height: float) -> Goal:
    """Before what holds its target up in its middle, or beside one that is too low for it."""
    if height + group.models[0].height > targets[0].top_m:
        beside = targets[0].half[0] + group.half[0] + _CLEAR_M
        return Goal(_shift(_on_ground(targets[0], height), beside, 0.0), _ALONG_X)
    nearer = 0.4 * float(targets[0].half[1])
    return Goal(_shift(_on_ground(targets[0], height), 0.0, -nearer), _FIXED)


def _place_between(group: ObjectGroup, targets: Sequence[ObjectGroup], height: float) -> Goal:
    """In the middle, where `object_placement` has left room between them."""
    x, y, _ = np.mean([target.centre for target in targets], axis=0)
    return Goal(np.array([x, y, height]), _FIXED if len(targets) == 1 else -_AWAY)


def _place_follower(group: ObjectGroup, targets: Sequence[ObjectGroup], height: float) -> Goal:
    """Behind its target, on the same path."""
    target, own = targets[0], group.models[0]
    reach = 0.5 * (target.models[0].length + own.length)
    group.half = 0.5 * np.array([own.length, own.width, own.height])
    return Goal(target.to_world(-1.6 * reach - 0.4, 0.0, height - target.centre[2]), _FIXED)


_PLACE_BY_KIND: Mapping[str, Callable[[ObjectGroup, Sequence[ObjectGroup], float], Goal]] = {
    "around": _place_around,
    "above": _place_above,
    "under": _place_under,
    "between": _place_between,
    "follow": _place_follower,
}


def place_by_subject(group: ObjectGroup, kind: str, subject: ObjectGroup, height: float) -> Goal:
    """A target's position with respect to the subject that the scene relates to it.

    `height` is that of the target's origin, m; the subject is placed already.
    """
    if kind in ("behind", "from") and subject.plan.motion.kind == "appear":
        return _hide_before(group, subject, height)
    if kind == "through" and subject.plan.is_path:
        return _lead_through(group, subject, height)
    gap = GAP_M * min(subject.size_m, group.size_m)
    near = subject.half_at_rest()
    x, y, _ = subject.half + group.half + gap
    if kind == "behind":
        near = _half_below(group, subject.models[0].height)
        y = float(subject.half[1] + near[1]) + gap
    yaw, here = subject.plan.yaw, _on_ground(subject, height)
    along = (math.cos(yaw), math.sin(yaw))
    goes = subject.plan.is_path or subject.plan.path is not None
    is_aside = goes and abs(along[0]) > 0.5
    # Beside what goes across the image is behind it; else at its right, and smaller things nearer.
    beside = (0.0, y + _CLEAR_M, _AWAY) if is_aside else (x + _CLEAR_M, 0.0, _ALONG_X)
    level = 0.0 if goes else float(group.half[1] - subject.half[1])
    ahead = 0.55 * (subject.models[0].length + group.models[0].length) + 0.2
    goals = {
        "from": (-x * along[0], -y * along[1], _AWAY),
        "away from": (-x * along[0], -y * along[1], _AWAY),
        "towards": (x * along[0], y * along[1], _AWAY),
        "overtake": (0.0, y + _CLEAR_M, _AWAY),
        "past": beside,
        "beside": beside if is_aside else (x, level, _ALONG_X),
        "with": (ahead * along[0], y + 0.1, _AWAY) if is_aside else (x, level, _ALONG_X),
        "left of": (x, level, _ALONG_X),
        "right of": (-x, level, -_ALONG_X),
        "behind": (-_look_past(subject, near, y), -y, -_AWAY),
        "front": (_look_past(group, near, y), y, _AWAY),
    }
    right, back, slide = goals.get(kind, (x, 0.0, _ALONG_X))
    return Goal(_shift(here, right, back), slide)


def _hide_before(group: ObjectGroup, subject: ObjectGroup, height: float) -> Goal:
    """Before what appears, which comes out past its edge after a third of its way."""
    model, yaw = group.models[0], subject.plan.yaw
    way = 2.0 * subject.half[0] - subject.models[0].length
    shown = -0.2 * way - 0.5 * max(model.length, model.width)
    nearer = 0.5 * (subject.models[0].width + model.width) + _CLEAR_M
    start = shown * math.copysign(1.0, math.cos(yaw))
    return Goal(_shift(_on_ground(subject, height), start, -nearer), _FIXED)


def _lead_through(group: ObjectGroup, subject: ObjectGroup, height: float) -> Goal:
    """Along the way of who goes through, who is out at about half of that way."""
    if group.noun.name in nouns_with("passage"):
        group.plan = replace(group.plan, yaw=subject.plan.yaw)
        group.fit()
    way = 2.0 * float(max(subject.half[:2])) - subject.models[0].length
    back = 0.1 * way + 0.5 * group.models[0].length
    return Goal(subject.to_world(-back, 0.0, height - subject.centre[2]), _FIXED)


def _half_below(group: ObjectGroup, height_m: float) -> Float64Array:
    """[3] half extents of what of a group is lower than that: a tree's trunk."""
    boxes = [bounds([part]) for part in group.models[0].parts(Pose(0.0, 0.0, 0.0, "stand"))]
    boxes = [box for box in boxes if box[0][2] < height_m] or boxes
    size = max(float(np.abs(corner[:2]).max()) for box in boxes for corner in box)
    share = min(2.0 * size / max(group.models[0].length, group.models[0].width), 1.0)
    return group.half_at_rest() * [share, share, 1.0]


def _look_past(rear: ObjectGroup, near: Float64Array, apart_m: float) -> float:
    """Metres to the right at which what stands behind is seen past the edge of what is before it.

    0 where enough of it is seen above and beside. `near` are the half extents [3] of what is
    before it, m, `apart_m` the way from one middle to the other.
    """
    covered = np.minimum(1.0, near / rear.half_at_rest())
    if covered[0] * covered[2] <= _COVERED:
        return 0.0
    return float(near[0] + (apart_m + near[1]) * _ASIDE_RAD)


def _on_ground(group: ObjectGroup, height: float) -> Float64Array:
    return np.array([group.centre[0], group.centre[1], height])


def _shift(place: Float64Array, x: float, y: float) -> Float64Array:
    return np.asarray(place + np.array([x, y, 0.0]))


def orbit(group: ObjectGroup, around: ObjectGroup, number: int, duration_s: float) -> Trajectory:
    """Circles around another object, evenly spread."""
    model = group.models[number]
    radius = float(np.max(around.half[:2])) + 0.9 * group.size_m + 0.1 * around.size_m
    rate = 2.0 * math.pi / max(duration_s, 2.0) * group.plan.motion.pace
    if group.plan.motion.direction in ("right", "clockwise"):
        rate = -rate
    phase = 2.0 * math.pi * number / len(group.models)
    x, y, _ = around.centre
    place = (float(x), float(y), float(group.centre[2]))
    activity = "run" if group.plan.motion.kind == "run" else "move"
    lean = 0.3 if group.noun.habitat == "air" and model.length > model.height else 0.0
    return Circle(place, radius, rate, phase, activity, lean)


def place_at_distance(goal: Goal, relation: Relation, other: ObjectGroup, sign: float) -> Goal:
    """The goal at the distance of the relation to another group, if it has one.

    `sign` is 1 for the goal of the relation's subject, -1 for that of a target.
    """
    if relation.distance_m is None:
        return goal
    place = other.centre[:2] + sign * relation.distance_m * np.array(_SIDES[relation.kind])
    return Goal(np.array([*place, goal.position[2]]), _FIXED)

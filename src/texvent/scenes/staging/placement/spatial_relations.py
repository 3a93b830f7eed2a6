"""Relations as positions: on, under, between, beside, past, behind and so on."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from texvent.scenes.description import STANDING, Relation, SceneObject
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.placement.faced import hang_on, hangs
from texvent.scenes.staging.placement.object_groups import (
    GAP_M,
    ObjectGroup,
    half_extents_over_clip,
    hurry_past,
)
from texvent.scenes.staging.placement.resting import rest_in, rest_on
from texvent.scenes.staging.placement.tables.at_table import place_at
from texvent.scenes.staging.placement.tables.plating import is_dished
from texvent.scenes.staging.trajectories.phases import PATH_KINDS
from texvent.scenes.staging.trajectories.trajectory import Circle, Trajectory


class Goal(NamedTuple):
    """Where a group should be."""

    position: Float64Array
    """[3] middle of the group, m."""
    slide: Float64Array
    """[3] direction in which it may move from there to find room; zero = it stays."""


_FIXED = np.zeros(3)
_ON_GROUND = np.array([1.0, 1.0, 0.0])
_AWAY = np.array([0.0, 1.0, 0.0])
_ALONG_X = np.array([1.0, 0.0, 0.0])


def place_on_targets(
    group: ObjectGroup, kind: str, targets: list[ObjectGroup], height: float, neighbours: list[int]
) -> Goal:
    """A subject's position with respect to objects that are placed already.

    Args:
        group: the subject; what it does may change: it rides, orbits or jumps over the target.
        kind: one of `object_placement.ON_TARGET`.
        targets: what it is related to.
        height: of its origin where the relation does not decide it, m.
        neighbours: for "on" and "in", the indices of all objects there, one for each copy.
    """
    if kind == "at":
        return Goal(place_at(group, targets[0], neighbours), _FIXED)
    if kind == "on" and hangs(group.noun, targets[0].noun):
        return Goal(hang_on(group, targets[0], neighbours), _FIXED)
    if kind in ("on", "in"):
        rest = rest_on if kind == "on" or is_dished(group, targets[0]) else rest_in
        return Goal(rest(group, targets[0], neighbours), _FIXED)
    return _PLACE_BY_KIND[kind](group, targets, height)


def _place_around(group: ObjectGroup, targets: list[ObjectGroup], height: float) -> Goal:
    """What moves circles its target; what stays stands in a ring and faces it."""
    target = targets[0]
    x, y, level = target.centre
    if group.plan.motion.kind not in PATH_KINDS | {"orbit", "spin"}:
        _stand_in_ring(group, target)
        return Goal(np.array([x, y, height]), _FIXED)
    group.orbits = target
    if group.noun.habitat == "air":
        level += 0.8 * _top(target)
    return Goal(np.array([x, y, max(level, 0.0)]), _FIXED)


def _stand_in_ring(group: ObjectGroup, target: ObjectGroup) -> None:
    count, own = len(group.models), group.models[0]
    within = max(target.models[0].length, target.models[0].width) * 0.5
    if len(target.models) > 1:
        within = float(max(target.half[:2]))
    radius = within + 0.6 * own.length + 0.1
    wide = 0.5 * count * 1.15 * own.width / math.pi
    radius = max(radius, wide)
    angles = _ring_open_to_camera(count)
    group.offsets = [(radius * math.cos(a), radius * math.sin(a), 0.0) for a in angles]
    group.yaws = [a + math.pi for a in angles]
    group.half = np.array([radius + own.length, radius + own.length, 0.5 * own.height])


def _ring_open_to_camera(count: int) -> list[float]:
    """Directions from the middle of a ring to those in it; none stands right before the middle."""
    if count <= _OPPOSITE:
        return [math.pi * number for number in range(count)]
    return [float(a) for a in np.linspace(-_OPEN_RAD, math.pi + _OPEN_RAD, count)]


_OPPOSITE, _OPEN_RAD = 2, 0.7


def _place_above(group: ObjectGroup, targets: list[ObjectGroup], height: float) -> Goal:
    target, own = targets[0], group.models[0].height
    top = _top(target)
    if group.plan.motion.kind == "jump":
        group.clear_m = min(top, 2.0 * own)
        return Goal(target.centre * _ON_GROUND, _FIXED)
    if group.noun.habitat == "fixed" and own > top:
        # A street lamp over a car stands on the ground and reaches over it.
        back = target.half[1] + group.half[1] + 0.3
        return Goal(target.centre * _ON_GROUND + [0.0, back, height], _AWAY)
    clear = top + 0.7 * own + 0.3 + _origin_height(group)
    return Goal(target.centre + np.array([0.0, 0.0, max(clear, height)]), _FIXED)


def _place_under(group: ObjectGroup, targets: list[ObjectGroup], height: float) -> Goal:
    """On the ground below: between the legs, beside a trunk, or in the shade of a wing."""
    target, own = targets[0], group.models[0]
    base = targets[0].centre * _ON_GROUND + [0.0, 0.0, height]
    if target.noun.name in _TRUNKS:
        aside = 0.6 + 0.5 * max(own.length, own.width)
        return Goal(_shift(base, 0.3 * aside, -aside), _FIXED)
    lowest = target.centre[2] - (0.5 * target.models[0].height if is_centred(target.noun) else 0.0)
    clearance = lowest + _UNDERSIDES.get(target.noun.name, 0.8) * target.models[0].height
    if lowest > own.height or own.height < clearance:
        return Goal(base, _FIXED)
    return Goal(_shift(base, target.half[0] + group.half[0] + 0.3, 0.0), _ALONG_X)


GATES = frozenset({"tunnel", "arch", "gate", "door"})
"""Nouns that one goes through, along their length."""
_TRUNKS = frozenset({"tree", "pine", "palm", "street lamp", "traffic light", "sign", "flag",
                     "windmill", "wind turbine", "parasol"})  # fmt: skip
"""Nouns that one stands under beside what holds them up."""
_CROWN_M = 2.5
"""Height from which such a thing hides with its trunk alone."""
_UNDERSIDES = {"chair": 0.42, "sofa": 0.15, "bed": 0.25, "bench": 0.42, "bridge": 0.3, "car": 0.12,
               "house": 0.0, "building": 0.0}  # fmt: skip
"""Share of an object's height that is free below it."""


def _place_between(group: ObjectGroup, targets: list[ObjectGroup], height: float) -> Goal:
    """In the middle, where `object_placement` has left room between them."""
    middle = np.mean([target.centre for target in targets], axis=0)
    slide = _FIXED if len(targets) == 1 else -_AWAY
    return Goal(np.array([middle[0], middle[1], height]), slide)


def _place_behind(group: ObjectGroup, targets: list[ObjectGroup], height: float) -> Goal:
    """A follower: behind its target, on the same path."""
    target, own = targets[0], group.models[0]
    sizes = target.half[:2] + group.half[:2]
    heading = np.array([math.cos(target.plan.yaw), math.sin(target.plan.yaw)])
    reach = 0.5 * (target.models[0].length + own.length)
    wanted = target.centre[:2] - heading * min(1.6 * reach + 0.4, float(sizes.max()) + reach)
    group.half = 0.5 * np.array([own.length, own.width, own.height])
    if target.plan.path is not None:
        group.lag = (target, 1.3 * reach + 0.4)
    return Goal(np.array([*wanted, height]), _FIXED)


_PLACE_BY_KIND: dict[str, Callable[[ObjectGroup, list[ObjectGroup], float], Goal]] = {
    "around": _place_around,
    "above": _place_above,
    "under": _place_under,
    "between": _place_between,
    "follow": _place_behind,
}


def _top(target: ObjectGroup) -> float:
    """Height of a target's top above its origin, m."""
    return target.models[0].height * (0.5 if is_centred(target.noun) else 1.0)


def _origin_height(group: ObjectGroup) -> float:
    """Height of a group's origin above what it rests on, m."""
    return 0.5 * group.models[0].height if is_centred(group.noun) else 0.0


_SIDE_BY_SIDE = frozenset({"left of", "right of", "beside", "with"})


def place_by_subject(group: ObjectGroup, kind: str, subject: ObjectGroup, height: float) -> Goal:
    """A target's position with respect to the subject that the prompt relates to it.

    Args:
        group: the target.
        kind: of the relation.
        subject: what is placed already.
        height: of the target's origin, m.
    """
    x, y, _ = subject.half + group.half + GAP_M * min(subject.size_m, group.size_m)
    yaw = subject.plan.yaw
    is_path = subject.plan.is_path or subject.plan.path is not None
    here = subject.centre * _ON_GROUND + [0.0, 0.0, height]
    if is_path and kind in ("past", "beside", "with"):
        goes_sideways = abs(math.cos(yaw)) > 0.5
        if not goes_sideways and kind != "with":
            return Goal(_shift(here, x + 0.3, 0.0), _ALONG_X)
        if goes_sideways and kind == "with":
            ahead = 0.55 * (subject.models[0].length + group.models[0].length) + 0.2
            return Goal(_shift(here, ahead * math.cos(yaw), y + 0.1), _AWAY)
        if goes_sideways:
            return Goal(_shift(here, _find_stop(subject, kind), y + 0.3), _AWAY)
    if kind == "appear":
        # It comes out past the edge of what hides it after a third of its way.
        way = 2.0 * subject.half[0] - subject.models[0].length
        shown = -0.5 * way + 0.3 * way - 0.5 * max(group.models[0].length, group.models[0].width)
        start = shown * math.copysign(1.0, math.cos(yaw))
        nearer = 0.5 * (subject.models[0].width + group.models[0].width) + 0.3
        return Goal(_shift(here, start, -nearer), _FIXED)
    if kind == "through" and group.noun.name in GATES and is_path:
        group.plan = replace(group.plan, yaw=yaw)
        _share_gates(group, subject)
        # It is through at about half of its way.
        way = 2.0 * float(max(subject.half[:2])) - subject.models[0].length
        back = 0.1 * way + 0.5 * group.models[0].length
        return Goal(_shift(here, -back * math.cos(yaw), -back * math.sin(yaw)), _FIXED)
    has_trunk = group.noun.name in _TRUNKS and group.models[0].height > _CROWN_M
    own = subject.models[0]
    deep = 0.6 + 0.5 * max(own.length, own.width) if has_trunk else y
    hidden = 0.25 if has_trunk else float(_half_at_rest(group)[0])
    if kind == "behind" and hurry_past(subject, hidden):
        return Goal(_shift(here, 0.0, -deep), _FIXED)
    if kind == "behind" and has_trunk:
        return Goal(_shift(here, 0.2 + 0.3 * max(own.width, 0.3), -deep), _FIXED)
    away = (-x * math.cos(yaw), -y * math.sin(yaw), _AWAY)
    goals = {
        "from": away,
        "away from": away,
        "overtake": (0.0, y + 0.3, _AWAY),
        "past": (x + 0.3, 0.0, _ALONG_X),
        "behind": (-_look_past(subject, group, y), -y, -_AWAY),
        "front": (_look_past(group, subject, y), y, _AWAY),
        "left of": (x, 0.0, _ALONG_X),
        "right of": (-x, 0.0, -_ALONG_X),
        "towards": (x * math.cos(yaw), y * math.sin(yaw), _AWAY),
    }
    right, back, slide = goals.get(kind, (x, 0.0, _ALONG_X))
    if kind in _SIDE_BY_SIDE and not is_path:
        # What is smaller stands nearer to the camera, and looks larger.
        back = float(group.half[1] - subject.half[1])
    return Goal(_shift(here, right, back), slide)


def _find_stop(subject: ObjectGroup, kind: str) -> float:
    """How far to the right of its middle the nose of what stops beside something comes, m."""
    said = subject.scene_object
    last = (subject.plan.motion, *said.then)[-1]
    if kind != "beside" or not (last.end_pace == 0.0 or (said.then and last.kind == "stand")):
        return 0.0
    reach = float(subject.half[0]) - 0.1 * subject.models[0].length
    return math.copysign(reach, math.cos(subject.plan.yaw))


def _share_gates(group: ObjectGroup, subject: ObjectGroup) -> None:
    """Several gates side by side, one after another for each of who goes through them."""
    gates, gate, own = len(group.models), group.models[0], subject.models[0]
    yaw = subject.plan.yaw
    ahead = np.array([math.cos(yaw), math.sin(yaw)])
    aside = np.array([-ahead[1], ahead[0]])
    lanes = [1.05 * gate.width * (number - 0.5 * (gates - 1)) for number in range(gates)]
    group.offsets = [(float(lane * aside[0]), float(lane * aside[1]), 0.0) for lane in lanes]
    group.half = half_extents_over_clip(group.models, group.offsets, group.plan)
    rows = -(-len(subject.models) // gates)
    step = 1.3 * max(own.length, 0.6)
    before, subject.offsets = subject.offsets, []
    for number, (_, _, up) in enumerate(before):
        row, lane = divmod(number, gates)
        x, y = step * (0.5 * (rows - 1) - row) * ahead + lanes[lane] * aside
        subject.offsets.append((float(x), float(y), up))
    subject.half = half_extents_over_clip(subject.models, subject.offsets, subject.plan)


_COVERED = 0.55
"""Share of what stands behind that may be hidden where it stands right behind."""
_TURN = 0.14
"""How far the camera may stand aside, radians."""
_DISTANCE = 2.6
"""Of the camera, in half widths of all it shows."""


def _look_past(rear: ObjectGroup, front: ObjectGroup, apart_m: float) -> float:
    """Metres to the right at which what stands behind is seen past the edge of what is before it.

    0 where enough of it is seen above and beside. Otherwise its middle is at the edge as the
    camera sees it: further to the right the further it stands behind.
    """
    back, near = _half_at_rest(rear), _half_at_rest(front)
    covered = min(1.0, near[0] / back[0]) * min(1.0, near[2] / back[2])
    if covered <= _COVERED:
        return 0.0
    deep = apart_m + float(near[1])
    edge = float(near[0])
    aside = max(edge - float(back[0]), 0.0) / (_DISTANCE * float(near[0] + back[0]))
    return edge + deep * (_TURN + aside)


def _half_at_rest(group: ObjectGroup) -> Float64Array:
    """[3] half extents of all copies where they stand, without their way, m."""
    plan = replace(group.plan, motion=STANDING, path=None)
    return half_extents_over_clip(group.models, group.offsets, plan)


INVERSE = {"behind": "front", "front": "behind", "left of": "right of", "right of": "left of",
           "beside": "beside"}  # fmt: skip
"""Relation of a subject to its target → that of the target to the subject."""


def _shift(place: Float64Array, x: float, y: float) -> Float64Array:
    return np.asarray(place + np.array([x, y, 0.0]))


_WAYS = {"left": -1.0, "right": 1.0}


def side_offset(
    group: ObjectGroup, objects: Sequence[SceneObject], build: Callable[[int], ObjectGroup]
) -> float:
    """How far to the right of the middle a group stands, m; nearer where both sides are taken.

    Args:
        group: what is "on the left" or "on the right", or neither.
        objects: all objects of the prompt.
        build: gives the group of one of them, by its number.
    """
    way = _WAYS.get(group.scene_object.side or "", 0.0)
    sides = [one.side for one in objects]
    if not way or not _WAYS.keys() <= set(sides):
        return way * 2.0 * group.size_m
    midst = [build(index) for index, side in enumerate(sides) if side == "centre"]
    room = sum(float(one.half[0]) for one in midst)
    return way * (float(group.half[0]) + 0.4 * group.size_m + 1.3 * room)


def orbit(group: ObjectGroup, around: ObjectGroup, number: int, duration_s: float) -> Trajectory:
    """Circles around another object, evenly spread."""
    model = group.models[number]
    radius = float(np.max(around.half[:2])) + 0.9 * group.size_m + 0.1 * around.size_m
    rate = 2.0 * math.pi / max(duration_s, 2.0) * group.plan.motion.pace
    if group.plan.motion.direction in ("right", "clockwise"):
        rate = -rate
    phase = 2.0 * math.pi * number / len(group.models)
    x, y, _ = around.centre
    height = float(group.centre[2])
    activity = "run" if group.plan.motion.kind == "run" else "move"
    lean = 0.3 if group.noun.habitat == "air" and model.length > model.height else 0.0
    return Circle((float(x), float(y), height), radius, rate, phase, activity, lean)


_SIDES = {"left of": (-1.0, 0.0), "right of": (1.0, 0.0), "behind": (0.0, 1.0),
          "front": (0.0, -1.0), "beside": (1.0, 0.0)}  # fmt: skip
"""Relation with a distance → where its subject is, seen from the target, on the ground."""


def place_at_distance(goal: Goal, relation: Relation, other: ObjectGroup, sign: float) -> Goal:
    """The goal at the distance of the relation, if it has one.

    Args:
        goal: where the group would be without it.
        relation: between the group and another one.
        other: that one, which is placed already.
        sign: 1 for the goal of the relation's subject, -1 for that of a target.
    """
    if relation.distance_m is None:
        return goal
    place = other.centre[:2] + sign * relation.distance_m * np.array(_SIDES[relation.kind])
    return Goal(np.array([*place, goal.position[2]]), _FIXED)

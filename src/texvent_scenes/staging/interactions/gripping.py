"""Gripping: machines whose hand lifts, carries, sets down or moves things.

The joints of a machine follow its activity and how far it goes for that, its "shift": to the height
at which it takes a thing, to that at which it leaves it, and between both places.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np

from texvent_scenes.models.anchors import (
    Gripper,
    find_rim,
    find_support,
    gripper_of,
    has_rim,
    locate,
)
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.shapes import Affine, point, shift
from texvent_scenes.models.tables import trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor, size_of
from texvent_scenes.staging.interactions.holding import moving
from texvent_scenes.staging.interactions.reaching import REACHED_M, OutOfReachError, search
from texvent_scenes.staging.tracks.keys import Key, Vector
from texvent_scenes.staging.tracks.track import (
    Attachment,
    BodyState,
    Grips,
    Term,
    Track,
    attached,
    rotation,
    steady,
)

ACTIVITIES = {
    "lift": "machine lifts", "set down": "machine sets down", "move over": "machine moves",
    "drop": "machine moves", "hold": "machine holds",
}  # fmt: skip
"""Relation → activity of a machine."""
Left = Literal["in", "on", "pile"]
"""Manner in which a thing is left."""
_CARRIED_S, _OVER_RIM_M, _LATEST_S = 1.2, 0.12, 0.8
"""From where a thing is taken to where it is left, s; height above a rim at which it is let go, m;
the last instant at which what is moved is taken."""
_TO_CAMERA = -0.5 * math.pi
_WIDE_M = 0.8
"""Size from which on a goal is put a quarter turn away from where a thing is taken."""
_STEPS, _ROUNDS = 33, 5
_STEP_S, _STILL_M = 0.05, 1e-6
_ACTS_S = np.arange(-1.5, 1.5, _STEP_S)
"""Instants of an act, s after the contact, at which its hand is looked for; least move of that."""


@dataclass(frozen=True)
class _Plan:
    """An act: the machine where it stands, its activity, and its settings."""

    machine: Actor
    gripper: Gripper
    kind: str
    contact_s: float
    left: Left
    """Manner in which the thing is left."""
    aim: Vector = (0.0, 0.0, 0.0)
    """Turns of the hand where it takes and where it leaves a thing, and of all of the machine."""

    @property
    def activity(self) -> str:
        return ACTIVITIES[self.kind]

    def hand(self, act_s: float, settings: tuple[float, float, float]) -> Affine:
        """Axes of the hand in body coordinates, at a time since the contact."""
        pose = Pose(0.0, 0.0, 0.0, self.activity, act_s=act_s, grips=self.grips(settings))
        return locate(self.machine.model, "hands", pose)

    def grips(self, settings: tuple[float, float, float]) -> Grips:
        """Channels of its joints."""
        return (("shift", settings), *[("aim", self.aim)] * any(self.aim))

    def first_move_s(self) -> float:
        """When its hand begins to move, s after the contact."""
        half = 0.5 * sum(self.gripper.reach)
        settings = (half, half, self.gripper.turn)
        rest = self.hand(float(_ACTS_S[0]), settings)
        return next(
            (
                float(one)
                for one in _ACTS_S
                if np.abs(self.hand(float(one) + _STEP_S, settings) - rest).max() > _STILL_M
            ),
            0.0,
        )

    def aimed_rad(self, turn: float) -> float:
        """Angle by which a setting turns all of it."""
        x, y = replace(self, aim=(0.0, 0.0, 0.1 * turn)).hand(0.0, (0.0, 0.0, 0.0))[:2, 3]
        return 10.0 * math.atan2(float(y), float(x))

    def bent(self, shifted: float, bend: float) -> Float64Array:
        """Place of the hand where it takes a thing, body coordinates."""
        one = replace(self, aim=(bend, 0.0, 0.0))
        return np.asarray(one.hand(0.0, (shifted, 0.0, 0.0))[:, 3])

    def solve(self, height_m: float, act_s: float, place: int) -> float:
        """The setting that brings the hand to a height above the machine's foot, or closest."""
        low, high = self.gripper.reach
        best = low
        for _ in range(_ROUNDS):
            tried = np.linspace(low, high, _STEPS)
            off = [abs(float(self.hand(act_s, _settings(one, place, self.gripper.turn))[2, 3])
                       - height_m) for one in tried]  # fmt: skip
            best, step = float(tried[int(np.argmin(off))]), float(tried[1] - tried[0])
            low, high = max(best - step, low), min(best + step, high)
        return best


def _settings(value: float, place: int, turn: float) -> tuple[float, float, float]:
    return (value, 0.0, turn) if place == 0 else (0.0, value, turn)


@dataclass(frozen=True)
class Manner:
    """Statement of a scene about an act."""

    is_turned: bool = True
    """Whether the machine may be turned, its side to the camera."""
    is_fixed: bool = False
    """Whether both the machine and the first thing stay where they are."""
    left: Left = "in"
    """In a goal that has a rim, on it, or on a pile of the others, which it bears."""
    begin_s: float | None = None
    """When the machine begins to move for it, s; None: the length of the clip decides."""


def grip(
    kind: str, machine: Actor, things: Sequence[Actor], duration_s: float, *,
    support: Actor | None = None, goal: Actor | None = None, manner: Manner,
) -> tuple[Actor, list[Actor], Actor | None]:  # fmt: skip
    """The machine, the things and the goal of an act.

    Args:
        kind: a relation of `ACTIVITIES`.
        machine: who does it.
        things: the first is handled; what is moved ends on the others.
        duration_s: length of the clip, s.
        support: what the first is on; else the machine has it where its hand is.
        goal: what it is set down on or in, which is put there.
        manner: what else the scene says of it.

    Raises:
        OutOfReachError: both stay where they are, and the hand does not get from one to the other.
    """
    row = gripper_of(machine.noun.name)
    if kind == "hold":
        return *_carry(machine, row, things[0]), goal
    if goal is not None and goal.size_m > _WIDE_M:
        row = replace(row, turn=math.copysign(0.5 * math.pi, row.turn))
    if manner.is_turned:
        yaw = 0.0 if support is None else _TO_CAMERA
        machine = moving(machine, steady(machine.track.at(0.0).position, yaw))
    plan = _Plan(machine, row, kind, _contact_s(kind, duration_s), manner.left)
    if manner.begin_s is not None:
        plan = replace(plan, contact_s=manner.begin_s - plan.first_move_s())
    first, *others = things
    pick = put = 0.0
    if kind != "set down":
        plan, first, pick = _take(plan, first, support, manner)
    if kind != "lift":
        level_m = plan.machine.track.at(0.0).position[2]
        left_m = _left_height(plan, goal, others, first)
        put = plan.solve(_hand_height(row, first, left_m - level_m), _left_s(kind), 1)
    settings = (pick, put, row.turn)
    plan = replace(plan, machine=_acting(plan, settings))
    if kind != "lift":
        goal, others = _put_below(plan, settings, goal, others)
    return plan.machine, [_follow_hand(plan, settings, first, goal), *others], goal


def _take(
    plan: _Plan, first: Actor, support: Actor | None, manner: Manner
) -> tuple[_Plan, Actor, float]:
    """The plan with its machine where it takes a thing, the thing there, and the shift for it."""
    if manner.is_fixed:
        plan, pick = reach_out(plan, first, is_turned=manner.is_turned)
        return plan, first, pick
    level_m = plan.machine.track.at(0.0).position[2]
    low_m = first.lowest_m(plan.contact_s) if support is not None else level_m
    pick = plan.solve(_hand_height(plan.gripper, first, low_m - level_m), 0.0, 0)
    hand = plan.hand(0.0, (pick, 0.0, plan.gripper.turn))
    if support is not None:
        return (
            replace(plan, machine=_placed_at(plan.machine, first, hand, plan.contact_s)),
            first,
            pick,
        )
    return plan, moving(first, _at_hand(plan, first, hand, low_m)), pick


def reach_out(plan: _Plan, thing: Actor, *, is_turned: bool) -> tuple[_Plan, float]:
    """The plan with its machine turned and bent to a thing, and its shift.

    Raises:
        OutOfReachError: its hand does not get there.
    """
    home, row = plan.machine.track.at(0.0), plan.gripper
    x, y, _ = np.subtract(thing.middle(plan.contact_s), home.position)
    ahead_m = math.hypot(x, y) - _behind(row, thing, plan.machine)
    up_m = _hand_height(row, thing, thing.lowest_m(plan.contact_s) - home.position[2])
    if is_turned:
        track = replace(plan.machine.track, yaw=math.atan2(y, x))
        plan, aim = replace(plan, machine=replace(plan.machine, track=track)), 0.0
    else:
        aim = math.remainder(math.atan2(y, x) - home.yaw, math.tau)
    near_m, far_m, best = search(plan.bent, (row.reach, row.bend), ahead_m, up_m)
    pick, bend, gap_m = best
    can_turn = abs(plan.aimed_rad(1.0)) > _STILL_M
    if gap_m > REACHED_M or (not can_turn and abs(aim) * ahead_m > REACHED_M):
        raise OutOfReachError(
            near_m + _behind(row, thing, plan.machine),
            far_m + _behind(row, thing, plan.machine),
            home.yaw if not (is_turned or can_turn) else math.atan2(y, x),
        )
    turn = aim / plan.aimed_rad(1.0) if can_turn else 0.0
    return replace(plan, aim=(bend, 0.0, turn)), pick


def _contact_s(kind: str, duration_s: float) -> float:
    """Instant at which the hand takes the thing, or leaves what it has from the beginning."""
    if _is_moved(kind):
        return min(max(0.25 * duration_s, 0.3), _LATEST_S)
    return min(max(0.4 * duration_s, 0.3), 1.1)


def _is_moved(kind: str) -> bool:
    return kind in ("move over", "drop")


def _left_s(kind: str) -> float:
    """Time since the contact at which the thing is left."""
    return _CARRIED_S if _is_moved(kind) else 0.0


def _hand_height(row: Gripper, thing: Actor, low_m: float) -> float:
    """Height of the hand that has a thing whose lowest point is so high, m."""
    pocket = float(trait_value("fork pockets", thing.noun.name) or 0.0) * size_of(thing.model)
    return low_m + (pocket if row.is_below else 0.5 * thing.model.height)


def _placed_at(machine: Actor, thing: Actor, hand: Affine, time_s: float) -> Actor:
    """The machine behind a thing, whose place then is that of its hand."""
    x, y, _ = thing.middle(time_s)
    home = machine.track.at(0.0)
    off = rotation(home.yaw, 0.0, 0.0) @ hand[:, 3]
    place = (float(x - off[0]), float(y - off[1]), home.position[2])
    return moving(machine, steady(place, home.yaw))


def _at_hand(plan: _Plan, thing: Actor, hand: Affine, low_m: float) -> Track:
    """Rest where the hand takes the thing."""
    home = plan.machine.track.at(0.0)
    back = _behind(plan.gripper, thing, plan.machine)
    x, y, _ = home.to_world() @ np.array([hand[0, 3] + back, hand[1, 3], hand[2, 3], 1.0])
    return steady((float(x), float(y), low_m + thing.foot_m), home.yaw, activity="stand")


def _behind(row: Gripper, thing: Actor, machine: Actor) -> float:
    """Distance, m, of its middle ahead of that of the forks at whose back it stands."""
    return max(0.5 * (thing.model.length - size_of(machine.model)), 0.0) if row.is_below else 0.0


def _acting(plan: _Plan, settings: tuple[float, float, float]) -> Actor:
    home = plan.machine.track.at(0.0)
    rest = steady(home.position, home.yaw, activity=plan.activity)
    track = replace(rest, contact_s=plan.contact_s, grips=plan.grips(settings))
    return moving(plan.machine, track)


def _left_height(plan: _Plan, goal: Actor | None, others: Sequence[Actor], first: Actor) -> float:
    """Height at which the bottom of the thing is left, m."""
    level_m = plan.machine.track.at(0.0).position[2]
    pile_m = sum(one.model.height for one in others)
    if goal is not None:
        rim = find_rim(goal.noun.name, goal.model) if plan.left == "in" else None
        level_m += pile_m if plan.left == "pile" else 0.0
        return level_m + (rim.height + _OVER_RIM_M if rim else find_support(goal.model).height)
    fallen = 2.0 * first.model.height if plan.kind == "drop" else 0.0
    return level_m + fallen + pile_m


def _put_below(
    plan: _Plan, settings: tuple[float, float, float], goal: Actor | None, others: Sequence[Actor]
) -> tuple[Actor | None, list[Actor]]:
    """The goal, or the other things on top of each other, where the first is left."""
    x, y, _ = plan.machine.anchor("hands", plan.contact_s + _left_s(plan.kind))[:, 3]
    height_m, yaw = plan.machine.track.at(0.0).position[2], plan.machine.track.yaw
    if goal is not None:
        there = (float(x), float(y), goal.track.at(0.0).position[2])
        across = 0.5 * math.pi * (goal.model.length > goal.model.width)
        goal = moving(goal, steady(there, yaw + settings[2] + across, activity="stand"))
        if plan.left != "pile":
            return goal, [*others]
        height_m += find_support(goal.model).height
    stacked = []
    for one in others:
        place = (float(x), float(y), height_m + one.foot_m)
        stacked.append(moving(one, steady(place, yaw + settings[2], activity="stand")))
        height_m += one.model.height
    return goal, stacked


def _follow_hand(
    plan: _Plan, settings: tuple[float, float, float], thing: Actor, goal: Actor | None
) -> Actor:
    """The thing on its way: at rest, in the hand, and where it is left."""
    axes, begin_s = partial(plan.machine.anchor, "hands"), plan.contact_s
    left_s = begin_s + _left_s(plan.kind)
    if plan.kind == "set down":
        here = axes(left_s)
        place = here[:, 3] - [0.0, 0.0, 0.5 * thing.model.height - thing.foot_m]
        rest = steady(point(place), plan.machine.track.yaw + settings[2], activity="stand")
        anchor = _bound(plan.machine.track, axes, rest.at(0.0).to_world(), left_s)
        return moving(thing, replace(rest, anchor=anchor, release_s=left_s))
    anchor = _bound(plan.machine.track, axes, thing.track.at(begin_s).to_world(), begin_s)
    if not _is_moved(plan.kind):
        return replace(thing, track=replace(thing.track, anchor=anchor, grab_s=begin_s),
                       is_mover=True)  # fmt: skip
    end = anchor.at(left_s)
    floor_m = _floor_below(plan, thing, goal)
    track = _moved_on(thing.track.at(begin_s), end, begin_s, left_s, floor_m)
    return moving(thing, replace(track, anchor=anchor, grab_s=begin_s, release_s=left_s))


def _bound(carrier: Track, axes: partial[Float64Array], place: Affine, time_s: float) -> Attachment:
    """Offset that keeps a place [3, 4] of the world, at an instant, in axes that move."""
    square = (np.vstack([one, [0.0, 0.0, 0.0, 1.0]]) for one in (axes(time_s), place))
    return Attachment(carrier, axes, np.linalg.solve(*square)[:3])


def _floor_below(plan: _Plan, thing: Actor, goal: Actor | None) -> float | None:
    """Height of its origin where it comes to rest after it is let go; None: it stays there."""
    is_in = goal is not None and plan.left == "in" and has_rim(goal.noun.name)
    is_dropped = plan.kind == "drop" or is_in
    level_m = plan.machine.track.at(0.0).position[2]
    return level_m + thing.foot_m if is_dropped else None


def _moved_on(
    first: BodyState, last: BodyState, begin_s: float, end_s: float, floor_m: float | None
) -> Track:
    """At rest at the first place until it is taken, at the last one or falling from there on."""
    way = np.subtract(last.position, first.position)
    span_s, heading = end_s - begin_s, math.atan2(float(way[1]), float(way[0]))
    carried = Key(span_s, math.hypot(way[0], way[1]) / span_s, climb_m_s=float(way[2]) / span_s,
                  ramp_s=0.0, activity="stand")  # fmt: skip
    after = Key(1.0, 0.0, ramp_s=0.0, activity="stand")
    if floor_m is not None:
        after = replace(after, restitution=0.3)
    turned = math.remainder(last.yaw - first.yaw, math.tau) / span_s
    term = Term("yaw", offset=first.yaw - heading - turned * begin_s, drift=turned,
                begin_s=begin_s, end_s=end_s)  # fmt: skip
    keys = (Key(begin_s, 0.0, ramp_s=0.0, activity="stand"), carried, after)
    low = -math.inf if floor_m is None else floor_m
    return Track(first.position, heading, keys, (term,), floor_m=low, pivot_m=first.pivot_m)


def _carry(machine: Actor, row: Gripper, thing: Actor) -> tuple[Actor, list[Actor]]:
    """Both, the thing in the hand all along."""
    track = machine.track if row.is_below else replace(machine.track, activity=ACTIVITIES["hold"])
    machine = replace(machine, track=track)
    up = thing.foot_m - _hand_height(row, thing, 0.0)
    offset = shift(_behind(row, thing, machine), 0.0, up)
    upright = partial(_level, machine)
    held = attached(machine.track, offset, axes=upright)
    return machine, [replace(thing, track=held, is_mover=machine.is_mover, lead_m=0.0)]


def _level(machine: Actor, time_s: float) -> Float64Array:
    """Axes at the hand that stay level."""
    yaw = machine.track.at(time_s).yaw
    return np.column_stack([rotation(yaw, 0.0, 0.0), machine.anchor("hands", time_s)[:, 3]])

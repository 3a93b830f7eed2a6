"""Bodies that run into each other: two that move, or one against something that stands."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.attached import FreeFlight, Switched, with_middle
from texvent.scenes.staging.acts.striking import contact_time, heading_of, lift_of, vector
from texvent.scenes.staging.body_boxes import gap, part_boxes
from texvent.scenes.staging.trajectories.steered_path import Piece, SteeredPath
from texvent.scenes.staging.trajectories.trajectory import (
    Rolling,
    Stationary,
    Trajectory,
    Vector,
)

_TURN_ROUND_S = 0.08
"""How long the speed takes to change at the contact."""
_REBOUND = {"roll": 0.4, "drive": 0.12, "slide": 0.25}
"""Usual motion → share of the speed with which such a body goes back."""
_LENGTHS = (1.0, 2.0)
"""Least and most of its own length that a body covers before the contact."""
_FLOWN_LENGTHS, _FLOWN_SHARE = 2.5, 0.5
"""Way of what flies: lengths of its own, or a share of the size of what it hits if that is more."""
_BOUNCED = 0.3
"""Share of its speed with which what flies falls back."""
_THROUGH_AIR = ("air", "fixed")
"""Habitats of what comes through the air: what cannot go by itself was thrown."""
_STICKS = frozenset({"arrow", "dart", "spear", "knife", "axe"})
"""What stays in what it hits."""
_STUCK = 0.12
"""Share of its length by which it does."""
_THIN = 0.6
"""Share of its width up to which what is hit has a front: a wall, a target."""
_FRONTED = frozenset({"archery target"})
"""What has one though it is not thin: its legs stand out behind."""
_ASLANT = 0.55
"""Angle to the picture of the way to such a front, rad."""
_TALL = 3.0
"""From so many heights of its own on a ball flies against what stands."""
_HALVINGS = 20


def collide(subject: Actor, other: Actor, duration_s: float) -> tuple[Actor, Actor]:
    """Both come from left and right and touch at one instant; what is fixed stays.

    Args:
        subject: one of them.
        other: the other one.
        duration_s: length of the clip, s.
    """
    contact_s = contact_time(duration_s, 0.5)
    if not _moves(subject) and _moves(other):
        still, mover = _run_into(other, subject, contact_s)
        return still, mover
    if not _moves(other):
        still, mover = _run_into(subject, other, contact_s)
        return mover, still
    first, second = subject.trajectory.at(0.0).position, other.trajectory.at(0.0).position
    if second[0] < first[0]:
        right, left = collide(other, subject, duration_s)
        return left, right
    touch_x, depth = 0.5 * (first[0] + second[0]), 0.5 * (first[1] + second[1])
    bodies = []
    for actor, side in ((subject, -1.0), (other, 1.0)):
        home = actor.trajectory.at(0.0)
        touching = (touch_x + side * 0.5 * actor.model.length, depth, home.position[2])
        path = _run_up(actor, touching, 0.0 if side < 0.0 else math.pi, contact_s)
        bodies.append(_moving(actor, path))
    return bodies[0], bodies[1]


def _moves(actor: Actor) -> bool:
    return actor.noun.habitat != "fixed"


def _run_into(mover: Actor, still: Actor, contact_s: float) -> tuple[Actor, Actor]:
    """What stands, its front to what comes, and what comes: it rolls back, falls off or sticks."""
    home, place = mover.trajectory.at(0.0), still.trajectory.at(0.0)
    is_from_left = home.position[0] <= place.position[0]
    yaw = 0.0 if is_from_left else math.pi
    if still.noun.name in _FRONTED or still.model.length < _THIN * still.model.width:
        yaw = _ASLANT if is_from_left else math.pi - _ASLANT
        still = replace(still, trajectory=Stationary(place.position, yaw + math.pi))
    low, high = part_boxes(still, 0.0).hull
    middle = 0.5 * (low + high)
    is_flying = _comes_flying(mover, still)
    lift = lift_of(mover)
    goal = (float(middle[0]), float(middle[1]),
            float(middle[2]) - lift if is_flying else home.position[2])  # fmt: skip
    heading = heading_of(yaw)
    touching = _find_contact(mover, still, np.array(goal), heading, yaw)
    if not is_flying:
        return still, _moving(mover, _run_up(mover, vector(touching), yaw, contact_s))
    if mover.noun.name in _STICKS:
        touching = touching + _STUCK * mover.model.length * heading
    length = max(_FLOWN_LENGTHS * mover.model.length, _FLOWN_SHARE * still.size_m)
    speed = length / contact_s
    pieces = (Piece(contact_s, speed), Piece(0.1, 0.0, ramp_s=1e-3))
    start = vector(touching - length * heading)
    path: Trajectory = SteeredPath(start, yaw, pieces, initial_speed_m_s=speed)
    if mover.noun.name not in _STICKS:
        rest, up = 0.5 * mover.model.height, np.array([0.0, 0.0, lift])
        at_contact = with_middle(path.at(0.0), vector(touching + up), lift)
        back = vector(-_BOUNCED * speed * heading)
        path = Switched(path, FreeFlight(at_contact, contact_s, back, lift, rest, -3.0), contact_s)
    return still, _moving(mover, path)


def _comes_flying(mover: Actor, still: Actor) -> bool:
    """Whether it comes through the air; a ball does against what is tall, but not if it rolls."""
    if getattr(mover.model, "is_wheeled", False):
        return False
    if mover.noun.motion == "roll":
        is_tall = still.model.height > _TALL * mover.model.height
        return is_tall and not isinstance(mover.trajectory, Rolling)
    return mover.noun.habitat in _THROUGH_AIR


def _find_contact(
    mover: Actor, still: Actor, goal: Float64Array, heading: Float64Array, yaw: float
) -> Float64Array:
    """Where the mover first touches what stands on a straight way to a place in it, m."""
    other = part_boxes(still, 0.0)
    near, far = 0.0, 0.5 * mover.size_m + float(np.linalg.norm(other.hull[1] - other.hull[0]))
    for _ in range(_HALVINGS):
        between = 0.5 * (near + far)
        placed = replace(mover, trajectory=Stationary(vector(goal - between * heading), yaw))
        if gap(part_boxes(placed, 0.0), other) > 0.0:
            far = between
        else:
            near = between
    return np.asarray(goal - far * heading)


def _moving(actor: Actor, path: Trajectory) -> Actor:
    return replace(actor, trajectory=path, is_mover=True, lead_m=0.0, props=())


def _run_up(actor: Actor, touching: Vector, yaw: float, contact_s: float) -> SteeredPath:
    """Along the ground to where it touches, and a little back."""
    length = actor.model.length
    usual = actor.noun.speed_m_s or length / contact_s
    speed = min(max(usual * contact_s, _LENGTHS[0] * length), _LENGTHS[1] * length) / contact_s
    back, way = speed * _REBOUND.get(actor.noun.motion, 0.0), speed * contact_s
    start = (touching[0] - way * math.cos(yaw), touching[1] - way * math.sin(yaw), touching[2])
    return SteeredPath(
        start,
        yaw,
        (
            Piece(contact_s, speed),
            Piece(0.25, -back, ramp_s=_TURN_ROUND_S),
            Piece(0.6, 0.0, ramp_s=0.6),
            Piece(0.1, activity="stand"),
        ),
        initial_speed_m_s=speed,
    )

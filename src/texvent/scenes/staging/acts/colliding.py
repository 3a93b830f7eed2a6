"""Bodies that run into each other: two that move, or one against something that stands."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent.scenes.models.traits import nouns_with
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import lift_of, vector
from texvent.scenes.staging.acts.striking import contact_time, heading_of
from texvent.scenes.staging.body_boxes import gap, part_boxes
from texvent.scenes.staging.trajectories.action_trajectories import Flight, Switched
from texvent.scenes.staging.trajectories.steered_path import Piece, SteeredPath
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Stationary,
    Trajectory,
    Vector,
    ahead,
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
_STUCK = 0.12
"""Share of its length by which what stays in a thing is in it."""
_THIN, _ASLANT = 0.6, 0.55
"""Share of its width up to which what is hit has a front, and the way's angle to the picture then,
rad."""
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
    if subject.noun.habitat == "fixed" and other.noun.habitat != "fixed":
        other, subject = _run_into(other, subject, contact_s)
        return subject, other
    if other.noun.habitat == "fixed":
        return _run_into(subject, other, contact_s)
    places = [actor.trajectory.at(0.0).position for actor in (subject, other)]
    x, y = (0.5 * (places[0][axis] + places[1][axis]) for axis in (0, 1))
    side = -1.0 if places[0][0] <= places[1][0] else 1.0
    met = []
    for actor, place, away in ((subject, places[0], side), (other, places[1], -side)):
        touching = (x + away * 0.5 * actor.model.length, y, place[2])
        met.append(_moving(actor, _run_up(actor, touching, 0.0 if away < 0.0 else math.pi,
                                          contact_s)))  # fmt: skip
    return met[0], met[1]


def _run_into(mover: Actor, still: Actor, contact_s: float) -> tuple[Actor, Actor]:
    """What comes rolls back, falls off or sticks; what stands has its front to it."""
    home, place = mover.trajectory.at(0.0), still.trajectory.at(0.0)
    is_from_left = home.position[0] <= place.position[0]
    yaw = 0.0 if is_from_left else math.pi
    if still.model.length < _THIN * still.model.width:
        yaw = _ASLANT if is_from_left else math.pi - _ASLANT
        still = replace(still, trajectory=Stationary(place.position, yaw + math.pi))
    low, high = part_boxes(still, 0.0).hull
    x, y, z = 0.5 * (low + high)
    is_flying, lift = _comes_flying(mover, still), lift_of(mover)
    goal = np.array([x, y, z - lift if is_flying else home.position[2]])
    touching = _find_contact(mover, still, goal, yaw)
    if not is_flying:
        return _moving(mover, _run_up(mover, touching, yaw, contact_s)), still
    is_sticking = mover.noun.name in nouns_with("stays in what it hits")
    if is_sticking:
        touching = ahead(touching, yaw, _STUCK * mover.model.length, touching[2])
    way = max(_FLOWN_LENGTHS * mover.model.length, _FLOWN_SHARE * still.size_m)
    speed = way / contact_s
    pieces = (Piece(contact_s, speed), Piece(0.1, 0.0, ramp_s=1e-3))
    path: Trajectory = SteeredPath(ahead(touching, yaw, -way, touching[2]), yaw, pieces, speed)
    if not is_sticking:
        start = BodyState(touching, yaw, distance_m=way, pivot_m=lift)
        floor, back = 0.5 * mover.model.height - lift, vector(-_BOUNCED * speed * heading_of(yaw))
        path = Switched(path, Flight(start, back, floor, 0.55, contact_s, -3.0), contact_s)
    return _moving(mover, path), still


def _comes_flying(mover: Actor, still: Actor) -> bool:
    """Whether it comes through the air; a ball does against what is tall, but not if it rolls."""
    if mover.noun.motion == "roll":
        is_thrown = isinstance(mover.trajectory, Stationary)
        return is_thrown and still.model.height > _TALL * mover.model.height
    is_wheeled = getattr(mover.model, "is_wheeled", False)
    # What cannot go by itself was thrown.
    return not is_wheeled and mover.noun.habitat in ("air", "fixed")


def _find_contact(mover: Actor, still: Actor, goal: Float64Array, yaw: float) -> Vector:
    """Where the mover first touches what stands on a straight way to a place in it, m."""
    other = part_boxes(still, 0.0)
    near, far = 0.0, 0.5 * mover.size_m + float(np.linalg.norm(other.hull[1] - other.hull[0]))
    for _ in range(_HALVINGS):
        between = 0.5 * (near + far)
        place = vector(goal - between * heading_of(yaw))
        placed = replace(mover, trajectory=Stationary(place, yaw))
        if gap(part_boxes(placed, 0.0), other) > 0.0:
            far = between
        else:
            near = between
    return vector(goal - far * heading_of(yaw))


def _moving(actor: Actor, path: Trajectory) -> Actor:
    return replace(actor, trajectory=path, is_mover=True, lead_m=0.0, props=())


def _run_up(actor: Actor, touching: Vector, yaw: float, contact_s: float) -> SteeredPath:
    """Along the ground to where it touches, and a little back."""
    length = actor.model.length
    usual = actor.noun.speed_m_s or length / contact_s
    speed = min(max(usual * contact_s, _LENGTHS[0] * length), _LENGTHS[1] * length) / contact_s
    back = speed * _REBOUND.get(actor.noun.motion, 0.0)
    return SteeredPath(
        ahead(touching, yaw, -speed * contact_s, touching[2]),
        yaw,
        (
            Piece(contact_s, speed),
            Piece(0.25, -back, ramp_s=_TURN_ROUND_S),
            Piece(0.6, 0.0, ramp_s=0.6),
            Piece(0.1, activity="stand"),
        ),
        initial_speed_m_s=speed,
    )

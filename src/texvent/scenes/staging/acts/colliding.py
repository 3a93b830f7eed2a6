"""Bodies that run into each other: two that move, or one against something that stands."""

from __future__ import annotations

import math
from dataclasses import replace

from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.striking import contact_time
from texvent.scenes.staging.trajectories.steered_path import Piece, SteeredPath

_TURN_ROUND_S = 0.08
"""How long the speed takes to change at the contact."""
_REBOUND = {"roll": 0.4, "drive": 0.12, "slide": 0.25}
"""Usual motion → share of the speed with which such a body goes back."""
_LENGTHS = (1.0, 2.0)
"""Least and most of its own length that a body covers before the contact."""


def collide(subject: Actor, other: Actor, duration_s: float) -> tuple[Actor, Actor]:
    """Both come from left and right and touch at one instant; what is fixed stays.

    Args:
        subject: one of them.
        other: the other one.
        duration_s: length of the clip, s.
    """
    contact_s = contact_time(duration_s, 0.5)
    first, second = subject.trajectory.at(0.0).position, other.trajectory.at(0.0).position
    if second[0] < first[0]:
        right, left = collide(other, subject, duration_s)
        return left, right
    is_fixed = (not _moves(subject) and _moves(other), not _moves(other))
    touch_x, depth = 0.5 * (first[0] + second[0]), 0.5 * (first[1] + second[1])
    if is_fixed[0]:
        touch_x, depth = float(subject.corners(0.0)[:, 0].max()), first[1]
    elif is_fixed[1] and _moves(subject):
        touch_x, depth = float(other.corners(0.0)[:, 0].min()), second[1]
    is_fixed = (is_fixed[0], is_fixed[1] and _moves(subject))
    bodies = []
    for actor, stays, side in ((subject, is_fixed[0], -1.0), (other, is_fixed[1], 1.0)):
        home = actor.trajectory.at(0.0)
        touching = (touch_x + side * 0.5 * actor.model.length, depth, home.position[2])
        bodies.append(actor if stays else _run_up(actor, touching, -side, contact_s))
    return bodies[0], bodies[1]


def _moves(actor: Actor) -> bool:
    return actor.noun.habitat != "fixed"


def _run_up(
    actor: Actor, touching: tuple[float, float, float], way: float, contact_s: float
) -> Actor:
    """Along the image to where it touches, with a way of 1 to the right, and a little back."""
    length = actor.model.length
    usual = actor.noun.speed_m_s or length / contact_s
    speed = min(max(usual * contact_s, _LENGTHS[0] * length), _LENGTHS[1] * length) / contact_s
    back = speed * _REBOUND.get(actor.noun.motion, 0.0)
    start = (touching[0] - way * speed * contact_s, touching[1], touching[2])
    path = SteeredPath(
        start,
        0.0 if way > 0.0 else math.pi,
        (
            Piece(contact_s, speed),
            Piece(0.25, -back, ramp_s=_TURN_ROUND_S),
            Piece(0.6, 0.0, ramp_s=0.6),
            Piece(0.1, activity="stand"),
        ),
        initial_speed_m_s=speed,
    )
    return replace(actor, trajectory=path, is_mover=True, lead_m=0.0, props=())

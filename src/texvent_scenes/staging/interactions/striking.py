"""Kick, throw and collide: an instant of contact, motion before and after it.

Each act gives its subject an activity whose contact is at that instant, finds the place of the body
that touches the thing then, and lets the thing fly from there, or to there.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent_scenes.models.shapes import bounds, moved, point, shift
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.interactions.holding import (
    held_at,
    is_person,
    moving,
)
from texvent_scenes.staging.trajectories.action_trajectories import (
    Flight,
    about_pivot,
)
from texvent_scenes.staging.trajectories.steered_path import Piece, SteeredPath
from texvent_scenes.staging.trajectories.trajectory import (
    BodyState,
    Performed,
    Stationary,
    Switched,
    Vector,
    ahead,
    rotation,
)

_FLIGHT_M = 2.4
"""Most metres that a thing flies in the rest of the clip, so that the camera can show it."""
_LOFT = {"kick": 0.45, "throw": 0.35}
"""Upward speed of what flies off, as a share of its speed along the ground."""
_TURN_ROUND_S = 0.08
"""Duration of the change of speed at the contact."""
_REBOUND = {"roll": 0.4, "drive": 0.12, "slide": 0.25}
"""Usual motion → share of the speed with which such a body goes back."""
_LENGTHS = (1.0, 2.0)
"""Least and most of its own length that a body covers before the contact."""
_THIN, _ASLANT = 0.6, 0.55
"""Share of its width up to which what is hit has a front, and the way's angle to the picture then,
rad."""


def contact_time(duration_s: float, share: float = 0.45) -> float:
    """Time of the contact of the bodies, s."""
    return min(max(share * duration_s, 0.3), 1.1)


def heading_of(yaw: float) -> Float64Array:
    """The unit vector on the ground towards `yaw` (rad)."""
    return np.array([math.cos(yaw), math.sin(yaw), 0.0])


def kick(subject: Actor, thing: Actor, duration_s: float) -> tuple[Actor, Actor]:
    """The foot meets the thing, the thing flies."""
    contact_s, home = contact_time(duration_s), subject.trajectory.at(0.0)
    activity = "kick" if is_person(subject) else "stand"
    path = Performed(Stationary(home.position, home.yaw), activity, contact_s=contact_s)
    subject = moving(subject, path)
    tip, heading = subject.anchor("right foot", contact_s)[:, 3], heading_of(home.yaw)
    radius, low = 0.5 * thing.model.length, home.position[2]
    inset = 0.0
    if abs(thing.model.length - thing.model.height) < 0.1 * radius:
        inset = radius - math.sqrt(max(radius**2 - (radius - min(tip[2], radius)) ** 2, 0.0))
    spot = np.array([tip[0], tip[1], low + 0.5 * thing.model.height]) + (radius - inset) * heading
    flight = _fly_off("kick", thing, _at(thing, spot, home.yaw), home, (contact_s, duration_s))
    rolling = math.hypot(*flight.velocity_m_s[:2]) / max(0.5 * thing.model.height, 0.05)
    return subject, moving(thing, replace(flight, tumble_rad_s=rolling))


def throw(subject: Actor, thing: Actor, duration_s: float) -> tuple[Actor, Actor]:
    """Let go in the middle of the swing; it flies off."""
    release_s, home = contact_time(duration_s, 0.35), subject.trajectory.at(0.0)
    path = Performed(Stationary(home.position, home.yaw), "throw", contact_s=release_s)
    subject = moving(subject, path)
    reach = 0.5 * min(thing.model.length, thing.model.width) + 0.03
    anchor = "right hand" if is_person(subject) else "mouth"
    held = held_at(subject, anchor, shift(reach, 0.0, -thing.lift_m))
    start = about_pivot(held.at(release_s), thing.lift_m)
    flight = _fly_off("throw", thing, start, home, (release_s, duration_s))
    return subject, moving(thing, Switched(held, replace(flight, tumble_rad_s=6.0), release_s))


def _at(thing: Actor, middle: Float64Array, yaw: float) -> BodyState:
    """The thing with its middle there."""
    place = point(middle - [0.0, 0.0, thing.lift_m])
    return BodyState(place, yaw, pivot_m=thing.lift_m)


def _fly_off(
    act: str, thing: Actor, start: BodyState, home: BodyState, times_s: tuple[float, float]
) -> Flight:
    """From a start to where the subject faces at home, between the contact and the clip's end."""
    speed = min(max(_FLIGHT_M / max(times_s[1] - times_s[0], 0.1), 1.5), 7.0)
    along = speed * heading_of(home.yaw)
    floor = home.position[2] + 0.5 * thing.model.height - start.pivot_m
    velocity = (float(along[0]), float(along[1]), _LOFT[act] * speed)
    return Flight(start, velocity, floor, 0.55, times_s[0])


def collide(subject: Actor, other: Actor, duration_s: float) -> tuple[Actor, Actor]:
    """Both come from left and right and touch at one instant; what is fixed stays.

    Args:
        subject: one of them.
        other: the other one.
        duration_s: length of the clip, s.
    """
    contact_s = contact_time(duration_s, 0.5)
    homes = [actor.trajectory.at(0.0).position for actor in (subject, other)]
    yaws = (0.0, math.pi) if homes[0][0] <= homes[1][0] else (math.pi, 0.0)
    if other.noun.habitat == "fixed":
        return _run_into(subject, other, yaws[0], contact_s)
    if subject.noun.habitat == "fixed":
        other, subject = _run_into(other, subject, yaws[1], contact_s)
        return subject, other
    x, y = (0.5 * (homes[0][axis] + homes[1][axis]) for axis in (0, 1))
    met = []
    for actor, yaw, home in zip((subject, other), yaws, homes, strict=True):
        touching = ahead((x, y, home[2]), yaw, -0.5 * actor.model.length, home[2])
        met.append(moving(actor, _run_up(actor, touching, yaw, contact_s)))
    return met[0], met[1]


def _run_into(mover: Actor, still: Actor, yaw: float, contact_s: float) -> tuple[Actor, Actor]:
    """The mover rebounds; the still object faces it."""
    if still.model.length < _THIN * still.model.width:
        yaw += _ASLANT if yaw == 0.0 else -_ASLANT
        place = still.trajectory.at(0.0).position
        still = replace(still, trajectory=Stationary(place, yaw + math.pi))
    touching = _find_contact(mover, still, yaw, mover.trajectory.at(0.0).position[2])
    return moving(mover, _run_up(mover, touching, yaw, contact_s)), still


def _find_contact(mover: Actor, still: Actor, yaw: float, level_m: float) -> Vector:
    """Origin of a body at its contact with another's middle, along a heading at a height, m."""
    frame = rotation(-yaw, 0.0, 0.0)
    parts = still.own_parts(still.pose(0.0))
    parts = moved(parts, frame @ still.trajectory.at(0.0).to_world())
    y = float((frame @ still.middle(0.0))[1])
    low = level_m + mover.lift_m - 0.5 * mover.model.height
    boxes = [bounds([part]) for part in parts]
    met = [
        box for box in boxes
        if box[0][2] < low + mover.model.height and box[1][2] > low and box[0][1] <= y <= box[1][1]
    ] or boxes  # fmt: skip
    x = min(float(box[0][0]) for box in met) - 0.5 * mover.model.length
    return point(frame.T @ np.array([x, y, level_m]))


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

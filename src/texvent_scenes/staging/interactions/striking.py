"""Kick, throw and collide: an instant of contact, motion before and after it.

Each act gives its subject an activity whose contact is at that instant, finds the place of the body
that touches the thing then, and lets the thing fly from there, or to there.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from texvent_scenes.models.shapes import bounds, moved, point, shift
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.interactions.holding import (
    held_at,
    is_person,
    moving,
)
from texvent_scenes.staging.tracks.keys import Key, Vector, ahead
from texvent_scenes.staging.tracks.phases import speeds_of
from texvent_scenes.staging.tracks.track import (
    BodyState,
    Term,
    Track,
    rotation,
    state_of,
    steady,
)


class Strike(NamedTuple):
    """An act that lets a thing fly off."""

    share: float
    """Instant of contact as a share of the clip."""
    loft: float
    """Upward speed of the thing, as a share of its speed along the ground."""
    tumble_rad_s: float | None = None
    """None = it rolls."""


KICK, THROW = Strike(0.45, 0.45), Strike(0.35, 0.35, 6.0)
_THROWN_M_S = 6.0
"""Speed at which things fly off that have no usual one."""
_TURN_ROUND_S = 0.08
"""Duration of the change of speed at the contact."""
_REBOUND = {"roll": 0.4, "drive": 0.12, "slide": 0.25}
"""Usual motion → share of the speed with which such a body goes back."""
_THIN, _ASLANT = 0.6, 0.55
"""Share of its width up to which what is hit has a front, and the way's angle to the picture then,
rad."""


def contact_time(duration_s: float, share: float = KICK.share) -> float:
    """Time of the contact of the bodies, s."""
    return min(max(share * duration_s, 0.3), 1.1)


def kick(subject: Actor, thing: Actor, duration_s: float) -> tuple[Actor, Actor]:
    """The foot meets the thing, the thing flies."""
    subject, contact_s = _strike(
        subject, "kick" if is_person(subject) else "stand", KICK, duration_s
    )
    home, tip = subject.track.at(0.0), subject.anchor("right foot", contact_s)[:, 3]
    model, inset = thing.model, 0.0
    radius = 0.5 * model.length
    if abs(model.length - model.height) < 0.1 * radius:
        inset = radius - math.sqrt(max(radius**2 - (radius - min(tip[2], radius)) ** 2, 0.0))
    middle_m = home.position[2] + 0.5 * model.height - thing.lift_m
    spot = ahead(point(tip), home.yaw, radius - inset, middle_m)
    start = BodyState(spot, home.yaw, pivot_m=thing.lift_m)
    return subject, moving(thing, _fly_off(KICK, thing, start, home, contact_s))


def throw(subject: Actor, thing: Actor, duration_s: float) -> tuple[Actor, Actor]:
    """Let go in the middle of the swing; it flies off."""
    subject, release_s = _strike(subject, "throw", THROW, duration_s)
    reach = 0.5 * min(thing.model.length, thing.model.width) + 0.03
    anchor = "right hand" if is_person(subject) else "mouth"
    held = held_at(subject, anchor, shift(reach, 0.0, -thing.lift_m))
    start = state_of(held.at(release_s).to_world(), thing.lift_m)
    flight = _fly_off(THROW, thing, start, subject.track.at(0.0), release_s)
    return subject, moving(thing, replace(flight, anchor=held.anchor, release_s=release_s))


def _strike(subject: Actor, activity: str, act: Strike, duration_s: float) -> tuple[Actor, float]:
    """The subject in its place, doing that, and the instant of contact, s."""
    contact_s, home = contact_time(duration_s, act.share), subject.track.at(0.0)
    rest = steady(home.position, home.yaw, activity=activity)
    return moving(subject, replace(rest, contact_s=contact_s)), contact_s


def _fly_off(
    act: Strike, thing: Actor, start: BodyState, home: BodyState, contact_s: float
) -> Track:
    """From a start to where the subject faces at home, after the contact."""
    speed = float(speeds_of(thing.noun).get("throw", _THROWN_M_S))
    half = 0.5 * thing.model.height
    tumble = act.tumble_rad_s or speed / max(half, 0.05)
    flight = Key(1.0, speed, climb_m_s=act.loft * speed, ramp_s=0.0, restitution=0.55)
    turned = start.pitch - tumble * contact_s
    terms = (
        Term("yaw", offset=start.yaw - home.yaw), Term("roll", offset=start.roll),
        Term("pitch", offset=turned, drift=tumble, begin_s=contact_s),
    )  # fmt: skip
    floor = home.position[2] + half - start.pivot_m
    keys = (Key(contact_s), flight)
    return Track(start.position, home.yaw, keys, terms, floor_m=floor, pivot_m=start.pivot_m)


_RAISED_M, _LEAST_ROOM_M = 0.02, 0.02
"""Height from which on a body stands on another one; the least way to a contact there, m."""


def collide(subject: Actor, other: Actor, duration_s: float) -> tuple[Actor, Actor]:
    """Both come from left and right and touch at one instant; what is fixed stays.

    Args:
        subject: one of them.
        other: the other one.
        duration_s: length of the clip, s.
    """
    contact_s = contact_time(duration_s, 0.5)
    homes = [actor.track.at(0.0).position for actor in (subject, other)]
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
        place = still.track.at(0.0).position
        still = replace(still, track=steady(place, yaw + math.pi, activity="stand"))
    touching = _find_contact(mover, still, yaw, mover.track.at(0.0).position[2])
    return moving(mover, _run_up(mover, touching, yaw, contact_s)), still


def _find_contact(mover: Actor, still: Actor, yaw: float, level_m: float) -> Vector:
    """Origin of a body at its contact with another's middle, along a heading at a height, m."""
    frame = rotation(-yaw, 0.0, 0.0)
    parts = still.own_parts(still.pose(0.0))
    parts = moved(parts, frame @ still.track.at(0.0).to_world())
    y = float((frame @ still.middle(0.0))[1])
    low = level_m + mover.lift_m - 0.5 * mover.model.height
    boxes = [bounds([part]) for part in parts]
    met = [
        box for box in boxes
        if box[0][2] < low + mover.model.height and box[1][2] > low and box[0][1] <= y <= box[1][1]
    ] or boxes  # fmt: skip
    x = min(float(box[0][0]) for box in met) - 0.5 * mover.model.length
    return point(frame.T @ np.array([x, y, level_m]))


def _run_up(actor: Actor, touching: Vector, yaw: float, contact_s: float) -> Track:
    """Along the ground to where it touches, and a little back; on a table from its place there."""
    length = actor.model.length
    speed = actor.noun.speed_m_s or length / contact_s
    if touching[2] > _RAISED_M and actor.noun.habitat in ("ground", "fixed"):
        room_m = math.dist(actor.track.at(0.0).position[:2], touching[:2])
        speed = min(speed, max(room_m, _LEAST_ROOM_M) / contact_s)
    back = speed * _REBOUND.get(actor.noun.motion, 0.0)
    keys = (
        Key(0.0, speed),
        Key(contact_s, speed),
        Key(0.25, -back, ramp_s=_TURN_ROUND_S),
        Key(0.6, 0.0, ramp_s=0.6),
        Key(0.1, activity="stand"),
    )
    return Track(ahead(touching, yaw, -speed * contact_s, touching[2]), yaw, keys)

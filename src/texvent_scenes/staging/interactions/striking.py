"""Impacts: kick, throw and collide as rows of one mechanism.

An act gives its subject an activity whose contact is at an instant, finds the place of the body
that touches the thing then, and lets the thing fly from there; or two bodies run up to each other.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import Literal, NamedTuple

import numpy as np

from texvent_scenes.models.activities import ACTIVITIES, HAND_NOUNS, ON_TOP
from texvent_scenes.models.shapes import bounds, moved, point, shift
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor, size_of
from texvent_scenes.staging.interactions.by_hand import BY_HAND, act_by_hand
from texvent_scenes.staging.interactions.holding import (
    held_at,
    is_person,
    moving,
)
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2, Key, Vector, ahead, arc, flight_s
from texvent_scenes.staging.tracks.phases import speeds_of
from texvent_scenes.staging.tracks.track import (
    Attachment,
    BodyState,
    Term,
    Track,
    ballistic,
    rotation,
    state_of,
    steady,
)


class Impact(NamedTuple):
    """An act with one instant of contact, at which what moved so far moves on in another way."""

    share: float
    """Instant of the contact as a share of the clip."""
    activity: str | None = None
    """Activity of the person who does it in place; None = both run up and recoil."""
    by: str = ""
    """Place of the body that touches the thing."""
    is_held: bool = False
    """Whether the thing is at that place until then; else it waits where it is met."""
    loft: float = 0.0
    """Upward speed of the thing, as a share of its speed along the ground."""
    tumble_rad_s: float | None = None
    """None = it rolls."""
    is_flung: bool = True
    """Whether the thing leaves the body at a speed."""
    is_caught: bool = False
    """Whether the thing comes flying, and stays at that place from then on."""
    carried: Literal["before", "after"] | None = None
    """When the thing is at that place, if it stands on the ground else."""
    top_m: float = 0.0
    """Height of what it stands on then, for a body of the usual size."""


_BENCH_M = 0.846
"""Height of a bench before a body of the usual size."""
IMPACTS: Mapping[str, Impact] = MappingProxyType(
    {
        "kick": Impact(0.45, "kick", "right foot", loft=0.45),
        "throw": Impact(0.35, "throw", "right hand", is_held=True, loft=0.35, tumble_rad_s=6.0),
        "roll": Impact(0.35, "underarm", "right hand", is_held=True),
        "lift": Impact(0.4, "pick up", "hands", carried="after"),
        "set down": Impact(0.5, "put down", "hands", carried="before"),
        ON_TOP["lift"]: Impact(0.4, ON_TOP["lift"], "hands", carried="after", top_m=_BENCH_M),
        ON_TOP["set down"]: Impact(
            0.5, ON_TOP["set down"], "hands", carried="before", top_m=_BENCH_M
        ),
        "drop": Impact(0.3, "let go", "hands", is_held=True, is_flung=False),
        "catch": Impact(0.45, "catch", "hands", is_caught=True),
        "hit": Impact(0.45, by="right hand", loft=0.22, tumble_rad_s=9.0),
        "collide": Impact(0.5),
        "knock over": Impact(0.4),
    }
)
"""Relation → how its bodies meet."""
_FLUNG_M_S, _RESTITUTION = 6.0, 0.55
"""Speed at which things fly off that have no usual one; what each bounce keeps of it."""
LEAD_S = 0.45
"""Time from the stated start of an act to its contact."""
_TURN_ROUND_S = 0.08
"""Duration of the change of speed at the contact."""
_DELIVERED_M, _MOST_FLIGHT_S, _LOW = 4.0, 1.0, 0.12
"""Way of what is sent to a receiver, m; its time, s; upward share of its speed along the ground."""
_MOST_COME = 0.6
"""Most way of what comes to be hit, as a share of that on which it then goes."""
_PITCHED_M, _ON_TEE = 2.6, 0.2
"""Most way of what comes to be hit, m; height below which it waits on the ground, in that of who
hits it."""
_LEAP, _SPIN_RAD_S, _THROWN = 0.6, 9.0, 2.6
"""Height to which an animal leaps for what it catches, in its own; rate of turning of what is
caught; most way that it comes, in heights of who catches it."""
_REBOUND = {"roll": 0.4, "drive": 0.12, "slide": 0.25}
"""Usual motion → share of the speed with which such a body goes back."""
_THIN, _ASLANT = 0.6, 0.55
"""Share of its width up to which what is hit has a front, and the way's angle to the picture then,
rad."""


def contact_time(duration_s: float, share: float) -> float:
    """Time of the contact of the bodies, s."""
    return min(max(share * duration_s, 0.3), 1.1)


def strike(
    kind: str, subject: Actor, thing: Actor, duration_s: float, _: int = 0
) -> tuple[Actor, Actor]:  # fmt: skip
    """Both bodies of an act of `IMPACTS`, bound by the instant of contact."""
    act = IMPACTS[kind]
    contact_s = subject.track.contact_s
    if contact_s is None:
        contact_s = contact_time(duration_s, act.share)
    if kind == "hit" and is_person(subject):  # others run against it
        return _bat(act, subject, thing, contact_s)
    if act.activity is None:
        meet = _knock_over if kind == "knock over" else _run_together
        return meet(subject, thing, contact_s)
    home = subject.track.at(0.0)
    if subject.noun.name in HAND_NOUNS and kind in BY_HAND:
        return act_by_hand(kind, subject, thing, contact_s)
    if act.is_caught:
        return _catch(act, subject, thing, contact_s)
    is_limbed = is_person(subject) or act.is_held
    rest = steady(home.position, home.yaw, activity=act.activity if is_limbed else "stand")
    props = subject.props if act.top_m else ()
    subject = moving(subject, replace(rest, contact_s=contact_s))
    if act.carried is not None:
        subject = replace(subject, props=props or subject.props)
        return subject, moving(thing, _carry(act, subject, thing, contact_s))
    if not act.is_held:
        tip = subject.anchor(act.by, contact_s)[:, 3]
        start = BodyState(_meet(thing, tip, home), home.yaw, pivot_m=thing.lift_m)
        return subject, moving(thing, _fly_off(act, thing, start, home, contact_s))
    reach = 0.5 * min(thing.model.length, thing.model.width) + 0.03
    place = act.by if is_person(subject) else "mouth"
    reach = reach if act.is_flung else 0.0
    held = held_at(subject, place, shift(reach, 0.0, -thing.lift_m), is_upright=not act.is_flung)
    start = state_of(held.at(contact_s).to_world(), thing.lift_m)
    flight = _fly_off(act, thing, start, home, contact_s)
    return subject, moving(thing, replace(flight, anchor=held.anchor, release_s=contact_s))


def _catch(act: Impact, subject: Actor, thing: Actor, contact_s: float) -> tuple[Actor, Actor]:
    """In free flight to a place of the body, which has it from then on; an animal leaps for it."""
    home, place = subject.track.at(0.0), act.by if is_person(subject) else "mouth"
    path = steady(home.position, home.yaw, activity=act.activity or "stand")
    if not is_person(subject):
        path = _leap(subject, contact_s)
    subject = moving(subject, replace(path, contact_s=contact_s if is_person(subject) else None))
    held = held_at(subject, place, shift(0.0, 0.0, -thing.lift_m), is_upright=True)
    end = state_of(held.at(contact_s).to_world(), thing.lift_m)
    most_m = min(_DELIVERED_M, _THROWN * subject.model.height)
    speed = min(float(speeds_of(thing.noun).get("throw", _FLUNG_M_S)), most_m / contact_s)
    start = ahead(end.position, home.yaw, speed * contact_s, end.position[2])
    flight = ballistic(
        start, home.yaw + math.pi, speed, 0.5 * GRAVITY_M_S2 * contact_s,
        floor_m=home.position[2] + 0.5 * thing.model.height - end.pivot_m, restitution=0.0,
    )  # fmt: skip
    terms = (Term("yaw", offset=end.yaw - home.yaw - math.pi, drift=_SPIN_RAD_S, end_s=contact_s),)
    turned = terms[0]._replace(offset=terms[0].offset - _SPIN_RAD_S * contact_s)
    flight = replace(flight, terms=(turned,), pivot_m=end.pivot_m, anchor=held.anchor)
    return subject, moving(thing, replace(flight, grab_s=contact_s))


def _bat(act: Impact, subject: Actor, thing: Actor, contact_s: float) -> tuple[Actor, Actor]:
    """In free flight to what is swung, and back from there; a golf ball waits on the ground."""
    home = subject.track.at(0.0)
    rest = steady(home.position, home.yaw, activity=home.activity)
    props, act_of = subject.props, ACTIVITIES[home.activity]
    subject = moving(subject, replace(rest, contact_s=contact_s))
    subject, home = (
        replace(subject, props=props), home.with_fields(yaw=home.yaw + act_of.sends_rad)
    )  # fmt: skip
    axes = subject.anchor(act.by, contact_s)
    tip = axes @ np.array([0.0, 0.0, act_of.reach_m * size_of(subject.model), 1])
    if tip[2] < home.position[2] + _ON_TEE * subject.model.height:
        start = BodyState(_meet(thing, tip, home), home.yaw, pivot_m=thing.lift_m)
        return subject, moving(thing, _fly_off(act, thing, start, home, contact_s))
    met = tip - [0.0, 0.0, thing.lift_m]
    speed = float(speeds_of(thing.noun).get("throw", _FLUNG_M_S))
    slow = min(speed, _PITCHED_M / contact_s)
    start_m = ahead(point(met), home.yaw, slow * contact_s, float(met[2]))
    flight = ballistic(
        start_m, home.yaw + math.pi, slow, 0.5 * GRAVITY_M_S2 * contact_s,
        floor_m=home.position[2], restitution=_RESTITUTION,
    )  # fmt: skip
    come = replace(flight.keys[-1], duration_s=contact_s, ramp_s=0.0)
    back = replace(come, duration_s=1.0, speed_m_s=-speed, climb_m_s=act.loft * speed)
    return subject, moving(thing, replace(flight, keys=(flight.keys[0], come, back)))


def _leap(subject: Actor, contact_s: float) -> Track:
    """Up on the spot, highest at the contact."""
    home = subject.track.at(0.0)
    flown_s = min(flight_s(_LEAP * subject.model.height), contact_s)
    leap = Key(flown_s, hop_m=GRAVITY_M_S2 * flown_s**2 / 8.0, activity="jump")
    waits = Key(max(contact_s - 0.5 * flown_s, 1e-3), activity="stand")
    return Track(home.position, home.yaw, (waits, leap, Key(0.1, activity="stand")))


def _carry(act: Impact, subject: Actor, thing: Actor, contact_s: float) -> Track:
    """At rest below the place of the body that has it before or after, and there as it was."""
    home = subject.track.at(0.0)
    x, y, _ = point(subject.anchor(act.by, contact_s)[:, 3])
    low_m = home.position[2] + act.top_m * size_of(subject.model)
    rest = steady((x, y, low_m + thing.foot_m), home.yaw, activity="stand")
    anchor = _grasp(act.by, subject, rest, contact_s)
    if act.carried == "after":
        return replace(rest, anchor=anchor, grab_s=contact_s)
    return replace(rest, anchor=anchor, release_s=contact_s)


def _grasp(by: str, subject: Actor, path: Track, contact_s: float) -> Attachment:
    """The bond to a place of the body of what is where its path takes it at the contact."""
    axes = partial(subject.anchor, by)
    world = (axes(contact_s), path.at(contact_s).to_world())
    square = (np.vstack([one, [0.0, 0.0, 0.0, 1.0]]) for one in world)
    return Attachment(subject.track, axes, np.linalg.solve(*square)[:3])


def _meet(thing: Actor, tip: Float64Array, home: BodyState) -> Vector:
    """Origin of a thing on the ground of `home` that a point [3] of a body just touches."""
    model, inset, radius = thing.model, 0.0, 0.5 * thing.model.length
    if abs(model.length - model.height) < 0.1 * radius:
        inset = radius - math.sqrt(max(radius**2 - (radius - min(tip[2], radius)) ** 2, 0.0))
    middle_m = home.position[2] + 0.5 * model.height - thing.lift_m
    return ahead(point(tip), home.yaw, radius - inset, middle_m)


def _fly_off(
    act: Impact, thing: Actor, start: BodyState, home: BodyState, contact_s: float
) -> Track:
    """From a start to where the subject faces at home, after the contact."""
    speed = float(speeds_of(thing.noun).get("throw", _FLUNG_M_S)) * act.is_flung
    half = 0.5 * thing.model.height
    tumble = act.tumble_rad_s or speed / max(half, 0.05)
    turned = start.pitch - tumble * contact_s
    terms = (
        Term("yaw", offset=start.yaw - home.yaw), Term("roll", offset=start.roll),
        Term("pitch", offset=turned, drift=tumble, begin_s=contact_s),
    )  # fmt: skip
    flight = ballistic(
        start.position, home.yaw, speed, act.loft * speed, wait_s=contact_s,
        restitution=_RESTITUTION, floor_m=home.position[2] + half - start.pivot_m,
    )  # fmt: skip
    return replace(flight, terms=terms, pivot_m=start.pivot_m)


def rebound(thing: Actor, wall: Actor, *, is_turned: bool, is_moved: bool) -> tuple[Actor, Actor]:
    """Both, the thing that flies off going back from the wall; or as they were.

    A thing that flies past the wall, or does not fly, stays as it is.

    Args:
        thing: what is kicked or thrown.
        wall: what it is sent against.
        is_turned: whether the wall may be turned to face it.
        is_moved: whether the wall may be moved into its way.
    """
    track, (x, y, level_m), before = thing.track, wall.track.at(0.0).position, wall
    flight, half = track.keys[-1], 0.5 * thing.model.width
    if is_turned:
        wall = replace(wall, track=steady((x, y, level_m), track.yaw + math.pi, activity="stand"))
    left = np.array([-math.sin(track.yaw), math.cos(track.yaw)])
    aside = (wall.corners(0.0)[:, :2] - track.start[:2]) @ left
    step = min(-half - float(aside.min()), 0.0) + max(half - float(aside.max()), 0.0)
    if flight.speed_m_s <= 0.0 or (step and not is_moved):
        return thing, before
    x, y, level_m = wall.track.start
    shifted = (x + step * float(left[0]), y + step * float(left[1]), level_m)
    wall = replace(wall, track=replace(wall.track, start=shifted))
    way = np.subtract(_find_contact(thing, wall, track.yaw, level_m), track.start)
    flown_s = (way[0] * math.cos(track.yaw) + way[1] * math.sin(track.yaw)) / flight.speed_m_s
    if flown_s <= 0.0:
        return thing, wall
    met_s = sum(key.duration_s for key in track.keys[:-1]) + flown_s
    low, high = (track.at(met_s + step).position[2] for step in (-_STEP_S, _STEP_S))
    back = replace(
        flight, speed_m_s=-_KEPT * flight.speed_m_s, climb_m_s=(high - low) / (2.0 * _STEP_S)
    )
    keys = (*track.keys[:-1], replace(flight, duration_s=flown_s), back)
    return replace(thing, track=replace(track, keys=keys)), wall


def deliver(
    thing: Actor, receiver: Actor, duration_s: float, *, is_thrown: bool, is_placed: bool = False,
    is_taken: bool = False,
) -> tuple[Actor, Actor]:  # fmt: skip
    """Both, the thing ending at who receives it: caught if it is thrown, else before the feet.

    A person takes up from there what `is_taken`.

    The receiver stands on its way and faces it; it flies to one who is placed.
    """
    track, person = thing.track, is_person(receiver)
    sent_s, size = sum(key.duration_s for key in track.keys[:-1]), size_of(receiver.model)
    flown_s = min(max(duration_s - sent_s - 0.2, 0.2), _MOST_FLIGHT_S)
    sense = math.copysign(1.0, track.keys[-1].speed_m_s)  # what is hit goes back as it came
    speed = min(abs(track.keys[-1].speed_m_s), _DELIVERED_M / flown_s)
    (x, y, z), level_m = track.at(sent_s).position, receiver.track.at(0.0).position[2]
    caught_m = level_m + (1.08 * size if person else 0.62 * receiver.model.height) - thing.lift_m
    up = (caught_m - z) / flown_s + 0.5 * GRAVITY_M_S2 * flown_s
    flight = replace(
        track.keys[-1], duration_s=flown_s, speed_m_s=sense * speed, climb_m_s=up, ramp_s=0.0
    )
    last = Key(1.0, ramp_s=0.0) if is_thrown else Key(1.0, ramp_s=0.15, restitution=0.2)
    if not is_thrown:
        flight = replace(flight, climb_m_s=_LOW * speed)
    terms = (one._replace(end_s=sent_s + flown_s) if one.drift else one for one in track.terms)
    sent = replace(track, keys=(*track.keys[:-1], flight, last), terms=tuple(terms))
    arm_m = 0.36 * size if person else 0.5 * receiver.model.length
    if is_placed:
        over = np.subtract(receiver.track.at(0.0).position[:2], (x, y))
        room_m = arm_m + (0.0 if is_thrown else 0.5 * thing.model.length)
        slows_s = 0.5 * last.ramp_s
        speed = max(float(np.hypot(*over)) - room_m, 0.0) / (flown_s + slows_s)
        flight = replace(flight, speed_m_s=sense * speed)
        sent = _aimed(replace(sent, keys=(*track.keys[:-1], flight, last)), over)
        track = replace(track, yaw=sent.yaw)
    way_m = speed * flown_s + arm_m + (0.0 if is_thrown else 0.5 * thing.model.length)
    heading = track.yaw if sense > 0.0 else track.yaw + math.pi
    place = ahead((x, y, level_m), heading, way_m, level_m)
    place = receiver.track.at(0.0).position if is_placed else place
    rest = steady(place, heading + math.pi, activity="stand")
    if is_thrown and not person:
        return _leap_for(replace(thing, track=sent), replace(receiver, track=rest), flown_s)
    if is_thrown:
        side, high = 0.5 * thing.model.width, 1.08 * size
        rest = replace(
            rest, grips=(("left hand", (arm_m, side, high)), ("right hand", (arm_m, -side, high)))
        )
    if is_taken and person and not is_thrown:
        taken_s = sent_s + flown_s + last.ramp_s
        rest = replace(steady(place, rest.yaw, activity="pick up"), contact_s=taken_s)
        receiver = moving(receiver, rest)
        anchor = _grasp("hands", receiver, sent, taken_s)
        return replace(thing, track=replace(sent, anchor=anchor, grab_s=taken_s)), receiver
    return replace(thing, track=sent), moving(receiver, rest)


def _aimed(track: Track, way: Float64Array) -> Track:
    """The track of what is sent, its flight along a way [2]; what is hit comes from there."""
    flight, came_s = track.keys[-2], sum(key.duration_s for key in track.keys[:-2])
    x, y, z = track.at(came_s).position
    sense = math.copysign(1.0, flight.speed_m_s)
    heading = math.atan2(way[1], way[0]) + (math.pi if sense < 0.0 else 0.0)
    turn = math.remainder(heading - track.yaw, math.tau)
    came_m = float(np.hypot(x - track.start[0], y - track.start[1]))
    near = min(1.0, _MOST_COME * float(np.hypot(way[0], way[1])) / max(came_m, 1e-9))
    come = (replace(one, speed_m_s=near * one.speed_m_s) for one in track.keys[:-2])
    terms = (one._replace(offset=one.offset - turn * (one.channel == "yaw"))
             for one in track.terms)  # fmt: skip
    return replace(
        track, start=ahead((x, y, z), track.yaw + turn, -near * came_m, track.start[2]),
        yaw=track.yaw + turn, keys=(*come, *track.keys[-2:]), terms=tuple(terms),
    )  # fmt: skip


def _leap_for(thing: Actor, animal: Actor, flown_s: float) -> tuple[Actor, Actor]:
    """Both, the thing that is thrown ending at the mouth of an animal that leaps for it."""
    track, flight = thing.track, thing.track.keys[-2]
    sense = math.copysign(1.0, flight.speed_m_s)
    caught_s = sum(key.duration_s for key in track.keys[:-1])
    animal = moving(animal, _leap(animal, caught_s))
    held = held_at(animal, "mouth", shift(0.0, 0.0, -thing.lift_m), is_upright=True)
    end = held.at(caught_s).position
    way, hop_m = (
        np.subtract(end, track.at(caught_s - flown_s).position),
        end[2] - held.at(0.0).position[2],
    )
    up_m_s = float(way[2]) / flown_s + 0.5 * GRAVITY_M_S2 * flown_s
    speed_m_s = float(np.hypot(*way[:2])) / flown_s
    flight = replace(flight, speed_m_s=sense * speed_m_s, climb_m_s=up_m_s)
    keys = (*track.keys[:-2], flight, Key(1.0, ramp_s=0.0, restitution=0.0))  # down with it
    floor_m = float(end[2] - hop_m)
    track = replace(_aimed(replace(track, keys=keys), way), floor_m=floor_m)
    return replace(thing, track=track), animal


_STEP_S, _KEPT = 1e-3, 0.6
"""Half of the time over which a speed is measured; share of a speed after a wall."""
_RAISED_M, _LEAST_ROOM_M = 0.02, 0.02
"""Height from which on a body stands on another one; the least way to a contact there, m."""


def _run_together(subject: Actor, other: Actor, contact_s: float) -> tuple[Actor, Actor]:
    """Both come from left and right and touch at one instant; what is fixed stays."""
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


def _knock_over(subject: Actor, thing: Actor, contact_s: float) -> tuple[Actor, Actor]:
    """The subject runs against the thing, which falls over away from it, where both stand level."""
    homes = [actor.track.at(0.0).position for actor in (subject, thing)]
    if abs(homes[0][2] - homes[1][2]) > _RAISED_M:
        return subject, thing
    yaw = 0.0 if homes[0][0] <= homes[1][0] else math.pi
    subject, thing = _run_into(subject, replace(thing, track=steady(homes[1], yaw)), yaw, contact_s)
    edge_m = float(bounds(thing.own_parts(thing.pose(0.0)))[1][0])
    keys = (
        Key(contact_s, activity="stand"),
        Key(_TIPPED_S, ramp_s=_TIPPED_S, activity="stand", pitch_rad=0.5 * math.pi),
    )
    way = thing.track.at(0.0)
    return subject, moving(thing, Track(way.position, yaw, keys, edge_m=edge_m))


_TIPPED_S, _TURNED_S, _LEAST_TURN = 0.5, 0.8, 0.5
"""Times that a body takes to fall over and to turn after a contact, s; least turn, rad."""


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
    """Along the ground to where it touches, and a little back; on a table from its place there.

    It brakes as hard at any speed. What is said to turn round does so then, and goes on.
    """
    length = actor.model.length
    haste = max(actor.haste, 1.0)
    speed = actor.haste * (actor.noun.speed_m_s or length / contact_s)
    if touching[2] > _RAISED_M and actor.noun.habitat in ("ground", "fixed"):
        room_m = math.dist(actor.track.at(0.0).position[:2], touching[:2])
        speed = min(speed, max(room_m, _LEAST_ROOM_M) / contact_s)
    back = speed * _REBOUND.get(actor.noun.motion, 0.0)
    keys: tuple[Key, ...] = (
        Key(0.0, speed),
        Key(contact_s, speed),
        Key(0.25, -back, ramp_s=_TURN_ROUND_S),
        Key(0.6 * haste, 0.0, ramp_s=0.6 * haste),
        Key(0.1, activity="stand"),
    )
    turn = actor.track.at(actor.track.duration_s).yaw - actor.track.at(0.0).yaw
    if abs(turn) > _LEAST_TURN:
        keys = (*keys[:3], *arc(_TURNED_S, 0.0, turn, 0.0), Key(1.0, speed))
    return Track(ahead(touching, yaw, -speed * contact_s, touching[2]), yaw, keys)

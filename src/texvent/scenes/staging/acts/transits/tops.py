"""Off the top of a thing, and onto it: jumped, rolled, fallen, walked or flown."""

from __future__ import annotations

import math
from dataclasses import replace

from texvent.scenes.description import ObjectMotion
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.transits.surfaces import (
    Top,
    ahead_of,
    find_top,
    half_along,
    height_at,
    rest_height,
)
from texvent.scenes.staging.trajectories.legs import Leg, Legs, flight_s
from texvent.scenes.staging.trajectories.trajectory import (
    Stationary,
    Trajectory,
    Vector,
)

ROLLING, FALLING, JUMPING = frozenset({"roll", "bounce"}), frozenset({"fall"}), frozenset({"jump"})
FLYING = frozenset({"fly", "rise"})
"""Motions in which a body leaves a top, or comes onto it, each in its own way."""
_WAIT, _EDGE = 0.2, 0.45
"""Shares of the clip after which what stands jumps, and what rolls is at the edge."""
_MOST_WAIT_S, _MOST_EDGE_S = 0.7, 1.3
_TOWARDS_RAD = 0.2
"""How far the way leads towards the viewer."""
_FLAT = 0.4
"""Height below which a thing is flat, as a share of its length and width."""
_CLEAR = 0.3
"""How high above both ends a jump goes, in heights of the body."""


def choose_yaw(subject: Actor, target: Actor) -> float:
    """To the left or to the right, as it goes anyhow, and a little towards the viewer.

    A conveyor belt decides itself.
    """
    if target.noun.name == "conveyor belt":
        return target.trajectory.at(0.0).yaw
    is_right = math.cos(subject.trajectory.at(0.0).yaw) >= 0.0
    return -_TOWARDS_RAD if is_right else math.pi + _TOWARDS_RAD


def _along_picture(target: Actor) -> Actor:
    """A conveyor belt, seen from the side."""
    path = target.trajectory
    if target.noun.name != "conveyor belt" or not isinstance(path, Stationary):
        return target
    return replace(target, trajectory=replace(path, yaw=-_TOWARDS_RAD))


def aside(path: Legs, across_m: float) -> Legs:
    """The same way so far to its left."""
    shift = (-across_m * math.sin(path.yaw), across_m * math.cos(path.yaw))

    def move(place: Vector) -> Vector:
        return (place[0] + shift[0], place[1] + shift[1], place[2])

    legs = tuple(replace(leg, end=move(leg.end)) for leg in path.legs)
    return replace(path, start=move(path.start), legs=legs)


def with_path(subject: Actor, path: Trajectory) -> Actor:
    """The body on its way."""
    return replace(subject, trajectory=path, is_mover=True, lead_m=0.0, extras=())


def leave_top(
    subject: Actor, target: Actor, motion: ObjectMotion, duration_s: float, turn: float
) -> tuple[Actor, Actor]:
    """From the top of a thing to the ground beside it; what flies goes up.

    Args:
        subject: the body.
        target: the thing, which stays.
        motion: of the subject.
        duration_s: length of the clip, s.
        turn: 0 for the first of several that follow each other .. 1 for the last.
    """
    kind = motion.kind
    target = _along_picture(target)
    yaw = choose_yaw(subject, target)
    top = find_top(target, yaw)
    lift, half = rest_height(subject), half_along(subject)
    up, down = float(top.middle[2]) + lift, float(target.trajectory.at(0.0).position[2]) + lift
    wait_s = min(_WAIT * duration_s, _MOST_WAIT_S) * (1.0 + 1.5 * turn)
    if kind in FLYING:
        begin = ahead_of(top.middle, yaw, 0.0, up)
        size = max(subject.size_m, 0.3)
        end = ahead_of(top.middle, yaw, 3.5 * size, up + 2.0 * size)
        flown = (Leg(begin, wait_s, "stand"), Leg(end, duration_s - wait_s, "move"))
        return with_path(subject, Legs(begin, yaw, flown)), target
    if kind in JUMPING:
        start = max(top.edge_m - 0.8 * half, 0.0)
        up = height_at(target, top, yaw, start) + lift
        begin = ahead_of(top.middle, yaw, start, up)
        apex = up + _CLEAR * subject.model.height
        land = top.side_m + 1.3 * half + 0.25 * (up - down)
        end = ahead_of(top.middle, yaw, land, down)
        legs = (
            Leg(begin, wait_s, "stand"),
            Leg(end, flight_s(up, down, apex), "jump", is_flight=True),
            Leg(end, duration_s, "stand"),
        )
        return with_path(subject, Legs(begin, yaw, legs)), target
    heights, is_belt = (up, down), target.noun.name == "conveyor belt"
    go = _go_off_belt if is_belt else _go_over_edge
    return with_path(subject, go(subject, top, yaw, kind, heights, duration_s, turn)), target


def _go_over_edge(
    subject: Actor,
    top: Top,
    yaw: float,
    kind: str,
    heights: tuple[float, float],
    duration_s: float,
    turn: float,
) -> Legs:
    """It goes to the edge, falls beyond it, and goes on or stays there."""
    up, down = heights
    half, tall = half_along(subject), subject.model.height
    edge_s = min(_EDGE * duration_s, _MOST_EDGE_S) * (0.7 + 0.9 * turn)
    is_fall = kind in FALLING or kind == "slide"
    room = top.edge_m + 0.6 * min(top.edge_m, 0.8)
    run = min(room, 2.0 * half + 0.15 if is_fall else max(4.0 * half, 0.7))
    over = top.edge_m + 0.05 * half
    speed = max(run / edge_s, 0.25)
    fall_s = flight_s(up, down, up)
    land = max(over + speed * fall_s, top.side_m + 1.05 * half + 0.12)
    begin = ahead_of(top.middle, yaw, over - run, up)
    brink = ahead_of(top.middle, yaw, over, up)
    gait = kind if kind in ("walk", "run") else "stand" if is_fall else "move"
    if is_fall:
        # It ends on its side, its middle as high as half its width; what is flat on its back.
        is_flat = tall < _FLAT * min(subject.model.length, subject.model.width)
        fallen = math.pi if is_flat else 0.5 * math.pi
        lying = down + 0.5 * min(subject.model.length, subject.model.width) - 0.5 * tall
        lying = down if is_flat or subject.is_centred else lying
        end = ahead_of(top.middle, yaw, land + 0.5 * tall, lying)
        legs = (
            Leg(brink, edge_s, gait),
            Leg(end, fall_s, "stand", is_flight=True, tumble_rad=fallen),
            Leg(end, duration_s, "stand"),
        )  # fmt: skip
        pivot = 0.0 if subject.is_centred else 0.5 * tall
        return Legs(begin, yaw, legs, pivot_m=pivot)
    rolls = kind in ROLLING and abs(subject.model.length - tall) < 0.3 * tall
    end = ahead_of(top.middle, yaw, land, down)
    left = max(duration_s - edge_s - fall_s, 0.2)
    far = ahead_of(top.middle, yaw, land + 0.5 * speed * left, down)
    legs = (
        Leg(brink, edge_s, gait),
        Leg(end, fall_s, gait, is_flight=True),
        Leg(far, left, gait, slows=True),
    )
    pivot = 0.5 * tall if rolls else 0.0
    return Legs(begin, yaw, legs, radius_m=pivot, pivot_m=pivot)


def _go_off_belt(
    subject: Actor,
    top: Top,
    yaw: float,
    kind: str,
    heights: tuple[float, float],
    duration_s: float,
    turn: float,
) -> Legs:
    """Carried to the belt's end, one after the other; each slides on from where it falls."""
    up, down = heights
    half = half_along(subject)
    edge_s = (0.2 + 0.5 * turn) * duration_s
    speed = max(5.0 * half / duration_s, 0.5)
    over, fall_s = top.edge_m, flight_s(up, down, up)
    land = max(over + speed * fall_s, top.side_m + 1.5 * half)
    left = max(duration_s - edge_s - fall_s, 0.2)
    far = land + 2.6 * half * (1.0 - turn) + 0.3 * half
    legs = (
        Leg(ahead_of(top.middle, yaw, over, up), edge_s, "stand"),
        Leg(ahead_of(top.middle, yaw, land, down), fall_s, "stand", is_flight=True),
        Leg(ahead_of(top.middle, yaw, far, down), min(left, 0.6), "stand", slows=True),
        Leg(ahead_of(top.middle, yaw, far, down), duration_s, "stand"),
    )
    return Legs(ahead_of(top.middle, yaw, over - speed * edge_s, up), yaw, legs)


def come_onto(
    subject: Actor, target: Actor, motion: ObjectMotion, duration_s: float, turn: float
) -> tuple[Actor, Actor]:
    """From the ground beside a thing onto its top; what flies comes down from the air."""
    kind = motion.kind
    yaw = choose_yaw(subject, target)
    back = yaw + math.pi
    top = find_top(target, back)
    lift, half = rest_height(subject), half_along(subject)
    up, down = float(top.middle[2]) + lift, float(target.trajectory.at(0.0).position[2]) + lift
    wait_s = min(_WAIT * duration_s, _MOST_WAIT_S) * (1.0 + 1.5 * turn)
    inside = max(top.edge_m - max(1.3 * half, 0.2), 0.0) if turn == 0.0 else 0.0
    inside = min(inside, 0.5 * top.edge_m)
    up = height_at(target, top, back, inside) + lift
    end = ahead_of(top.middle, back, inside, up)
    if kind in FLYING | {"sink", "hover"}:
        size = max(subject.size_m, 0.3)
        begin = ahead_of(top.middle, back, 3.5 * size, up + 1.8 * size)
        fly_s = 0.7 * duration_s
        flown = (Leg(end, fly_s, "move", slows=True), Leg(end, duration_s, "stand"))
        return with_path(subject, Legs(begin, yaw, flown)), target
    begin = ahead_of(top.middle, back, top.side_m + 1.3 * half + 0.3 * (up - down), down)
    is_leap = kind in JUMPING
    apex = up + (_CLEAR if is_leap else 0.08) * subject.model.height
    gait = kind if kind in ("walk", "run") else "move"
    far = begin if is_leap else ahead_of(top.middle, back, top.side_m + 3.5 * half, down)
    near = ahead_of(top.middle, back, top.side_m + 1.1 * half, down)
    first = Leg(begin, wait_s, "stand") if is_leap else Leg(near, 2.0 * wait_s, gait)
    legs = (
        first,
        Leg(end, flight_s(down, up, apex), "jump", is_flight=True),
        Leg(end, duration_s, "stand"),
    )
    return with_path(subject, Legs(far, yaw, legs)), target

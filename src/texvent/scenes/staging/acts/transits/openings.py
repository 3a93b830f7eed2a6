"""Through what has an opening: a hoop, a window, a goal, a tunnel; and half way into it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from texvent.scenes.description import ObjectMotion
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.transits.surfaces import half_along, rest_height
from texvent.scenes.staging.acts.transits.tops import with_path
from texvent.scenes.staging.acts.transits.vessels import Tipped
from texvent.scenes.staging.trajectories.legs import Leg, Legs, flight_s
from texvent.scenes.staging.trajectories.trajectory import Stationary, Trajectory, Vector

OPENINGS = frozenset({"hula hoop", "window", "goal"})
"""Nouns that one goes through along their front, besides gates."""
_MIDDLES = {"hula hoop": 0.5, "window": 0.69}
"""Height of the middle of an opening, in its own heights, of those that are above the ground."""
_MIDDLE = 0.4
"""Share of the clip after which a leap is in the opening."""
_TURNED_RAD = 0.6
"""How far the way is turned out of the picture's plane: opening and way are both seen."""


def pass_opening(
    subject: Actor,
    target: Actor,
    motion: ObjectMotion,
    duration_s: float,
    turn: float,
    *,
    is_out: bool = False,
    is_half: bool = False,
) -> tuple[Actor, Actor]:
    """Along the front of the opening, from one side of it to the other.

    Args:
        subject: who goes.
        target: what has the opening; it turns, and a hoop stands up.
        motion: of the subject.
        duration_s: length of the clip, s.
        turn: 0 for the first of several .. 1 for the last.
        is_out: whether it begins inside.
        is_half: whether it ends inside, or begins there.
    """
    path = target.trajectory
    if not isinstance(path, Stationary):
        return subject, target
    is_right = math.cos(subject.trajectory.at(0.0).yaw) >= 0.0
    # Into something its front is seen, and so is who comes out of it.
    out_of_plane = _TURNED_RAD if is_half and not is_out else -_TURNED_RAD
    yaw = out_of_plane if is_right else math.pi - out_of_plane
    front = yaw if is_out or not is_half else yaw + math.pi
    turned: Trajectory = replace(path, yaw=front)
    if target.noun.name == "hula hoop":
        turned = Tipped(path, front, 0.5 * math.pi, 0.5 * target.model.length)
    target = replace(target, trajectory=turned)
    height, lift = _find_level(subject, target, motion)
    x, y, z = path.home
    half = half_along(subject)
    speed_way = min(max(subject.noun.speed_m_s, 2.0 * half) * duration_s, 6.0 * half + 1.0)
    reach = max(0.5 * speed_way, 1.6 * half + 0.5 * target.model.length)
    # What is longer than a tunnel ends with its front in it.
    deep = min(0.3 * target.model.length, 0.4 * target.model.length - half)
    far = reach + (0.5 * target.model.length if is_half else 0.0)
    first = -abs(deep) if deep > 0.0 else deep
    first = first if is_half and is_out else -far
    last = deep if is_half and not is_out else far

    def spot(along: float) -> tuple[float, float, float]:
        return (x + along * math.cos(yaw), y + along * math.sin(yaw), z + height + lift)

    rolls = motion.kind == "roll" and abs(subject.model.length - subject.model.height) < 0.2
    radius = 0.5 * subject.model.height if rolls else 0.0
    gait = motion.kind if motion.kind in ("walk", "run") else "move"
    seconds = (0.8 if is_half else 1.0) * duration_s * (1.0 - 0.2 * turn)
    legs: tuple[Leg, ...] = (Leg(spot(last), seconds, gait, slows=is_half and not is_out),)
    if motion.kind == "jump" and height > 0.0:
        return with_path(subject, _leap(spot, height, 2.2 * half, duration_s, yaw)), target
    return with_path(subject, Legs(spot(first), yaw, legs, radius, radius)), target


def _find_level(subject: Actor, target: Actor, motion: ObjectMotion) -> tuple[float, float]:
    """How high above the opening's foot it goes through, and above that the subject's origin, m."""
    if target.noun.name == "hula hoop":
        return _raised(subject, motion, target.model.length * 0.5), rest_height(subject)
    if target.noun.name not in _MIDDLES:
        return 0.0, rest_height(subject)
    height = _MIDDLES[target.noun.name] * target.model.height
    return height - (0.0 if subject.is_centred else 0.5 * subject.model.height), 0.0


def _leap(
    spot: Callable[[float], Vector], height_m: float, reach_m: float, duration_s: float, yaw: float
) -> Legs:
    """From the ground before the opening through it to the ground behind it."""
    (x0, y0, top), (x1, y1, _) = spot(-reach_m), spot(reach_m)
    ground = top - height_m
    flight = flight_s(ground, ground, top)
    legs = (
        Leg((x0, y0, ground), max(_MIDDLE * duration_s - 0.5 * flight, 0.1), "stand"),
        Leg((x1, y1, ground), flight, "jump", is_flight=True),
        Leg((x1, y1, ground), duration_s, "stand"),
    )
    return Legs((x0, y0, ground), yaw, legs)


def _raised(subject: Actor, motion: ObjectMotion, middle_m: float) -> float:
    """How high who jumps or flies goes; others stay on the ground."""
    if motion.kind not in ("jump", "fly"):
        return 0.0
    return max(middle_m - (0.0 if subject.is_centred else 0.5 * subject.model.height), 0.0)

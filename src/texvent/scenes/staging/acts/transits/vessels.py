"""Into and out of vessels: over the rim, or on the ground into one that lies on its side."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from texvent.scenes.description import ObjectMotion
from texvent.scenes.models.materials import Material
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import box, post
from texvent.scenes.models.support_surface import find_support
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.transits.surfaces import ahead_of, half_along, rest_height
from texvent.scenes.staging.acts.transits.tops import FLYING, JUMPING, choose_yaw, with_path
from texvent.scenes.staging.body_boxes import part_boxes
from texvent.scenes.staging.trajectories.legs import Leg, Legs, flight_s
from texvent.scenes.staging.trajectories.trajectory import BodyState, Stationary, Trajectory

HATS = frozenset({"hat", "top hat", "cap", "helmet"})
"""What opens below, and is put upside down."""
_OVER_RIM = JUMPING | FLYING | {"fall", "bounce", "throw", "swim"}
_DARK = Material((0.02, 0.018, 0.015))
_INSIDE = 0.86
"""Width of an opening, as a share of the vessel's."""
_SUNK, _LOWEST = 0.6, 0.1
"""Share of its height by which a body is below the rim; lowest place of it, in heights of the
vessel."""
_CLEAR = 0.3
_TURNED_RAD = 0.45
"""How far an opening that lies is turned to the viewer."""


@dataclass(frozen=True)
class Tipped:
    """On its side, its opening where it heads, or (`is_over`) upside down."""

    path: Stationary
    yaw: float
    pitch_rad: float
    lift_m: float

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        x, y, z = self.path.home
        return BodyState(
            (x, y, z + self.lift_m), self.yaw, self.pitch_rad, activity=self.path.activity
        )


def go_into(
    subject: Actor,
    target: Actor,
    motion: ObjectMotion,
    duration_s: float,
    turn: float,
    *,
    is_out: bool,
) -> tuple[Actor, Actor]:
    """Into a vessel, or out of it.

    Args:
        subject: who goes.
        target: the vessel; it is opened, tipped over or turned upside down.
        motion: of the subject.
        duration_s: length of the clip, s.
        turn: 0 for the first of several .. 1 for the last, which starts later.
        is_out: whether it comes out.
    """
    path = target.trajectory
    if not isinstance(path, Stationary):
        return subject, target
    wait = min(0.2 * duration_s, 0.7) * (1.0 + 1.5 * turn)
    if motion.kind in _OVER_RIM or target.noun.name in HATS:
        target = _upturned(target, path) if target.noun.name in HATS else _opened(target)
        return _go_over_rim(subject, target, wait, duration_s, is_out=is_out), target
    yaw = choose_yaw(subject, target)
    is_right = math.cos(yaw) > 0.0
    ahead = -_TURNED_RAD if is_right else math.pi + _TURNED_RAD
    if not is_out:
        ahead = math.pi + _TURNED_RAD if is_right else -_TURNED_RAD
    tipped: Trajectory = Tipped(path, ahead, 0.5 * math.pi, 0.5 * target.model.length)
    target = replace(_opened(target), trajectory=tipped)
    legs = _go_along(subject, target, motion.kind, (ahead, wait), duration_s, is_out=is_out)
    return with_path(subject, legs), target


def _opened(target: Actor) -> Actor:
    """A closed box gets an opening with its flaps; others have theirs."""
    if target.noun.name != "box" or target.extras:
        return target
    model = target.model
    long, wide, tall = model.length, model.width, model.height
    card = Material((0.46, 0.29, 0.14))
    inner = box(_DARK, (0.0, 0.0, tall), (_INSIDE * long, _INSIDE * wide, 0.01))
    flap = 0.4 * long
    flaps: list[ModelPart] = [inner]
    for side in (1.0, -1.0):
        flaps.append(box(card, (side * (0.5 * long + 0.25 * flap), 0.0, tall + 0.30 * flap),
                         (0.01, wide, 0.9 * flap), lean=0.8 * side))  # fmt: skip
    return replace(target, extras=tuple(flaps))


def _upturned(target: Actor, path: Stationary) -> Actor:
    """Its opening above."""
    model = target.model
    wide = 0.62 * min(model.length, model.width)
    turned = Tipped(path, path.yaw, math.pi, model.height)
    return replace(
        target, trajectory=turned, extras=(post(_DARK, (0.0, 0.0, -0.004), (wide, wide, 0.006)),)
    )


def _go_over_rim(
    subject: Actor, target: Actor, wait_s: float, duration_s: float, *, is_out: bool
) -> Actor:
    """A flight between the ground beside the vessel and its inside."""
    low, high = part_boxes(target, 0.0).hull
    yaw = choose_yaw(subject, target)
    lift, half, tall = rest_height(subject), half_along(subject), subject.model.height
    middle = 0.5 * (low + high)
    # The handle of a basket is above its rim.
    is_upright = isinstance(target.trajectory, Stationary)
    rim = float(low[2]) + find_support(target.model).height if is_upright else float(high[2])
    inside = max(rim - _SUNK * tall, float(low[2]) + _LOWEST * (rim - float(low[2])))
    aside = 0.5 * float(max(high[:2] - low[:2])) + 1.3 * half + 0.1
    within = ahead_of(middle, yaw, 0.0, inside + lift)
    outer = ahead_of(middle, yaw, aside if is_out else -aside, float(low[2]) + lift)
    apex = max(float(high[2]) + lift + _CLEAR * tall, within[2] + 0.1)
    first, last = (within, outer) if is_out else (outer, within)
    flight = flight_s(first[2], last[2], apex)
    legs = (
        Leg(first, wait_s, "stand"),
        Leg(last, flight, "jump", is_flight=True),
        Leg(last, duration_s, "stand"),
    )
    return with_path(subject, Legs(first, yaw, legs))


def _go_along(
    subject: Actor,
    target: Actor,
    kind: str,
    how: tuple[float, float],
    duration_s: float,
    *,
    is_out: bool,
) -> Legs:
    """Along the ground, into what lies there or out of it; `how`: its heading, the wait."""
    ahead, wait = how
    place = target.trajectory.at(0.0).position
    deep = target.model.height
    lift, half = rest_height(subject), half_along(subject)
    floor = target.trajectory.at(0.0).position[2] - 0.5 * target.model.length + lift
    wall = 0.06 * target.model.length
    base = (place[0], place[1])
    inner = max(deep - 2.1 * half, 0.35 * deep)
    rolls = kind == "roll" and abs(subject.model.length - subject.model.height) < 0.2
    radius = 0.5 * subject.model.height if rolls else 0.0
    gait = kind if kind in ("walk", "run") else "move"

    def spot(along: float, height: float) -> tuple[float, float, float]:
        return (
            base[0] + along * math.cos(ahead), base[1] + along * math.sin(ahead), height
        )  # fmt: skip

    within, mouth = spot(inner, floor + wall), spot(deep + 0.2 * half, floor)
    outer = spot(deep + max(4.0 * half, 0.5), floor)
    seconds = min(0.6 * duration_s, 1.6)
    if is_out:
        legs = (
            Leg(within, wait, "stand"),
            Leg(mouth, 0.4 * seconds, gait),
            Leg(outer, seconds, gait, slows=True),
        )
        return Legs(within, ahead, legs, radius, radius)
    way_in = (
        Leg(mouth, 0.7 * seconds, gait),
        Leg(within, 0.4 * seconds, gait, slows=True),
    )
    return Legs(outer, ahead + math.pi, way_in, radius, radius)

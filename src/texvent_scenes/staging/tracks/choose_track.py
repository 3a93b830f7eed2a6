"""Chooses the track that a motion of the prompt stands for."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent_scenes.description import SPIN_RATE_HZ
from texvent_scenes.models.activities import ANIMAL_ACTIVITIES, TRAVELLING
from texvent_scenes.models.protocol import Model
from texvent_scenes.staging.tracks.flight_keys import BOUNCY, DULL, NO_FLOOR_M, fallen_m
from texvent_scenes.staging.tracks.keys import Vector, ahead
from texvent_scenes.staging.tracks.motion_plan import MotionPlan
from texvent_scenes.staging.tracks.phase_keys import spin_lift, to_and_fro
from texvent_scenes.staging.tracks.phases import (
    LEANING,
    PATH_KINDS,
    SWINGS,
    activity_of,
    oscillations,
)
from texvent_scenes.staging.tracks.track import TO_CAMERA, Term, Track, ballistic, steady
from texvent_scenes.staging.tracks.turning import CLOCKWISE, axle_of, spin_sign, work_sign

_STAYING = frozenset({"stand", "sit", "lie", "hang", *ANIMAL_ACTIVITIES}) - TRAVELLING
"""Activities in place of bodies without hands."""
_ORBIT_SIZES = 1.3
"""Least radius of a circle around nothing, in sizes of who goes along it."""
_ORBIT_HASTE = 1.5
"""Most multiple of its usual speed at which a body goes round something large in the clip."""
_NEAREST = -0.5 * math.pi
"""Direction from the middle of a circle to the camera."""


def choose_track(
    plan: MotionPlan,
    model: Model,
    home: Vector,
    rng: np.random.Generator,
) -> Track:
    """The track of one body.

    Args:
        plan: motion of its object.
        model: its model.
        home: where it is at mid clip, or where it stays, m.
        rng: decides phases.
    """
    kind, direction = plan.motion.kind, plan.motion.direction
    if plan.work:
        return replace(steady(home, plan.yaw), terms=plan.work)
    if plan.path is not None:
        x, y, z = np.add(plan.path.start, home)
        # What flies stays above the ground; what is in the water goes down from the surface.
        dives = any(key.climb_m_s < 0.0 and key.activity == "swim" for key in plan.path.keys)
        lowest = -math.inf if home[2] <= 0.0 and dives else min(0.5 * model.height, home[2])
        has_floor = plan.path.floor_m > NO_FLOOR_M
        floor = plan.path.floor_m + home[2] if has_floor else lowest
        return replace(
            plan.path, start=(x, y, z), floor_m=floor, radius_m=plan.radius_m,
            is_facing=plan.is_facing,
        )  # fmt: skip
    if plan.gesture is not None:
        return replace(
            steady(home, plan.yaw, activity=plan.gesture), terms=_tempo(plan.motion.pace)
        )
    phase = float(rng.uniform(0.0, 2.0 * math.pi))
    if kind == "orbit":
        return orbit(
            plan, home, orbit_radius(plan, max(model.length, model.width)), phase / math.tau
        )
    if direction in SWINGS and kind != "sway":
        return _go_and_return(plan, model, home)
    if kind in PATH_KINDS:
        return _go_straight(plan, model, home, phase)
    if kind in ("bounce", "fall", "throw"):
        return _fly_freely(plan, model, home)
    if kind == "spin":
        return _spin(plan, model, home, phase)
    return _act_in_place(plan, model, home, phase)


def _raised(home: Vector, lift_m: float) -> Vector:
    return (home[0], home[1], home[2] + lift_m)


def _tempo(pace: float, gain_per_s: float = 0.0) -> tuple[Term, ...]:
    """The pace of gestures, of which the mean since t = 0 counts."""
    return (Term("tempo", offset=pace - 1.0, drift=0.5 * gain_per_s),)


def orbit_radius(plan: MotionPlan, size_m: float) -> float:
    """Radius of a circle around nothing, m: once round in the clip at the usual speed."""
    usual_m_s = plan.speed_m_s / max(plan.motion.pace, 0.1)
    return max(_ORBIT_SIZES * size_m, usual_m_s * max(plan.duration_s, 2.0) / (2.0 * math.pi))


def orbit(plan: MotionPlan, centre: Vector, radius_m: float, share: float) -> Track:
    """Once round a point in the clip, or as far as it gets; at share 0 before it at half time."""
    rate = 2.0 * math.pi / max(plan.duration_s, 2.0) * plan.motion.pace
    if plan.motion.speed_m_s is not None:
        rate = plan.motion.speed_m_s / radius_m
    else:
        rate = min(rate, _ORBIT_HASTE * plan.speed_m_s / radius_m)
    rate *= -1.0 if plan.motion.direction in CLOCKWISE else 1.0
    activity = plan.motion.kind if plan.motion.kind in ("walk", "run") else "move"
    begin, (x, y, z) = _NEAREST + 2.0 * math.pi * share - 0.5 * rate * plan.duration_s, centre
    start = (x + radius_m * math.cos(begin), y + radius_m * math.sin(begin), z)
    yaw = begin + math.copysign(0.5 * math.pi, rate)
    circle = steady(start, yaw, abs(rate) * radius_m, turn_rad_s=rate, activity=activity)
    return replace(circle, is_facing=plan.is_facing)


def _go_and_return(plan: MotionPlan, model: Model, home: Vector) -> Track:
    """To and fro, or up and down: what stands on the ground rises from it."""
    key = to_and_fro(plan.motion, plan.speed_m_s, plan.duration_s, model)
    rise_m = key.climb_m_s / (2.0 * math.pi * key.swing_hz)
    return Track(_raised(home, rise_m), plan.yaw, (key,), is_facing=plan.is_facing)


def _go_straight(plan: MotionPlan, model: Model, home: Vector, phase: float) -> Track:
    kind, half_m = plan.motion.kind, 0.5 * plan.duration_s * plan.speed_m_s
    risen_m = 0.0 if plan.is_facing else plan.climb * half_m  # a shape goes up from the ground
    start = ahead(home, plan.yaw, -half_m, home[2] - risen_m)
    doing = f"{activity_of(kind)} and {plan.act}" if plan.act else activity_of(kind)
    line = steady(start, plan.yaw, plan.speed_m_s, climb=plan.climb, activity=doing)
    waves = oscillations(plan.motion, model, phase)
    return replace(line, terms=waves, radius_m=plan.radius_m, is_facing=plan.is_facing)


def _act_in_place(plan: MotionPlan, model: Model, home: Vector, phase: float) -> Track:
    motion, waves = plan.motion, oscillations(plan.motion, model, phase)
    is_afloat = motion.kind == "float" and home[2] < 0.0  # not in the air
    activity = motion.kind if motion.kind in _STAYING or is_afloat else "move"
    if not waves:
        sign = work_sign(motion.direction, model)
        waves = _tempo(sign * motion.pace, sign * _gain(plan))
    elif motion.kind in LEANING:
        activity = "stand"
    if plan.is_laid:
        on_side = 0.5 * max(model.length, model.width) - 0.5 * model.height
        waves = (Term("pitch", offset=0.5 * math.pi), Term("z", offset=on_side))
        laid = steady(home, plan.yaw, activity="stand")
        return replace(laid, terms=waves, pivot_m=0.5 * model.height)
    rest = replace(steady(home, plan.yaw, activity=activity), terms=waves)
    return replace(rest, pivot_m=axle_of(model, "roll").height_m) if plan.is_facing else rest


def _spin(plan: MotionPlan, model: Model, home: Vector, phase: float) -> Track:
    """A wheel about its axle, a flat shape in the picture, the rest about the vertical."""
    sign = spin_sign(plan.motion.direction, plan.spin_axis, plan.yaw)
    usual = 2.0 * math.pi * sign * SPIN_RATE_HZ
    turn = Term(plan.spin_axis, drift=usual * plan.motion.pace, gain=usual * _gain(plan))
    if plan.spin_axis == "yaw":
        return replace(steady(home, plan.yaw if plan.is_headed else phase), terms=(turn,))
    lift = spin_lift(model) if plan.spin_axis == "roll" else 0.0
    rest = steady(_raised(home, lift), TO_CAMERA if plan.is_facing else plan.yaw)
    return replace(rest, terms=(turn,), pivot_m=axle_of(model, plan.spin_axis).height_m)


def _gain(plan: MotionPlan) -> float:
    """Growth of pace per second, of what speeds up or slows down in its place."""
    pace, end = plan.motion.pace, plan.motion.end_pace
    return 0.0 if end is None else (end - pace) / plan.duration_s


def _fly_freely(plan: MotionPlan, model: Model, home: Vector) -> Track:
    """Bouncing, falling and thrown objects: gravity decides."""
    kind, duration_s, floor = plan.motion.kind, plan.duration_s, home[2]
    if kind == "fall":
        height = fallen_m(model, duration_s) if plan.start_m is None else plan.start_m
        is_timed = plan.start_m is not None or plan.motion.start_s is not None
        return ballistic(
            _raised(home, height),
            plan.yaw,
            floor_m=floor,
            restitution=DULL,
            wait_s=0.0 if is_timed else 0.1 * duration_s,
        )
    height = min(max(3.0 * model.height, 0.8), 2.5) if plan.start_m is None else plan.start_m
    stated = plan.motion.speed_m_s
    is_still = kind == "bounce" and plan.motion.direction is None
    along = plan.speed_m_s * (1.0 if kind == "throw" else 0.5) if stated is None else stated
    along = 0.0 if is_still and stated is None else along
    place = ahead(home, plan.yaw, -0.5 * along * duration_s, floor + height)
    return ballistic(place, plan.yaw, along, floor_m=floor, restitution=BOUNCY)

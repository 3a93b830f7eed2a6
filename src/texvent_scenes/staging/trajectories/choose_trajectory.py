"""Chooses the trajectory that a motion of the prompt stands for."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent_scenes.description import SPIN_RATE_HZ
from texvent_scenes.models.activities import ANIMAL_ACTIVITIES
from texvent_scenes.models.protocol import Model
from texvent_scenes.staging.trajectories.action_trajectories import (
    GRAVITY_M_S2,
    Flight,
    Oscillating,
    Spin,
    Wave,
    hover,
)
from texvent_scenes.staging.trajectories.motion_plan import MotionPlan
from texvent_scenes.staging.trajectories.phases import NO_FLOOR_M, PATH_KINDS, activity_of
from texvent_scenes.staging.trajectories.steered_path import steady
from texvent_scenes.staging.trajectories.trajectory import (
    TO_CAMERA,
    BodyState,
    Facing,
    Rolling,
    Shuttle,
    Stationary,
    Trajectory,
    Vector,
    ahead,
)

_STAYING = frozenset({"stand", "sit", "lie", "hang", *ANIMAL_ACTIVITIES})
"""Activities in place of bodies without hands."""
ORBIT_SIZES = 1.3
"""Radius of a circle around nothing, in sizes of who goes along it."""
_BOB_HZ, _WEAVE_HZ, _WEAVE_RAD, _SWAY_RAD = 0.4, 0.68, 0.08, 0.14
"""Up and down of what flies or floats, swaying of a fish about its heading, of what leans."""
_ON_GROUND = frozenset({"walk", "run", "crawl", "drive", "roll", "slide"})
"""Ground motions for which "up and down" means back and forth."""


def choose_trajectory(
    plan: MotionPlan,
    model: Model,
    home: Vector,
    rng: np.random.Generator,
) -> Trajectory:
    """The trajectory of one body.

    Args:
        plan: what its object does.
        model: its model.
        home: where it is at mid clip, or where it stays, m.
        rng: decides phases.
    """
    kind, direction = plan.motion.kind, plan.motion.direction
    if plan.path is not None:
        x, y, z = np.add(plan.path.start, home)
        # What flies stays above the ground.
        floor = home[2] if plan.path.floor_m > NO_FLOOR_M else min(0.5 * model.height, home[2])
        path: Trajectory = replace(plan.path, start=(x, y, z), floor_m=floor)
        if plan.radius_m:
            path = Rolling(path, plan.radius_m)
        return Facing(path) if plan.is_facing else path
    if plan.gesture is not None:
        return Stationary(home, plan.yaw, plan.gesture, plan.motion.pace)
    phase = float(rng.uniform(0.0, 2.0 * math.pi))
    if kind == "orbit":
        return orbit(plan, home, ORBIT_SIZES * max(model.length, model.width), phase / math.tau)
    if direction in ("to and fro", "up and down") and kind != "sway":
        return _go_and_return(plan, model, home)
    if kind in PATH_KINDS:
        return _follow_path(plan, model, home, phase)
    if kind in ("bounce", "fall", "throw"):
        return _fly_freely(plan, model, home)
    return _act_in_place(plan, model, home, phase)


def _raised(home: Vector, lift_m: float) -> Vector:
    return (home[0], home[1], home[2] + lift_m)


def orbit(plan: MotionPlan, centre: Vector, radius_m: float, share: float) -> Trajectory:
    """Once round a point in the clip, from that share of the round on."""
    rate = 2.0 * math.pi / max(plan.duration_s, 2.0) * plan.motion.pace
    rate *= -1.0 if plan.motion.direction in ("right", "clockwise") else 1.0
    activity = "run" if plan.motion.kind == "run" else "move"
    begin, (x, y, z) = 2.0 * math.pi * share, centre
    start = (x + radius_m * math.cos(begin), y + radius_m * math.sin(begin), z)
    yaw = begin + math.copysign(0.5 * math.pi, rate)
    circle = steady(start, yaw, abs(rate) * radius_m, turn_rad_s=rate, activity=activity)
    return Facing(circle) if plan.is_facing else circle


def _go_and_return(plan: MotionPlan, model: Model, home: Vector) -> Trajectory:
    """To and fro, or up and down: what stands on the ground rises from it."""
    kind, direction, rate = plan.motion.kind, plan.motion.direction, plan.motion.rate_hz
    reach = max(0.3 * plan.speed_m_s * plan.duration_s, 0.4 * model.height)
    is_vertical = direction == "up and down" and kind not in _ON_GROUND
    period_s = 1.0 / rate if rate else max(plan.duration_s, 1.0)
    place = _raised(home, reach) if is_vertical else home
    path = Shuttle(place, plan.yaw, reach, period_s, activity_of(kind), is_vertical)
    return Facing(path) if plan.is_facing else path


def _follow_path(plan: MotionPlan, model: Model, home: Vector, phase: float) -> Trajectory:
    kind, half_m = plan.motion.kind, 0.5 * plan.duration_s * plan.speed_m_s
    start = ahead(home, plan.yaw, -half_m, home[2] - plan.climb * half_m)
    path: Trajectory = steady(
        start, plan.yaw, plan.speed_m_s, climb=plan.climb, activity=activity_of(kind)
    )
    if plan.is_facing:
        path = Facing(path)
    if kind in ("fly", "sail", "paddle"):
        return Oscillating(path, (Wave("z", 0.04 * model.height, _BOB_HZ, phase),))
    if kind == "swim":
        return Oscillating(path, (Wave("yaw", _WEAVE_RAD, _WEAVE_HZ, phase),))
    return Rolling(path, plan.radius_m) if plan.radius_m else path


def _act_in_place(plan: MotionPlan, model: Model, home: Vector, phase: float) -> Trajectory:
    """Trajectory of a motion in place."""
    kind, pace = plan.motion.kind, plan.motion.pace
    is_clockwise = plan.motion.direction in ("right", "clockwise")
    if kind == "spin":
        usual = 2.0 * math.pi * (-SPIN_RATE_HZ if is_clockwise else SPIN_RATE_HZ)
        return _spin(plan, model, home, usual, phase)
    if kind in ("hover", "float"):
        bob_m = 0.12 * min(max(model.length, model.width, model.height), 2.5) * pace
        return hover(Stationary(home, plan.yaw, "move"), bob_m, phase)
    if kind == "sway":
        lean = Wave("roll", _SWAY_RAD, plan.motion.rate_hz or 0.5 * pace)
        return Oscillating(Stationary(home, plan.yaw), (lean,))
    sign = -1.0 if plan.motion.direction == "clockwise" else 1.0
    activity = kind if kind in _STAYING else "move"
    return Stationary(home, plan.yaw, activity, sign * pace, sign * _gain(plan))


def _spin(
    plan: MotionPlan, model: Model, home: Vector, usual_rad_s: float, phase: float
) -> Trajectory:
    """A wheel about its axle, a flat shape in the picture, the rest about the vertical."""
    rate, gain = usual_rad_s * plan.motion.pace, usual_rad_s * _gain(plan)
    if plan.spin_axis == "yaw":
        return Spin(home, rate, phase, gain)
    lift = 0.0
    if plan.is_facing:  # its corners stay above the ground
        lift = 0.5 * (math.hypot(model.width, model.height) - model.height)
    yaw = TO_CAMERA if plan.is_facing else plan.yaw
    return Spin(_raised(home, lift), rate, yaw, gain, plan.spin_axis, 0.5 * model.height)


def _gain(plan: MotionPlan) -> float:
    """By how much the pace of what speeds up or slows down in its place grows each second."""
    pace, end = plan.motion.pace, plan.motion.end_pace
    return 0.0 if end is None else (end - pace) / plan.duration_s


def _fly_freely(plan: MotionPlan, model: Model, home: Vector) -> Trajectory:
    """Bouncing, falling and thrown objects: gravity decides."""
    kind, pivot, duration_s = plan.motion.kind, 0.5 * model.height, plan.duration_s
    floor = home[2]
    if kind == "fall":
        height = 0.5 * GRAVITY_M_S2 * (0.45 * duration_s) ** 2
        height = min(max(height, model.height), max(1.2 * model.height, 0.5))
        start = BodyState(_raised(home, height), plan.yaw, pivot_m=pivot)
        return Flight(start, floor_m=floor, restitution=0.3, start_s=0.1 * duration_s)
    height = min(max(3.0 * model.height, 0.8), 2.5)
    is_still = kind == "bounce" and plan.motion.direction is None
    along = 0.0 if is_still else 0.5 * plan.speed_m_s
    place = ahead(home, plan.yaw, -0.5 * along * duration_s, floor + height)
    velocity = (along * math.cos(plan.yaw), along * math.sin(plan.yaw), 0.0)
    return Flight(BodyState(place, plan.yaw), velocity, floor, 0.82)

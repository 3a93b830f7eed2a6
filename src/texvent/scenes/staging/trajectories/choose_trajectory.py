"""Chooses the trajectory that a motion of the prompt stands for."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent.scenes.description import SPIN_RATE_HZ
from texvent.scenes.models.animals.acts import ANIMAL_ACTS
from texvent.scenes.models.people.activities import (
    TRAVELLING,
)
from texvent.scenes.models.protocol import Model, Pose
from texvent.scenes.models.shapes import bounds
from texvent.scenes.staging.trajectories.action_trajectories import (
    GRAVITY_M_S2,
    Bounce,
    Hop,
    Hover,
    RollOver,
    Spin,
    SpinOnAxle,
    Swing,
    Wheelie,
)
from texvent.scenes.staging.trajectories.motion_plan import MotionPlan
from texvent.scenes.staging.trajectories.phases import (
    NO_FLOOR_M,
    PATH_KINDS,
)
from texvent.scenes.staging.trajectories.steered_path import SteeredPath
from texvent.scenes.staging.trajectories.stunts import (
    STAYING,
    build_drift,
    build_eight,
    build_flip,
    build_leap,
    build_lift,
    build_round,
    build_sinking,
    build_sway,
)
from texvent.scenes.staging.trajectories.trajectory import (
    TO_CAMERA,
    Facing,
    Rolling,
    Shuttle,
    Stationary,
    Straight,
    Trajectory,
    Vector,
)

_WEAVING, _LEANING = frozenset({"swim"}), frozenset({"fly", "orbit"})


def choose_trajectory(
    plan: MotionPlan,
    model: Model,
    home: Vector,
    rng: np.random.Generator,
    *,
    clear_m: float = 0.0,
) -> Trajectory:
    """The trajectory of one body.

    Args:
        plan: what its object does.
        model: its model.
        home: where it is at mid clip, or where it stays, m.
        rng: decides phases.
        clear_m: height of what it jumps over at its home, m.
    """
    if plan.path is not None:
        path = _shift_path(plan.path, model, home)
        return Facing(path) if plan.is_facing else path
    if plan.gesture is not None:
        return Stationary(home, plan.yaw, plan.gesture, plan.motion.pace)
    if clear_m > 0.0:
        return build_leap(model, home, plan.yaw, plan.duration_s, clear_m)
    kind, direction = plan.motion.kind, plan.motion.direction
    phase = float(rng.uniform(0.0, 2.0 * math.pi))
    if kind == "orbit" or (kind in PATH_KINDS and direction in ("circle", "eight")):
        return _go_round(plan, model, home, phase)
    if direction in ("to and fro", "up and down") and kind != "sway":
        return _go_and_return(plan, model, home)
    if kind == "drift":
        return build_drift(home, plan.yaw, 1.2 * plan.speed_m_s, plan.duration_s)
    if kind in PATH_KINDS:
        return _follow_path(plan, model, home, phase)
    return _act_in_place(plan, model, home, phase)


def _go_round(plan: MotionPlan, model: Model, home: Vector, phase: float) -> Trajectory:
    """Along a circle or an eight; that of a flat shape stands upright in the picture."""
    kind, motion = plan.motion.kind, plan.motion
    lean = 0.35 * (kind in _LEANING)
    if motion.direction == "eight" and kind != "orbit":
        eight = build_eight(model, home, plan.yaw, motion.pace, plan.duration_s)
        if plan.is_facing:
            return Facing(eight, _raised(home, 0.5 * eight.half_m))
        return replace(eight, activity=_activity(kind), lean_rad=lean)
    pace = 0.0 if motion.speed_m_s is not None else motion.pace / plan.duration_s
    circle = build_round(model, home, phase, plan.speed_m_s, pace)
    if plan.is_facing:
        rate = 2.0 * math.pi * pace or circle.rate_rad_s
        upright = _raised(home, circle.radius_m)
        return Facing(replace(circle, rate_rad_s=rate), upright)
    return replace(circle, activity=_activity(kind), lean_rad=lean)


def _go_and_return(plan: MotionPlan, model: Model, home: Vector) -> Trajectory:
    """To and fro, or up and down: what stands on the ground rises from it."""
    kind, direction, rate = plan.motion.kind, plan.motion.direction, plan.motion.rate_hz
    reach = max(0.3 * plan.speed_m_s * plan.duration_s, 0.4 * model.height)
    is_flat = model.length < 0.3 * min(model.width, model.height)
    is_vertical = direction == "up and down" and kind not in _ON_GROUND
    yaw = TO_CAMERA if is_flat and is_vertical else plan.yaw
    period_s = 1.0 / rate if rate else max(plan.duration_s, 1.0)
    place = _raised(home, reach) if is_vertical else home
    path = Shuttle(place, yaw, reach, period_s, _activity(kind), is_vertical)
    return Facing(path) if plan.is_facing else path


_ON_GROUND = frozenset({"walk", "run", "crawl", "drive", "roll", "slide"})
"""Who goes up and down a street on the ground goes to and fro."""


def _shift_path(path: SteeredPath, model: Model, home: Vector) -> SteeredPath:
    """The path about a home; what flies stays above the ground."""
    x, y, _ = path.start
    floor = home[2] if path.floor_m > NO_FLOOR_M else min(0.5 * model.height, home[2])
    return replace(path, start=(x + home[0], y + home[1], home[2]), floor_m=floor)


def _raised(home: Vector, lift_m: float) -> Vector:
    return (home[0], home[1], home[2] + lift_m)


def _activity(kind: str) -> str:
    if kind in TRAVELLING or kind == "fly":
        return kind
    return "stand" if kind == "slide" else "move"


def _follow_path(plan: MotionPlan, model: Model, home: Vector, phase: float) -> Trajectory:
    kind = plan.motion.kind
    is_air = kind == "fly"
    is_flat = model.length < 0.3 * min(model.width, model.height)
    is_flat = plan.is_facing or (is_flat and (is_air or kind == "slide"))
    path = Straight(
        home,
        plan.yaw,
        plan.speed_m_s,
        0.5 * plan.duration_s,
        _activity(kind),
        climb=plan.climb,
        bob_m=0.04 * model.height if is_air or kind in ("sail", "paddle") else 0.0,
        weave_rad=0.08 if kind in _WEAVING else 0.0,
        phase=phase,
        facing_rad=-0.5 * math.pi + 0.35 * is_air if is_flat else None,
    )
    if plan.is_facing and path.climb:
        reach = 0.5 * path.climb * path.speed_m_s * plan.duration_s
        return Facing(replace(path, home=_raised(home, reach)))
    if kind == "wheelie":
        return Wheelie(path, 0.30 * model.length, 0.3 * model.height)
    if kind == "roll" and not (plan.is_vehicle or getattr(model, "is_wheeled", False)):
        return Rolling(path, 0.5 * model.height, 0.5 * model.height)
    return path


def _act_in_place(plan: MotionPlan, model: Model, home: Vector, phase: float) -> Trajectory:
    kind, pace = plan.motion.kind, plan.motion.pace
    span = max(model.length, model.width, model.height)
    if kind == "spin":
        sign = -1.0 if plan.motion.direction in ("right", "clockwise") else 1.0
        return _spin(plan, model, home, sign * 2.0 * math.pi * SPIN_RATE_HZ, phase)
    if kind in ("bounce", "fall", "throw"):
        return _fly_freely(plan, model, home)
    if kind == "sink" and plan.is_vessel:
        return build_sinking(model, home, plan.duration_s)
    if kind in ("rise", "sink"):
        speed = min(max(plan.speed_m_s, 0.3 * span), span)
        is_up = kind == "rise"
        lift = build_lift(home, plan.yaw, speed, plan.duration_s, plan.is_winged, is_up)
        return Facing(lift) if plan.is_facing else lift
    if kind == "swing":
        length = max(1.6 * model.height, 0.6)
        return Swing(home, length, 0.5, pace)
    if kind == "jump":
        height = min(min(max(0.35 * model.height, 0.12), 1.5) * pace, plan.headroom_m)
        if plan.is_swimmer:
            height = max(height, 0.7 * model.length)
        hop = 0.0 if plan.motion.direction is None else 0.5 * model.length * 2.0
        return Hop(home, height, hop_m=hop, yaw=plan.yaw, mid_s=0.5 * plan.duration_s)
    if kind == "dance":
        return Hop(home, 0.06 * model.height, 0.1, yaw=-1.2, sway_rad=0.5, phase_s=0.1 * phase)
    return _act_on_spot(plan, model, home, phase)


def _spin(
    plan: MotionPlan, model: Model, home: Vector, usual_rad_s: float, phase: float
) -> Trajectory:
    """A wheel about its axle, a flat shape in the picture, the rest about the vertical."""
    pivot = 0.5 * model.height
    rate, gain = usual_rad_s * plan.motion.pace, usual_rad_s * _gain(plan)
    if plan.is_facing:
        # Its corners stay above the ground.
        lift = 0.5 * (math.hypot(model.width, model.height) - model.height)
        raised = _raised(home, lift)
        return SpinOnAxle(raised, TO_CAMERA, rate, pivot, gain, is_along=True)
    if plan.is_wheel:
        return SpinOnAxle(home, plan.yaw, rate, pivot, gain)
    return Spin(home, rate, phase, gain)


_LARGEST_AFLOAT_M = 2.5
"""What is larger bobs no more than that: a moon, a cloud."""


def _act_on_spot(plan: MotionPlan, model: Model, home: Vector, phase: float) -> Trajectory:
    """What goes neither far nor high."""
    kind, pace = plan.motion.kind, plan.motion.pace
    span = max(model.length, model.width, model.height)
    if kind == "flip":
        return build_flip(model, home, plan.yaw, pace)
    if kind in ("hover", "float"):
        return Hover(home, 0.12 * min(span, _LARGEST_AFLOAT_M) * pace, plan.yaw, phase)
    if kind == "sway":
        sway = build_sway(model, home, plan.yaw, pace)
        return replace(sway, rate_hz=plan.motion.rate_hz or sway.rate_hz)
    if kind == "roll over":
        lying = model.parts(Pose(0.0, 0.0, 0.0, "lie"))
        return RollOver(home, plan.yaw, 0.5 * float(bounds(lying)[1][2]), pace)
    is_act = kind in STAYING or kind in ANIMAL_ACTS
    way = -1.0 if plan.motion.direction == "clockwise" else 1.0
    doing = kind if is_act else "move"
    return Stationary(home, plan.yaw, doing, way * pace, way * _gain(plan))


def _gain(plan: MotionPlan) -> float:
    """By how much the pace of what speeds up or slows down in its place grows each second."""
    pace, end = plan.motion.pace, plan.motion.end_pace
    return 0.0 if end is None else (end - pace) / plan.duration_s


def _fly_freely(plan: MotionPlan, model: Model, home: Vector) -> Trajectory:
    """Bouncing, falling and thrown objects: gravity decides."""
    x, y, z = home
    kind, pivot = plan.motion.kind, 0.5 * model.height
    if kind == "bounce":
        height = min(max(3.0 * model.height, 0.8), 2.5)
        along = 0.0 if plan.motion.direction is None else 0.5 * plan.speed_m_s
        back = 0.5 * along * plan.duration_s
        x, y = x - back * math.cos(plan.yaw), y - back * math.sin(plan.yaw)
        return Bounce((x, y, z + height), z, along_m_s=along, yaw=plan.yaw, restitution=0.82)
    if kind == "fall":
        height = 0.5 * GRAVITY_M_S2 * (0.45 * plan.duration_s) ** 2
        height = min(max(height, model.height), max(1.2 * model.height, 0.5))
        wait = 0.1 * plan.duration_s
        return Bounce(
            (x, y, z + height), z, yaw=plan.yaw, restitution=0.3, start_s=wait, pivot_m=pivot
        )
    travel = plan.travel_m
    span = max(model.length, model.height)
    start = (
        x - 0.5 * travel * math.cos(plan.yaw),
        y - 0.5 * travel * math.sin(plan.yaw),
        z + min(max(1.0, model.height), 4.0 * span),
    )
    up = min(0.5 * GRAVITY_M_S2 * min(0.55 * plan.duration_s, 1.0),
             math.sqrt(2.0 * GRAVITY_M_S2 * (0.2 + 4.0 * span)))  # fmt: skip
    along = travel / plan.duration_s
    return Bounce(
        start, z, up, along, plan.yaw, 0.6, tumble_rad_s=along / max(pivot, 0.05), pivot_m=pivot
    )

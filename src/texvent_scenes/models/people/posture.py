"""Postures: where hips, hands and feet are and how torso and head turn; joints follow from them.

Body coordinates are those of `protocol`: origin on the ground, facing +x, y to the left, z up,
for an adult of 1.75 m. Angles are radians, lengths metres.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent_scenes.models.limbs import bend
from texvent_scenes.models.shapes import Affine, Point, mixed, point, rotation

THIGH, SHIN, ANKLE = 0.43, 0.43, 0.08
HIP, HIP_SIDE = 0.95, 0.10
NECK = 0.52
"""From the hips up to the base of the neck."""
SHOULDER_SIDE, SHOULDER_DROP = 0.20, 0.09
UPPER_ARM, FOREARM, PALM = 0.29, 0.27, 0.08
LOWER_ARM = FOREARM + PALM
"""From the elbow to the middle of the palm."""
SIDES = (1.0, -1.0)
"""Left, right: the sign of y."""
SEAT = 0.42
"""Height of the chair on which one sits, m: hips are a little above it."""

DOWN: Point = (-0.2, 0.5, -1.0)
OUT: Point = (-0.3, 1.0, -0.5)
"""Directions in which an elbow usually points: down, outward."""


@dataclass(frozen=True)
class Arm:
    """Pose of one arm, by its hand."""

    hand: Point = (0.06, 0.05, -0.60)
    """Middle of the palm from the shoulder, in the torso's axes: forward, outward, up; or in body
    coordinates where `is_absolute`."""
    elbow: Point = (-0.6, 0.5, -0.6)
    """Direction in which the elbow points: forward, outward, up, in the torso's axes."""
    is_absolute: bool = False


@dataclass(frozen=True)
class Leg:
    """Pose of one leg, by its foot."""

    foot: Point = (0.0, 0.08, ANKLE)
    """Ankle: forward, outward, up, in body coordinates."""
    knee: Point = (1.0, 0.1, 0.35)
    """Direction in which the knee points: forward, outward, up."""
    pitch: float = 0.0
    """Downward pitch of the toes."""


@dataclass(frozen=True)
class Posture:
    """One instant of a body; None = as the legs' gait has it."""

    hips: Point | None = None
    """Middle of the hips, body coordinates."""
    lean: float = 0.0
    """Torso forward; -pi/2 = on the back."""
    tilt: float = 0.0
    """Torso to its right."""
    turn: float = 0.0
    """Torso to its left, about the vertical."""
    nod: float = 0.0
    """Head down."""
    look: float = 0.0
    """Head to its left."""
    heading: float = 0.0
    """Whole body to its left about the vertical through the origin."""
    left: Arm | None = None
    right: Arm | None = None
    left_leg: Leg | None = None
    right_leg: Leg | None = None
    tool: Point = (0.45, 0.0, 0.9)
    """Direction of a long thing in the right hand: forward, outward, up, in the torso's axes."""


@dataclass(frozen=True)
class Skeleton:
    """All joints in body coordinates; pairs are left, right."""

    torso: Affine
    """[3, 4] torso axes, origin at the hips."""
    head: Affine
    """[3, 4] head axes, origin at the base of the neck."""
    shoulders: tuple[Point, Point]
    elbows: tuple[Point, Point]
    hands: tuple[Point, Point]
    hips: tuple[Point, Point]
    knees: tuple[Point, Point]
    ankles: tuple[Point, Point]
    pitches: tuple[float, float]
    heading: float
    tool: Point
    """Unit direction of a long thing in the right hand."""


def fill(posture: Posture, base: Posture) -> Posture:
    """A posture whose open fields are those of `base`; their leans add up where its hips are open.

    Args:
        posture: what the activity decides.
        base: a complete posture: standing or stepping.
    """
    if posture.hips is None:
        posture = replace(posture, hips=base.hips, lean=posture.lean + base.lean)
    return replace(
        posture,
        left=posture.left or base.left,
        right=posture.right or base.right,
        left_leg=posture.left_leg or base.left_leg,
        right_leg=posture.right_leg or base.right_leg,
    )


def blend(first: Posture, second: Posture, share: float) -> Posture:
    """Between two complete postures: the first at share 0, the second at 1."""
    if share <= 0.0:
        return first
    if share >= 1.0:
        return second
    a, b = (_absolute(fill(one, _REST)) for one in (first, second))
    blended: Posture = mixed(a, b, share)
    return blended


_REST = Posture((0.0, 0.0, HIP), left=Arm(), right=Arm(), left_leg=Leg(), right_leg=Leg())


def solve(posture: Posture) -> Skeleton:
    """Joints of a complete posture: elbows and knees by inverse kinematics of two bones.

    A hand or foot out of reach is drawn at the end of the straight limb.
    """
    posture = _absolute(posture)
    hips = posture.hips or (0.0, 0.0, HIP)
    torso = _torso_axes(posture)
    axes = torso[:, :3]
    heading = rotation("z", posture.heading)
    neck = torso @ np.array([0.0, 0.0, NECK, 1.0])
    head = axes @ rotation("z", posture.look) @ rotation("y", posture.nod)
    arms = [_solve_arm(torso, arm or Arm(), side)
            for arm, side in zip((posture.left, posture.right), SIDES, strict=True)]  # fmt: skip
    turn = rotation("z", posture.turn) if abs(posture.lean) < 1.0 else np.eye(3)
    legs = [
        _solve_leg(np.array(hips), axes, turn, leg or Leg(), side)
        for leg, side in zip((posture.left_leg, posture.right_leg), SIDES, strict=True)
    ]
    points = [[point(heading @ joint) for joint in limb] for limb in (*arms, *legs)]
    pitches = tuple((leg or Leg()).pitch for leg in (posture.left_leg, posture.right_leg))
    forward, out, up = posture.tool
    tool = heading @ axes @ np.array([forward, -out, up])
    return Skeleton(
        torso=np.column_stack([heading @ axes, heading @ torso[:, 3]]),
        head=np.column_stack([heading @ head, heading @ neck]),
        shoulders=(points[0][0], points[1][0]),
        elbows=(points[0][1], points[1][1]),
        hands=(points[0][2], points[1][2]),
        hips=(points[2][0], points[3][0]),
        knees=(points[2][1], points[3][1]),
        ankles=(points[2][2], points[3][2]),
        pitches=(pitches[0], pitches[1]),
        heading=posture.heading,
        tool=point(tool / max(float(np.linalg.norm(tool)), 1e-9)),
    )


def _solve_arm(torso: Affine, arm: Arm, side: float) -> list[Affine]:
    shoulder = torso @ np.array([0.0, side * SHOULDER_SIDE, NECK - SHOULDER_DROP, 1.0])
    forward, out, up = arm.elbow
    towards = torso[:, :3] @ np.array([forward, side * out, up])
    hand = _within(shoulder, np.array(arm.hand), UPPER_ARM + LOWER_ARM)
    elbow = bend(point(shoulder), point(hand), UPPER_ARM, LOWER_ARM, point(towards))
    return [shoulder, np.array(elbow), hand]


def _solve_leg(hips: Affine, axes: Affine, turn: Affine, leg: Leg, side: float) -> list[Affine]:
    hip = hips + axes @ np.array([0.0, side * HIP_SIDE, -0.02])
    forward, out, up = leg.knee
    towards = turn @ np.array([forward, side * out, up])
    x, y, z = leg.foot
    ankle = _within(hip, np.array([x, side * y, z]), THIGH + SHIN)
    knee = bend(point(hip), point(ankle), THIGH, SHIN, point(towards))
    return [hip, np.array(knee), ankle]


def _within(start: Affine, end: Affine, reach: float) -> Affine:
    """The end, or the point of the sphere of that reach in its direction."""
    span = end - start
    long = math.sqrt(float(span @ span))
    return end if long <= reach else start + span * (reach / long)


def _absolute(posture: Posture) -> Posture:
    """The same posture with hands in body coordinates (before the heading)."""
    if all(arm is not None and arm.is_absolute for arm in (posture.left, posture.right)):
        return posture
    torso = _torso_axes(posture)
    arms = []
    for arm, side in zip((posture.left, posture.right), SIDES, strict=True):
        where = arm or Arm()
        if not where.is_absolute:
            forward, out, up = where.hand
            spot = torso @ np.array(
                [forward, side * (SHOULDER_SIDE + out), NECK - SHOULDER_DROP + up, 1.0]
            )
            where = Arm(point(spot), where.elbow, True)
        arms.append(where)
    return replace(posture, left=arms[0], right=arms[1])


def _torso_axes(posture: Posture) -> Affine:
    turn = rotation("z", posture.turn) @ rotation("y", posture.lean) @ rotation("x", posture.tilt)
    return np.column_stack([turn, np.array(posture.hips or (0.0, 0.0, HIP))])

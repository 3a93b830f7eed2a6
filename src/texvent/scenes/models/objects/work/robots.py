"""A robot arm that moves blocks from pad to pad, and a gripper that opens, closes and grasps."""

from __future__ import annotations

import math

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.limb_kinematics import bend
from texvent.scenes.models.machine_acts import GRASP, PICK
from texvent.scenes.models.materials import RED, Material
from texvent.scenes.models.objects.palette import GREY_PLASTIC, INK, IRON, PALE, SILVER
from texvent.scenes.models.people.timing import ease, swing
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import (
    Point,
    ball,
    box,
    compose,
    limb,
    moved,
    plank,
    post,
    rod,
    shift,
    turn_y,
    turn_z,
)
from texvent.scenes.models.variation import paint
from texvent.scenes.scene import Colour

_BRIGHT: tuple[Colour, ...] = ((0.75, 0.22, 0.01), (0.75, 0.45, 0.02), (0.03, 0.15, 0.50))
_BLOCK = Material(RED)
_SIDE, _PAD_M = 0.20, 0.14
"""Edge of the block, and height of the pads that it lies on, m."""
_REACH_M, _TURN_RAD = 0.82, 0.95
_UPPER_M, _FORE_M = 0.66, 0.70
_SHOULDER: Point = (0.0, 0.0, 0.45)
_LOW_M, _HIGH_M = _PAD_M + 0.5 * _SIDE + 0.20, 0.92
"""Height of the wrist at the block and on the way, m."""
_KEYS = (
    # s, share of the turn, height of the wrist, how far the fingers are closed
    (0.0, 0.0, 1.0, 0.0),
    (0.40, 0.0, 0.0, 0.0),
    (0.52, 0.0, 0.0, 1.0),
    (0.85, 0.0, 1.0, 1.0),
    (1.40, 1.0, 1.0, 1.0),
    (1.70, 1.0, 0.0, 1.0),
    (1.82, 1.0, 0.0, 0.0),
    (2.20, 1.0, 1.0, 0.0),
)


def _finger(y: float) -> ModelPart:
    """A finger of the arm's gripper where it only moves."""
    return plank(
        IRON,
        (0.77, y, 0.96),
        (0.88, 0.8 * y, 0.83),
        chord=(0.04, 0.0, 0.04),
        thickness=(0.0, 0.02, 0.0),
    )


def _swaying(skin: Material, time_s: float) -> list[ModelPart]:
    """The arm as it turns and nods."""
    parts = [
        post(GREY_PLASTIC, (0.0, 0.0, 0.36), (0.32, 0.32, 0.14)),
        limb(skin, (0.0, 0.0, 0.45), (-0.15, 0.0, 1.05), 0.11),
        ball(IRON, (-0.15, 0.0, 1.05), (0.24, 0.28, 0.24)),
        limb(skin, (-0.15, 0.0, 1.05), (0.55, 0.0, 1.15), 0.085),
        ball(IRON, (0.60, 0.0, 1.15), (0.16, 0.18, 0.16)),
        rod(skin, (0.60, 0.0, 1.15), (0.78, 0.0, 0.95), 0.05),
        *(_finger(0.05 * s) for s in (1.0, -1.0)),
        rod(GREY_PLASTIC, (-0.10, 0.10, 0.55), (-0.12, 0.12, 1.0), 0.02),
    ]
    phase = 0.5 / (2.0 * math.pi)
    turn = turn_z(0.7 * swing(time_s, 0.25, phase), (0.0, 0.0, 0.0))
    nod = turn_y(0.35 * swing(time_s, 0.425, phase), _SHOULDER)
    return moved(parts, compose(turn, nod))


def _course(time_s: float) -> tuple[float, float, float, bool]:
    """Turn, height of the wrist, closing of the fingers, and whether the block has been put down.

    What lies on one pad is put on the other, and then back.
    """
    period = _KEYS[-1][0]
    number, clock = divmod(max(time_s, 0.0), period)
    after = next(n for n in range(1, len(_KEYS)) if clock <= _KEYS[n][0])
    first, last = _KEYS[after - 1], _KEYS[after]
    share = ease(clock, first[0], last[0])
    turn, height, grip = (first[k] + share * (last[k] - first[k]) for k in (1, 2, 3))
    side = 1.0 if number % 2 == 0 else -1.0
    angle = side * _TURN_RAD * (1.0 - 2.0 * turn)
    return angle, _LOW_M + height * (_HIGH_M - _LOW_M), grip, clock > _KEYS[5][0]


def _handling(skin: Material, time_s: float) -> list[ModelPart]:
    """The arm, its gripper over a block, the block and two pads."""
    angle, z, grip, is_done = _course(time_s)
    wrist: Point = (_REACH_M, 0.0, z)
    elbow = bend(_SHOULDER, wrist, _UPPER_M, _FORE_M, (-0.3, 0.0, 1.0))
    gap = 0.17 - 0.06 * grip
    arm = [
        post(GREY_PLASTIC, (0.0, 0.0, 0.36), (0.32, 0.32, 0.14)),
        limb(skin, _SHOULDER, elbow, 0.11),
        ball(IRON, elbow, (0.24, 0.28, 0.24)),
        limb(skin, elbow, wrist, 0.085),
        ball(IRON, wrist, (0.16, 0.18, 0.16)),
        box(skin, (_REACH_M, 0.0, z - 0.08), (0.10, 0.36, 0.05)),
        *(box(IRON, (_REACH_M, gap * s, z - 0.18), (0.07, 0.03, 0.18)) for s in (1.0, -1.0)),
    ]
    at = (_REACH_M, 0.0, _PAD_M + 0.5 * _SIDE)
    is_held = grip > 0.5
    lifted = (_REACH_M, 0.0, z - 0.20) if is_held else at
    block = box(_BLOCK, lifted, (_SIDE, _SIDE, _SIDE))
    side = math.copysign(_TURN_RAD, angle)
    if not is_held and abs(angle) < 0.99 * _TURN_RAD:
        side = -side if is_done else side
    turned = angle if is_held else side
    pads = [
        post(PALE, (_REACH_M * math.cos(a), _REACH_M * math.sin(a), 0.5 * _PAD_M),
             (0.42, 0.42, _PAD_M))
        for a in (_TURN_RAD, -_TURN_RAD)
    ]  # fmt: skip
    origin = (0.0, 0.0, 0.0)
    return [*moved(arm, turn_z(angle, origin)), *moved([block], turn_z(turned, origin)), *pads]


def _build_arm(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """An industrial robot, 1.5 m; `colour` is its paint."""
    skin = Material(paint(colour, seed, "paint", _BRIGHT))
    base = [
        box(IRON, (0.0, 0.0, 0.05), (0.60, 0.60, 0.10)),
        post(skin, (0.0, 0.0, 0.20), (0.36, 0.36, 0.20)),
    ]

    def articulate(pose: Pose) -> list[ModelPart]:
        return (_handling if pose.activity == PICK else _swaying)(skin, pose.time_s)

    return ArticulatedModel(base, scale=scale, articulate=articulate)


def _closing(activity: str, time_s: float) -> float:
    """How far the fingers are closed."""
    if activity == "open":
        return 1.0 - ease(time_s, 0.3, 1.5)
    if activity in ("close", GRASP):
        return ease(time_s, 0.3, 1.5 if activity == "close" else 0.9)
    return 0.5 - 0.5 * math.cos(math.pi * time_s) if activity in ("move", "work") else 0.0


def _build_gripper(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """A gripper with two fingers on a stand, 0.8 m; `colour` is its body."""
    skin = Material(paint(colour, seed, "paint", _BRIGHT))
    stand = [
        box(IRON, (0.0, 0.0, 0.02), (0.44, 0.70, 0.04)),
        post(SILVER, (-0.16, 0.0, 0.45), (0.07, 0.07, 0.90)),
        box(GREY_PLASTIC, (-0.06, 0.0, 0.84), (0.28, 0.12, 0.10)),
        post(PALE, (0.06, 0.0, 0.07), (0.20, 0.20, 0.06)),
    ]

    def articulate(pose: Pose) -> list[ModelPart]:
        shut = _closing(pose.activity, pose.time_s)
        holds = pose.activity == GRASP
        gap = 0.20 - (0.10 if holds else 0.165) * shut
        lift = 0.22 * ease(pose.time_s, 1.0, 1.8) if holds else 0.0
        hand = [
            post(skin, (0.06, 0.0, 0.66), (0.16, 0.16, 0.26)),
            box(skin, (0.06, 0.0, 0.50), (0.14, 0.50, 0.09)),
            *(box(INK, (0.06, gap * s, 0.36), (0.10, 0.05, 0.24)) for s in (1.0, -1.0)),
            *(box(IRON, (0.06, (gap - 0.03) * s, 0.20), (0.09, 0.04, 0.16)) for s in (1.0, -1.0)),
        ]
        thing = [ball(_BLOCK, (0.06, 0.0, 0.19), (0.17, 0.15, 0.17))] if holds else []
        return moved([*hand, *thing], shift(z=lift - (0.0 if holds else 0.02)))

    return ArticulatedModel(stand, scale=scale, articulate=articulate)


NOUNS = (
    Noun(
        "robot arm", _build_arm, "fixed", 0.0, "stand",
        ("robotic arm", "manipulator", "industrial robot", "mechanical arm"),
        place="indoor", is_working=True, acts=frozenset({PICK}),
    ),
    Noun(
        "gripper", _build_gripper, "fixed", 0.0, "stand",
        ("robot gripper", "robotic gripper", "mechanical claw", "end effector", "parallel gripper"),
        place="indoor", acts=frozenset({"open", "close", GRASP}),
    ),
)  # fmt: skip
"""The robot arm, and its gripper alone."""

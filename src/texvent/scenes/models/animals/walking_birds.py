"""Birds that walk: ostrich, flamingo, penguin and chicken, from one table of proportions."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial

from texvent.scenes.models.animals.acts import act_stance
from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.limb_kinematics import Gait, bend, foot_path, step_amount
from texvent.scenes.models.materials import (
    BLACK,
    ORANGE,
    WHITE,
    Material,
    feathers,
    leather,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import Point, ball, blade, limb, moved, shift, spike, turn_y
from texvent.scenes.models.variation import fraction
from texvent.scenes.scene import Colour


@dataclass(frozen=True)
class Strider:
    """Proportions and colours of a two-legged bird, m."""

    hip: float
    """Height of the hips."""
    body: tuple[float, float, float]
    """Full length, width and height of the trunk."""
    neck: float
    """Length of the neck."""
    neck_radius: float
    head: float
    """Length of the head without the beak."""
    beak: float
    gait: Gait
    plumage: Colour
    wing: Colour
    skin: Colour
    """Neck and head."""
    legs: Colour
    beak_colour: Colour
    comb: bool = False
    has_fan: bool = False
    """Whether the tail stands up as a fan."""


OSTRICH = Strider(
    1.22, (1.15, 0.78, 0.78), 1.00, 0.062, 0.20, 0.14, Gait(2.2, 0.45, 0.32),
    (0.022, 0.020, 0.020), (0.70, 0.68, 0.64), (0.42, 0.26, 0.19), (0.40, 0.26, 0.18),
    (0.45, 0.28, 0.16),
)  # fmt: skip
FLAMINGO = Strider(
    0.78, (0.46, 0.26, 0.28), 0.58, 0.026, 0.11, 0.11, Gait(0.8, 0.6, 0.16),
    (0.80, 0.30, 0.30), (0.78, 0.20, 0.20), (0.80, 0.32, 0.32), (0.70, 0.25, 0.22),
    (0.04, 0.03, 0.03),
)  # fmt: skip
CHICKEN = Strider(
    0.21, (0.36, 0.22, 0.24), 0.13, 0.045, 0.075, 0.035, Gait(0.28, 0.6, 0.05),
    (0.72, 0.66, 0.56), (0.45, 0.25, 0.10), (0.72, 0.66, 0.56), ORANGE, ORANGE, comb=True,
)  # fmt: skip


ROOSTER = replace(
    CHICKEN, hip=0.27, neck=0.17, plumage=(0.34, 0.10, 0.02), wing=(0.02, 0.06, 0.05),
    skin=(0.50, 0.22, 0.03),
)  # fmt: skip
TURKEY = replace(
    CHICKEN, hip=0.36, body=(0.58, 0.44, 0.44), neck=0.24, neck_radius=0.05, head=0.085,
    gait=Gait(0.42, 0.6, 0.06), plumage=(0.07, 0.045, 0.03), wing=(0.16, 0.09, 0.05),
    skin=(0.50, 0.10, 0.10), comb=False, has_fan=True,
)  # fmt: skip


def build_strider(
    kind: Strider, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a walking bird; `colour` is its plumage."""
    plumage = feathers(colour if colour is not None else kind.plumage)
    start = fraction(seed, "step")

    def articulate(pose: Pose) -> list[ModelPart]:
        amount = step_amount(pose.activity, pose.speed_m_s, 0.4 * kind.gait.stride)
        distance = pose.distance_m + start * kind.gait.stride
        turn = 2.0 * math.pi * distance / kind.gait.stride
        bob = 0.03 * kind.hip * amount * math.cos(2.0 * turn)
        parts = _trunk(kind, plumage, amount * math.sin(2.0 * turn))
        down = act_stance(pose.activity, pose.time_s).head_down
        if down:
            # The whole bird bows about its hips.
            parts = moved(parts, turn_y(_BOW * down, (0.0, 0.0, kind.hip)))
        parts = moved(parts, shift(z=bob))
        for side, offset in ((1.0, 0.0), (-1.0, 0.5)):
            foot = foot_path(kind.gait, distance, offset, amount)
            parts += _leg(kind, side, foot, bob)
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate)


_BOW = 1.0
"""Turn of a bird whose beak is at the ground, rad."""


def _trunk(kind: Strider, plumage: Material, nod: float) -> list[ModelPart]:
    """Body, wings, tail, neck and head; `nod` -1..1 moves the head forth and back."""
    length, width, height = kind.body
    z = kind.hip + 0.10 * height
    skin, wing = leather(kind.skin), feathers(kind.wing)
    neck_base: Point = (0.40 * length, 0.0, z + 0.15 * height)
    reach = 0.10 * kind.neck * (1.0 + 0.5 * nod)
    middle: Point = (neck_base[0] + 0.22 * kind.neck, 0.0, neck_base[2] + 0.42 * kind.neck)
    top: Point = (middle[0] - 0.02 * kind.neck + reach, 0.0, neck_base[2] + 0.97 * kind.neck)
    beak_base: Point = (top[0] + 0.55 * kind.head, 0.0, top[2] - 0.01)
    beak_tip: Point = (beak_base[0] + kind.beak, 0.0, beak_base[2] - 0.35 * kind.beak)
    eye = 0.16 * kind.head
    parts = [
        ball(plumage, (0.0, 0.0, z), kind.body),
        ball(
            plumage,
            (-0.22 * length, 0.0, z + 0.12 * height),
            (0.7 * length, 0.9 * width, 0.8 * height),
        ),
        ball(
            wing,
            (-0.48 * length, 0.0, z + 0.18 * height),
            (0.34 * length, 0.5 * width, 0.5 * height),
        ),
        limb(skin, neck_base, middle, 1.15 * kind.neck_radius),
        limb(skin, middle, top, kind.neck_radius),
        ball(
            skin,
            (top[0] + 0.2 * kind.head, 0.0, top[2]),
            (kind.head, 0.62 * kind.head, 0.62 * kind.head),
        ),
        spike(Material(kind.beak_colour), beak_base, beak_tip, 0.20 * kind.head),
        ball(
            Material(BLACK),
            (top[0] + 0.32 * kind.head, 0.0, top[2] + 0.10 * kind.head),
            (eye, 0.62 * kind.head, eye),
        ),
    ]
    for side in (1.0, -1.0):
        fold = (-0.08 * length, side * 0.43 * width, z + 0.02 * height)
        parts.append(ball(plumage, fold, (0.72 * length, 0.20 * width, 0.62 * height)))
        white = (-0.36 * length, side * 0.40 * width, z - 0.10 * height)
        parts.append(ball(wing, white, (0.36 * length, 0.20 * width, 0.26 * height)))
    if kind.has_fan:
        for angle in (-1.1, -0.66, -0.22, 0.22, 0.66, 1.1):
            tip = (
                -0.75 * length,
                0.75 * length * math.sin(angle),
                z + 0.80 * length * math.cos(angle),
            )
            base = (-0.40 * length, 0.0, z + 0.1 * height)
            parts.append(blade(wing, base, tip, chord=(0.0, 0.24 * length, 0.0),
                               thickness=(0.03 * length, 0.0, 0.0)))  # fmt: skip
    if kind.comb:
        red = Material((0.55, 0.02, 0.02))
        parts.append(ball(red, (top[0] + 0.01, 0.0, top[2] + 0.045), (0.08, 0.02, 0.06)))
        parts.append(ball(red, (top[0] + 0.04, 0.0, top[2] - 0.04), (0.03, 0.03, 0.05)))
    return parts


def _leg(kind: Strider, side: float, foot: tuple[float, float], bob: float) -> list[ModelPart]:
    """A feathered thigh and a bare shank; what bends backwards is the heel, high off the ground."""
    x, lift = foot
    thick = 0.030 * kind.hip
    y = side * 0.26 * kind.body[1]
    hip: Point = (0.0, y, kind.hip - 0.15 * kind.body[2] + bob)
    ankle: Point = (x, y, thick + lift)
    half = 0.54 * kind.hip
    heel = bend(hip, ankle, half, half, (-1.0, 0.0, 0.0))
    legs = Material(kind.legs)
    toes: Point = (x + 0.13 * kind.hip, y, thick + lift)
    return [
        limb(legs, hip, heel, 2.8 * thick),
        limb(legs, heel, ankle, 1.1 * thick),
        limb(legs, ankle, toes, thick),
    ]


def build_penguin(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a penguin that waddles; `colour` is its back."""
    back = feathers(colour if colour is not None else BLACK)
    front, feet = feathers(WHITE), leather(ORANGE)
    gait = Gait(0.30, 0.6, 0.04)
    start = fraction(seed, "step")
    trunk = [
        limb(back, (-0.02, 0.0, 0.14), (0.0, 0.0, 0.58), 0.17, side_radius=0.18),
        ball(front, (0.055, 0.0, 0.36), (0.26, 0.27, 0.52)),
        ball(back, (0.02, 0.0, 0.74), (0.19, 0.17, 0.18)),
        ball(Material((0.72, 0.42, 0.05)), (0.045, 0.0, 0.68), (0.15, 0.155, 0.07)),
        spike(feet, (0.10, 0.0, 0.74), (0.20, 0.0, 0.72), 0.025),
        ball(front, (0.075, 0.0, 0.77), (0.04, 0.14, 0.03)),
        limb(back, (0.0, 0.17, 0.56), (-0.04, 0.26, 0.28), 0.05, side_radius=0.02),
        limb(back, (0.0, -0.17, 0.56), (-0.04, -0.26, 0.28), 0.05, side_radius=0.02),
    ]

    def articulate(pose: Pose) -> list[ModelPart]:
        amount = step_amount(pose.activity, pose.speed_m_s, 0.15)
        distance = pose.distance_m + start * gait.stride
        sway = 0.05 * amount * math.sin(2.0 * math.pi * distance / gait.stride)
        parts = moved(trunk, shift(y=sway))
        for side, offset in ((1.0, 0.0), (-1.0, 0.5)):
            x, z = foot_path(gait, distance, offset, amount)
            parts.append(ball(feet, (x + 0.05, 0.09 * side, 0.025 + z), (0.20, 0.11, 0.05)))
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate)


_ACTS = frozenset({"graze", "eat", "drink", "peck", "nod", "bark", "howl"})
NOUNS = (
    Noun("ostrich", partial(build_strider, OSTRICH), "ground", 2.5, "walk", acts=_ACTS),
    Noun("flamingo", partial(build_strider, FLAMINGO), "ground", 0.6, "walk", acts=_ACTS),
    Noun("chicken", partial(build_strider, CHICKEN), "ground", 0.4, "walk", ("hen",), acts=_ACTS),
    Noun("rooster", partial(build_strider, ROOSTER), "ground", 0.4, "walk", acts=_ACTS),
    Noun("turkey", partial(build_strider, TURKEY), "ground", 0.4, "walk", acts=_ACTS),
    Noun("penguin", build_penguin, "ground", 0.4, "walk"),
)

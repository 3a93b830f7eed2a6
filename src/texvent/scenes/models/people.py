"""People: walking, running, standing or sitting, from one table of proportions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.limb_kinematics import Gait, bend, foot_path, step_amount
from texvent.scenes.models.materials import (
    CLOTH_COLOURS,
    DARK,
    HAIR_COLOURS,
    ORANGE,
    SKIN_TONES,
    YELLOW,
    Material,
    cloth,
    fur,
    skin,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import Point, ball, limb, peak
from texvent.scenes.models.variation import choose, paint
from texvent.scenes.scene import Colour

WALK = Gait(stride=1.25, duty=0.60, lift=0.12)
RUN = Gait(stride=2.40, duty=0.34, lift=0.32)

_THIGH, _SHIN, _ANKLE = 0.43, 0.43, 0.08
_HIP, _HIP_SIDE = 0.95, 0.10
UPPER_ARM, FOREARM = 0.29, 0.27


@dataclass(frozen=True)
class PersonKind:
    """What sets one kind of person apart."""

    height: float = 1.0
    """Relative to an adult of 1.75 m."""
    head: float = 1.0
    """Head size relative to the body: children have large heads."""
    dress: str = "trousers"
    """ "trousers", "skirt", "shorts"."""
    long_hair: bool = False
    hat: str = ""
    """ "", "helmet"."""
    runs: bool = False
    """Whether it runs unless told otherwise."""
    shirts: tuple[Colour, ...] = CLOTH_COLOURS


@dataclass(frozen=True)
class Outfit:
    """Surfaces of one person."""

    skin: Material
    hair: Material
    shirt: Material
    legs: Material
    shins: Material
    shoes: Material


ADULT = PersonKind()
WOMAN = PersonKind(height=0.95, dress="skirt", long_hair=True)
CHILD = PersonKind(height=0.66, head=1.3, dress="shorts")
RUNNER = PersonKind(dress="shorts", runs=True)
WORKER = PersonKind(hat="helmet", shirts=(ORANGE,))


def build_person(
    kind: PersonKind, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a person; `colour` is the shirt or dress."""
    outfit = dress_person(kind, colour=colour, seed=seed)

    def articulate(pose: Pose) -> list[ModelPart]:
        runs = pose.activity == "run" or (kind.runs and pose.activity == "move")
        gait = RUN if runs else WALK
        amount = step_amount(pose.activity, pose.speed_m_s, 0.5)
        return _person(kind, outfit, gait, (pose.distance_m, amount, pose.activity == "sit"))

    return ArticulatedModel([], scale=scale * kind.height, articulate=articulate)


def dress_person(kind: PersonKind, *, colour: Colour | None, seed: int) -> Outfit:
    """Choose skin, hair and clothes."""
    flesh = skin(choose(seed, "skin", SKIN_TONES))
    shirt = cloth(paint(colour, seed, "shirt", kind.shirts))
    trousers = cloth(choose(seed, "trousers", ((0.03, 0.05, 0.12), (0.06, 0.055, 0.05))))
    legs = shirt if kind.dress == "skirt" else trousers
    return Outfit(
        skin=flesh,
        hair=fur(choose(seed, "hair", HAIR_COLOURS)),
        shirt=shirt,
        legs=flesh if kind.dress == "skirt" else legs,
        shins=trousers if kind.dress == "trousers" else flesh,
        shoes=DARK if kind.dress != "shorts" else Material((0.6, 0.6, 0.58)),
    )


def draw_head(kind: PersonKind, outfit: Outfit, neck: Point) -> list[ModelPart]:
    """Neck, head, nose, hair and hat above the base of the neck."""
    x, y, z = neck
    size = 0.23 * kind.head
    middle = z + 0.09 + 0.5 * size
    parts = [
        limb(outfit.skin, (x, y, z - 0.02), (x + 0.01, y, z + 0.12), 0.055),
        ball(outfit.skin, (x + 0.02, y, middle), (0.9 * size, 0.78 * size, 1.08 * size)),
        ball(outfit.skin, (x + 0.02 + 0.46 * size, y, middle - 0.02), (0.05, 0.04, 0.06)),
        ball(
            outfit.hair,
            (x - 0.005, y, middle + 0.16 * size),
            (0.92 * size, 0.86 * size, 0.92 * size),
        ),
    ]
    if kind.long_hair:
        parts.append(ball(outfit.hair, (x - 0.07, y, z + 0.06), (0.13, 0.20, 0.36)))
    if kind.hat == "helmet":
        yellow = Material(YELLOW)
        parts.append(ball(yellow, (x + 0.01, y, middle + 0.28 * size), (0.28, 0.25, 0.22)))
        parts.append(ball(yellow, (x + 0.05, y, middle + 0.26 * size), (0.38, 0.30, 0.05)))
    return parts


def draw_torso(kind: PersonKind, outfit: Outfit, hips: Point, neck: Point) -> list[ModelPart]:
    """Pelvis, chest, shoulders, and a skirt or a vest's stripes."""
    waist = (0.6 * hips[0] + 0.4 * neck[0], hips[1], 0.6 * hips[2] + 0.4 * neck[2])
    collar = (neck[0], neck[1], neck[2] - 0.10)
    low = (hips[0], hips[1], hips[2] + 0.02)
    pelvis = outfit.shirt if kind.dress == "skirt" else outfit.legs
    parts = [
        limb(pelvis, (low[0], low[1], low[2] - 0.06), waist, 0.115, side_radius=0.165),
        limb(outfit.shirt, low, collar, 0.125, side_radius=0.17),
        ball(outfit.shirt, (neck[0], neck[1], neck[2] - 0.12), (0.22, 0.43, 0.24)),
    ]
    if kind.dress == "skirt":
        skirt = (hips[0] + 0.02, hips[1], hips[2] - 0.02)
        parts.append(peak(outfit.shirt, skirt, (0.74, 0.62, 1.00)))
    if kind.hat == "helmet":
        band = Material((0.75, 0.75, 0.3), emission=0.2)
        parts.append(ball(band, (waist[0], waist[1], waist[2] + 0.04), (0.265, 0.36, 0.09)))
    return parts


def draw_arm(outfit: Outfit, shoulder: Point, elbow: Point, hand: Point) -> list[ModelPart]:
    """Sleeve, forearm and hand."""
    return [
        limb(outfit.shirt, shoulder, elbow, 0.055),
        limb(outfit.skin, elbow, hand, 0.042),
        ball(outfit.skin, hand, (0.10, 0.07, 0.11)),
    ]


def draw_leg(outfit: Outfit, hip: Point, ankle: Point, *, pitch: float = 0.0) -> list[ModelPart]:
    """Thigh, shin and shoe, the knee pointing forward; `pitch` radians tip the toes down."""
    knee = bend(hip, ankle, _THIGH, _SHIN, (1.0, 0.0, 0.35))
    heel = (ankle[0] - 0.05, ankle[1], ankle[2] - 0.035)
    toe_x, toe_z = 0.13 * math.cos(pitch), 0.13 * math.sin(pitch)
    toe = (ankle[0] + toe_x, ankle[1], ankle[2] - 0.035 - toe_z)
    return [
        limb(outfit.legs, hip, knee, 0.085),
        limb(outfit.shins, knee, ankle, 0.058),
        limb(outfit.shoes, heel, toe, 0.044),
    ]


def _person(
    kind: PersonKind, outfit: Outfit, gait: Gait, stepping: tuple[float, float, bool]
) -> list[ModelPart]:
    distance, amount, sits = stepping
    runs = gait is RUN
    turn = 2.0 * math.pi * distance / gait.stride
    # A walker is highest in mid-stance, a runner lowest; legs are nearly straight at both.
    bob = -0.03 * math.cos(2.0 * turn + 1.0) if runs else 0.03 * math.cos(2.0 * turn - 0.63)
    drop = 0.05 if runs else 0.02
    hip_z = 0.50 if sits else _HIP + amount * (bob - drop)
    lean = amount * (0.16 if runs else 0.04)
    hips: Point = (0.0, 0.0, hip_z)
    neck: Point = (lean * 0.52, 0.0, hip_z + 0.52)
    parts = [*draw_torso(kind, outfit, hips, neck), *draw_head(kind, outfit, neck)]
    for side, offset in ((1.0, 0.0), (-1.0, 0.5)):
        parts += _leg_at(outfit, gait, (hip_z, side), (distance, offset, amount), sits)
        # Each arm swings with the opposite leg.
        swing = amount * (0.75 if runs else 0.42) * math.sin(turn + 2.0 * math.pi * offset)
        fold = 0.12 + amount * (1.45 if runs else 0.18)
        if sits:
            swing, fold = 0.55, 0.9
        parts += _swung_arm(outfit, neck, side, (swing, fold))
    return parts


def _leg_at(
    outfit: Outfit,
    gait: Gait,
    hip_at: tuple[float, float],
    step: tuple[float, float, float],
    sits: bool,
) -> list[ModelPart]:
    hip_z, side = hip_at
    distance, offset, amount = step
    hip = (0.0, side * _HIP_SIDE, hip_z - 0.02)
    if sits:
        return draw_leg(outfit, hip, (0.40, side * _HIP_SIDE, _ANKLE))
    x, z = foot_path(gait, distance, offset + 0.25, amount)
    pitch = 0.9 * z / max(gait.lift, 1e-9) * 0.6
    return draw_leg(outfit, hip, (x, side * 0.8 * _HIP_SIDE, _ANKLE + z), pitch=pitch)


def _swung_arm(
    outfit: Outfit, neck: Point, side: float, angles: tuple[float, float]
) -> list[ModelPart]:
    swing, fold = angles
    shoulder = (neck[0], side * 0.20, neck[2] - 0.09)
    elbow = (
        shoulder[0] + UPPER_ARM * math.sin(swing),
        shoulder[1] + side * 0.04,
        shoulder[2] - UPPER_ARM * math.cos(swing),
    )
    hand = (
        elbow[0] + FOREARM * math.sin(swing + fold),
        elbow[1] - side * 0.01,
        elbow[2] - FOREARM * math.cos(swing + fold),
    )
    return draw_arm(outfit, shoulder, elbow, hand)


NOUNS = (
    Noun(
        "person", partial(build_person, ADULT), "ground", 1.4, "walk",
        ("pedestrian", "human", "walker", "somebody", "tourist", "hiker"), ("people",),
    ),
    Noun(
        "man", partial(build_person, ADULT), "ground", 1.4, "walk",
        ("guy", "gentleman", "businessman"),
    ),
    Noun("woman", partial(build_person, WOMAN), "ground", 1.3, "walk", ("lady", "businesswoman")),
    Noun(
        "child", partial(build_person, CHILD), "ground", 1.1, "walk",
        ("kid", "boy", "girl", "toddler"), ("children",),
    ),
    Noun(
        "runner", partial(build_person, RUNNER), "ground", 3.5, "run",
        ("jogger", "athlete", "sprinter", "marathon runner"),
    ),
    Noun(
        "worker", partial(build_person, WORKER), "ground", 1.2, "walk",
        ("construction worker", "builder", "workman"),
    ),
)  # fmt: skip

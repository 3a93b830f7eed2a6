"""Birds that fly with flapping wings, and ducks that float."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import partial

from texvent.scenes.models.animals.acts import act_stance
from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    BLACK,
    WHITE,
    Material,
    feathers,
    shade,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import (
    Point,
    ball,
    blade,
    limb,
    moved,
    part_way,
    spike,
    turn_x,
    turn_y,
    turn_z,
)
from texvent.scenes.models.variation import fraction, paint
from texvent.scenes.scene import Colour


@dataclass(frozen=True)
class Plumage:
    """Proportions, in body lengths, and colours of a bird in flight."""

    length: float
    """Beak to tail, m."""
    span: float
    """Of both wings, body lengths."""
    chord: float
    """Width of a wing, body lengths."""
    flap_hz: float
    flap: float
    """Swing of a wing to either side, radians."""
    bodies: tuple[Colour, ...]
    wing: Colour
    head: Colour
    beak: Colour


SMALL = Plumage(
    0.45, 1.9, 0.42, 4.0, 0.75, ((0.05, 0.14, 0.40), (0.25, 0.07, 0.04), (0.22, 0.16, 0.10)),
    (0.06, 0.07, 0.10), (0.03, 0.04, 0.06), (0.55, 0.30, 0.02),
)  # fmt: skip
EAGLE = Plumage(
    0.95, 2.4, 0.46, 1.6, 0.42, ((0.075, 0.038, 0.018),),
    (0.060, 0.032, 0.016), (0.75, 0.73, 0.68), (0.70, 0.42, 0.03),
)  # fmt: skip
GULL = Plumage(
    0.60, 2.5, 0.32, 2.2, 0.50, ((0.78, 0.78, 0.77),),
    (0.42, 0.44, 0.47), (0.80, 0.80, 0.79), (0.70, 0.40, 0.03),
)  # fmt: skip

PARROT = Plumage(
    0.55, 1.9, 0.40, 3.5, 0.65, ((0.55, 0.03, 0.02), (0.05, 0.35, 0.08)),
    (0.04, 0.14, 0.50), (0.60, 0.05, 0.03), (0.60, 0.55, 0.45),
)  # fmt: skip


def build_flier(
    plumage: Plumage, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a bird in flight; `colour` is its body and wings."""
    size = plumage.length
    body = feathers(paint(colour, seed, "body", plumage.bodies))
    wing = feathers(shade(colour, 0.8) if colour is not None else plumage.wing)
    head, beak = feathers(plumage.head), Material(plumage.beak)
    rigid = [
        limb(body, (-0.28 * size, 0.0, 0.0), (0.22 * size, 0.0, 0.02 * size), 0.13 * size),
        ball(head, (0.34 * size, 0.0, 0.06 * size), (0.22 * size, 0.18 * size, 0.18 * size)),
        spike(beak, (0.42 * size, 0.0, 0.05 * size), (0.56 * size, 0.0, 0.02 * size), 0.04 * size),
        ball(
            Material(BLACK),
            (0.39 * size, 0.0, 0.09 * size),
            (0.04 * size, 0.19 * size, 0.04 * size),
        ),
        blade(
            wing,
            (-0.22 * size, 0.0, 0.01 * size),
            (-0.58 * size, 0.0, 0.0),
            chord=(0.0, 0.30 * size, 0.0),
            thickness=(0.0, 0.0, 0.04 * size),
        ),
    ]
    start = fraction(seed, "flap")

    def articulate(pose: Pose) -> list[ModelPart]:
        if pose.activity in ("stand", "sit") or pose.activity in BIRD_ACTS:
            wings = [*_folded(plumage, wing, 1.0), *_folded(plumage, wing, -1.0)]
            down = act_stance(pose.activity, pose.time_s).head_down
            return [
                *moved([*rigid, *wings], turn_y(1.05 * down - _PERCHED)),
                *_legs(size, beak, 0.0),
            ]
        turn = 2.0 * math.pi * (plumage.flap_hz * pose.time_s + start)
        inner = plumage.flap * math.sin(turn) + 0.12
        outer = 0.8 * plumage.flap * math.sin(turn - 0.9) - 0.10
        return [
            *rigid,
            *_wing(plumage, wing, 1.0, (inner, outer)),
            *_wing(plumage, wing, -1.0, (inner, outer)),
            *_legs(size, beak, 1.0),
        ]

    return ArticulatedModel([], scale=scale, articulate=articulate, is_centred=True)


BIRD_ACTS = frozenset({"peck", "eat", "drink", "nod"})
"""Acts of birds that perch; a bird that does them is on the ground."""
_PERCHED = 0.75
"""How far the body of a bird that stands is turned up, rad."""


def _legs(size: float, skin: Material, tucked: float) -> list[ModelPart]:
    """Two legs with their toes; `tucked` 1 = back along the body, as in flight."""
    parts = []
    for side in (1.0, -1.0):
        hip: Point = (-0.04 * size, side * 0.07 * size, -0.08 * size)
        low: Point = (-0.02 * size, side * 0.07 * size, -0.34 * size)
        back: Point = (-0.28 * size, side * 0.05 * size, -0.10 * size)
        foot = part_way(low, back, tucked)
        toe = (foot[0] + (0.12 - 0.16 * tucked) * size, foot[1], foot[2])
        parts += [limb(skin, hip, foot, 0.022 * size), limb(skin, foot, toe, 0.018 * size)]
    return parts


def _wing(
    plumage: Plumage, material: Material, side: float, lift: tuple[float, float]
) -> list[ModelPart]:
    """A spread wing; angles from horizontal at the shoulder, then at the wrist."""
    shoulder, wrist, arm, hand = _spread(plumage, material, side)
    inner, outer = lift
    bent = moved([hand], turn_x(side * outer, wrist))
    return moved([arm, *bent], turn_x(side * inner, shoulder))


def _folded(plumage: Plumage, material: Material, side: float) -> list[ModelPart]:
    """A wing at rest along the body: the hand lies back over the arm."""
    shoulder, wrist, arm, hand = _spread(plumage, material, side)
    closed = [arm, *moved([hand], turn_z(-3.05 * side, wrist))]
    along = moved(closed, turn_z(1.45 * side, shoulder))
    return moved(along, turn_x(-0.7 * side, shoulder))


def _spread(
    plumage: Plumage, material: Material, side: float
) -> tuple[Point, Point, ModelPart, ModelPart]:
    """Shoulder, wrist, and the inner and outer half of a flat wing."""
    size, half = plumage.length, 0.5 * plumage.span * plumage.length
    shoulder: Point = (0.08 * size, side * 0.07 * size, 0.06 * size)
    wrist: Point = (0.12 * size, side * (0.07 * size + 0.48 * half), 0.06 * size)
    tip: Point = (-0.10 * size, side * half, 0.06 * size)
    chord, thin = plumage.chord * size, 0.035 * size
    arm = blade(
        material,
        part_way(shoulder, wrist, -0.1),
        part_way(shoulder, wrist, 1.15),
        chord=(chord, 0.0, 0.0),
        thickness=(0.0, 0.0, 1.3 * thin),
    )
    hand = blade(
        material,
        part_way(wrist, tip, -0.2),
        tip,
        chord=(0.8 * chord, 0.0, 0.0),
        thickness=(0.0, 0.0, thin),
    )
    return shoulder, wrist, arm, hand


def build_swan(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a swan afloat, its origin on the waterline; `colour` is its plumage."""
    hue = colour if colour is not None else (0.82, 0.81, 0.78)
    coat, bill = feathers(hue), Material((0.65, 0.25, 0.02))
    bones = [(0.34, 0.12), (0.50, 0.28), (0.46, 0.48), (0.40, 0.66), (0.50, 0.78)]
    neck = [
        limb(coat, (a[0], 0.0, a[1]), (b[0], 0.0, b[1]), 0.060)
        for a, b in itertools.pairwise(bones)
    ]
    parts = [
        limb(coat, (-0.34, 0.0, 0.10), (0.34, 0.0, 0.08), 0.20, side_radius=0.24),
        *(ball(coat, (-0.08, y, 0.20), (0.74, 0.16, 0.30)) for y in (0.17, -0.17)),
        spike(coat, (-0.36, 0.0, 0.18), (-0.72, 0.0, 0.28), 0.12),
        *neck,
        ball(coat, (0.54, 0.0, 0.79), (0.18, 0.12, 0.13)),
        spike(bill, (0.60, 0.0, 0.78), (0.76, 0.0, 0.74), 0.035),
        ball(Material(BLACK), (0.605, 0.0, 0.81), (0.06, 0.10, 0.04)),
    ]
    start = 2.0 * math.pi * fraction(seed, "rock")

    def articulate(pose: Pose) -> list[ModelPart]:
        return moved(parts, turn_x(0.03 * math.sin(2.5 * pose.time_s + start)))

    return ArticulatedModel([], scale=scale, articulate=articulate)


def build_duck(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a duck afloat, its origin on the waterline; it rocks a little."""
    body = feathers(colour if colour is not None else (0.30, 0.22, 0.14))
    head = feathers((0.02, 0.16, 0.06) if colour is None else colour)
    parts = [
        limb(body, (-0.20, 0.0, 0.05), (0.16, 0.0, 0.05), 0.12, side_radius=0.13),
        spike(Material(BLACK), (-0.22, 0.0, 0.08), (-0.38, 0.0, 0.18), 0.06),
        limb(Material(WHITE), (0.17, 0.0, 0.10), (0.21, 0.0, 0.21), 0.046),
        limb(head, (0.19, 0.0, 0.17), (0.22, 0.0, 0.28), 0.052),
        ball(head, (0.23, 0.0, 0.29), (0.15, 0.12, 0.12)),
        ball(Material((0.70, 0.38, 0.02)), (0.33, 0.0, 0.275), (0.14, 0.07, 0.035)),
        ball(Material(BLACK), (0.26, 0.0, 0.31), (0.025, 0.122, 0.025)),
        ball(feathers((0.16, 0.12, 0.09)), (-0.05, 0.0, 0.10), (0.36, 0.27, 0.15)),
    ]
    start = 2.0 * math.pi * fraction(seed, "rock")

    def articulate(pose: Pose) -> list[ModelPart]:
        return moved(parts, turn_x(0.06 * math.sin(4.0 * pose.time_s + start)))

    return ArticulatedModel([], scale=scale, articulate=articulate)


NOUNS = (
    Noun(
        "bird", partial(build_flier, SMALL), "air", 5.0, "fly", acts=BIRD_ACTS,
    ),
    Noun(
        "eagle", partial(build_flier, EAGLE), "air", 9.0, "fly", acts=BIRD_ACTS,
    ),
    Noun("gull", partial(build_flier, GULL), "air", 8.0, "fly", ("seagull",), acts=BIRD_ACTS),
    Noun("parrot", partial(build_flier, PARROT), "air", 5.0, "fly", acts=BIRD_ACTS),
    Noun("swan", build_swan, "water", 0.5, "paddle"),
    Noun("duck", build_duck, "water", 0.6, "paddle"),
)  # fmt: skip

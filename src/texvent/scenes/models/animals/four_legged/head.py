"""Heads of four-legged animals: skull, muzzle, eyes, ears, horns, and a trunk."""

from __future__ import annotations

import math

from texvent.scenes.models.animals.acts import STANDING, Stance
from texvent.scenes.models.animals.four_legged.build import Build, Coat
from texvent.scenes.models.materials import BLACK, WHITE, Material
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Point,
    ball,
    limb,
    moved,
    part_way,
    spike,
    turn_y,
    turn_z,
)

NOSE = 2
"""Which of the parts of a head the nose is."""


def draw_head(
    build: Build, coat: Coat, top: Point, wag: float = 0.0, stance: Stance = STANDING
) -> list[ModelPart]:
    """A head whose neck ends at `top`; `wag`, -1 to 1, moves ears and trunk."""
    skull, muzzle = build.head
    face = coat.limbs if not build.fleece else coat.dark
    nose: Point = (top[0] + 0.35 * skull + muzzle, 0.0, top[2] - 0.45 * muzzle - 0.05 * skull)
    brow: Point = (top[0] + 0.30 * skull, 0.0, top[2])
    eye_y, eye = 0.30 * skull, 0.13 * skull
    parts = [
        ball(face, (top[0] + 0.12 * skull, 0.0, top[2]), (skull, 0.74 * skull, 0.84 * skull)),
        limb(coat.muzzle or face, brow, nose, 0.24 * skull, side_radius=0.23 * skull),
        ball(coat.dark, nose, (0.34 * skull, 0.42 * skull, 0.34 * skull)),
    ]
    if coat.face is not None:
        parts += coat.face(build, top)
    parts += [
        ball(Material(BLACK), (top[0] + 0.36 * skull, y, top[2] + 0.16 * skull), (eye,) * 3)
        for y in (eye_y, -eye_y)
    ]
    for side in (1.0, -1.0):
        parts.append(_ear(build, coat, (top, side), 0.12 * wag))
        parts += _horn(build, coat, top, side)
    parts += _mouth(build, coat.muzzle or face, (brow, nose), stance)
    return [*parts, *_trunk(build, coat, nose, wag, stance.trunk)]


def _mouth(
    build: Build, jaw: Material, along: tuple[Point, Point], stance: Stance
) -> list[ModelPart]:
    """A lower jaw that opens, and a tongue; both inside the muzzle while it is shut."""
    skull, _ = build.head
    brow, nose = along
    hinge = (brow[0], 0.0, brow[2] - 0.10 * skull)
    tip = (nose[0] - 0.04 * skull, 0.0, nose[2] - 0.06 * skull)
    opened = turn_y(0.75 * stance.gape, hinge)
    out = 0.42 * skull * stance.tongue
    root = (tip[0] - 0.30 * skull, 0.0, tip[2] + 0.08 * skull)
    end = (tip[0] + 0.10 * skull + 0.7 * out, 0.0, tip[2] + 0.06 * skull - out)
    if stance.tongue <= 0.0:
        end = (tip[0] - 0.10 * skull, 0.0, root[2])
    return moved(
        [
            limb(jaw, hinge, tip, 0.13 * skull, side_radius=0.17 * skull),
            limb(_TONGUE, root, end, 0.05 * skull, side_radius=0.12 * skull),
        ],
        opened,
    )


_TONGUE = Material((0.75, 0.16, 0.20))


def _ear(build: Build, coat: Coat, at: tuple[Point, float], twitch: float) -> ModelPart:
    (x, _, z), side = at
    skull = build.head[0]
    long, kind = build.ear
    material = coat.ears or (coat.dark if kind == "flop" or build.fleece else coat.limbs)
    root = (x - 0.05 * skull, side * 0.28 * skull, z + 0.30 * skull)
    if kind == "fan":
        middle = (x - 0.40 * skull, side * (0.70 + 0.15 * twitch) * skull, z - 0.10 * skull)
        return moved(
            [ball(coat.dark, middle, (0.95 * long, 0.12 * skull, 1.15 * long))],
            turn_z(-0.7 * side, middle),
        )[0]
    if kind == "round":
        return ball(material, (root[0], root[1], root[2] + 0.05 * skull), (0.5 * long, long, long))
    if kind == "wide":
        middle = (root[0], root[1] + side * 0.42 * long, root[2] - 0.05 * skull)
        return ball(material, middle, (0.75 * long, 1.1 * long, long))
    if kind == "flop":
        tip = (root[0] - 0.1 * long, root[1] + side * 0.3 * skull, root[2] - long)
        return limb(material, root, tip, 0.34 * long, side_radius=0.15 * long)
    if kind == "long":
        tip = (root[0] - 0.3 * long, root[1] + side * 0.1 * long, root[2] + long)
        return limb(material, (root[0], 0.6 * root[1], root[2]), tip, 0.15 * long)
    if kind == "side":
        tip = (root[0] - 0.2 * long, root[1] + side * long, root[2] + 0.15 * long)
        return limb(material, root, tip, 0.22 * long)
    tip = (root[0] - 0.1 * long, 1.15 * root[1], root[2] + long)
    return spike(material, (root[0], root[1], root[2] - 0.1 * long), tip, 0.40 * long)


def _horn(build: Build, coat: Coat, top: Point, side: float) -> list[ModelPart]:
    skull = build.head[0]
    x, y, z = top[0] + 0.05 * skull, side * 0.16 * skull, top[2] + 0.36 * skull
    bone = Material((0.55, 0.48, 0.36))
    if build.horns == "short":
        return [spike(bone, (x, y, z), (x + 0.04, y + side * 0.10, z + 0.20), 0.035)]
    if build.horns == "knobs":
        return [limb(coat.dark, (x, y, z), (x - 0.04, y, z + 0.16), 0.03)]
    if build.horns == "tusks":
        start = (x + 0.42 * skull, side * 0.28 * skull, z - 0.72 * skull)
        end = (start[0] + 0.75, start[1] + side * 0.06, start[2] - 0.30)
        return [spike(Material(WHITE), start, end, 0.075)]
    if build.horns == "antlers":
        fork = (x - 0.10, y + side * 0.16, z + 0.24)
        tip, tine = (x - 0.02, y + side * 0.26, z + 0.52), (x + 0.14, y + side * 0.20, z + 0.40)
        low = (x + 0.16, y + side * 0.10, z + 0.20)
        return [
            limb(bone, (x, y, z), fork, 0.020),
            limb(bone, fork, tip, 0.016),
            limb(bone, fork, tine, 0.014),
            limb(bone, part_way((x, y, z), fork, 0.4), low, 0.013),
        ]
    return []


def _trunk(build: Build, coat: Coat, nose: Point, wag: float, raised: float) -> list[ModelPart]:
    """Down from the nose; `raised` 1 curls it up and back over the head."""
    if build.trunk == 0.0:
        return []
    sway = 0.10 * wag * (1.0 - raised)
    parts = []
    here: Point = (nose[0] + 0.02, 0.0, nose[2])
    step = build.trunk / len(_TRUNK_DOWN)
    for index, (low, high) in enumerate(zip(_TRUNK_DOWN, _TRUNK_UP, strict=True)):
        bent = low + raised * (high - low) + sway * (index + 1)
        there = (here[0] + step * math.cos(bent), 0.0, here[2] + step * math.sin(bent))
        parts.append(limb(coat.limbs, here, there, (0.116 - 0.016 * index) * build.trunk))
        here = there
    return parts


_TRUNK_DOWN = (-1.10, -1.30, -1.45, -1.40, -1.10)
_TRUNK_UP = (0.30, 0.95, 1.60, 2.25, 2.75)
"""Directions of its pieces, rad."""

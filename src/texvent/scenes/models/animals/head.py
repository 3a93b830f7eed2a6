"""Heads of four-legged animals: skull, muzzle, eyes, ears, marks, and a trunk."""

from __future__ import annotations

import math

from texvent.scenes.models.animals.acts import STANDING, Stance
from texvent.scenes.models.animals.build import Build, Coat, placed_marks
from texvent.scenes.models.materials import BLACK, Material
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Point,
    ball,
    limb,
    moved,
    spike,
    turn_y,
    turn_z,
)

NOSE = 2
"""Which of the parts of a head the nose is."""


def draw_head(
    build: Build,
    coat: Coat,
    top: Point,
    wag: float = 0.0,
    stance: Stance = STANDING,
    curled: float = 0.0,
) -> list[ModelPart]:
    """A head whose neck ends at `top`; `wag`, -1 to 1, moves ears and trunk; see `_trunk`."""
    skull, muzzle = build.head
    face = coat.limbs if not build.fleece else coat.dark
    nose: Point = (top[0] + 0.35 * skull + muzzle, 0.0, top[2] - 0.45 * muzzle - 0.05 * skull)
    brow: Point = (top[0] + 0.30 * skull, 0.0, top[2])
    eye_y, eye = 0.30 * skull, 0.13 * skull
    parts = [
        ball(face, (top[0] + 0.12 * skull, 0.0, top[2]), (skull, 0.74 * skull, 0.84 * skull)),
        limb(coat.muzzle, brow, nose, 0.24 * skull, side_radius=0.23 * skull),
        ball(coat.dark, nose, (0.34 * skull, 0.42 * skull, 0.34 * skull)),
    ]
    parts += placed_marks(coat.face, top, (skull, skull, skull))
    parts += [
        ball(Material(BLACK), (top[0] + 0.36 * skull, y, top[2] + 0.16 * skull), (eye,) * 3)
        for y in (eye_y, -eye_y)
    ]
    for side in (1.0, -1.0):
        parts.append(_ear(build, coat, (top, side), 0.12 * wag))
    parts += _mouth(build, coat.muzzle, (brow, nose), stance)
    return [*parts, *_trunk(build, coat, nose, wag, curled)]


def _mouth(
    build: Build, jaw: Material, along: tuple[Point, Point], stance: Stance
) -> list[ModelPart]:
    """A lower jaw that opens; inside the muzzle while it is shut."""
    skull, _ = build.head
    brow, nose = along
    hinge = (brow[0], 0.0, brow[2] - 0.10 * skull)
    tip = (nose[0] - 0.04 * skull, 0.0, nose[2] - 0.06 * skull)
    lower = limb(jaw, hinge, tip, 0.13 * skull, side_radius=0.17 * skull)
    return moved([lower], turn_y(0.75 * stance.gape, hinge))


def _ear(build: Build, coat: Coat, at: tuple[Point, float], twitch: float) -> ModelPart:
    (x, _, z), side = at
    skull = build.head[0]
    long, kind = build.ear
    material = coat.ears
    root = (x - 0.05 * skull, side * 0.28 * skull, z + 0.30 * skull)
    if kind == "broad":
        middle = (x - 0.40 * skull, side * (0.70 + 0.15 * twitch) * skull, z - 0.10 * skull)
        return moved(
            [ball(coat.dark, middle, (0.95 * long, 0.12 * skull, 1.15 * long))],
            turn_z(-0.7 * side, middle),
        )[0]
    if kind == "round":
        return ball(material, (root[0], root[1], root[2] + 0.05 * skull), (0.5 * long, long, long))
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


def _trunk(build: Build, coat: Coat, nose: Point, wag: float, curled: float) -> list[ModelPart]:
    """Down from the nose; `curled` 1 bends it up and back over the head."""
    if build.trunk_length == 0.0:
        return []
    sway = 0.10 * wag * (1.0 - curled)
    parts = []
    here: Point = (nose[0] + 0.02, 0.0, nose[2])
    step = build.trunk_length / len(_TRUNK_DOWN)
    for index, (low, high) in enumerate(zip(_TRUNK_DOWN, _TRUNK_UP, strict=True)):
        bent = low + curled * (high - low) + sway * (index + 1)
        there = (here[0] + step * math.cos(bent), 0.0, here[2] + step * math.sin(bent))
        parts.append(limb(coat.limbs, here, there, (0.116 - 0.016 * index) * build.trunk_length))
        here = there
    return parts


_TRUNK_DOWN = (-1.10, -1.30, -1.45, -1.40, -1.10)
_TRUNK_UP = (0.30, 0.95, 1.60, 2.25, 2.75)
"""Directions of its pieces, rad."""

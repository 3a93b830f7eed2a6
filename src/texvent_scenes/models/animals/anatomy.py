"""Anatomy of four-legged animals: their parts, and how these stand in gaits and acts."""

from __future__ import annotations

import math

import numpy as np

from texvent_scenes.models.animals.activities import STANDING, Stance
from texvent_scenes.models.animals.build import Build, Coat, placed_marks
from texvent_scenes.models.limbs import bend
from texvent_scenes.models.materials import BLACK, Material, fur
from texvent_scenes.models.protocol import ModelPart
from texvent_scenes.models.shapes import (
    Affine,
    Point,
    ball,
    blade,
    limb,
    mixed,
    moved,
    rod,
    spike,
    turn_about,
)

LOWEST = -1.15
"""Angle of a neck that is let down, rad."""
_DROOP = 0.12
"""Lowering of the head of a lying animal."""
_LEVEL = 0.35
"""The same of who sits with its chest up, and looks ahead."""


def tail_lift(build: Build, stance: Stance, sits: float, lies: float) -> float:
    """Elevation of the tail, rad; that of a sitting or lying animal is along the ground."""
    lift = 0.0 if stance is STANDING else 0.4 * stance.wag
    return lift - lies * (build.tail[1] + 0.25) - sits * (build.tail[1] - _seated_pitch(build))


def tip(build: Build, stance: Stance, sits: float) -> Affine:
    """[3, 4] turn of the trunk: down about the hips for a low head; who sits has its chest up."""
    length, _, height = build.body_size
    hips = (-0.30 * length, 0.0, build.shoulder - 0.5 * height)
    low = lowered_head(build, stance) * (1.0 - sits)
    return turn_about("y", _bow(build) * low - _seated_pitch(build) * sits, hips)


def lowered_head(build: Build, stance: Stance) -> float:
    """Lowering of the head, 0 to 1: an animal with a trunk lowers the trunk instead."""
    return 0.1 * stance.head_down if build.trunk_length > 0.0 else stance.head_down


def _bow(build: Build) -> float:
    """Bow of the trunk with which the mouth reaches the ground, rad."""
    length, _, height = build.body_size
    long = (build.neck[0] + 0.2 * height) * math.sin(LOWEST)
    nose = build.shoulder - 0.36 * height + long - 0.9 * (build.head[1] + 0.35 * build.head[0])
    left = nose - 0.04 * build.shoulder - 0.12 * build.head[0]
    return min(max(left / max(0.66 * length, 1e-6), 0.0), 0.34)


def sit_drop(build: Build) -> float:
    """Descent of the hips, m: until the rump is on the ground."""
    _, _, height = build.body_size
    return max(build.shoulder - 0.5 * height - 0.48 * build.waist * height, 0.0)


def _seated_pitch(build: Build) -> float:
    """Pitch of a sitting animal's trunk, rad: until the fore legs are straight."""
    length, _, height = build.body_size
    leg = build.shoulder - 0.52 * height
    low = build.shoulder - 0.5 * height - sit_drop(build)
    return math.asin(min(max((0.97 * leg - low) / (0.60 * length), 0.12), 0.60))


def bob(build: Build, turn: float, runs: bool) -> float:
    """Rise of the trunk at an angle of its cycle of steps, m."""
    if build.hop > 0.0:
        return build.hop * (0.5 - 0.5 * math.cos(turn)) * 0.8
    if runs:
        return 0.05 * build.shoulder * math.sin(turn)
    return 0.012 * build.shoulder * math.cos(2.0 * turn)


def offset(index: int, runs: bool) -> float:
    """Share of a cycle by which a leg is ahead: fore left, fore right, hind left, hind right."""
    # A walk sets down hind left, fore left, hind right, fore right; a gallop both of a pair.
    return ((0.0, 0.12, 0.5, 0.62) if runs else (0.0, 0.5, 0.75, 0.25))[index]


def droop(build: Build, sits: float, lies: float) -> float:
    """Lowering of the head when sitting or lying; a body near the ground has no room for it."""
    return _DROOP * lies + _LEVEL * sits * min(1.0, 2.0 * build.shoulder / build.body_size[0])


def lying_drop(build: Build) -> float:
    """Rise of a lying animal's trunk, m: it is negative."""
    return build.body_size[2] - 0.98 * build.shoulder


def draw_torso(build: Build, coat: Coat) -> list[ModelPart]:
    """Trunk: back, chest, belly and rump; puffs of wool on a fleece."""
    length, width, height = build.body_size
    z = build.shoulder - 0.5 * height
    tall, wide, slim = 0.5 * height, 0.5 * width, build.waist
    chest: Point = (0.24 * length, 0.0, z)
    level = z + (1.0 - slim) * tall  # the back is level, the belly tucked up
    croup: Point = (-0.24 * length, 0.0, level)
    front: Point = (0.24 * length, 0.0, level)
    parts = [
        rod(coat.trunk, croup, front, 0.96 * slim * tall, side_radius=0.96 * slim * wide),
        _rounded(coat.trunk, chest, (0.52 * length, width, 1.04 * height)),
        _rounded(coat.trunk, croup, (0.52 * length, slim * width, slim * height)),
    ]
    if build.fleece:
        for x in (-0.3, 0.0, 0.3):
            for y in (0.26, -0.26):
                puff = (x * length, y * width, z + 0.16 * height)
                parts.append(ball(coat.trunk, puff, (0.46 * length, 0.62 * width, 0.74 * height)))
    return parts


def _rounded(material: Material, middle: Point, size: Point) -> ModelPart:
    """An ellipsoid whose local z runs along the body, so that stripes ring it."""
    x, y, z = middle
    start, end = (x - 0.5 * size[0], y, z), (x + 0.5 * size[0], y, z)
    across, upright = (0.0, size[1], 0.0), (0.0, 0.0, size[2])
    return blade(material, start, end, chord=across, thickness=upright)


def draw_neck_and_head(
    build: Build, coat: Coat, swings: tuple[float, float], stance: Stance, droop: float
) -> list[ModelPart]:
    """Neck and head. Of `swings` the first moves the neck, the second ears and trunk."""
    beat, wag = swings
    down = lowered_head(build, stance) + droop
    length, width, height = build.body_size
    base: Point = (0.36 * length, 0.0, build.shoulder - 0.36 * height)
    rise = build.neck[1] + 0.05 * beat
    rise -= down * (build.neck[1] - LOWEST)
    top: Point = (
        base[0] + (build.neck[0] + 0.2 * height) * math.cos(rise),
        0.0,
        base[2] + (build.neck[0] + 0.2 * height) * math.sin(rise),
    )
    thick = 0.26 * height if build.neck[0] < 1.2 * height else 0.20 * height
    parts = [
        limb(
            coat.trunk,
            base,
            top,
            1.25 * thick if build.neck[0] < 1.2 else thick,
            side_radius=0.34 * width,
        ),
        limb(coat.limbs, mixed(base, top, 0.5), top, 0.9 * thick, side_radius=0.26 * width),
    ]
    share = 0.5 + 7.0 * (stance.head_down - 0.93)
    curled = 0.38 * min(max(share, 0.0), 1.0) if stance.head_down else 0.0
    head = draw_head(build, coat, top, wag, stance, curled)
    head = moved(head, turn_about("y", 0.75 * down, top)) if down else head
    return [*parts, *head, *_mane(build, coat, base, top)]


def _mane(build: Build, coat: Coat, base: Point, top: Point) -> list[ModelPart]:
    skull, height = build.head[0], build.body_size[2]
    if build.mane == "ridge":
        up = 0.16 * height
        start = (base[0] - 0.10 * height, 0.0, base[2] + 0.42 * height)
        end = (top[0] - 0.12 * skull, 0.0, top[2] + 0.42 * skull + 0.2 * up)
        return [limb(coat.dark, start, end, 0.12 * height, side_radius=0.05 * height)]
    if build.mane == "full":
        middle = (top[0] - 0.42 * skull, 0.0, top[2] - 0.14 * skull)
        shaggy = fur(coat.dark.colour)
        return [
            ball(shaggy, middle, (1.20 * skull, 1.75 * skull, 1.95 * skull)),
            limb(shaggy, base, (middle[0], 0.0, middle[2] - 0.3 * skull), 0.62 * skull),
        ]
    return []


def draw_tail(build: Build, coat: Coat, wag: float, lift: float) -> list[ModelPart]:
    """`lift` turns it up, rad, so that wagging is seen from the side."""
    length, _, height = build.body_size
    long, rise = build.tail[0], build.tail[1] + lift
    root: Point = (-0.46 * length, 0.0, build.shoulder - 0.28 * height)
    side = 0.25 * wag
    middle = (
        root[0] - 0.5 * long * math.cos(rise),
        0.2 * side * long,
        root[2] + 0.5 * long * math.sin(rise),
    )
    bent = rise + 0.25
    tip = (
        middle[0] - 0.5 * long * math.cos(bent),
        0.6 * side * long,
        max(middle[2] + 0.5 * long * math.sin(bent), 0.05 * build.shoulder),
    )
    thick = (0.14 if build.bushy_tail else 0.075) * (long if build.bushy_tail else height)
    material = coat.dark if build.mane == "ridge" else coat.tail
    return [
        limb(material, root, middle, 0.8 * thick),
        limb(coat.dark if build.mane else material, middle, tip, thick),
    ]


def draw_leg(
    build: Build,
    coat: Coat,
    index: int,
    step: tuple[tuple[float, float], float, float],
    body: Affine,
) -> list[ModelPart]:
    """Upper leg, lower leg and hoof or paw; hind legs bend backwards at the hock."""
    (x, lift), rise, sit = step
    is_fore, side = index < 2, 1.0 if index % 2 == 0 else -1.0
    length, width, height = build.body_size
    root_x = (0.30 if is_fore else -0.32) * length
    thick = 0.052 * build.shoulder**0.9 * build.thick
    y = side * (0.5 * width - 0.9 * thick)
    top: Point = (root_x, y, build.shoulder - 0.52 * height)
    x_top, y_top, z_top = body @ np.array([*top, 1.0])
    lifted = (z_top - top[2]) * (1.0 - sit) if is_fore else 0.0
    if is_fore:
        x += sit * (float(x_top) - top[0])
    if lifted > 0.02:
        # The fore feet leave the ground with the body.
        x, lift = x + float(x_top) - top[0] + 0.25 * lifted, lift + 0.9 * lifted
    top = (float(x_top), float(y_top), float(z_top) + rise)
    ahead = 0.0 if is_fore else 0.24 * length * sit
    ankle: Point = (root_x + x + ahead, y, 0.8 * thick + lift)
    half = (0.50 + 0.02 / build.thick) * (build.shoulder - 0.52 * height - 0.8 * thick)
    towards = (1.0, 0.0, 0.0) if is_fore else (-1.0, 0.0, 0.0)
    if sit > 0.0 and not is_fore:
        towards = (1.0, 0.0, 1.0)
    knee = bend(top, ankle, half, half, towards)
    toe = (ankle[0] + 1.1 * thick, y, ankle[2])
    legs = coat.legs
    return [
        limb(legs, top, knee, (1.2 + (0.4 if is_fore else 0.7) / build.thick) * thick),
        limb(legs, knee, ankle, 0.95 * thick),
        limb(coat.hoof, ankle, toe, 0.8 * thick),
    ]


NOSE = 2
"""Index of the nose among the parts of a head."""


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
    return moved([lower], turn_about("y", 0.75 * stance.gape, hinge))


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
            turn_about("z", -0.7 * side, middle),
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

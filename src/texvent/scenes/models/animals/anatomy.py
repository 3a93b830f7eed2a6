"""Anatomy of four-legged animals: the parts of trunk, neck, mane, tail and legs."""

from __future__ import annotations

import math

import numpy as np

from texvent.scenes.models.animals.acts import Stance
from texvent.scenes.models.animals.build import Build, Coat
from texvent.scenes.models.animals.head import draw_head
from texvent.scenes.models.animals.posture import LOWEST, curled_trunk, lowered_head
from texvent.scenes.models.limbs import bend
from texvent.scenes.models.materials import Material, fur
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Affine,
    Point,
    ball,
    blade,
    limb,
    moved,
    part_way,
    rod,
    turn_y,
)


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
    """Of `swings` the first moves the neck, the second ears and trunk; `droop` lowers the head."""
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
        limb(coat.limbs, part_way(base, top, 0.5), top, 0.9 * thick, side_radius=0.26 * width),
    ]
    curled = curled_trunk(stance) if stance.head_down else 0.0
    head = draw_head(build, coat, top, wag, stance, curled)
    head = moved(head, turn_y(0.75 * down, top)) if down else head
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

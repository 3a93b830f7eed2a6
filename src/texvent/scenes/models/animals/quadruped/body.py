"""A four-legged body: trunk, neck, head, tail, and legs that step without sliding."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from texvent.scenes.models.animals.acts import STANDING, Stance, act_stance, lowered
from texvent.scenes.models.animals.quadruped.build import (
    Build,
    Coat,
    paint_coat,
    placed_marks,
    read_build,
)
from texvent.scenes.models.animals.quadruped.head import NOSE, draw_head
from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.limb_kinematics import Gait, bend, foot_path, step_amount
from texvent.scenes.models.materials import (
    Material,
    fur,
)
from texvent.scenes.models.protocol import ModelPart, Pose
from texvent.scenes.models.shapes import (
    Affine,
    Point,
    ball,
    blade,
    limb,
    moved,
    part_way,
    rod,
    shift,
    turn_y,
)
from texvent.scenes.models.variation import fraction
from texvent.scenes.scene import Colour


def build_quadruped(
    table: Mapping[str, Any],
    is_centred: bool,
    *,
    colour: Colour | None,
    scale: float,
    seed: int,
) -> ArticulatedModel:
    """Make a four-legged animal from its table; `colour` is its coat.

    "run" takes longer bounds, "sit" lowers the hind quarters, "lie" the whole trunk.
    """
    build, coat = read_build(table), paint_coat(table, colour=colour, seed=seed)
    middle = (0.0, 0.0, build.shoulder - 0.5 * build.body_size[2])
    marks = placed_marks(coat.marks, middle, build.body_size)
    stride = build.stride if build.stride > 0.0 else 1.5 * build.shoulder
    walk = Gait(stride, 0.62, 0.10 * build.shoulder)
    run = Gait(1.6 * stride, 0.36, 0.22 * build.shoulder)
    start = fraction(seed, "step")

    def articulate(pose: Pose) -> list[ModelPart]:
        runs = pose.activity == "run" or build.hop > 0.0
        gait = run if runs else walk
        amount = step_amount(pose.activity, pose.speed_m_s, 0.25 * stride)
        distance = pose.distance_m + start * gait.stride
        turn = 2.0 * math.pi * distance / gait.stride
        rise = amount * _bob(build, turn, runs)
        sits, lies = lowered(pose.activity, pose.time_s)
        stance = act_stance(pose.activity, pose.time_s)
        rise += lies * (build.body_size[2] - build.shoulder + 0.02 * build.shoulder)
        rise -= sits * _sit_drop(build)
        beat = amount * math.sin(turn)
        wag = math.sin(2.0 * math.pi * (0.9 * pose.time_s + start))
        tail = wag if stance is STANDING else stance.wag
        parts = [
            *_torso(build, coat),
            *_neck_and_head(build, coat, (beat, wag), stance, _DROOP * lies + _level(build) * sits),
        ]
        before_tail = len(parts)
        parts += [*_tail(build, coat, tail, _tail_lift(build, stance, sits, lies)), *marks]
        body = _tip(build, stance, sits)
        parts = moved(moved(parts, body), shift(z=rise))
        if sits > 0.0:
            parts[before_tail:] = _above_ground(parts[before_tail:])
        for index in range(4):
            x, z = foot_path(gait, distance, _offset(index, runs), amount)
            parts += _leg(build, coat, index, ((x, z), rise, sits), body)
        return parts

    trunk = len(_torso(build, coat)) + 2
    face = len(draw_head(build, coat, (0.0, 0.0, 0.0)))

    def anchor(name: str, pose: Pose) -> Affine | None:
        if name == "mouth":
            at, ahead = trunk + NOSE, 0.1 * build.head[0]
        elif name == "trunk" and build.trunk > 0.0:
            part = articulate(pose)[trunk + face - 1].to_body
            return np.column_stack([np.eye(3), part[:, 3] + part[:, 2]])
        elif name == "neck":
            at, ahead = trunk - 1, 0.0
        elif name in _ON_SKULL:
            return _on_skull(articulate(pose)[trunk].to_body, _ON_SKULL[name])
        else:
            return None
        middle = articulate(pose)[at].to_body[:, 3]
        return np.column_stack([np.eye(3), middle + np.array([ahead, 0.0, 0.0])])

    return ArticulatedModel(
        [], scale=scale * table.get("size", 1.0), articulate=articulate, anchor=anchor
    )


def _level(build: Build) -> float:
    """How far who sits lets its head down; a body near the ground has no way to."""
    return _LEVEL * min(1.0, 2.0 * build.shoulder / build.body_size[0])


def _tail_lift(build: Build, stance: Stance, sits: float, lies: float) -> float:
    """How far the tail is turned up, rad; of who sits or lies it is along the ground."""
    lift = 0.0 if stance is STANDING else 0.4 * stance.wag
    return lift - lies * (build.tail[1] + 0.25) - sits * (build.tail[1] - _seated_pitch(build))


def _above_ground(parts: Sequence[ModelPart]) -> list[ModelPart]:
    """Parts, each lifted until it is not below the ground: tails of who sits lie on it."""
    lows = [part.to_body[2, 3] - np.linalg.norm(part.to_body[2, :3]) for part in parts]
    return [
        part if low >= 0.0 else moved([part], shift(z=-float(low)))[0]
        for part, low in zip(parts, lows, strict=True)
    ]


def _tip(build: Build, stance: Stance, sits: float) -> Affine:
    """[3, 4] turn of the trunk: down about the hips for a low head; who sits has its chest up."""
    length, _, height = build.body_size
    hips = (-0.30 * length, 0.0, build.shoulder - 0.5 * height)
    low = _lowered_head(build, stance) * (1.0 - sits)
    return turn_y(_bow(build) * low - _seated_pitch(build) * sits, hips)


def _lowered_head(build: Build, stance: Stance) -> float:
    """How low the head is, 0 to 1: what has a trunk lets down that instead."""
    return 0.1 * stance.head_down if build.trunk > 0.0 else stance.head_down


def _curled_trunk(stance: Stance) -> float:
    """How far a trunk is curled towards the mouth, 0 to 0.4."""
    return 0.38 * min(max(0.5 + 7.0 * (stance.head_down - 0.93), 0.0), 1.0)


def _bow(build: Build) -> float:
    """How far the trunk bows for the mouth to reach the ground, rad."""
    left = _lowest_nose(build) - 0.04 * build.shoulder - 0.12 * build.head[0]
    return min(max(left / max(0.66 * build.body_size[0], 1e-6), 0.0), 0.34)


def _lowest_nose(build: Build) -> float:
    """Height of the nose with neck and head as low as they go, m."""
    height = build.body_size[2]
    long = (build.neck[0] + 0.2 * height) * math.sin(_LOWEST)
    return build.shoulder - 0.36 * height + long - 0.9 * (build.head[1] + 0.35 * build.head[0])


_LOWEST = -1.15
"""Angle of a neck that is let down, rad."""
_DROOP = 0.12
"""How far the head of a lying animal is let down."""
_LEVEL = 0.35
"""The same of who sits with its chest up, and looks ahead."""
_ON_SKULL: Mapping[str, Point] = MappingProxyType(
    {"crown": (-0.05, 0.0, 0.86), "face": (0.90, 0.0, 0.36), "head": (0.0, 0.0, 0.0)}
)
"""Places on the head, in half extents of the skull."""


def _on_skull(skull: Affine, place: Point) -> Affine:
    """Axes of the head at a place of the ellipsoid that the skull is."""
    turn = skull[:, :3] / np.linalg.norm(skull[:, :3], axis=0)
    return np.column_stack([turn, skull @ np.array([*place, 1.0])])


def _sit_drop(build: Build) -> float:
    """How far the hips come down, m: until the rump is on the ground."""
    _, _, height = build.body_size
    return max(build.shoulder - 0.5 * height - 0.48 * build.waist * height, 0.0)


def _seated_pitch(build: Build) -> float:
    """How far the trunk of who sits is turned up, rad: until the fore legs are straight."""
    length, _, height = build.body_size
    leg = build.shoulder - 0.52 * height
    low = build.shoulder - 0.5 * height - _sit_drop(build)
    return math.asin(min(max((0.97 * leg - low) / (0.60 * length), 0.12), 0.60))


def _bob(build: Build, turn: float, runs: bool) -> float:
    if build.hop > 0.0:
        return build.hop * (0.5 - 0.5 * math.cos(turn)) * 0.8
    if runs:
        return 0.05 * build.shoulder * math.sin(turn)
    return 0.012 * build.shoulder * math.cos(2.0 * turn)


def _offset(index: int, runs: bool) -> float:
    """Share of a cycle by which a leg is ahead: fore left, fore right, hind left, hind right."""
    # A walk sets down hind left, fore left, hind right, fore right; a gallop both of a pair.
    return ((0.0, 0.12, 0.5, 0.62) if runs else (0.0, 0.5, 0.75, 0.25))[index]


def _torso(build: Build, coat: Coat) -> list[ModelPart]:
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


def _neck_and_head(
    build: Build, coat: Coat, swings: tuple[float, float], stance: Stance, droop: float
) -> list[ModelPart]:
    """Of `swings` the first moves the neck, the second ears and trunk; `droop` lowers the head."""
    beat, wag = swings
    down = _lowered_head(build, stance) + droop
    length, width, height = build.body_size
    base: Point = (0.36 * length, 0.0, build.shoulder - 0.36 * height)
    rise = build.neck[1] + 0.05 * beat
    rise -= down * (build.neck[1] - _LOWEST)
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
    curled = _curled_trunk(stance) if stance.head_down else 0.0
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


def _tail(build: Build, coat: Coat, wag: float, lift: float) -> list[ModelPart]:
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


def _leg(
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

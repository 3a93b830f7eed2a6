"""Building-site machines: tower crane that turns, excavator whose arm digs."""

from __future__ import annotations

import math

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    CONCRETE,
    DARK,
    GLASS,
    STEEL,
    YELLOW,
    Material,
    checked,
    shade,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose, working_noun
from texvent.scenes.models.shapes import (
    Point,
    ball,
    box,
    compose,
    limb,
    moved,
    rod,
    shift,
    turn_y,
    turn_z,
)
from texvent.scenes.models.variation import fraction
from texvent.scenes.scene import Colour


def build_crane(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a tower crane, 22 m; its jib turns to and fro over +x with a load on the hook."""
    hue = colour if colour is not None else YELLOW
    material, dark = Material(hue), Material(shade(hue, 0.45))
    lattice = checked(hue, shade(hue, 0.30), 10.0)
    rigid = [
        box(CONCRETE, (0.0, 0.0, 0.4), (3.2, 3.2, 0.8)),
        *(rod(material, (x, y, 0.5), (x, y, 18.0), 0.17) for x in (0.6, -0.6) for y in (0.6, -0.6)),
        *_braces(dark, 18.0),
    ]
    start = 2.0 * math.pi * fraction(seed, "turn")
    head = [
        box(material, (0.0, 0.0, 18.2), (1.8, 1.8, 0.5)),
        box(GLASS, (1.2, 0.9, 17.8), (1.3, 1.0, 1.3)),
        rod(material, (0.0, 0.0, 18.2), (0.0, 0.0, 22.0), 0.22),
        box(lattice, (7.0, 0.0, 18.9), (14.0, 0.8, 0.30)),
        rod(material, (0.0, 0.0, 19.8), (13.6, 0.0, 19.0), 0.10),
        box(lattice, (-3.0, 0.0, 18.9), (6.0, 0.9, 0.30)),
        box(CONCRETE, (-5.2, 0.0, 17.9), (1.4, 1.2, 2.0)),
        rod(DARK, (0.0, 0.0, 22.0), (10.0, 0.0, 19.0), 0.06),
        rod(DARK, (0.0, 0.0, 22.0), (-5.5, 0.0, 19.0), 0.06),
        box(dark, (10.5, 0.0, 18.6), (0.9, 1.0, 0.4)),
    ]

    def articulate(pose: Pose) -> list[ModelPart]:
        angle = 0.6 * math.sin(0.5 * pose.time_s + start)
        swing = 0.05 * math.sin(0.9 * pose.time_s + start)
        cable = [
            rod(DARK, (10.5, 0.0, 18.5), (10.5, 0.0, 11.2), 0.07),
            box(STEEL, (10.5, 0.0, 10.8), (2.6, 0.9, 0.7)),
        ]
        hung = moved(cable, turn_y(swing, (10.5, 0.0, 18.5)))
        return moved([*head, *hung], turn_z(angle))

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


def _braces(material: Material, height: float) -> list[ModelPart]:
    """Zigzag bars on all four sides of the mast."""
    step = height / 6.0
    parts = []
    for index in range(6):
        low, high = 0.6 + index * step * 0.96, 0.6 + (index + 1) * step * 0.96
        sign = 1.0 if index % 2 else -1.0
        for side in (0.6, -0.6):
            parts.append(rod(material, (-0.6 * sign, side, low), (0.6 * sign, side, high), 0.08))
            parts.append(rod(material, (side, -0.6 * sign, low), (side, 0.6 * sign, high), 0.08))
    return parts


def build_excavator(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make an excavator on tracks, 3 m tall, that digs to and fro in front of it."""
    material = Material(colour if colour is not None else YELLOW)
    start = fraction(seed, "dig")
    cabin = [
        box(material, (-0.4, 0.0, 1.50), (2.9, 2.2, 0.75)),
        box(material, (-1.3, 0.0, 1.95), (1.2, 2.0, 0.5)),
        box(material, (0.45, 0.62, 3.05), (1.25, 0.95, 0.14)),
        *(rod(material, (x, y, 1.8), (x, y, 3.0), 0.05) for x in (-0.10, 1.0) for y in (0.2, 1.04)),
        box(DARK, (0.20, 0.62, 1.95), (0.55, 0.60, 0.12)),
        box(DARK, (-0.05, 0.62, 2.30), (0.10, 0.60, 0.70)),
        rod(DARK, (0.80, 0.80, 1.85), (0.74, 0.80, 2.25), 0.025),
        rod(DARK, (-1.5, -0.6, 2.1), (-1.5, -0.6, 2.6), 0.08),
    ]

    def articulate(pose: Pose) -> list[ModelPart]:
        turn = 2.0 * math.pi * (0.22 * pose.time_s + start)
        arm = _digging_arm(material, math.sin(turn), math.sin(turn - 1.4))
        upper = moved([*cabin, *arm], turn_z(0.18 * math.sin(0.5 * turn)))
        return [*upper, *_tracks(pose.distance_m)]

    return ArticulatedModel([], scale=scale, articulate=articulate)


def _digging_arm(material: Material, raise_by: float, curl: float) -> list[ModelPart]:
    """Boom, stick, ram and bucket; both arguments run from -1 to 1."""
    root: Point = (0.7, -0.35, 1.6)
    rise = 0.80 + 0.16 * raise_by
    elbow = (root[0] + 2.5 * math.cos(rise), -0.35, root[2] + 2.5 * math.sin(rise))
    drop = -1.25 + 0.35 * curl
    wrist = (elbow[0] + 1.9 * math.cos(drop), -0.35, elbow[2] + 1.9 * math.sin(drop))
    scoop = -1.9 + 0.6 * curl
    tip = (wrist[0] + 0.75 * math.cos(scoop), -0.35, wrist[2] + 0.75 * math.sin(scoop))
    middle = tuple(0.5 * (a + b) for a, b in zip(root, elbow, strict=True))
    ram_end = (middle[0] + 0.1, -0.35, middle[2] + 0.1)
    return [
        limb(material, root, elbow, 0.26, side_radius=0.20),
        limb(material, elbow, wrist, 0.20, side_radius=0.17),
        rod(STEEL, (root[0] + 0.5, -0.35, root[2] - 0.1), ram_end, 0.07),
        limb(DARK, wrist, tip, 0.34, side_radius=0.45),
        ball(DARK, tip, (0.3, 0.9, 0.3)),
    ]


def _tracks(distance: float) -> list[ModelPart]:
    """Two tracks: dark boxes with round ends and wheels that turn with the distance."""
    parts: list[ModelPart] = []
    for side in (0.95, -0.95):
        left, right = side - 0.28, side + 0.28
        parts.append(box(DARK, (0.0, side, 0.42), (2.6, 0.56, 0.84)))
        for x in (1.3, -1.3):
            parts.append(rod(DARK, (x, left, 0.42), (x, right, 0.42), 0.42))
            hub = [
                rod(STEEL, (0.0, left - 0.01, 0.0), (0.0, right + 0.01, 0.0), 0.26),
                box(DARK, (0.0, side, 0.0), (0.46, 0.62, 0.10)),
            ]
            parts += moved(hub, compose(shift(x, 0.0, 0.42), turn_y(distance / 0.42)))
        parts.append(box(STEEL, (0.0, side, 0.42), (1.9, 0.58, 0.16)))
    parts.append(box(DARK, (0.0, 0.0, 0.95), (1.2, 1.5, 0.4)))
    return parts


NOUNS = (
    working_noun("crane", build_crane, ("tower crane", "construction crane", "building crane")),
    Noun(
        "excavator", build_excavator, "ground", 1.0, "drive",
        ("digger",),
    ),
)  # fmt: skip

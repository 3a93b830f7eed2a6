"""Flowers, wood, what lies on the ground, and bodies in the sky."""

from __future__ import annotations

import math

import numpy as np

from texvent.scenes.models.materials import BARK, Material, glowing, mottled, striped
from texvent.scenes.models.objects.figures import (
    Draw,
    Motion,
    Moving,
    bar,
    disc,
    lathe,
    lying,
    nothing,
    placed,
    ring,
    rolling,
    spinning,
    swinging,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BRASS,
    EARTH,
    INK,
    LEAF,
    PALE,
    SILVER,
    SILVERY,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart, Pose
from texvent.scenes.models.shapes import (
    Affine,
    Point,
    ball,
    blade,
    box,
    limb,
    moved,
    peak,
    plank,
    post,
    rod,
    spike,
    turn_x,
)
from texvent.scenes.scene import Colour

_BRIGHT: tuple[Colour, ...] = ((0.55, 0.03, 0.04), (0.75, 0.45, 0.03), (0.70, 0.25, 0.35))
_GREENS: tuple[Colour, ...] = ((0.06, 0.22, 0.03), (0.09, 0.26, 0.05))


def _stem(tall: float, leaves: int) -> list[ModelPart]:
    """A stalk with leaves on both sides."""
    return [rod(LEAF, (0.0, 0.0, 0.0), (0.0, 0.0, tall), 0.018 * tall),
            *(blade(LEAF, (0.0, 0.0, 0.15 * tall * (k + 1)),
                (0.0, (-1) ** k * 0.26 * tall, 0.15 * tall * (k + 1) + 0.14 * tall),
                chord=(0.03 * tall, 0.0, 0.0) if k % 2 else (0.05 * tall, 0.0, 0.0),
                thickness=(0.0, -0.02 * tall, 0.10 * tall)) for k in range(leaves))]  # fmt: skip


def _petals(
    skin: Material, centre: Point, radius: float, count: int, wide: float, lean: float
) -> list[ModelPart]:
    """Petals around a heart that faces +x, leaning forward."""
    x, y, z = centre
    return [
        blade(skin, (x, y + 0.25 * radius * math.cos(a), z + 0.25 * radius * math.sin(a)),
            (x + lean * radius, y + radius * math.cos(a), z + radius * math.sin(a)),
            chord=(0.0, -wide * math.sin(a), wide * math.cos(a)),
            thickness=(0.06 * radius, 0.0, 0.0))
        for a in (2.0 * math.pi * k / count for k in range(count))
    ]  # fmt: skip


def _tuft(turn: float) -> Draw:
    """Blades of grass that bend outwards from one foot."""
    return lambda skin: [
        blade(toned(skin, 0.8 + 0.1 * k), (0.01 * math.cos(a), 0.01 * math.sin(a), 0.0),
              (0.16 * math.cos(a), 0.16 * math.sin(a), 0.30 + 0.05 * (k % 3)),
              chord=(-0.022 * math.sin(a), 0.022 * math.cos(a), 0.0), thickness=(0.004, 0.004, 0.0))
        for k, a in enumerate(turn + 1.05 * step for step in range(6))
    ]  # fmt: skip


def _crystal(skin: Material, angle: float) -> list[ModelPart]:
    """One of the three axes of a snowflake."""
    c, s = math.cos(angle), math.sin(angle)
    parts = [bar(skin, (-0.05 * c, -0.05 * s), (0.05 * c, 0.05 * s), 0.004, 0.004)]
    for side in (1.0, -1.0):
        for turn in (0.7, -0.7):
            a = angle + turn
            foot = (0.028 * side * c, 0.028 * side * s)
            tip = (foot[0] + 0.018 * side * math.cos(a), foot[1] + 0.018 * side * math.sin(a))
            parts.append(bar(skin, foot, tip, 0.003, 0.004))
    return parts


def _ray(index: int) -> tuple[Point, Point]:
    """Start and end of a trail of a firework: directions spread evenly over a sphere."""
    up = 1.0 - (2.0 * index + 1.0) / 28.0
    flat, angle = math.sqrt(1.0 - up * up), 2.39996 * index
    x, y = flat * math.cos(angle), flat * math.sin(angle)
    return (1.8 * x, 1.8 * y, 1.8 * up), (3.2 * x, 3.2 * y, 3.2 * up)


def _burst() -> Motion:
    """Growing from a point to its full size once in 1.6 s, then again."""

    def motion(pose: Pose) -> Affine:
        phase = (pose.time_s / 1.6) % 1.0
        size = max(0.05, min(1.0, 1.6 * phase) * min(1.0, 10.0 * (1.0 - phase)))
        return np.column_stack([size * np.eye(3), np.zeros(3)])

    return motion


_GARDEN = placed("grass", (
    thing("rose", _BRIGHT[::2], nothing, (),
        moving=(Moving(lambda p: [*_stem(0.42, 3),
            ball(toned(p, 0.7), (0.0, 0.0, 0.45), (0.07, 0.07, 0.075)),
            *(ball(toned(p, 0.8 + 0.08 * k),
                (0.028 * math.cos(2.4 * k), 0.028 * math.sin(2.4 * k), 0.45 - 0.003 * k),
                (0.075, 0.075, 0.07)) for k in range(7)),
                *(ball(toned(p, 1.2), (0.012 * math.cos(2.4 * k), 0.012 * math.sin(2.4 * k),
                    0.478), (0.03, 0.03, 0.03)) for k in range(3)),
                    *(spike(LEAF, (0.0, 0.0, 0.415),
                        (0.06 * math.cos(a), 0.06 * math.sin(a), 0.42), 0.014)
                        for a in (0.0, 1.26, 2.51, 3.77, 5.03))], swinging("x", 0.04, 0.25)),)),
    thing("tulip", _BRIGHT, nothing,
        moving=(Moving(lambda p: [rod(LEAF, (0.0, 0.0, 0.0), (0.0, 0.0, 0.36), 0.007),
            *(blade(LEAF, (0.0, 0.0, 0.0), (0.02, 0.10 * s, 0.30), chord=(0.045, 0.0, 0.0),
                thickness=(0.0, 0.008, 0.0)) for s in (1.0, -1.0)),
                ball(p, (0.0, 0.0, 0.40), (0.065, 0.065, 0.085)),
                *(limb(toned(p, 0.9), (0.022 * math.cos(a), 0.022 * math.sin(a), 0.375),
                    (0.028 * math.cos(a), 0.028 * math.sin(a), 0.45), 0.018)
                    for a in (0.5, 1.55, 2.6, 3.64, 4.69, 5.74))], swinging("x", 0.04, 0.25)),)),
    thing("sunflower", ((0.78, 0.48, 0.02),), nothing,
        moving=(Moving(lambda p: [*_stem(1.35, 4),
            *_petals(p, (0.04, 0.0, 1.42), 0.27, 14, 0.09, 0.1),
            disc(Material((0.12, 0.06, 0.02)), (0.0, 1.42), 0.125, 0.05, 0.06),
            disc(Material((0.25, 0.13, 0.03)), (0.0, 1.42), 0.075, 0.055, 0.063)],
            swinging("x", 0.03, 0.25)),)),
    thing("daisy", (PALE.colour,), nothing, (),
        moving=(Moving(lambda p: [rod(LEAF, (0.0, 0.0, 0.0), (0.0, 0.0, 0.26), 0.004),
            *_petals(p, (0.01, 0.0, 0.27), 0.065, 12, 0.022, 0.15),
            ball(YELLOW_PAINT, (0.014, 0.0, 0.27), (0.02, 0.036, 0.036)),
            *(blade(LEAF, (0.0, 0.0, 0.02), (0.0, 0.06 * s, 0.09), chord=(0.02, 0.0, 0.0),
                thickness=(0.0, 0.004, 0.0)) for s in (1.0, -1.0))], swinging("x", 0.05, 0.3)),)),
    thing("dandelion", (PALE.colour,), nothing,
        moving=(Moving(lambda p: [rod(LEAF, (0.0, 0.0, 0.0), (0.0, 0.0, 0.22), 0.004),
            ball(mottled(p.colour, contrast=0.3, scale=8.0), (0.0, 0.0, 0.25),
                (0.065, 0.065, 0.065)), ball(EARTH, (0.0, 0.0, 0.222), (0.014, 0.014, 0.014)),
                *(blade(LEAF, (0.0, 0.0, 0.005), (0.10 * math.cos(a), 0.10 * math.sin(a), 0.02),
                    chord=(-0.03 * math.sin(a), 0.03 * math.cos(a), 0.0),
                    thickness=(0.0, 0.0, 0.004)) for a in (0.0, 1.26, 2.51, 3.77, 5.03))],
                    swinging("x", 0.05, 0.3)),)),
    thing("grass tuft", _GREENS, nothing,
        ("tuft of grass", "tall grass"),
        moving=tuple(Moving(_tuft(0.4 * k), swinging("x" if k % 2 else "y", 0.10, 0.3 + 0.05 * k))
            for k in range(4))),
    thing("leaf", _GREENS,
        lambda p: [blade(p, (-0.06, 0.0, 0.008), (0.06, 0.0, 0.008), chord=(0.0, 0.075, 0.0),
            thickness=(0.0, 0.0, 0.006)), spike(p, (0.03, 0.0, 0.008), (0.085, 0.0, 0.010), 0.008),
            rod(toned(p, 1.8), (-0.10, 0.0, 0.006), (0.06, 0.0, 0.0115), 0.0016),
            *(rod(toned(p, 1.8), (x, 0.0, 0.0115), (x + 0.022, 0.026 * s, 0.0105), 0.001)
                for x in (-0.03, -0.005, 0.02) for s in (1.0, -1.0))], plurals=("leaves",)),
    thing("log", (BARK.colour,),
        lambda p: [rod(mottled(p.colour, contrast=0.5, scale=6.0), (0.0, -0.8, 0.20),
            (0.0, 0.8, 0.20), 0.20),
            *(rod(Material((0.45, 0.30, 0.15)), (0.0, 0.8 * s, 0.20), (0.0, 0.803 * s, 0.20),
                0.18) for s in (1.0, -1.0)),
                rod(mottled(p.colour), (0.0, 0.2, 0.30), (0.05, 0.35, 0.52), 0.05)],
                ("wood log", "fallen tree")),
    thing("stump", (BARK.colour,),
        lambda p: [*lathe(mottled(p.colour, contrast=0.5, scale=6.0),
            [(0.0, 0.36), (0.12, 0.28), (0.42, 0.26)], 5),
            *(post(h, (0.0, 0.0, 0.42), (w, w, t)) for h, w,
                t in ((Material((0.48, 0.32, 0.16)), 0.48, 0.010),
                    (Material((0.32, 0.19, 0.09)), 0.36, 0.011),
                    (Material((0.48, 0.32, 0.16)), 0.32, 0.012),
                    (Material((0.32, 0.19, 0.09)), 0.20, 0.013),
                    (Material((0.48, 0.32, 0.16)), 0.16, 0.014))),
                    *(limb(mottled(p.colour), (0.25 * math.cos(a), 0.25 * math.sin(a), 0.08),
                        (0.48 * math.cos(a), 0.48 * math.sin(a), 0.03), 0.06)
                        for a in (0.4, 1.7, 2.9, 4.2, 5.4))], ("tree stump",)),
    thing("branch", (BARK.colour,),
        lambda p: [limb(toned(p, 1.8), (0.0, -0.6, 0.06), (0.0, 0.1, 0.08), 0.05),
            limb(toned(p, 1.8), (0.0, 0.1, 0.08), (0.1, 0.65, 0.18), 0.036),
            limb(toned(p, 1.8), (0.0, -0.1, 0.07), (-0.15, 0.35, 0.30), 0.028),
            limb(toned(p, 1.8), (0.0, -0.35, 0.06), (0.15, 0.0, 0.25), 0.024),
            *(blade(toned(LEAF, 1.5), (x, y, 1.6 * z), (x + 1.6 * dx, y + 0.16, 1.6 * z + 0.12),
                chord=(0.09, 0.0, 0.05), thickness=(0.0, 0.0, 0.008)) for x, y, z,
                dx in ((0.1, 0.62, 0.14, 0.03), (0.09, 0.5, 0.12, -0.07), (-0.15, 0.33, 0.16, 0.0),
                    (-0.12, 0.26, 0.14, -0.08), (0.15, -0.02, 0.13, 0.04),
                    (0.12, -0.06, 0.12, -0.03)))], ("twig", "tree branch"),
                    plurals=("branches",)),
    thing("hay bale", ((0.60, 0.42, 0.12),),
        lambda p: [rod(mottled(p.colour, contrast=0.35, scale=10.0), (0.0, -0.6, 0.65),
            (0.0, 0.6, 0.65), 0.65),
            *(rod(toned(p, 1.15), (0.0, 0.6 * s, 0.65), (0.0, 0.604 * s, 0.65), 0.5)
                for s in (1.0, -1.0)),
                *(rod(toned(p, 0.8), (0.0, 0.6 * s, 0.65), (0.0, 0.607 * s, 0.65), 0.25)
                    for s in (1.0, -1.0))],
                    ("bale of hay", "straw bale", "bale")),
    thing("pine cone", ((0.20, 0.10, 0.05),),
        lambda p: [ball(toned(p, 0.6), (0.0, 0.0, 0.05), (0.05, 0.05, 0.10)),
            *(blade(p, (0.018 * math.cos(2.4 * k), 0.018 * math.sin(2.4 * k), 0.012 + 0.0034 * k),
                ((0.038 - 0.0008 * abs(k - 8)) * math.cos(2.4 * k),
                    (0.038 - 0.0012 * abs(k - 8)) * math.sin(2.4 * k), 0.022 + 0.0034 * k),
                    chord=(-0.022 * math.sin(2.4 * k), 0.022 * math.cos(2.4 * k), 0.0),
                    thickness=(0.0, 0.0, 0.005)) for k in range(22))], ("pinecone",)),
    thing("bird nest", ((0.22, 0.13, 0.06),),
        lambda p: [*(part for k in range(3)
            for part in ring(mottled(p.colour, contrast=0.5, scale=8.0),
                (0.0, 0.0, 0.02 + 0.022 * k), (0.09 + 0.008 * k, 0.09 + 0.008 * k), 0.02, axis="z",
                pieces=10)), post(toned(p, 0.6), (0.0, 0.0, 0.02), (0.18, 0.18, 0.03)),
                *(ball(Material((0.35, 0.55, 0.58)),
                    (0.03 * math.cos(2.09 * k), 0.03 * math.sin(2.09 * k), 0.055),
                    (0.035, 0.045, 0.035)) for k in range(3))], ("nest",)),
    thing("beehive", ((0.70, 0.48, 0.14),),
        lambda p: [*(post(toned(p, 0.85 + 0.15 * (k % 2)), (0.0, 0.0, 0.05 + 0.09 * k),
            (w, w, 0.10)) for k, w in enumerate((0.44, 0.52, 0.52, 0.46, 0.34, 0.18))),
            ball(INK, (0.25, 0.0, 0.12), (0.04, 0.10, 0.09))], ("hive",)),
    thing("bone", (PALE.colour,),
        lambda p: [rod(p, (0.0, -0.09, 0.02), (0.0, 0.09, 0.02), 0.012),
            *(ball(p, (0.015 * t, 0.10 * s, 0.02), (0.035, 0.035, 0.035)) for s in (1.0, -1.0)
                for t in (1.0, -1.0))], ("dog bone",)),
    thing("skull", (PALE.colour,),
        lambda p: [ball(p, (-0.02, 0.0, 0.11), (0.19, 0.15, 0.16)),
            box(p, (0.05, 0.0, 0.045), (0.07, 0.08, 0.05)),
            box(p, (0.045, 0.0, 0.010), (0.08, 0.085, 0.02)),
            *(ball(INK, (0.066, 0.032 * s, 0.098), (0.03, 0.038, 0.038)) for s in (1.0, -1.0)),
            spike(INK, (0.078, 0.0, 0.062), (0.074, 0.0, 0.085), 0.012),
            *(box(INK, (0.086, -0.03 + 0.015 * k, 0.028), (0.002, 0.003, 0.022))
                for k in range(5))]),
    thing("seashell", ((0.75, 0.50, 0.38),),
        lambda p: lying([*(bar(toned(p, 0.8 + 0.3 * (k % 2)), (0.0, 0.0),
            (0.075 * math.sin(0.22 * (k - 4)), 0.075 * math.cos(0.22 * (k - 4))), 0.02, 0.012)
            for k in range(9)), *(ball(toned(p, 0.8 + 0.3 * (k % 2)),
                (0.0, 0.075 * math.sin(0.22 * (k - 4)), 0.075 * math.cos(0.22 * (k - 4))),
                (0.012, 0.02, 0.02)) for k in range(9)),
                bar(p, (-0.018, 0.0), (0.018, 0.0), 0.02, 0.012)]),
                ("shell",)),
    thing("volcano", ((0.14, 0.11, 0.10),),
        lambda p: [*lathe(mottled(p.colour, contrast=0.4, scale=6.0),
            [(0.0, 42.0), (12.0, 24.0), (26.0, 11.0), (32.0, 8.0)], 12),
            post(glowing((1.0, 0.30, 0.04), 1.5), (0.0, 0.0, 32.0), (13.0, 13.0, 0.6)),
            *(limb(glowing((1.0, 0.28, 0.03), 1.2), (7.0 * math.cos(a), 7.0 * math.sin(a), 32.0),
                (19.0 * math.cos(a), 19.0 * math.sin(a), 16.5), 1.3)
                for a in (0.0, 0.9, -0.8, 2.6)),
                *(ball(Material((0.16, 0.15, 0.15), emission=0.05), (0.0, 3.0 * k, 38.0 + 7.0 * k),
                    (12.0 + 4.0 * k, 12.0 + 4.0 * k, 9.0)) for k in range(3))]),
    thing("iceberg", ((0.62, 0.74, 0.80),),
        lambda p: [plank(p, (0.0, 0.0, 0.0), (1.0, 0.5, 9.0), chord=(9.0, 0.0, 0.0),
            thickness=(0.0, 8.0, 0.0)),
            plank(toned(p, 0.9), (3.0, 4.5, 0.0), (2.0, 3.5, 5.0), chord=(7.0, 2.0, 0.0),
                thickness=(0.0, 7.0, 0.0)),
                peak(toned(p, 1.1), (-1.0, -2.0, 5.5), (9.0, 8.0, 11.0)),
                peak(p, (0.5, 5.0, 3.5), (8.0, 9.0, 7.0))]),
    thing("snowflake", (PALE.colour,), nothing,
        moving=(Moving(lambda p: [part for k in range(3)
            for part in _crystal(p, math.pi * k / 3.0)], swinging("z", 0.8, 0.3)),),
            goes=("air", "float", 0.4)),
    thing("snowball", (PALE.colour,), nothing,
        moving=(Moving(lambda p: [ball(mottled(p.colour, contrast=0.12, scale=5.0),
            (0.0, 0.0, 0.0), (0.09, 0.09, 0.09)),
            ball(p, (0.01, 0.01, 0.01), (0.08, 0.085, 0.082))], rolling(0.046)),),
            goes=("ground", "roll", 1.5)),
))  # fmt: skip

_SKY = placed("space", (
    thing("satellite", (SILVERY, BRASS.colour),
        lambda p: [box(p, (0.0, 0.0, 0.0), (1.1, 1.0, 1.2)),
            box(BRASS, (0.0, 0.0, 0.0), (1.12, 0.6, 1.22)),
            *(box(Material((0.02, 0.05, 0.22)), (0.0, 2.6 * s, 0.0), (0.05, 3.2, 1.0))
                for s in (1.0, -1.0)),
                *(box(SILVER, (0.0, s * (1.2 + 0.7 * k), 0.0), (0.07, 0.04, 1.02))
                    for s in (1.0, -1.0) for k in range(5)),
                    *(rod(SILVER, (0.0, 0.5 * s, 0.0), (0.0, 1.0 * s, 0.0), 0.05)
                        for s in (1.0, -1.0)), spike(PALE, (0.0, 0.0, 1.15), (0.0, 0.0, 0.6), 0.6),
                        rod(SILVER, (0.0, 0.0, 0.6), (0.0, 0.0, 1.5), 0.03)],
                        ("communications satellite",),
                        goes=("air", "float", 1.5)),
    thing("planet", ((0.45, 0.25, 0.10), (0.10, 0.25, 0.45), (0.50, 0.12, 0.05)), nothing,
        moving=(Moving(lambda p: [ball(striped(p.colour, toned(p, 0.65).colour, 5.0),
            (0.0, 0.0, 0.0), (4.0, 4.0, 4.0)),
            ball(toned(p, 0.5), (1.6, 0.6, -0.6), (0.7, 1.0, 0.6))], spinning("z", 0.08)),),
            goes=("air", "float", 0.5)),
    thing("saturn", ((0.60, 0.45, 0.24),),
        lambda p: moved([ball(striped(p.colour, toned(p, 0.75).colour, 6.0), (0.0, 0.0, 0.0),
            (3.0, 3.0, 2.8)), *(part for r,
            h in ((2.1, 0.8), (2.5, 1.1), (2.9, 0.7))
                for part in ring(toned(p, h), (0.0, 0.0, 0.0), (r, r), 0.14, axis="z",
                    pieces=16))], turn_x(0.35)), ("ringed planet",), goes=("air", "float", 0.5)),
    thing("earth", ((0.03, 0.16, 0.45),), nothing,
        moving=(Moving(lambda p: [ball(p, (0.0, 0.0, 0.0), (4.0, 4.0, 4.0)),
            *(ball(Material((0.12, 0.30, 0.06)),
                (1.55 * math.cos(a) * math.cos(b), 1.55 * math.sin(a) * math.cos(b),
                    1.55 * math.sin(b)), (1.05, 1.05, w)) for a, b,
                    w in ((0.0, 0.4, 1.4), (0.5, 0.7, 1.0), (0.2, -0.4, 1.2), (1.9, 0.3, 1.4),
                        (2.4, -0.4, 1.2), (3.6, 0.5, 1.3), (4.3, 0.4, 1.4), (5.2, -0.3, 1.1))),
                        *(ball(PALE, (0.0, 0.0, 1.75 * s), (1.5, 1.5, 0.55))
                            for s in (1.0, -1.0))], spinning("z", 0.08)),),
                            goes=("air", "float", 0.5)),
    thing("asteroid", ((0.20, 0.18, 0.16),), nothing,
        moving=(Moving(lambda p: [ball(mottled(p.colour, contrast=0.5, scale=3.0), (0.0, 0.0, 0.0),
            (2.2, 1.6, 1.5)), ball(mottled(p.colour, contrast=0.5, scale=3.0), (0.5, 0.3, 0.25),
            (1.2, 1.1, 1.0)), ball(mottled(toned(p, 0.8).colour, contrast=0.5, scale=3.0),
            (-0.5, -0.25, 0.1), (1.2, 1.1, 1.1)),
            *(ball(toned(p, 0.4), (x, y, z), (0.4, 0.4, 0.4)) for x, y,
                z in ((0.3, -0.68, 0.1), (-0.4, -0.5, 0.55), (0.95, -0.25, 0.1)))],
                spinning("z", 0.3)),), goes=("air", "float", 2.0)),
    thing("meteor", ((0.22, 0.14, 0.10),),
        lambda p: [ball(mottled(p.colour, contrast=0.6), (0.0, 0.0, 0.0), (1.0, 0.9, 0.9)),
            ball(glowing((1.0, 0.55, 0.15), 2.5), (0.12, 0.0, 0.0), (1.1, 1.05, 1.05)),
            spike(glowing((1.0, 0.35, 0.05), 1.8), (0.0, 0.0, 0.0), (-3.2, 0.0, 0.35), 0.52),
            spike(glowing((1.0, 0.75, 0.35), 2.5), (0.0, 0.0, 0.0), (-1.8, 0.0, 0.2), 0.4)],
            ("shooting star",), goes=("air", "fly", 8.0)),
    thing("star", ((1.0, 0.80, 0.20),),
        lambda p: [spike(Material(p.colour, emission=1.0), (0.0, 0.0, 0.0),
            (0.0, 0.5 * math.cos(a), 0.5 * math.sin(a)), 0.17)
            for a in (math.pi / 2 + 2 * math.pi * k / 5
                for k in range(5))] + [ball(Material(p.colour, emission=1.0), (0.0, 0.0, 0.0),
                (0.26, 0.34, 0.34))], goes=("air", "float", 0.4)),
))  # fmt: skip
_FIREWORKS = placed("sky", (
    thing("firework", ((1.0, 0.25, 0.10), (0.20, 0.75, 1.0), (0.95, 0.80, 0.20)), nothing,
        ("fireworks", "firework burst"), plurals=("fireworks",),
        moving=(Moving(lambda p: [limb(Material(p.colour if k % 3 else (1.0, 0.9, 0.5),
            emission=4.0), *_ray(k), 0.08) for k in range(28)], _burst()),),
            goes=("air", "float", 0.5)),
))  # fmt: skip

NOUNS = (*_GARDEN, *_SKY, *_FIREWORKS)
"""Nouns of nature and sky."""

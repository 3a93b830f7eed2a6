"""Things about the house, and tables of games."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import CHROME, Material, foliage, glowing
from texvent.scenes.models.objects.figures import (
    Moving,
    lathe,
    nothing,
    placed,
    ring,
    struck,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLUE_PAINT,
    BREAD,
    BULB,
    INK,
    IRON,
    PALE,
    RED_PAINT,
    SILVER,
    WATER,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, blade, box, limb, peak, plank, post, rod, spike

_WOOD = Material(WOOD_BROWN)
_CHINA = Material((0.80, 0.80, 0.78))
_GLASS = Material((0.62, 0.74, 0.78))


def _legs(p: Material, long: float, wide: float, tall: float, thick: float) -> list[ModelPart]:
    return [
        box(p, (x * long, y * wide, 0.5 * tall), (thick, thick, tall))
        for x in (0.45, -0.45)
        for y in (0.45, -0.45)
    ]


_HOME = (
    thing("yarn ball", ((0.60, 0.06, 0.10), (0.10, 0.25, 0.55)), lambda p: [ball(p, (0.0, 0.0,
        0.06), (0.12, 0.12, 0.12)), *(part for k in range(3) for part in ring(toned(p, 0.6),
            (0.0, 0.0, 0.06), (
        0.058, 0.058), 0.004, axis="xyz"[k], pieces=10)), limb(p, (0.0, 0.05, 0.005), (0.12,
            0.16, 0.004), 0.004), limb(p, (0.12, 0.16, 0.004), (0.06, 0.28, 0.004), 0.004)],
        ("ball of yarn", "yarn", "wool ball", "ball of wool")),
    thing("ironing board", ((0.25, 0.42, 0.60),), lambda p: [box(p, (0.0, -0.1, 0.86), (0.36,
        1.0, 0.05)), blade(p, (0.0, 0.30, 0.86), (0.0, 0.68, 0.86), chord=(0.36, 0.0, 0.0),
            thickness=(0.0, 0.0, 0.05)),
        *(rod(SILVER, (x, y, 0.0), (x, -y, 0.84), 0.015) for x in (0.12, -0.12) for y in (0.4,
            -0.4))]),
    thing("christmas tree", ((0.03, 0.18, 0.04),), lambda p: [rod(_WOOD, (0.0, 0.0, 0.0), (0.0,
        0.0, 0.3), 0.06), *(peak(foliage(p.colour), (0.0, 0.0, 0.55 + 0.42 * k), (1.2 - 0.26 * k,
            1.2 - 0.26 * k, 0.7)) for k in range(4)),
        *(ball((RED_PAINT, glowing((1.0, 0.75, 0.2), 1.5), BLUE_PAINT)[k % 3],
            (r * math.cos(2.4 * k), r * math.sin(2.4 * k), z), (0.09, 0.09, 0.09)) for k, (z,
                r) in enumerate(
            (0.32 + 0.08 * j, 0.56 - 0.028 * j) for j in range(18))), ball(BULB, (0.0, 0.0, 2.2),
                (0.16, 0.16, 0.16))], ("xmas tree", "decorated tree")),
    thing("goldfish bowl", ((0.85, 0.28, 0.02),), lambda p: [*ring(_GLASS, (0.0, 0.0, 0.24),
        (0.09, 0.09), 0.008, axis="z", pieces=12), *ring(_GLASS, (0.0, 0.0, 0.14), (0.14, 0.12),
            0.005, pieces=14),
        *ring(_GLASS, (0.0, 0.0, 0.14), (0.14, 0.12), 0.005, axis="y", pieces=14), post(WATER,
            (0.0, 0.0, 0.04), (0.22, 0.22, 0.03)), limb(p, (0.0, -0.03, 0.13), (0.0, 0.04, 0.13),
                0.022),
        blade(p, (0.0, -0.04, 0.13), (0.0, -0.08, 0.14), chord=(0.0, 0.0, 0.05),
            thickness=(0.006, 0.0, 0.0)), limb(Material((0.05, 0.25, 0.04)), (0.0, 0.06, 0.04),
                (0.0, 0.07, 0.16), 0.006)],
        ("fishbowl", "fish bowl", )),
    thing("clothesline", (PALE.colour,), lambda p: [*(rod(_WOOD, (0.0, y, 0.0), (0.0, y, 1.9),
        0.04) for y in (-1.6, 1.6)), rod(PALE, (0.0, -1.6, 1.8), (0.0, 1.6, 1.8), 0.008),
        *(box(c, (0.0, y, 1.8 - 0.5 * h), (0.02, w, h)) for c, y, w, h in ((p, -1.1, 0.7,
            0.9), (RED_PAINT, -0.35, 0.4, 0.5), (BLUE_PAINT, 0.3, 0.4, 0.7), (YELLOW_PAINT, 1.0,
                0.6, 0.6)))],
        ("washing line", "laundry line", "laundry", "clothes line")),
    thing("pinata", ((0.75, 0.10, 0.40),), nothing, ("piñata",),
        moving=(Moving(lambda p: [rod(IRON, (0.0, 0.0, 0.9), (0.0, 0.0, 1.9),
        0.008), *(rod((p, YELLOW_PAINT, BLUE_PAINT, p, YELLOW_PAINT)[k], (-0.3 + 0.12 * k, 0.0,
            0.8), (-0.18 + 0.12 * k, 0.0, 0.8), 0.16)
        for k in range(5)), *(rod((BLUE_PAINT, p)[s], (-0.2 + 0.42 * s, y, 0.35),
            (-0.2 + 0.42 * s, y, 0.75), 0.05) for s in (0, 1) for y in (0.09, -0.09)),
                limb(YELLOW_PAINT, (0.28, 0.0, 0.85), (0.42, 0.0, 1.15), 0.09),
        ball(p, (0.48, 0.0, 1.18), (0.26, 0.16, 0.18)), *(spike(BLUE_PAINT, (0.42, y, 1.22),
            (0.40, 1.3 * y, 1.42), 0.035) for y in (0.06, -0.06))],
        struck(0.35, (0.0, 0.0, 1.9)), hangs=True),)),
    thing("bird feeder", (WOOD_BROWN,), lambda p: [rod(p, (0.0, 0.0, 0.0), (0.0, 0.0, 1.4),
        0.03), box(p, (0.0, 0.0, 1.42), (0.4, 0.4, 0.04)), *(rod(p, (x, y, 1.42), (x, y, 1.68),
            0.015) for x in (0.16, -0.16) for y in (.16, -.16)),
        peak(Material((0.30, 0.08, 0.05)), (0.0, 0.0, 1.80), (0.62, 0.62, 0.26)), ball(BREAD,
            (0.0, 0.0, 1.45), (0.26, 0.26, 0.06))], ("bird table",)),
    thing("gift", (RED_PAINT.colour, BLUE_PAINT.colour), lambda p: [box(p, (0.0, 0.0, 0.14),
        (0.3, 0.3, 0.28)), box(YELLOW_PAINT, (0.0, 0.0, 0.14), (0.31, 0.05, 0.285)),
            box(YELLOW_PAINT, (0.0, 0.0, 0.14), (0.05, 0.31, 0.285)),
        *(ball(YELLOW_PAINT, (0.0, 0.07 * s, 0.31), (0.06, 0.12, 0.06)) for s in (1, -1))],
            ("present", "gift box", "birthday present", "wrapped gift")),
    thing("handbell", ((0.58, 0.40, 0.10),), lambda p: [*lathe(p, [(0.0, 0.09), (0.03, 0.075),
        (0.10, 0.05), (0.13, 0.02)], 6), rod(_WOOD, (0.0, 0.0, 0.13), (0.0, 0.0, 0.24), 0.014)],
            ("hand bell", "brass bell", "dinner bell")),
)  # fmt: skip

_PLAY = placed("indoor", (
    thing("table tennis table", ((0.03, 0.18, 0.14), (0.03, 0.12, 0.40)), lambda p: [box(p, (0.0,
        0.0, 0.74), (1.52, 2.74, 0.04)), *(box(PALE, (0.0, 1.35 * s, 0.763), (1.52, 0.03,
            0.006)) for s in (1, -1)), *(
        box(PALE, (0.75 * s, 0.0, 0.763), (0.03, 2.74, 0.006)) for s in (1, -1)), box(PALE, (0.0,
            0.0, 0.762), (0.012, 2.74, 0.006)), box(INK, (0.0, 0.0, 0.83), (1.7, 0.012, 0.14)),
                box(PALE, (0.0, 0.0, 0.905), (
            1.7, 0.016, 0.02)), *_legs(IRON, 1.3, 2.3, 0.72, 0.05)], ("ping pong table",
                "ping-pong table", "tennis table")),
    thing("pool table", ((0.03, 0.26, 0.10),), lambda p: [box(_WOOD, (0.0, 0.0, 0.68), (1.4, 2.6,
        0.24)), box(p, (0.0, 0.0, 0.80), (1.16, 2.36, 0.02)), *(box(_WOOD, (0.64 * s, 0.0, 0.83),
            (0.12, 2.6, 0.08)) for s in (1, -1)), *(
        box(_WOOD, (0.0, 1.24 * s, 0.83), (1.4, 0.12, 0.08)) for s in (1, -1)), *(post(INK, (x,
            y, 0.85), (0.12, 0.12, 0.06)) for x in (0.58, -0.58) for y in (1.2, 0.0, -1.2)),
                *_legs(_WOOD, 1.3, 2.4, 0.6, 0.16), *(
            ball((RED_PAINT, YELLOW_PAINT, BLUE_PAINT, INK, PALE)[k % 5],
                (0.0 + 0.07 * ((k * 2) % 3 - 1), 0.4 + 0.07 * (k // 3), 0.84), (0.07, 0.07,
                    0.07)) for k in range(8)), ball(PALE, (0.0, -0.6, 0.84), (.07, .07, .07))],
        ("billiard table", "billiards table", "snooker table", "billiards")),
    thing("table football", ((0.05, 0.36, 0.10),), lambda p: [box(_WOOD, (0.0, 0.0, 0.75), (0.8,
        1.4, 0.3)), box(p, (0.0, 0.0, 0.86), (0.68, 1.28, 0.09)), *(rod(SILVER, (-0.7, y, 0.97),
            (0.7, y, 0.97), 0.012) for y in (
        -0.45, -0.15, 0.15, 0.45)), *(box(RED_PAINT if k % 2 else BLUE_PAINT, (x,
            -0.45 + 0.3 * k, 0.95), (0.05, 0.03, 0.12)) for k in range(4) for x in (-0.2, 0.0,
                0.2)), *_legs(IRON, 0.7, 1.2, 0.7, 0.08),
        ball(PALE, (0.1, 0.02, 0.92), (0.05, 0.05, 0.05))], ("foosball table", "foosball",
            "table soccer")),
    thing("lifeguard tower", (RED_PAINT.colour, YELLOW_PAINT.colour), lambda p: [*(rod(_WOOD, (x,
        y, 0.0), (0.8 * x, 0.8 * y, 2.2), 0.08) for x in (0.9, -0.9) for y in (0.9, -0.9)),
            box(_WOOD, (0.0, 0.0, 2.2), (2.4, 2.4, 0.1)),
        box(p, (-0.2, 0.0, 3.0), (1.6, 1.8, 1.5)), box(INK, (0.61, 0.0, 3.2), (0.04, 1.3, 0.7)),
            plank(PALE, (1.2, 0.0, 3.7), (-1.3, 0.0, 4.1), chord=(0.0, 2.4, 0.0), thickness=(0.0,
                0.0, 0.1)), *(box(_WOOD, (
            1.3 + 0.12 * k, 0.0, 2.0 - 0.4 * k), (0.14, 0.8, 0.05)) for k in range(5)),
                box(CHROME, (0.62, 0.0, 2.5), (0.03, 0.5, 0.3))], ("lifeguard stand",
                    "lifeguard chair")),
))  # fmt: skip

NOUNS = (*_HOME, *_PLAY)

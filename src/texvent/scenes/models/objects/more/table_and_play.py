"""Food, things of the house, tables and gear of play that strangers name."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import CHROME, Material, foliage, glowing, mottled
from texvent.scenes.models.objects.figures import disc, lathe, placed, ring, thing, toned
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


def _plate(z: float = 0.008) -> list[ModelPart]:
    return [
        post(_CHINA, (0.0, 0.0, z), (0.26, 0.26, 0.016)),
        post(_CHINA, (0.0, 0.0, z + 0.008), (0.18, 0.18, 0.008)),
    ]


def _legs(p: Material, long: float, wide: float, tall: float, thick: float) -> list[ModelPart]:
    return [
        box(p, (x * long, y * wide, 0.5 * tall), (thick, thick, tall))
        for x in (0.45, -0.45)
        for y in (0.45, -0.45)
    ]


_FOOD = (
    thing("pancake", ((0.62, 0.36, 0.10),), lambda p: [*_plate(), *(post(p if k % 2 else toned(p,
        0.8), (0.0, 0.0, 0.03 + 0.018 * k), (0.17, 0.17, 0.016)) for k in range(5)),
        box(YELLOW_PAINT, (0.0, 0.0, 0.125), (0.04, 0.04, 0.02)), ball(Material((0.30, 0.12,
            0.02)), (0.06, 0.04, 0.10), (0.06, 0.05, 0.06))], ("crepe",
                "waffle")),
    thing("popcorn", ((0.82, 0.78, 0.60),), lambda p: [*(box(c, (0.075 * math.cos(a),
        0.075 * math.sin(a), 0.09), (0.05, 0.05, 0.18)) for c, a in (
        (RED_PAINT, 0.0), (PALE, 0.785), (RED_PAINT, 1.57), (PALE, 2.36), (RED_PAINT, 3.14),
            (PALE, 3.93), (RED_PAINT, 4.71), (PALE, 5.5))),
        *(ball(p, (0.07 * math.cos(2.4 * k) * (k % 4) / 3,
            0.07 * math.sin(2.4 * k) * (k % 4) / 3, 0.20 + 0.012 * (k % 3)), (0.045, 0.045,
                0.04)) for k in range(24))],
        ("popcorn bucket", "popcorn kernel")),
    thing("fried egg", (PALE.colour,), lambda p: [ball(p, (0.0, 0.0, 0.006), (0.13, 0.12,
        0.014)), ball(p, (0.03, 0.03, 0.005), (0.08, 0.07, 0.012)),
        ball(Material((0.85, 0.45, 0.02)), (0.0, 0.0, 0.016), (0.05, 0.05, 0.028))],
            ("sunny side up egg",)),
    thing("noodles", ((0.75, 0.60, 0.30),), lambda p: [*lathe(RED_PAINT, [(0.0, 0.05), (0.08,
        0.10)], 5), *(part for k in range(3) for part in ring(p, (0.0, 0.0, 0.085 + 0.01 * k), (
        0.07 - 0.018 * k, 0.07 - 0.018 * k), 0.010, axis="z", pieces=8)), *(rod(_WOOD, (0.02 * s,
            0.0, 0.09), (-0.12, 0.10 + 0.02 * s, 0.16), 0.004) for s in (1, -1)),
        ball(Material((0.82, 0.5, 0.1)), (0.03, -0.03, 0.11), (0.04, 0.04, 0.02))],
            ("ramen", "spaghetti", "pasta")),
    thing("steak", ((0.28, 0.09, 0.05),), lambda p: [*_plate(), ball(p, (0.0, 0.0, 0.035), (0.15,
        0.11, 0.035)), *(box(INK, (0.03 * k - 0.04, 0.0, 0.052), (0.006, 0.08,
            0.003)) for k in range(4)),
        ball(Material((0.08, 0.28, 0.04)), (0.06, 0.07, 0.03), (0.05, 0.04, 0.03))],
            ("beef steak", "meat", "grilled meat")),
    thing("sushi", (PALE.colour,), lambda p: [box(_WOOD, (0.0, 0.0, 0.01), (0.14, 0.26, 0.02)),
        *(part for k in range(4) for part in (ball(p, (0.0, -0.09 + 0.06 * k, 0.035), (0.07,
            0.04, 0.03)), ball(
        Material((0.85, 0.30, 0.12)), (0.0, -0.09 + 0.06 * k, 0.05), (0.08, 0.042, 0.018)),
            box(INK, (0.0, -0.09 + 0.06 * k, 0.04), (0.018, 0.044, 0.04))))], ("sushi roll",),
                plurals=("sushi",)),
    thing("croissant", ((0.62, 0.34, 0.09),), lambda p: [limb(p if k % 2 else toned(p, 0.75),
        (0.05 * math.cos(a) - 0.02, 0.075 * math.sin(a), 0.025),
            (0.05 * math.cos(a + 0.4) - 0.02, 0.075 * math.sin(
        a + 0.4), 0.025), 0.026 - 0.006 * abs(k - 3)) for k,
            a in enumerate(-1.6 + 0.46 * j for j in range(7))], ("pastry",)),
    thing("onion", ((0.50, 0.24, 0.08),), lambda p: [ball(p, (0.0, 0.0, 0.04), (0.085, 0.085,
        0.075)), spike(p, (0.0, 0.0, 0.07), (0.0, 0.0, 0.11), 0.015)]),
    thing("peach", ((0.80, 0.38, 0.16),), lambda p: [ball(p, (0.0, 0.0, 0.036), (0.078, 0.078,
        0.074)), ball(RED_PAINT, (0.014, 0.012, 0.042), (0.055, 0.055, 0.055)),
            blade(Material((0.06, 0.25, 0.03)), (
        0.0, 0.0, 0.07), (0.03, 0.03, 0.09), chord=(0.0, 0.03, 0.0), thickness=(0.0, 0.0,
            0.004))], ("apricot", "nectarine", "mango"), plurals=("peaches",)),
    thing("coconut", ((0.16, 0.08, 0.04),), lambda p: [ball(mottled(p.colour, contrast=0.4,
        scale=6.0), (0.0, 0.0, 0.07), (0.15, 0.14, 0.14)), *(ball(INK, (0.065, 0.025 * y,
            0.09 + z), (0.02, 0.02, 0.02))
        for y, z in ((1, 0.0), (-1, 0.0), (0, 0.03)))]),
    thing("cabbage", ((0.22, 0.46, 0.12),), lambda p: [ball(p, (0.0, 0.0, 0.09), (0.19, 0.19,
        0.17)), *(blade(toned(p, 0.8 + 0.1 * (k % 2)), (0.05 * math.cos(k), 0.05 * math.sin(k),
            0.01), (
        0.13 * math.cos(k), 0.13 * math.sin(k), 0.13), chord=(-0.12 * math.sin(k),
            0.12 * math.cos(k), 0.0), thickness=(0.01 * math.cos(k), 0.01 * math.sin(k),
                0.0)) for k in range(6))], ("lettuce",)),
    thing("cocktail", ((0.80, 0.25, 0.05),), lambda p: [post(_GLASS, (0.0, 0.0, 0.004), (0.07,
        0.07, 0.008)), rod(_GLASS, (0.0, 0.0, 0.0), (0.0, 0.0, 0.09), 0.005), spike(p, (0.0, 0.0,
            0.16), (0.0, 0.0, 0.08), 0.055),
        rod(RED_PAINT, (0.0, 0.02, 0.12), (0.0, 0.06, 0.22), 0.003), disc(YELLOW_PAINT, (-0.05,
            0.16), 0.022, 0.006)], ("cocktail glass", "margarita", "martini")),
)  # fmt: skip

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
    thing("pinata", ((0.75, 0.10, 0.40),), lambda p: [rod(IRON, (0.0, 0.0, 0.9), (0.0, 0.0, 1.9),
        0.008), *(rod((p, YELLOW_PAINT, BLUE_PAINT, p, YELLOW_PAINT)[k], (-0.3 + 0.12 * k, 0.0,
            0.8), (-0.18 + 0.12 * k, 0.0, 0.8), 0.16)
        for k in range(5)), *(rod((BLUE_PAINT, p)[s], (-0.2 + 0.42 * s, y, 0.35),
            (-0.2 + 0.42 * s, y, 0.75), 0.05) for s in (0, 1) for y in (0.09, -0.09)),
                limb(YELLOW_PAINT, (0.28, 0.0, 0.85), (0.42, 0.0, 1.15), 0.09),
        ball(p, (0.48, 0.0, 1.18), (0.26, 0.16, 0.18)), *(spike(BLUE_PAINT, (0.42, y, 1.22),
            (0.40, 1.3 * y, 1.42), 0.035) for y in (0.06, -0.06))], ("piñata",)),
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

NOUNS = (*_FOOD, *_HOME, *_PLAY)

"""Dishes, fruit and vegetables, told by shape and colour."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, mottled
from texvent.scenes.models.objects.figures import disc, lathe, ring, thing, toned
from texvent.scenes.models.objects.palette import (
    INK,
    PALE,
    RED_PAINT,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, blade, box, post, rod, spike

_WOOD = Material(WOOD_BROWN)
_CHINA = Material((0.80, 0.80, 0.78))
_GLASS = Material((0.62, 0.74, 0.78))


def _plate() -> list[ModelPart]:
    return [
        post(_CHINA, (0.0, 0.0, 0.008), (0.26, 0.26, 0.016)),
        post(_CHINA, (0.0, 0.0, 0.016), (0.18, 0.18, 0.008)),
    ]


NOUNS = (
    thing("pancake", ((0.62, 0.36, 0.10),), lambda p: [*_plate(), *(post(p if k % 2 else toned(p,
        0.8), (0.0, 0.0, 0.03 + 0.018 * k), (0.17, 0.17, 0.016)) for k in range(5)),
        box(YELLOW_PAINT, (0.0, 0.0, 0.125), (0.04, 0.04, 0.02)), ball(Material((0.30, 0.12,
            0.02)), (0.06, 0.04, 0.10), (0.06, 0.05, 0.06))], ("crepe",)),
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
            ("beef steak",)),
    thing("sushi", (PALE.colour,), lambda p: [box(_WOOD, (0.0, 0.0, 0.01), (0.14, 0.26, 0.02)),
        *(part for k in range(4) for part in (ball(p, (0.0, -0.09 + 0.06 * k, 0.035), (0.07,
            0.04, 0.03)), ball(
        Material((0.85, 0.30, 0.12)), (0.0, -0.09 + 0.06 * k, 0.05), (0.08, 0.042, 0.018)),
            box(INK, (0.0, -0.09 + 0.06 * k, 0.04), (0.018, 0.044, 0.04))))], ("sushi roll",),
                plurals=("sushi",)),
    thing("croissant", ((0.62, 0.34, 0.09),), lambda p: [
        ball(p if k % 2 else toned(p, 0.6), (0.05 * math.cos(a) - 0.02, 0.075 * math.sin(a),
            0.026 - 0.003 * abs(k - 4)),
            (0.066 - 0.009 * abs(k - 4), 0.052 - 0.006 * abs(k - 4), 0.056 - 0.008 * abs(k - 4)))
        for k, a in enumerate(-1.8 + 0.45 * j for j in range(9))], ()),
    thing("onion", ((0.50, 0.24, 0.08),), lambda p: [ball(p, (0.0, 0.0, 0.04), (0.085, 0.085,
        0.075)), spike(p, (0.0, 0.0, 0.07), (0.0, 0.0, 0.11), 0.015)]),
    thing("peach", ((0.80, 0.38, 0.16),), lambda p: [ball(p, (0.0, 0.0, 0.036), (0.078, 0.078,
        0.074)), ball(RED_PAINT, (0.014, 0.012, 0.042), (0.055, 0.055, 0.055)),
            blade(Material((0.06, 0.25, 0.03)), (
        0.0, 0.0, 0.07), (0.03, 0.03, 0.09), chord=(0.0, 0.03, 0.0), thickness=(0.0, 0.0,
            0.004))], ("apricot", "nectarine"), plurals=("peaches",)),
    thing("coconut", ((0.16, 0.08, 0.04),), lambda p: [ball(mottled(p.colour, contrast=0.4,
        scale=6.0), (0.0, 0.0, 0.07), (0.15, 0.14, 0.14)), *(ball(INK, (0.065, 0.025 * y,
            0.09 + z), (0.02, 0.02, 0.02))
        for y, z in ((1, 0.0), (-1, 0.0), (0, 0.03)))]),
    thing("cabbage", ((0.22, 0.46, 0.12),), lambda p: [ball(p, (0.0, 0.0, 0.09), (0.19, 0.19,
        0.17)), *(blade(toned(p, 0.8 + 0.1 * (k % 2)), (0.05 * math.cos(k), 0.05 * math.sin(k),
            0.01), (
        0.13 * math.cos(k), 0.13 * math.sin(k), 0.13), chord=(-0.12 * math.sin(k),
            0.12 * math.cos(k), 0.0), thickness=(0.01 * math.cos(k), 0.01 * math.sin(k),
                0.0)) for k in range(6))], ()),
    thing("cocktail", ((0.80, 0.25, 0.05),), lambda p: [post(_GLASS, (0.0, 0.0, 0.004), (0.07,
        0.07, 0.008)), rod(_GLASS, (0.0, 0.0, 0.0), (0.0, 0.0, 0.09), 0.005), spike(p, (0.0, 0.0,
            0.16), (0.0, 0.0, 0.08), 0.055),
        rod(RED_PAINT, (0.0, 0.02, 0.12), (0.0, 0.06, 0.22), 0.003), disc(YELLOW_PAINT, (-0.05,
            0.16), 0.022, 0.006)], ("cocktail glass", "margarita", "martini")),
)  # fmt: skip

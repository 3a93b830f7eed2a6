"""Food: fruit, vegetables, bread, sweets, dishes."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, checked, mottled, striped
from texvent.scenes.models.objects.figures import (
    chain,
    disc,
    lathe,
    lying,
    placed,
    ring,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BREAD,
    CHINA,
    INK,
    LEAF,
    PALE,
    RED_PAINT,
    STALK,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, blade, box, limb, post, rod, spike

_CREAM = Material((0.82, 0.74, 0.58))
_SAUSAGE = Material((0.42, 0.10, 0.05))
_CHEESE = Material((0.78, 0.50, 0.06))
_CRUST = mottled((0.52, 0.28, 0.08), contrast=0.3)
_CHOCOLATE = Material((0.10, 0.04, 0.02))
_PLATE = Material(CHINA)


def _around(count: int, radius: float, z: float, start: float = 0.0) -> list[Point]:
    """Points on a level circle."""
    angles = [2.0 * math.pi * step / count + start for step in range(count)]
    return [(radius * math.cos(angle), radius * math.sin(angle), z) for angle in angles]


def _stalked_fruit(skin: Material, size: Point) -> list[ModelPart]:
    """A round fruit with a dimple, a stalk and a leaf."""
    x, y, z = size
    return [
        ball(skin, (0.0, 0.11 * y, 0.5 * z), (x, 0.78 * y, z)),
        ball(skin, (0.0, -0.11 * y, 0.5 * z), (x, 0.78 * y, z)),
        ball(toned(skin, 0.8), (0.0, 0.0, 0.46 * z), (0.9 * x, 0.8 * y, 0.88 * z)),
        rod(STALK, (0.0, 0.0, 0.85 * z), (0.0, 0.06 * y, 1.25 * z), 0.035 * y),
        blade(LEAF, (0.0, 0.04 * y, 1.08 * z), (0.0, 0.5 * y, 1.22 * z),
              chord=(0.22 * x, 0.0, 0.08 * z), thickness=(0.0, 0.0, 0.04 * z)),
    ]  # fmt: skip


def _bunch(skin: Material) -> list[ModelPart]:
    """A hand of three bananas on its back, all from one stalk."""
    parts = []
    for x in (-0.035, 0.0, 0.035):
        bend = [(x, 0.10 * math.sin(a), 0.13 - 0.11 * math.cos(a)) for a in
                (-1.25, -0.75, -0.25, 0.25, 0.75)]  # fmt: skip
        parts += chain(skin, bend, 0.018)
        parts += [
            rod(STALK, bend[0], (0.4 * x, -0.115, 0.125), 0.008),
            ball(INK, bend[-1], (0.016,) * 3),
        ]
    return parts


def _leafy(skin: Material, spots: list[Point], wide: float) -> list[ModelPart]:
    return [ball(skin, spot, (wide, wide, 0.9 * wide)) for spot in spots]


def _slice(skin: Material, z: float) -> list[ModelPart]:
    """A slice of toast bread, lying."""
    return [box(skin, (0.0, 0.0, z), (0.12, 0.12, 0.016))]


def _round_dish(rim: Material, top: Material, radius: float, tall: float) -> list[ModelPart]:
    return [
        post(rim, (0.0, 0.0, 0.5 * tall), (2 * radius, 2 * radius, tall)),
        post(top, (0.0, 0.0, tall), (1.76 * radius, 1.76 * radius, 0.15 * tall)),
    ]


def _sprinkled(spots: list[Point], size: Point, skin: Material) -> list[ModelPart]:
    return [ball(skin, spot, size) for spot in spots]


NOUNS = placed("indoor", (
    thing("apple", ((0.50, 0.03, 0.02), (0.25, 0.42, 0.04)),
          lambda p: _stalked_fruit(p, (0.078, 0.080, 0.072))),
    thing("orange", ((0.75, 0.22, 0.01),), lambda p: [
        ball(mottled(p.colour, contrast=0.12, scale=9.0), (0.0, 0.0, 0.04), (0.08, 0.08, 0.078)),
        ball(LEAF, (0.0, 0.0, 0.078), (0.014, 0.014, 0.006)),
        blade(LEAF, (0.0, 0.0, 0.079), (0.0, 0.04, 0.088), chord=(0.02, 0.0, 0.0),
              thickness=(0.0, 0.0, 0.003)),
    ], ("orange fruit",)),
    thing("lemon", ((0.80, 0.62, 0.04),), lambda p: [
        ball(p, (0.0, 0.0, 0.03), (0.06, 0.08, 0.06)),
        ball(p, (0.0, 0.038, 0.03), (0.022, 0.026, 0.022)),
        ball(p, (0.0, -0.038, 0.03), (0.018, 0.02, 0.018)),
    ]),
    thing("pear", ((0.42, 0.50, 0.08),), lambda p: [
        ball(p, (0.0, 0.0, 0.038), (0.078, 0.078, 0.076)),
        limb(p, (0.0, 0.0, 0.06), (0.0, 0.0, 0.09), 0.024),
        rod(STALK, (0.0, 0.0, 0.10), (0.0, 0.008, 0.13), 0.003),
    ]),
    thing("banana", ((0.78, 0.56, 0.04),), _bunch, ("bunch of bananas",)),
    thing("pineapple", ((0.50, 0.28, 0.04),), lambda p: [
        ball(checked(p.colour, (0.22, 0.11, 0.02), 3.5), (0.0, 0.0, 0.09), (0.13, 0.13, 0.18)),
        *(spike(LEAF, (0.0, 0.0, 0.16), (0.45 * x, 0.45 * y, z), 0.018)
          for x, y, z in (*_around(6, 0.2, 0.25), *_around(5, 0.08, 0.31, 0.4), (0.0, 0.0, 0.33))),
    ]),
    thing("watermelon", ((0.05, 0.20, 0.04),), lambda p: [
        ball(striped(p.colour, (0.20, 0.42, 0.12), 5.0), (0.0, 0.0, 0.11), (0.22, 0.30, 0.22)),
    ]),
    thing("strawberry", ((0.58, 0.03, 0.03),), lambda p: lying([
        ball(p, (0.0, 0.0, 0.036), (0.036, 0.036, 0.024)),
        spike(p, (0.0, 0.0, 0.036), (0.0, 0.0, 0.0), 0.0178),
        ball(p, (0.0, 0.0, 0.024), (0.027, 0.027, 0.032)),
        *_sprinkled([*_around(6, 0.0170, 0.034), *_around(5, 0.0135, 0.022, 0.5),
                     *_around(4, 0.0085, 0.012)], (0.003, 0.003, 0.004), _CHEESE),
        *(blade(LEAF, (0.0, 0.0, 0.047), (x, y, z), chord=(-0.35 * y, 0.35 * x, 0.0),
                thickness=(0.0, 0.0, 0.002)) for x, y, z in _around(6, 0.015, 0.046)),
        rod(LEAF, (0.0, 0.0, 0.046), (0.0, 0.0, 0.056), 0.0015),
    ])),
    thing("grape", ((0.16, 0.03, 0.16), (0.32, 0.42, 0.08)), lambda p: [
        *(ball(p, (x, y, z), (0.026,) * 3)
          for ring_z, r, n in ((0.013, 0.0, 1), (0.032, 0.018, 4), (0.052, 0.026, 6),
              (0.072, 0.028, 6))
          for x, y, z in _around(n, r, ring_z, ring_z * 40)),
        rod(STALK, (0.0, 0.0, 0.07), (0.0, 0.0, 0.11), 0.003),
    ], ("bunch of grapes", "grapes")),
    thing("cherry", ((0.45, 0.01, 0.02),), lambda p: [
        ball(p, (0.0, 0.014, 0.011), (0.022,) * 3), ball(p, (0.0, -0.014, 0.011), (0.022,) * 3),
        rod(LEAF, (0.0, 0.014, 0.02), (0.0, 0.0, 0.055), 0.0012),
        rod(LEAF, (0.0, -0.014, 0.02), (0.0, 0.0, 0.055), 0.0012),
        blade(LEAF, (0.0, 0.0, 0.055), (0.0, 0.03, 0.06), chord=(0.014, 0.0, 0.0),
              thickness=(0.0, 0.0, 0.001)),
    ]),
    thing("tomato", ((0.60, 0.04, 0.015),), lambda p: [
        ball(p, (0.0, 0.0, 0.033), (0.08, 0.08, 0.066)),
        *(blade(LEAF, (0.0, 0.0, 0.066), (x, y, z), chord=(-0.3 * y, 0.3 * x, 0.0),
                thickness=(0.0, 0.0, 0.003)) for x, y, z in _around(5, 0.028, 0.062)),
    ]),
    thing("carrot", ((0.75, 0.20, 0.01),), lambda p: lying([
        spike(p, (0.0, 0.0, 0.0), (0.0, 0.20, 0.0), 0.022),
        ball(p, (0.0, 0.0, 0.0), (0.04, 0.03, 0.04)),
        *(blade(LEAF, (0.0, 0.0, 0.0), (0.0, -0.11, z), chord=(0.0, 0.006, 0.016),
                thickness=(0.02, 0.0, 0.0)) for z in (-0.05, -0.02, 0.015, 0.05)),
    ])),
    thing("broccoli", ((0.04, 0.16, 0.03),), lambda p: [
        rod(Material((0.28, 0.42, 0.14)), (0.0, 0.0, 0.0), (0.0, 0.0, 0.08), 0.022),
        *(rod(Material((0.28, 0.42, 0.14)), (0.0, 0.0, 0.04), (x, y, z), 0.012)
          for x, y, z in _around(4, 0.04, 0.085)),
        *_leafy(mottled(p.colour, contrast=0.6, scale=7.0),
                [*_around(7, 0.045, 0.095), *_around(3, 0.018, 0.115)], 0.052),
    ], plurals=("broccoli",)),
    thing("mushroom", ((0.55, 0.05, 0.03), (0.45, 0.28, 0.14)), lambda p: [
        *lathe(_CREAM, [(0.0, 0.018), (0.06, 0.013)], 3),
        post(_CREAM, (0.0, 0.0, 0.060), (0.090, 0.090, 0.006)),
        *lathe(p, [(0.063, 0.050), (0.08, 0.042), (0.092, 0.025), (0.097, 0.008)], 7),
        *_sprinkled(_around(6, 0.037, 0.082), (0.014, 0.014, 0.01), PALE),
    ], ("toadstool",)),
    thing("pumpkin", ((0.70, 0.20, 0.01),), lambda p: [
        *(ball(p, (x, y, z), (0.20, 0.20, 0.26)) for x, y, z in _around(8, 0.09, 0.13)),
        rod(Material((0.14, 0.20, 0.04)), (0.0, 0.0, 0.22), (0.02, 0.02, 0.31), 0.02),
    ]),
    thing("egg", ((0.78, 0.66, 0.50),), lambda p: [
        ball(p, (0.0, 0.0, 0.026), (0.044, 0.044, 0.052)),
        ball(p, (0.0, 0.0, 0.031), (0.0405, 0.0405, 0.058)),
    ], ("chicken egg",)),
    thing("bread", ((0.52, 0.28, 0.09),), lambda p: [
        rod(mottled(p.colour, contrast=0.2), (0.0, -0.15, 0.055), (0.0, 0.15, 0.055), 0.055),
        *(ball(mottled(p.colour, contrast=0.2), (0.0, y, 0.055), (0.11, 0.08, 0.11))
            for y in (0.15, -0.15)),
        *(box(_CREAM, (0.0, y, 0.106), (0.05, 0.012, 0.012))
            for y in (-0.1, -0.05, 0.0, 0.05, 0.1)),
    ], ("loaf", "loaf of bread")),
    thing("sandwich", ((0.10, 0.34, 0.04),), lambda p: [
        *_slice(BREAD, 0.010), *_slice(Material((0.70, 0.52, 0.30)), 0.056),
        box(p, (0.0, 0.0, 0.022), (0.132, 0.134, 0.006)),
        box(_CHEESE, (0.0, 0.0, 0.029), (0.126, 0.124, 0.007)),
        box(RED_PAINT, (0.0, 0.0, 0.037), (0.120, 0.118, 0.009)),
        box(Material((0.62, 0.30, 0.24)), (0.0, 0.0, 0.045), (0.126, 0.126, 0.006)),
        rod(STALK, (0.02, 0.0, 0.05), (0.02, 0.0, 0.11), 0.002),
        ball(LEAF, (0.02, 0.0, 0.09), (0.016,) * 3),
    ], ("club sandwich",), plurals=("sandwiches",)),
    thing("hamburger", ((0.52, 0.25, 0.07),), lambda p: [
        post(p, (0.0, 0.0, 0.012), (0.105, 0.105, 0.024)),
        post(LEAF, (0.0, 0.0, 0.027), (0.118, 0.118, 0.006)),
        post(Material((0.13, 0.05, 0.025)), (0.0, 0.0, 0.038), (0.108, 0.108, 0.018)),
        box(_CHEESE, (0.0, 0.0, 0.049), (0.096, 0.096, 0.004)),
        post(RED_PAINT, (0.0, 0.0, 0.054), (0.10, 0.10, 0.007)),
        *lathe(p, [(0.057, 0.053), (0.075, 0.047), (0.088, 0.028), (0.093, 0.008)], 7),
        *_sprinkled(_around(7, 0.033, 0.083), (0.006, 0.006, 0.004), _CREAM),
    ], ("burger", "cheeseburger")),
    thing("hot dog", ((0.58, 0.34, 0.13),), lambda p: [
        limb(p, (0.026, -0.06, 0.022), (0.026, 0.06, 0.022), 0.022),
        limb(p, (-0.026, -0.06, 0.026), (-0.026, 0.06, 0.026), 0.026),
        limb(_SAUSAGE, (0.0, -0.085, 0.042), (0.0, 0.085, 0.042), 0.017),
        *chain(YELLOW_PAINT, [(0.008 * (-1) ** i, -0.07 + 0.02 * i, 0.058) for i in range(8)],
            0.004),
    ], ("hotdog",)),
    thing("pizza", ((0.72, 0.42, 0.05),), lambda p: [
        *_round_dish(_CRUST, mottled(p.colour, contrast=0.3, scale=6.0), 0.16, 0.022),
        *(post(Material((0.48, 0.04, 0.02)), (x, y, z), (0.05, 0.05, 0.006))
          for x, y, z in (*_around(6, 0.095, 0.026), *_around(2, 0.03, 0.026))),
        *_sprinkled(_around(6, 0.065, 0.025, 0.5), (0.022, 0.014, 0.006), LEAF),
    ]),
    thing("donut", ((0.72, 0.18, 0.30), (0.14, 0.06, 0.03)), lambda p: [
        *ring(BREAD, (0.0, 0.0, 0.015), (0.041, 0.041), 0.0165, axis="z", pieces=18),
        *ring(p, (0.0, 0.0, 0.021), (0.041, 0.041), 0.0145, axis="z", pieces=18),
        *_sprinkled([*_around(6, 0.034, 0.034), *_around(7, 0.048, 0.033, 0.3)],
            (0.008, 0.004, 0.003), _CREAM),
    ], ("doughnut",)),
    thing("cake", ((0.75, 0.42, 0.45),), lambda p: [
        post(PALE, (0.0, 0.0, 0.005), (0.32, 0.32, 0.010)),
        post(_CHOCOLATE, (0.0, 0.0, 0.035), (0.26, 0.26, 0.05)),
        post(p, (0.0, 0.0, 0.085), (0.26, 0.26, 0.06)),
        *_sprinkled(_around(8, 0.11, 0.122), (0.036, 0.036, 0.028), _CREAM),
        *_sprinkled(_around(4, 0.11, 0.138), (0.016, 0.016, 0.016), RED_PAINT),
        *(rod(PALE, (x, y, 0.11), (x, y, 0.16), 0.005) for x, y, _ in _around(4, 0.05, 0.0, 0.4)),
        *(ball(Material((1.0, 0.6, 0.15), emission=2.0), (x, y, 0.17), (0.010, 0.010, 0.020))
          for x, y, _ in _around(4, 0.05, 0.0, 0.4)),
    ], ("birthday cake", "layer cake")),
    thing("cupcake", ((0.72, 0.25, 0.36),), lambda p: [
        *lathe(striped((0.60, 0.35, 0.12), (0.45, 0.22, 0.07), 1.0), [(0.0, 0.024), (0.04, 0.034)],
            4),
        *lathe(p, [(0.04, 0.038), (0.055, 0.036), (0.075, 0.020), (0.085, 0.006)], 6),
        ball(RED_PAINT, (0.0, 0.0, 0.089), (0.016,) * 3),
    ]),
    thing("ice cream", ((0.75, 0.35, 0.40), (0.78, 0.70, 0.50)), lambda p: [
        spike(checked((0.58, 0.34, 0.12), (0.42, 0.22, 0.07), 4.0), (0.0, 0.0, 0.11),
            (0.0, 0.0, 0.0), 0.03),
        ball(p, (0.0, 0.0, 0.125), (0.066, 0.066, 0.06)),
        ball(_CHOCOLATE, (0.0, 0.0, 0.165), (0.054, 0.054, 0.05)),
    ], ("ice cream cone", "ice-cream")),
    thing("cheese", ((0.78, 0.50, 0.06),), lambda p: [
        box(p, (0.0, 0.0, 0.045), (0.09, 0.16, 0.09)),
        *(ball(toned(p, 0.55), (0.042, y, z), (0.012, r, r)) for y, z, r in
          ((-0.055, 0.06, 0.03), (-0.01, 0.03, 0.024), (0.03, 0.065, 0.034), (0.06, 0.03, 0.02))),
        *(ball(toned(p, 0.55), (x, y, 0.087), (r, r, 0.012)) for x, y, r in
          ((0.01, -0.04, 0.03), (-0.02, 0.02, 0.024), (0.015, 0.055, 0.02)))],
          ("block of cheese",)),
    thing("sausage", ((0.42, 0.10, 0.05),), lambda p: chain(
        p, [(0.05 * math.cos(a), 0.09 * math.sin(a), 0.018) for a in (-1.2, -0.6, 0.0, 0.6, 1.2)],
        0.018)),
    thing("lollipop", ((0.62, 0.04, 0.10),), lambda p: [
        rod(PALE, (0.0, 0.0, 0.0), (0.0, 0.0, 0.13), 0.003), disc(p, (0.0, 0.16), 0.036, 0.012),
        *ring(PALE, (0.008, 0.0, 0.16), (0.024, 0.024), 0.003, pieces=9, span=(0.0, 300.0)),
        ball(PALE, (0.008, 0.0, 0.16), (0.008, 0.012, 0.012)),
    ]),
    thing("corn", ((0.78, 0.52, 0.05),), lambda p: lying([
        limb(checked(p.colour, (0.60, 0.36, 0.03), 6.0), (0.0, -0.07, 0.0), (0.0, 0.07, 0.0),
            0.024),
        *(blade(LEAF, (0.0, -0.10, 0.0), (0.01, 0.03, z), chord=(0.02, 0.0, 0.03),
            thickness=(0.006, 0.0, 0.0))
          for z in (-0.035, 0.035)),
    ]), ("corn cob", "corncob")),
    thing("pepper", ((0.55, 0.03, 0.02), (0.10, 0.34, 0.04), (0.75, 0.45, 0.02)), lambda p: [
        *(limb(p, (x, y, 0.03), (x, y, z), 0.028) for x, y, z in _around(4, 0.02, 0.07)),
        rod(LEAF, (0.0, 0.0, 0.09), (0.0, 0.006, 0.125), 0.007),
    ], ("bell pepper",)),
    thing("cucumber", ((0.05, 0.18, 0.03),), lambda p: [
        limb(mottled(p.colour, contrast=0.3, scale=6.0), (0.0, -0.12, 0.022), (0.0, 0.12, 0.022),
            0.022)]),
    thing("potato", ((0.42, 0.27, 0.12),), lambda p: [
        ball(mottled(p.colour, contrast=0.25), (0.0, 0.0, 0.032), (0.07, 0.10, 0.064)),
        ball(mottled(p.colour, contrast=0.25), (0.0, 0.02, 0.034), (0.064, 0.06, 0.066))],
        plurals=("potatoes",)),
    thing("cookie", ((0.50, 0.29, 0.10),), lambda p: [
        post(mottled(p.colour, contrast=0.2), (0.0, 0.0, 0.006), (0.075, 0.075, 0.012)),
        *_sprinkled([*_around(5, 0.024, 0.013), (0.0, 0.0, 0.013)], (0.013, 0.011, 0.008),
            _CHOCOLATE)]),
    thing("soup", ((0.60, 0.24, 0.04),), lambda p: [
        *lathe(_PLATE, [(0.0, 0.04), (0.015, 0.07), (0.06, 0.095)], 6),
        post(p, (0.0, 0.0, 0.0605), (0.175, 0.175, 0.003)),
        *_sprinkled(_around(4, 0.05, 0.063), (0.016, 0.016, 0.004), LEAF)],
        ("bowl of soup",)),
    thing("salad", ((0.16, 0.40, 0.05),), lambda p: [
        *lathe(_PLATE, [(0.0, 0.05), (0.015, 0.08), (0.07, 0.12)], 6),
        *_leafy(mottled(p.colour, contrast=0.5), [*_around(6, 0.065, 0.07), (0.0, 0.0, 0.09)],
            0.075),
        *_sprinkled(_around(3, 0.05, 0.11), (0.034, 0.034, 0.034), RED_PAINT)]),
))  # fmt: skip
"""Nouns of food."""

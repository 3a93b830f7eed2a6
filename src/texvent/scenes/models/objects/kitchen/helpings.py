"""Food as it lies on a plate: helpings of rice, vegetables, fruit; slices; cutlery."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material
from texvent.scenes.models.objects.figures import chain, placed, ring, thing, toned
from texvent.scenes.models.objects.palette import CHINA, INK, LEAF, PALE, RED_PAINT, SILVER, STALK
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Point,
    ball,
    box,
    limb,
    moved,
    plank,
    post,
    rod,
    shift,
    turn_z,
)

_GREEN = Material((0.05, 0.20, 0.03))
_PALE_GREEN = Material((0.28, 0.42, 0.14))
_ORANGE = Material((0.75, 0.20, 0.01))
_YELLOW = Material((0.78, 0.56, 0.04))
_BROWN = Material((0.26, 0.10, 0.04))
_CRUST = Material((0.52, 0.28, 0.08))
_CHEESE = Material((0.80, 0.52, 0.08))
_GRAPE = Material((0.20, 0.04, 0.20))
_GOLDEN = math.pi * (3.0 - math.sqrt(5.0))


def _grains(skin: Material, radius: float, tall: float, count: int) -> list[ModelPart]:
    """A mound with grains all over it."""
    parts = [
        ball(toned(skin, 0.85), (0.0, 0.0, 0.3 * tall), (2.0 * radius, 2.0 * radius, 1.2 * tall))
    ]
    for k in range(count):
        share = (k + 0.5) / count
        far, angle = radius * math.sqrt(share), _GOLDEN * k
        z = tall * (0.3 + 0.6 * math.sqrt(1.0 - share))
        spot = (far * math.cos(angle), far * math.sin(angle), z)
        size = (0.026, 0.010, 0.010) if k % 2 else (0.010, 0.026, 0.010)
        parts.append(ball(toned(skin, 0.72 + 0.28 * (k % 3 > 0)), spot, size))
    return parts


def _floret(at: Point, size: float, skin: Material = _GREEN) -> list[ModelPart]:
    """A piece of broccoli."""
    x, y, z = at
    return [
        rod(_PALE_GREEN, (x, y, z), (x, y, z + 0.6 * size), 0.16 * size),
        *(ball(skin, (x + 0.3 * size * math.cos(a), y + 0.3 * size * math.sin(a), z + 0.7 * size),
               (0.5 * size,) * 3) for a in (0.0, 1.57, 3.14, 4.71)),
        ball(skin, (x, y, z + 0.88 * size), (0.5 * size,) * 3),
    ]  # fmt: skip


def _coin(skin: Material, at: Point, radius: float) -> list[ModelPart]:
    """A slice of carrot, cucumber or tomato."""
    x, y, z = at
    return [
        post(skin, (x, y, z), (2.0 * radius, 2.0 * radius, 0.014)),
        post(toned(skin, 1.25), (x, y, z + 0.007), (radius, radius, 0.004)),
    ]


def _vegetables(skin: Material) -> list[ModelPart]:
    """Broccoli, slices of carrot, peas, tomatoes and strips of pepper in a heap."""
    parts = [*_floret((0.0, -0.04, 0.0), 0.062, skin), *_floret((-0.045, 0.03, 0.0), 0.058, skin),
             *_floret((0.05, 0.015, 0.0), 0.05, skin)]  # fmt: skip
    for x, y, z in ((0.075, -0.05, 0.012), (0.055, -0.075, 0.02), (0.085, -0.015, 0.012),
                    (-0.07, -0.05, 0.012), (-0.045, -0.075, 0.02)):  # fmt: skip
        parts += _coin(_ORANGE, (x, y, z), 0.022)
    parts += [ball(RED_PAINT, spot, (0.04, 0.04, 0.036)) for spot in
              ((0.03, 0.065, 0.018), (-0.01, 0.075, 0.018), (-0.085, 0.0, 0.018))]  # fmt: skip
    parts += [ball(LEAF, (0.07 + 0.014 * (k % 3), 0.035 + 0.014 * (k // 3), 0.008), (0.016,) * 3)
              for k in range(6)]  # fmt: skip
    return parts


def _bananas(at: Point) -> list[ModelPart]:
    """Two bananas side by side on their backs."""
    x, y, z = at
    parts: list[ModelPart] = []
    for k in range(2):
        bend = [(x + 0.026 * k, y + 0.085 * math.sin(a), z + 0.09 - 0.085 * math.cos(a))
                for a in (-1.1, -0.55, 0.0, 0.55, 1.1)]  # fmt: skip
        parts += chain(_YELLOW, bend, 0.016)
        parts.append(ball(INK, bend[-1], (0.014,) * 3))
    return parts


def _fruit(skin: Material) -> list[ModelPart]:
    """Apples, oranges, bananas and grapes in a heap."""
    parts = [
        ball(skin, (0.05, -0.035, 0.036), (0.076, 0.076, 0.07)),
        rod(STALK, (0.05, -0.035, 0.066), (0.054, -0.03, 0.086), 0.003),
        ball(Material((0.75, 0.24, 0.01)), (0.045, 0.045, 0.037), (0.076, 0.076, 0.074)),
        ball(Material((0.30, 0.46, 0.04)), (-0.045, -0.045, 0.036), (0.074, 0.074, 0.07)),
        ball(Material((0.75, 0.24, 0.01)), (0.0, 0.0, 0.085), (0.072, 0.072, 0.07)),
        *_bananas((-0.055, 0.035, 0.03)),
    ]
    parts += [ball(_GRAPE, (0.085 - 0.016 * (k % 3), 0.005 + 0.017 * (k // 3), 0.062 - 0.008 * k),
                   (0.022,) * 3) for k in range(6)]  # fmt: skip
    return parts


def _meat(at: Point, skin: Material = _BROWN) -> list[ModelPart]:
    """A grilled slice of meat with dark stripes."""
    x, y, z = at
    return [
        ball(skin, (x, y, z + 0.014), (0.11, 0.085, 0.032)),
        *(box(INK, (x + 0.022 * k - 0.022, y, z + 0.028), (0.005, 0.055, 0.004)) for k in range(3)),
    ]


def _food(skin: Material) -> list[ModelPart]:
    """Meat, rice, broccoli and carrots side by side."""
    rice = moved(_grains(skin, 0.046, 0.045, 12), shift(-0.04, 0.052))
    return [
        *_meat((0.04, 0.035, 0.0)), *rice, *_floret((-0.05, -0.03, 0.0), 0.055),
        *_floret((-0.015, -0.06, 0.0), 0.05),
        *_coin(_ORANGE, (0.035, -0.045, 0.008), 0.022), *_coin(_ORANGE, (0.06, -0.03, 0.008), 0.02),
        *_coin(_ORANGE, (0.045, -0.035, 0.02), 0.02),
        ball(RED_PAINT, (0.02, -0.085, 0.018), (0.036, 0.036, 0.034)),
        ball(RED_PAINT, (0.055, -0.075, 0.018), (0.036, 0.036, 0.034)),
    ]  # fmt: skip


def _cutlery(at: float, spread: float, skin: Material = SILVER) -> list[ModelPart]:
    """A fork at y = at + spread, a knife and a spoon at y = at - spread, all lying along x."""
    fork, knife = at + spread, at - spread
    spoon = knife - 0.04
    return [
        box(skin, (-0.03, fork, 0.006), (0.12, 0.012, 0.006)),
        box(skin, (0.045, fork, 0.006), (0.04, 0.034, 0.006)),
        *(box(skin, (0.085, fork + d, 0.006), (0.05, 0.005, 0.005))
          for d in (-0.0145, -0.005, 0.005, 0.0145)),
        box(toned(skin, 0.5), (-0.05, knife, 0.007), (0.09, 0.018, 0.01)),
        plank(skin, (-0.005, knife, 0.006), (0.11, knife, 0.006), chord=(0.0, 0.024, 0.0),
              thickness=(0.0, 0.0, 0.004)),
        box(skin, (-0.03, spoon, 0.006), (0.14, 0.011, 0.006)),
        ball(skin, (0.07, spoon, 0.008), (0.065, 0.042, 0.014)),
        ball(toned(skin, 0.5), (0.07, spoon, 0.013), (0.048, 0.028, 0.008)),
    ]  # fmt: skip


def _meal(plate: Material) -> list[ModelPart]:
    """A plate of food between fork and knife."""
    return [
        post(plate, (0.0, 0.0, 0.007), (0.28, 0.28, 0.014)),
        *ring(plate, (0.0, 0.0, 0.016), (0.135, 0.135), 0.007, axis="z", pieces=10),
        *moved(_food(PALE), shift(z=0.014)),
        *_cutlery(0.0, 0.18),
    ]


def _pizza_slice(skin: Material) -> list[ModelPart]:
    """A narrow triangle of pizza with its crust, tip towards -y."""
    parts = [
        box(skin, (0.0, 0.10 - 0.024 * k, 0.008), (0.15 - 0.0145 * k, 0.026, 0.014))
        for k in range(10)
    ]
    parts.append(limb(_CRUST, (-0.072, 0.122, 0.014), (0.072, 0.122, 0.014), 0.016))
    for x, y in ((-0.028, 0.075), (0.03, 0.06), (0.0, 0.01), (-0.004, -0.05)):
        parts.append(post(Material((0.48, 0.04, 0.02)), (x, y, 0.017), (0.036, 0.036, 0.006)))
    return [*parts, ball(LEAF, (0.03, 0.02, 0.017), (0.02, 0.012, 0.006))]


def _waffle(skin: Material) -> list[ModelPart]:
    """A round waffle with a grid of hollows, butter and syrup."""
    parts = [post(skin, (0.0, 0.0, 0.012), (0.17, 0.17, 0.024))]
    for k in range(-2, 3):
        half = 0.082 * math.cos(0.5 * k)
        for turn in (0.0, 0.5 * math.pi):
            bar = box(toned(skin, 1.25), (0.03 * k, 0.0, 0.026), (0.010, 2.0 * half, 0.012))
            parts += moved([bar], turn_z(turn))
    parts.append(box(_YELLOW, (0.01, 0.0, 0.038), (0.035, 0.035, 0.014)))
    return parts


def _pan(skin: Material) -> list[ModelPart]:
    """A flat baking pan with a rim."""
    return [
        post(skin, (0.0, 0.0, 0.008), (0.36, 0.36, 0.016)),
        *ring(toned(skin, 1.3), (0.0, 0.0, 0.02), (0.175, 0.175), 0.010, axis="z", pieces=16),
    ]


def _green_peas(skin: Material) -> list[ModelPart]:
    """A heap of peas."""
    parts = [ball(toned(skin, 0.7), (0.0, 0.0, 0.008), (0.11, 0.11, 0.03))]
    for k in range(36):
        far, angle = 0.055 * math.sqrt((k + 0.5) / 36), _GOLDEN * k
        spot = (far * math.cos(angle), far * math.sin(angle), 0.030 - 5.0 * far * far)
        parts.append(ball(skin, spot, (0.018,) * 3))
    return parts


NOUNS = placed("indoor", (
    thing("food", (PALE.colour,), _food, ("cooked food",)),
    thing("meal", (CHINA,), _meal, ("hot meal",)),
    thing("meat", (_BROWN.colour,),
          lambda p: [*_meat((0.0, 0.035, 0.0), p), *_meat((0.02, -0.04, 0.012), p)],
          ("grilled meat", "cooked meat")),
    thing("rice", (PALE.colour,), lambda p: _grains(p, 0.07, 0.05, 56),
          ("cooked rice", "white rice")),
    thing("vegetables", (_GREEN.colour,), _vegetables,
          ("vegetable", "veggies", "veggie"), plurals=("vegetables",)),
    thing("fruit", (RED_PAINT.colour,), _fruit, ("mixed fruit",), plurals=("fruits",)),
    thing("peas", (LEAF.colour,), _green_peas, ("green peas",), plurals=("peas",)),
    thing("cutlery", (SILVER.colour,), lambda p: _cutlery(0.02, 0.03, p),
          ("silverware", "eating utensil", "flatware"), plurals=("eating utensils",)),
    thing("pizza slice", (_CHEESE.colour,), _pizza_slice, ("slice of pizza", "piece of pizza"),
          plurals=("slices of pizza", "pieces of pizza")),
    thing("waffle", ((0.56, 0.30, 0.07),), _waffle),
    thing("pizza pan", ((0.20, 0.20, 0.21),), _pan, ("baking pan",)),
))  # fmt: skip
"""Nouns of helpings; a heap is one thing, whatever its word's number."""

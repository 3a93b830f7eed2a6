"""Larger sports gear: rods and spears, ramps, a climbing wall, a podium, chess pieces, a saddle."""

from __future__ import annotations

import itertools
import math

from texvent.scenes.models.materials import Material, leather
from texvent.scenes.models.objects.figures import (
    Moving,
    bar,
    chain,
    disc,
    lathe,
    lying,
    placed,
    ring,
    spinning,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLACKISH,
    BLUE_PAINT,
    INK,
    PALE,
    PALE_WOOD,
    RED_PAINT,
    SILVER,
    SILVERY,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, blade, box, limb, plank, post, rod, spike

_HOLDS = (RED_PAINT, YELLOW_PAINT, BLUE_PAINT, Material((0.05, 0.35, 0.08)))


def _climbing_wall(p: Material) -> list[ModelPart]:
    holds = [
        ball(_HOLDS[k % 4], (0.14, -1.7 + (0.83 * k) % 3.4, 0.3 + 0.155 * k), (0.14, 0.22, 0.16))
        for k in range(22)
    ]
    return [box(p, (0.0, 0.0, 2.0), (0.2, 4.0, 4.0)), *holds]


def _ramp(p: Material) -> list[ModelPart]:
    """A quarter pipe: planks that become steeper, and a deck with a rail behind."""
    curve = [(1.9, 0.02), (1.2, 0.10), (0.7, 0.30), (0.3, 0.65), (0.08, 1.1), (0.0, 1.6)]
    side = toned(p, 0.55)
    parts: list[ModelPart] = []
    for (x0, z0), (x1, z1) in itertools.pairwise(curve):
        parts.append(
            plank(p, (x0, 0.0, z0), (x1, 0.0, z1), chord=(0.0, 3.0, 0.0),
                  thickness=(0.03, 0.0, 0.04))
        )  # fmt: skip
        for y in (1.48, -1.48):
            parts.append(box(side, (0.5 * (x0 + x1), y, 0.25 * (z0 + z1)),
                             (abs(x0 - x1) + 0.02, 0.05, 0.5 * (z0 + z1))))  # fmt: skip
    parts += [
        box(p, (-0.5, 0.0, 1.58), (1.0, 3.0, 0.06)),
        *(box(side, (-0.5, y, 0.79), (1.0, 0.05, 1.58)) for y in (1.48, -1.48)),
        rod(SILVER, (0.0, -1.5, 1.61), (0.0, 1.5, 1.61), 0.03),
        *(rod(SILVER, (-0.98, y, 1.6), (-0.98, y, 2.5), 0.025) for y in (1.4, 0.0, -1.4)),
        rod(SILVER, (-0.98, -1.4, 2.5), (-0.98, 1.4, 2.5), 0.025),
    ]
    return parts


def _wedge(p: Material) -> list[ModelPart]:
    """A straight ramp that falls towards +x, on posts, 2.8 m long and 1.1 m high."""
    side = toned(p, 0.55)
    return [
        plank(p, (1.4, 0.0, 0.02), (-1.4, 0.0, 1.1), chord=(0.0, 1.0, 0.0),
              thickness=(0.02, 0.0, 0.05)),
        *(plank(side, (1.4, y, 0.02), (-1.4, y, 1.1), chord=(0.0, 0.05, 0.0),
                thickness=(0.04, 0.0, 0.10)) for y in (0.5, -0.5)),
        *(box(side, (x, y, 0.5 * tall), (0.09, 0.09, tall))
          for x, tall in ((-1.34, 1.02), (-0.6, 0.74), (0.2, 0.43)) for y in (0.44, -0.44)),
    ]  # fmt: skip


def _podium(p: Material) -> list[ModelPart]:
    steps = ((0.0, 0.75), (-0.9, 0.5), (0.9, 0.35))
    parts = [box(p, (0.0, y, 0.5 * tall), (0.8, 0.9, tall)) for y, tall in steps]
    parts += [bar(RED_PAINT, (0.0, 0.2), (0.0, 0.6), 0.08, 0.02, 0.405)]
    for start, end in (((-1.05, 0.42), (-0.75, 0.42)), ((-0.75, 0.42), (-0.75, 0.30)),
                       ((-0.75, 0.28), (-1.05, 0.28)), ((-1.05, 0.26), (-1.05, 0.14)),
                       ((-1.05, 0.12), (-0.75, 0.12)), ((0.75, 0.30), (1.05, 0.30)),
                       ((0.80, 0.19), (1.05, 0.19)), ((0.75, 0.07), (1.05, 0.07)),
                       ((1.05, 0.05), (1.05, 0.32))):  # fmt: skip
        parts.append(bar(RED_PAINT, start, end, 0.05, 0.02, 0.405))
    return parts


def _king(p: Material) -> list[ModelPart]:
    return [
        *lathe(p, [(0.0, 0.030), (0.012, 0.030), (0.02, 0.020), (0.05, 0.012), (0.075, 0.018),
                   (0.085, 0.020)], 8),
        ball(p, (0.0, 0.0, 0.088), (0.036, 0.036, 0.02)),
        box(p, (0.0, 0.0, 0.108), (0.008, 0.008, 0.028)),
        box(p, (0.0, 0.0, 0.110), (0.008, 0.022, 0.008)),
    ]  # fmt: skip


def _arc(eighth: int) -> list[tuple[float, float]]:
    """Cosine and sine of three angles of an eighth of a circle."""
    return [
        (math.cos(0.7854 * (eighth + k / 2)), math.sin(0.7854 * (eighth + k / 2))) for k in range(3)
    ]


_IN_HALLS = placed("indoor", (
    thing("climbing wall", ((0.52, 0.47, 0.40), (0.30, 0.36, 0.42)), _climbing_wall,
          ("rock climbing wall", "bouldering wall")),
    thing("podium", (PALE.colour,), _podium, ("winners podium", "victory podium", "rostrum")),
    thing("chess piece", (PALE_WOOD, (0.05, 0.035, 0.03)), _king,
          ("chessman", "pawn", "chess king")),
    thing("kettlebell", (BLACKISH, (0.45, 0.05, 0.04)), lambda p: [
        ball(p, (0.0, 0.0, 0.10), (0.20, 0.20, 0.19)), post(p, (0.0, 0.0, 0.015),
            (0.13, 0.13, 0.03)),
        *ring(p, (0.0, 0.0, 0.21), (0.075, 0.085), 0.018, span=(-30.0, 210.0), pieces=10)]),
    thing("exercise bike", (BLACKISH, (0.45, 0.05, 0.04)), lambda p: [
        box(p, (0.0, 0.0, 0.05), (0.10, 0.9, 0.08)), *(box(p, (0.45 * s, 0.0, 0.04),
            (0.10, 0.5, 0.06)) for s in (1, -1)),
        box(p, (0.0, 0.0, 0.10), (1.0, 0.08, 0.08)), rod(SILVER, (0.32, 0.0, 0.06),
            (0.32, 0.0, 0.5), 0.05), limb(p, (-0.25, 0.0, 0.1), (-0.35, 0.0, 0.9), 0.035),
        ball(INK, (-0.35, 0.0, 0.93), (0.28, 0.2, 0.09)),
        limb(p, (0.3, 0.0, 0.1), (0.45, 0.0, 1.1), 0.035),
        rod(INK, (0.42, -0.22, 1.12), (0.42, 0.22, 1.12), 0.02),
        box(Material((0.10, 0.30, 0.55), emission=0.8), (0.46, 0.0, 1.2), (0.04, 0.2, 0.14))],
        ("stationary bike", "spin bike", "stationary bicycle", "exercise bicycle"),
        moving=(Moving(lambda p: [
            rod(SILVER, (0.38, -0.05, 0.42), (0.38, 0.05, 0.42), 0.24),
            rod(INK, (0.38, -0.055, 0.42), (0.38, 0.055, 0.42), 0.19)],
            spinning("y", 1.0, (0.38, 0.0, 0.42))),)),
))  # fmt: skip

_OUTSIDE = placed("grass", (
    thing("fishing rod", (BLACKISH,), lambda p: [
        limb(p, (0.0, -0.9, 0.25), (0.0, 0.9, 1.25), 0.020), limb(Material((0.45, 0.30, 0.15)),
            (0.0, -1.0, 0.19), (0.0, -0.7, 0.36), 0.022),
        disc(SILVER, (-0.66, 0.31), 0.05, 0.05, 0.04), disc(INK, (-0.66, 0.31), 0.03, 0.08, 0.04),
        rod(PALE, (0.0, 0.9, 1.25), (0.0, 0.95, 0.30), 0.006),
        ball(RED_PAINT, (0.0, 0.95, 0.30), (0.05, 0.05, 0.06)),
        ball(PALE, (0.0, 0.95, 0.275), (0.045, 0.045, 0.04)),
        *(rod(Material(WOOD_BROWN), (0.06 * s, -0.45, 0.0), (-0.02 * s, -0.45, 0.48), 0.022)
            for s in (1, -1))], ("fishing pole", "angling rod")),
    thing("spear", (WOOD_BROWN,), lambda p: lying([
        rod(p, (0.0, 0.0, 0.0), (0.0, 0.0, 2.0), 0.018), spike(SILVER, (0.0, 0.0, 2.0),
            (0.0, 0.0, 2.28), 0.045), rod(RED_PAINT, (0.0, 0.0, 1.93), (0.0, 0.0, 2.01), 0.024)]),
        ("javelin",)),
    thing("skate ramp", ((0.50, 0.40, 0.28), (0.42, 0.43, 0.44)), _ramp,
          ("skateboard ramp", "bmx ramp")),
    thing("ramp", ((0.50, 0.40, 0.28), (0.42, 0.43, 0.44)), _wedge,
          ("wooden ramp", "loading ramp", "inclined plane", "incline", "slope ramp")),
    thing("saddle", ((0.20, 0.085, 0.035),), lambda p: [
        rod(Material(WOOD_BROWN), (-0.45, 0.0, 0.42), (0.45, 0.0, 0.42), 0.10),
        *(limb(Material(WOOD_BROWN), (x, 0.0, 0.42), (x, 0.28 * s, 0.0), 0.025)
            for x in (0.38, -0.38) for s in (1.0, -1.0)),
        ball(leather(p.colour), (0.0, 0.0, 0.52), (0.56, 0.30, 0.13)),
        ball(leather(p.colour), (-0.24, 0.0, 0.60), (0.12, 0.32, 0.17)),
        limb(p, (0.22, 0.0, 0.54), (0.25, 0.0, 0.68), 0.03),
        ball(p, (0.25, 0.0, 0.69), (0.11, 0.10, 0.05)),
        *(blade(toned(p, 0.8), (0.0, 0.10 * s, 0.54), (0.02, 0.24 * s, 0.20),
            chord=(0.42, 0.0, 0.0), thickness=(0.0, 0.03, 0.0)) for s in (1.0, -1.0)),
        *(part for s in (1.0, -1.0) for part in ring(SILVER, (0.04, 0.26 * s, 0.14),
            (0.05, 0.06), 0.010, axis="y", pieces=8))], ("horse saddle", "riding saddle")),
    thing("lifebuoy", ((0.75, 0.16, 0.02),), lambda p: [
        *(part for k in range(8) for part in chain(p if k % 2 else PALE,
            [(0.0, 0.30 * c, 0.38 + 0.30 * s) for c, s in _arc(k)], 0.07))],
        ("life ring", "life buoy", "life preserver", "swim ring", "inflatable ring",
         "rubber ring")),
    thing("barbed fence", (SILVERY,), lambda p: [
        *(rod(Material(WOOD_BROWN), (0.0, y, 0.0), (0.0, y, 1.3), 0.05) for y in (-1.5, 0.0, 1.5)),
        *(rod(p, (0.06, -1.5, z), (0.06, 1.5, z), 0.022) for z in (0.4, 0.8, 1.2)),
        *(spike(p, (0.06, -1.4 + 0.28 * k, z - 0.04), (0.06, -1.36 + 0.28 * k, z + 0.10), 0.035)
            for k in range(11) for z in (0.4, 0.8, 1.2))],
        ("barbed wire", "barbed wire fence", "wire fence")),
))  # fmt: skip


NOUNS = (*_IN_HALLS, *_OUTSIDE)
"""Nouns of larger sports gear."""

"""More furniture, and what belongs to a room: door, window, mirror, rug, plants in pots."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, cloth, glowing, mottled
from texvent.scenes.models.objects.figures import (
    Moving,
    bar,
    chain,
    lathe,
    nothing,
    placed,
    rectangle,
    ring,
    swinging,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BRASS,
    BRICK,
    CHINA,
    DARK_WOOD,
    EARTH,
    GREY_PLASTIC,
    INK,
    IRON,
    LEAF,
    PALE,
    PALE_WOOD,
    RED_PAINT,
    SILVER,
    SILVERY,
    STONE,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, blade, box, limb, plank, post, rod
from texvent.scenes.scene import Colour

_WOODS: tuple[Colour, ...] = (WOOD_BROWN, DARK_WOOD, PALE_WOOD)
_CLOTHS: tuple[Colour, ...] = (
    (0.05, 0.16, 0.32),
    (0.36, 0.07, 0.05),
    (0.24, 0.24, 0.22),
    (0.08, 0.22, 0.12),
)
_PANE = Material((0.20, 0.34, 0.46))


def _legs(skin: Material, x: float, y: float, tall: float, thick: float) -> list[ModelPart]:
    return [
        box(skin, (a * x, b * y, 0.5 * tall), (thick, thick, tall))
        for a in (1.0, -1.0)
        for b in (1.0, -1.0)
    ]


def _drawers(
    skin: Material, y: float, wide: float, rows: tuple[float, ...], tall: float, x: float
) -> list[ModelPart]:
    """Drawer fronts with knobs, one above the other."""
    parts = []
    for z in rows:
        parts += [
            box(toned(skin, 1.25), (x, y, z), (0.02, wide, tall)),
            ball(BRASS, (x + 0.02, y, z), (0.03, 0.04, 0.03)),
        ]
    return parts


def _potted(pot: Material) -> list[ModelPart]:
    """A pot with a bush of broad leaves."""
    parts = [
        *lathe(pot, [(0.0, 0.11), (0.26, 0.16)], 5),
        post(toned(pot, 1.2), (0.0, 0.0, 0.27), (0.35, 0.35, 0.04)),
        post(EARTH, (0.0, 0.0, 0.285), (0.29, 0.29, 0.02)),
    ]
    for k in range(9):
        a = 2.4 * k
        out, up = (0.30, 0.55) if k % 3 else (0.14, 0.80)
        tip = (out * math.cos(a), out * math.sin(a), up + 0.03 * (k % 4))
        parts.append(
            blade(
                toned(LEAF, 0.8 + 0.1 * (k % 4)),
                (0.0, 0.0, 0.26),
                tip,
                chord=(-0.17 * math.sin(a), 0.17 * math.cos(a), 0.0),
                thickness=(0.02 * math.cos(a), 0.02 * math.sin(a), 0.02),
            )
        )
    return parts


def _folds(skin: Material, y: float, wide: float, count: int) -> list[ModelPart]:
    """Hanging cloth in folds."""
    step = wide / count
    return [
        rod(
            toned(skin, 0.85 + 0.3 * (k % 2)),
            (0.0, y - 0.5 * wide + (k + 0.5) * step, 0.05),
            (0.0, y - 0.5 * wide + (k + 0.5) * step, 2.2),
            0.06,
            side_radius=0.56 * step,
        )
        for k in range(count)
    ]


NOUNS = placed("indoor", (
    thing("desk", _WOODS, lambda p: [box(p, (0.0, 0.0, 0.73), (0.70, 1.40, 0.04)),
        box(p, (-0.30, 0.0, 0.50), (0.02, 1.30, 0.42)),
        box(p, (0.0, 0.48, 0.36), (0.62, 0.38, 0.72)),
        *_drawers(p, 0.48, 0.34, (0.60, 0.38, 0.16), 0.19, 0.315),
        *(box(p, (x, -0.65, 0.36), (0.06, 0.06, 0.72)) for x in (0.3, -0.3))],
        ("writing desk", "office desk")),
    thing("shelf", _WOODS,
        lambda p: [*(box(p, (0.0, y, 0.75), (0.32, 0.04, 1.50)) for y in (0.48, -0.48)),
            *(box(p, (0.0, 0.0, z), (0.32, 0.96, 0.035)) for z in (0.06, 0.43, 0.80, 1.17, 1.48)),
            box(toned(p, 0.6), (-0.15, 0.0, 0.75), (0.02, 0.96, 1.48)),
            ball(RED_PAINT, (0.0, 0.25, 0.90), (0.16, 0.16, 0.16)),
            *(box(Material(h), (0.0, -0.35 + 0.06 * i, 0.56), (0.2, 0.05, 0.24)) for i,
                h in enumerate(_CLOTHS)), box(YELLOW_PAINT, (0.0, -0.2, 1.25), (0.2, 0.24, 0.13)),
                post(PALE, (0.0, 0.2, 0.55), (0.14, 0.14, 0.22))],
                ("shelves", "wall shelf"), plurals=("shelves",)),
    thing("armchair", _CLOTHS,
        lambda p: [box(p, (0.0, 0.0, 0.22), (0.80, 0.86, 0.28)),
            box(p, (-0.34, 0.0, 0.60), (0.20, 0.86, 0.60)),
            *(box(p, (0.03, y, 0.42), (0.80, 0.18, 0.36)) for y in (0.40, -0.40)),
            *(rod(p, (-0.36, y, 0.60), (0.43, y, 0.60), 0.09) for y in (0.40, -0.40)),
            box(toned(p, 1.35), (0.06, 0.0, 0.42), (0.64, 0.60, 0.14)),
            *_legs(Material(DARK_WOOD), 0.34, 0.36, 0.09, 0.07)],
            ("easy chair", "recliner", "lounge chair")),
    thing("office chair", (INK.colour, (0.05, 0.12, 0.32)),
        lambda p: [*(rod(IRON, (0.0, 0.0, 0.12), (0.32 * math.cos(a), 0.32 * math.sin(a), 0.07),
            0.022) for a in (0.0, 1.257, 2.513, 3.770, 5.027)),
            *(ball(INK, (0.32 * math.cos(a), 0.32 * math.sin(a), 0.035), (0.07, 0.07, 0.07))
                for a in (0.0, 1.257, 2.513, 3.770, 5.027)),
                rod(SILVER, (0.0, 0.0, 0.10), (0.0, 0.0, 0.45), 0.03),
                box(p, (0.02, 0.0, 0.49), (0.48, 0.50, 0.09)),
                box(p, (-0.24, 0.0, 0.85), (0.08, 0.44, 0.55)),
                rod(IRON, (-0.20, 0.0, 0.48), (-0.26, 0.0, 0.70), 0.02),
                *(part for y in (0.29, -0.29)
                    for part in chain(IRON, [(-0.05, y, 0.48), (-0.05, y, 0.68), (0.18, y, 0.68)],
                        0.02))], ("desk chair", "swivel chair")),
    thing("stool", _WOODS,
        lambda p: [post(p, (0.0, 0.0, 0.62), (0.34, 0.34, 0.05)),
            *(rod(p, (0.10 * a, 0.10 * b, 0.60), (0.19 * a, 0.19 * b, 0.0), 0.02) for a in (1, -1)
                for b in (1, -1)), *ring(toned(p, 0.8), (0.0, 0.0, 0.22), (0.18, 0.18), 0.014,
                axis="z", pieces=10)], ("bar stool",)),
    thing("rocking chair", _WOODS, nothing,
        moving=(Moving(lambda p: [box(p, (0.0, 0.0, 0.45), (0.46, 0.48, 0.04)),
            *(bar(p, (y, 0.46), (y, 1.05), 0.035, 0.03, -0.24)
                for y in (-0.2, -0.1, 0.0, 0.1, 0.2)),
                bar(p, (-0.23, 1.08), (0.23, 1.08), 0.10, 0.03, -0.24),
                *(part for y in (0.24, -0.24)
                    for part in (*ring(p, (0.0, y, 0.98), (0.62, 0.94), 0.022, axis="y",
                        span=(235.0, 305.0), pieces=6),
                        rod(p, (0.20, y, 0.08), (0.20, y, 0.66), 0.02),
                        rod(p, (-0.22, y, 0.08), (-0.24, y, 1.05), 0.02),
                        rod(p, (0.24, y, 0.66), (-0.24, y, 0.66), 0.022)))],
                        swinging("y", 0.13, 0.5, (0.0, 0.0, 0.9))),), same=("rocker",)),
    thing("wardrobe", _WOODS,
        lambda p: [box(p, (0.0, 0.0, 1.0), (0.60, 1.20, 1.96)),
            *(box(toned(p, 1.2), (0.305, 0.295 * s, 1.02), (0.02, 0.56, 1.80))
                for s in (1.0, -1.0)),
                *(box(BRASS, (0.33, 0.05 * s, 1.0), (0.03, 0.02, 0.16)) for s in (1.0, -1.0)),
                box(toned(p, 0.7), (0.0, 0.0, 1.99), (0.66, 1.28, 0.05))],
                ("closet", "armoire")),
    thing("chest of drawers", _WOODS,
        lambda p: [box(p, (0.0, 0.0, 0.46), (0.45, 0.90, 0.84)),
            box(toned(p, 0.8), (0.0, 0.0, 0.89), (0.50, 0.96, 0.04)),
            *_drawers(p, 0.0, 0.82, (0.16, 0.36, 0.56, 0.76), 0.17, 0.23),
            *_legs(toned(p, 0.7), 0.18, 0.40, 0.06, 0.06)],
            ("dresser",),
            plurals=("chests of drawers",)),
    thing("chest", _WOODS,
        lambda p: [box(p, (0.0, 0.0, 0.17), (0.42, 0.70, 0.34)),
            rod(p, (0.0, -0.35, 0.34), (0.0, 0.35, 0.34), 0.21),
            *(box(IRON, (0.0, y, 0.17), (0.43, 0.04, 0.345)) for y in (0.25, -0.25)),
            *(rod(IRON, (0.0, y - 0.02, 0.34), (0.0, y + 0.02, 0.34), 0.215)
                for y in (0.25, -0.25)), box(BRASS, (0.215, 0.0, 0.32), (0.02, 0.08, 0.10))],
                ("treasure chest",)),
    thing("crib", _WOODS[2:],
        lambda p: [*_legs(p, 0.33, 0.60, 0.95, 0.05),
            *(bar(p, (-0.6, z), (0.6, z), 0.05, 0.03, x) for x in (0.33, -0.33)
                for z in (0.35, 0.90)),
                *(bar(p, (-0.5 + 0.125 * i, 0.35), (-0.5 + 0.125 * i, 0.90), 0.02, 0.02, x)
                    for i in range(9) for x in (0.33, -0.33)),
                    *(box(p, (0.0, y, 0.62), (0.66, 0.03, 0.60)) for y in (0.60, -0.60)),
                    box(PALE, (0.0, 0.0, 0.42), (0.62, 1.16, 0.12)),
                    box(Material((0.35, 0.50, 0.65)), (0.0, 0.18, 0.49), (0.60, 0.76, 0.04))],
                    ("baby bed", "cot")),
    thing("pillow", (PALE.colour, *_CLOTHS),
        lambda p: [ball(p, (0.0, 0.0, 0.085), (0.42, 0.62, 0.17)),
            box(p, (0.0, 0.0, 0.07), (0.34, 0.52, 0.07)),
            *(limb(p, (0.06 * a, 0.11 * b, 0.075), (0.165 * a, 0.255 * b, 0.07), 0.055)
                for a in (1, -1) for b in (1, -1)),
            *(rod(toned(p, 0.7), (0.19 * a, -0.27, 0.065), (0.19 * a, 0.27, 0.065), 0.007)
                for a in (1, -1)),
            *(rod(toned(p, 0.7), (-0.18, 0.28 * b, 0.065), (0.18, 0.28 * b, 0.065), 0.007)
                for b in (1, -1))],
            ("cushion",)),
    thing("rug", ((0.42, 0.06, 0.05), (0.05, 0.14, 0.34)),
        lambda p: [box(p, (0.0, 0.0, 0.008), (1.20, 1.80, 0.016)),
            *(box(h, (0.0, 0.0, 0.0085 + 0.0015 * i), (1.20 - d, 1.80 - d, 0.016)) for i,
                (h, d) in enumerate(((Material((0.60, 0.48, 0.26)), 0.16), (p, 0.26),
                    (Material((0.10, 0.10, 0.20)), 0.60), (Material((0.60, 0.48, 0.26)), 0.80),
                    (p, 0.90)))), *(box(PALE, (-0.55 + 0.1 * i, 0.94 * s, 0.006),
                    (0.02, 0.08, 0.008)) for i in range(12) for s in (1.0, -1.0))],
                    ("carpet",)),
    thing("curtain", _CLOTHS,
        lambda p: [rod(BRASS, (0.0, -1.0, 2.22), (0.0, 1.0, 2.22), 0.03),
            *(ball(BRASS, (0.0, s, 2.22), (0.09, 0.09, 0.09)) for s in (1.0, -1.0)),
            *_folds(p, 0.75, 0.48, 7), *_folds(p, -0.75, 0.48, 7)],
            ("drape",)),
    thing("mirror", (*_WOODS, BRASS.colour),
        lambda p: [box(Material((0.50, 0.57, 0.62)), (0.0, 0.0, 0.85), (0.03, 0.56, 1.46)),
            *rectangle(p, (0.0, 0.85), (0.68, 1.58), 0.07, 0.06),
            plank(PALE, (0.004, -0.12, 0.75), (0.004, 0.20, 1.35), chord=(0.0, 0.05, -0.03),
                thickness=(0.028, 0.0, 0.0)),
                *(bar(p, (0.3 * s, 0.0), (0.3 * s, 0.2), 0.06, 0.30) for s in (1.0, -1.0))],
                ("looking glass", "wall mirror")),
    thing("door", _WOODS, lambda p: [*rectangle(toned(p, 0.6), (0.0, 1.06), (1.02, 2.12), 0.07,
        0.16)], ("wooden door", "front door"),
        moving=(Moving(lambda p: [box(p, (0.0, 0.0, 1.04), (0.05, 0.86, 2.0)),
            *(box(toned(p, 1.3), (0.02, 0.20 * s, z), (0.03, 0.28, h)) for s in (1.0, -1.0) for z,
                h in ((1.50, 0.75), (0.55, 0.75))),
                ball(BRASS, (0.06, -0.36, 1.02), (0.06, 0.06, 0.06)),
                ball(BRASS, (-0.06, -0.36, 1.02), (0.06, 0.06, 0.06))],
                swinging("z", 0.5, 0.12, (0.0, 0.43, 0.0))),)),
    thing("window", (PALE.colour, *_WOODS),
        lambda p: [box(_PANE, (0.0, 0.0, 1.30), (0.02, 1.10, 1.20)),
            *rectangle(p, (0.0, 1.30), (1.24, 1.34), 0.08, 0.10),
            bar(p, (0.0, 0.70), (0.0, 1.90), 0.06, 0.06),
            bar(p, (-0.56, 1.30), (0.56, 1.30), 0.05, 0.06),
            box(p, (0.05, 0.0, 0.62), (0.20, 1.40, 0.05)),
            *(limb(cloth((0.55, 0.50, 0.42)), (0.03, 0.68 * s, 2.02), (0.03, 0.74 * s, 0.08), 0.07)
                for s in (1.0, -1.0)),
            rod(p, (0.03, -0.85, 2.04), (0.03, 0.85, 2.04), 0.018)],
            ("window frame", "glass window", "windowpane")),
    thing("blind", (PALE.colour,),
        lambda p: [*(plank(toned(p, 0.85 + 0.15 * (i % 2)), (0.0, -0.6, 0.2 + 0.09 * i),
            (0.0, 0.6, 0.2 + 0.09 * i), chord=(0.06, 0.0, 0.035), thickness=(0.0, 0.0, 0.006))
            for i in range(16)), box(p, (0.0, 0.0, 1.66), (0.06, 1.22, 0.06)),
            *(rod(GREY_PLASTIC, (0.0, y, 0.2), (0.0, y, 1.65), 0.004) for y in (0.4, -0.4)),
            *(bar(toned(p, 0.6), (0.62 * s, 0.0), (0.62 * s, 1.68), 0.03, 0.05)
                for s in (1.0, -1.0))],
                ("venetian blind", "window blind")),
    thing("potted plant", ((0.45, 0.16, 0.07), CHINA), _potted,
        ("houseplant", "house plant", "pot plant", "flowerpot", "flower pot", "indoor plant")),
    thing("bouquet", ((0.55, 0.03, 0.04), (0.75, 0.45, 0.03)),
        lambda p: [*lathe(Material((0.35, 0.48, 0.55)), [(0.0, 0.05), (0.20, 0.075)], 4),
            *(rod(LEAF, (0.0, 0.0, 0.15),
                (0.13 * math.cos(2.4 * k), 0.13 * math.sin(2.4 * k), 0.34 + 0.02 * (k % 3)),
                0.005) for k in range(7)),
                *(ball(p if k % 2 else PALE,
                    (0.14 * math.cos(2.4 * k), 0.14 * math.sin(2.4 * k), 0.36 + 0.02 * (k % 3)),
                    (0.085, 0.085, 0.07)) for k in range(7)),
                    ball(p, (0.0, 0.0, 0.42), (0.09, 0.09, 0.08)),
                    *(ball(YELLOW_PAINT, (0.15 * math.cos(2.4 * k), 0.15 * math.sin(2.4 * k),
                        0.39 + 0.02 * (k % 3)), (0.03, 0.03, 0.03)) for k in range(7))],
                        ("flower arrangement", "nosegay")),
    thing("fireplace", (BRICK.colour,),
        lambda p: [*(box(mottled(p.colour, contrast=0.3, scale=6.0), (0.0, 0.55 * s, 0.5),
            (0.40, 0.30, 1.0)) for s in (1.0, -1.0)),
            box(mottled(p.colour, contrast=0.3, scale=6.0), (0.0, 0.0, 0.98), (0.40, 1.40, 0.26)),
            box(Material(DARK_WOOD), (0.05, 0.0, 1.14), (0.55, 1.60, 0.08)),
            box(INK, (-0.15, 0.0, 0.45), (0.06, 0.85, 0.90)),
            *(rod(Material(DARK_WOOD), (0.0, -0.25, z), (0.0, 0.25, z + 0.04), 0.05)
                for z in (0.06, 0.14)), box(STONE, (0.10, 0.0, 0.015), (0.70, 1.50, 0.03)),
                box(mottled(p.colour, contrast=0.3, scale=6.0), (-0.05, 0.0, 1.60),
                    (0.28, 0.9, 0.9))], ("hearth",),
                    moving=(Moving(lambda p: [*(limb(glowing((1.0, 0.45, 0.08), 2.5),
                        (0.0, y, 0.18), (0.0, 1.1 * y, h), 0.07) for y,
                        h in ((-0.14, 0.42), (0.02, 0.55), (0.16, 0.40))),
                        *(limb(glowing((1.0, 0.82, 0.35), 3.5), (0.02, y, 0.18),
                            (0.02, 1.1 * y, 0.7 * h), 0.04) for y,
                            h in ((-0.14, 0.42), (0.02, 0.55), (0.16, 0.40)))],
                            swinging("x", 0.10, 2.2, (0.0, 0.0, 0.1))),)),
    thing("stairs", (*_WOODS, STONE.colour),
        lambda p: [*(box(toned(p, 0.85 + 0.15 * (i % 2)), (0.9 - 0.28 * i, 0.0, 0.09 * (i + 1)),
            (0.28, 1.2, 0.18 * (i + 1))) for i in range(8)),
            *(rod(IRON, (0.9 - 0.28 * i, 0.56, 0.18 * i), (0.9 - 0.28 * i, 0.56, 0.18 * i + 1.1),
                0.02) for i in (0, 2, 4, 6)),
                rod(IRON, (1.0, 0.56, 1.03), (-1.1, 0.56, 2.38), 0.03)],
                ("staircase", "stairway", "stair", "flight of stairs"),
                plurals=("stairs",)),
    thing("bunk bed", _WOODS,
        lambda p: [*(box(p, (x, y, 0.85), (0.08, 0.08, 1.70)) for x in (0.98, -0.98)
            for y in (0.45, -0.45)),
            *(part for z in (0.40, 1.30)
                for part in (box(p, (0.0, 0.0, z), (1.96, 0.92, 0.10)),
                    box(PALE, (0.0, 0.0, z + 0.10), (1.90, 0.86, 0.12)),
                    box(Material(_CLOTHS[0]), (0.22, 0.0, z + 0.13), (1.40, 0.90, 0.10)),
                    ball(PALE, (-0.75, 0.0, z + 0.19), (0.36, 0.60, 0.14)))),
                    *(bar(p, (0.20 + 0.25 * k, 0.0), (0.20 + 0.25 * k, 1.5), 0.04, 0.04, 1.02)
                        for k in (0, 1)), *(bar(p, (0.20, 0.3 * k), (0.45, 0.3 * k), 0.04, 0.03,
                            1.02) for k in (1, 2, 3, 4))]),
    thing("aquarium", ((0.10, 0.38, 0.48),),
        lambda p: [box(p, (0.0, 0.0, 0.28), (0.36, 0.76, 0.42)),
            *(box(INK, (0.0, 0.0, z), (0.40, 0.80, 0.05)) for z in (0.045, 0.515)),
            box(Material((0.50, 0.40, 0.22)), (0.0, 0.0, 0.10), (0.37, 0.77, 0.08)),
            *(ball(Material((0.80, 0.22, 0.02)), (0.185, y, z), (0.02, 0.10, 0.05)) for y,
                z in ((-0.18, 0.36), (0.15, 0.26), (0.26, 0.42))),
                *(blade(Material((0.80, 0.22, 0.02)), (0.187, y, z), (0.187, y + 0.05, z),
                    chord=(0.0, 0.0, 0.05), thickness=(0.012, 0.0, 0.0)) for y,
                    z in ((-0.14, 0.36), (0.19, 0.26), (0.30, 0.42))),
                    *(blade(LEAF, (0.184, y, 0.12), (0.184, y + 0.02, h), chord=(0.0, 0.03, 0.0),
                        thickness=(0.012, 0.0, 0.0)) for y,
                        h in ((-0.28, 0.38), (-0.24, 0.30), (0.02, 0.34)))],
                        ("fish tank",)),
    thing("cage", (SILVERY, BRASS.colour),
        lambda p: [post(GREY_PLASTIC, (0.0, 0.0, 0.03), (0.44, 0.44, 0.06)),
            *(rod(p, (0.20 * math.cos(a), 0.20 * math.sin(a), 0.06),
                (0.20 * math.cos(a), 0.20 * math.sin(a), 0.46), 0.006)
                for a in (0.449 * i for i in range(14))),
                *(rod(p, (0.20 * math.cos(a), 0.20 * math.sin(a), 0.46), (0.0, 0.0, 0.62), 0.006)
                    for a in (0.898 * i for i in range(7))),
                    *ring(p, (0.0, 0.0, 0.66), (0.04, 0.04), 0.007, pieces=8),
                    rod(Material(PALE_WOOD), (0.0, -0.19, 0.25), (0.0, 0.19, 0.25), 0.008),
                    ball(YELLOW_PAINT, (0.0, 0.02, 0.30), (0.06, 0.06, 0.09)),
                    ball(YELLOW_PAINT, (0.02, 0.02, 0.355), (0.05, 0.05, 0.05))],
                    ("birdcage", "bird cage")),
))  # fmt: skip
"""Nouns of furniture and rooms."""

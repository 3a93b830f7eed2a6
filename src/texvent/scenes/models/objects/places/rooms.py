"""What rooms are known by: benches with glassware, school desks, stalls, seats, machines."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import CHROME, RED, STEEL, WHITE, Material, glowing, striped
from texvent.scenes.models.objects.figures import bar, disc, lathe, rectangle, ring, thing
from texvent.scenes.models.objects.palette import (
    BRASS,
    BULB,
    DARK_WOOD,
    GREY_PLASTIC,
    INK,
    IRON,
    PALE,
    PALE_WOOD,
    RED_PAINT,
    SCREEN,
    SILVER,
    SILVERY,
    WOOD_BROWN,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Point,
    ball,
    box,
    limb,
    moved,
    peak,
    post,
    rod,
    shift,
)

_LIQUIDS = (Material((0.05, 0.25, 0.75)), Material((0.10, 0.55, 0.15)), Material((0.75, 0.35,
    0.03)),
            Material((0.55, 0.04, 0.30)))  # fmt: skip
_CLEAR = Material((0.62, 0.72, 0.74))
_GOODS = (RED_PAINT, Material((0.75, 0.45, 0.02)), Material((0.05, 0.30, 0.08)),
          Material((0.03, 0.12, 0.45)), PALE)  # fmt: skip
_RED_CLOTH = Material((0.42, 0.02, 0.03))


def flask(at: Point, size: float, liquid: Material) -> list[ModelPart]:
    """An Erlenmeyer flask with a coloured liquid."""
    x, y, z = at
    return [
        peak(liquid, (x, y, z + 0.45 * size), (0.9 * size, 0.9 * size, 0.9 * size)),
        post(_CLEAR, (x, y, z + 0.9 * size), (0.24 * size, 0.24 * size, 0.5 * size)),
        post(_CLEAR, (x, y, z + 1.15 * size), (0.32 * size, 0.32 * size, 0.05 * size)),
    ]


def tube_rack(
    at: Point, wide: float, count: int = 6, first: Material = _LIQUIDS[0]
) -> list[ModelPart]:
    """Test tubes in a row, in a wooden rack."""
    x, y, z = at
    wood = Material(PALE_WOOD)
    parts = [
        box(wood, (x, y, z + 0.10 * wide), (0.22 * wide, wide, 0.04 * wide)),
        box(wood, (x, y, z + 0.02 * wide), (0.22 * wide, wide, 0.04 * wide)),
        *(box(wood, (x, y + s * 0.48 * wide, z + 0.06 * wide), (0.2 * wide, 0.03 * wide,
            0.12 * wide))
          for s in (1.0, -1.0)),
    ]  # fmt: skip
    for k in range(count):
        tube_y = y + wide * (0.84 * (k + 0.5) / count - 0.42)
        parts.append(post(_LIQUIDS[k % 4] if k else first, (x, tube_y, z + 0.12 * wide), (
            0.09 * wide, 0.09 * wide, 0.18 * wide)))  # fmt: skip
        parts.append(
            post(_CLEAR, (x, tube_y, z + 0.26 * wide), (0.1 * wide, 0.1 * wide, 0.12 * wide))
        )
    return parts


def _microscope(x: float, y: float, z: float) -> list[ModelPart]:
    return [
        box(INK, (x, y, z + 0.02), (0.20, 0.16, 0.04)),
        limb(PALE, (x - 0.07, y, z + 0.04), (x - 0.04, y, z + 0.34), 0.03),
        rod(INK, (x - 0.02, y, z + 0.40), (x + 0.06, y, z + 0.16), 0.03),
        box(INK, (x + 0.05, y, z + 0.12), (0.14, 0.13, 0.02)),
    ]


def _legs(skin: Material, size: Point, thick: float) -> list[ModelPart]:
    long, wide, tall = size
    return [
        box(skin, (sx * 0.46 * long, sy * 0.46 * wide, 0.5 * tall), (thick, thick, tall))
        for sx in (1.0, -1.0) for sy in (1.0, -1.0)
    ]  # fmt: skip


def _shelves(p: Material, wide: float, tall: float, goods: int) -> list[ModelPart]:
    """A shelf of goods of many colours."""
    parts = [box(p, (-0.18, 0.0, 0.5 * tall), (0.06, wide, tall))]
    for level in range(4):
        z = 0.1 + level * (tall - 0.2) / 4
        parts.append(box(p, (0.0, 0.0, z), (0.42, wide, 0.04)))
        for k in range(goods):
            y = wide * ((k + 0.5) / goods - 0.5)
            high = 0.26 + 0.06 * ((k * 7 + level * 3) % 3)
            parts.append(box(_GOODS[(k * 3 + level * 2) % 5], (0.02, y, z + 0.02 + 0.5 * high), (
                0.30, 0.82 * wide / goods, high)))  # fmt: skip
    return parts


NOUNS = (
    thing("lab bench", ((0.72, 0.72, 0.70),), lambda p: [
        box(p, (0.0, 0.0, 0.42), (0.62, 1.8, 0.84)), box(INK, (0.0, 0.0, 0.86), (0.70, 1.9, 0.05)),
        *(box(GREY_PLASTIC, (0.315, y, 0.5), (0.02, 0.40, 0.5)) for y in (-0.6, 0.0, 0.6)),
        *flask((0.05, -0.72, 0.885), 0.26, _LIQUIDS[0]), *flask((0.1, -0.42, 0.885), 0.20,
            _LIQUIDS[1]),
        *tube_rack((0.10, 0.0, 0.885), 0.46, 5), *_microscope(0.0, 0.62, 0.885),
    ], ("laboratory bench", "lab table")),
    thing("flask", ((0.05, 0.25, 0.75),), lambda p: flask((0.0, 0.0, 0.0), 0.16, p),
          ("erlenmeyer flask", "conical flask", "chemical flask")),
    thing("beaker", ((0.05, 0.40, 0.65),), lambda p: [
        post(p, (0.0, 0.0, 0.05), (0.10, 0.10, 0.10)), post(_CLEAR, (0.0, 0.0, 0.125),
                                                             (0.104, 0.104, 0.05)),
        *(box(INK, (0.05, 0.0, z), (0.004, 0.03, 0.003)) for z in (0.04, 0.07, 0.10))],
        ("glass beaker",)),
    thing("test tube", ((0.10, 0.45, 0.15),), lambda p: tube_rack((0.0, 0.0, 0.0), 0.24, 6, p),
          ("test tube rack",)),
    thing("petri dish", ((0.55, 0.20, 0.15),), lambda p: [
        post(_CLEAR, (0.0, 0.0, 0.008), (0.10, 0.10, 0.016)), post(p, (0.0, 0.0, 0.016),
                                                                   (0.09, 0.09, 0.004)),
        *(ball(PALE, (0.03 * math.cos(2.4 * k), 0.03 * math.sin(2.4 * k), 0.018),
               (0.012, 0.012, 0.006)) for k in range(7))], plurals=("petri dishes",)),
    thing("centrifuge", ((0.70, 0.70, 0.70),), lambda p: [
        box(p, (0.0, 0.0, 0.13), (0.46, 0.42, 0.26)), post(INK, (0.0, 0.0, 0.262), (0.34, 0.34,
            0.02)),
        *(rod(_LIQUIDS[k % 4], (0.06 * math.cos(k), 0.06 * math.sin(k), 0.275),
              (0.14 * math.cos(k), 0.14 * math.sin(k), 0.30), 0.018) for k in range(6)),
        box(SCREEN, (0.235, 0.08, 0.14), (0.01, 0.14, 0.07)),
        ball(RED_PAINT, (0.235, -0.10, 0.14), (0.02, 0.05, 0.05))]),
    thing("school desk", (PALE_WOOD,), lambda p: [
        box(p, (0.25, 0.0, 0.70), (0.48, 0.70, 0.04)), *moved(_legs(IRON, (0.46, 0.66, 0.68), 0.03),
                                                               shift(0.25)),
        box(p, (-0.32, 0.0, 0.42), (0.36, 0.40, 0.03)), box(p, (-0.49, 0.0, 0.68), (0.03, 0.40,
            0.24)),
        *moved(_legs(IRON, (0.34, 0.38, 0.42), 0.025), shift(-0.32)),
        box(PALE, (0.25, 0.08, 0.725), (0.20, 0.26, 0.015))], ("classroom desk",)),
    thing("wall blackboard", ((0.02, 0.09, 0.05),), lambda p: [
        box(p, (0.0, 0.0, 1.65), (0.05, 3.0, 1.2)), *rectangle(Material(PALE_WOOD), (0.0, 1.65),
                                                               (3.1, 1.3), 0.07, 0.08),
        *(box(PALE, (0.03, y, z), (0.004, w, 0.03)) for y, z, w in (
            (-0.9, 2.0, 0.9), (-0.8, 1.8, 0.7), (0.6, 2.0, 0.8), (0.7, 1.6, 0.5))),
        box(Material(PALE_WOOD), (0.06, 0.0, 1.02), (0.10, 3.0, 0.04))]),
    thing("large painting", (BRASS.colour,), lambda p: [
        *rectangle(p, (0.0, 1.6), (1.5, 1.1), 0.10, 0.09),
        box(Material((0.20, 0.36, 0.55)), (0.0, 0.0, 1.75), (0.04, 1.36, 0.70)),
        box(Material((0.14, 0.28, 0.06)), (0.005, 0.0, 1.28), (0.04, 1.36, 0.36)),
        ball(Material((0.8, 0.55, 0.1)), (0.0, 0.4, 1.85), (0.06, 0.2, 0.2)),
        box(Material((0.4, 0.12, 0.06)), (0.01, -0.3, 1.46), (0.04, 0.3, 0.3))],
            ("framed painting",)),
    thing("display case", (DARK_WOOD,), lambda p: [
        box(p, (0.0, 0.0, 0.45), (0.6, 0.6, 0.9)), box(_CLEAR, (0.0, 0.0, 1.30), (0.03, 0.03, 0.8)),
        *(box(STEEL, (x, y, 1.25), (0.025, 0.025, 0.7)) for x in (0.28, -0.28) for y in (0.28,
            -0.28)),
        box(STEEL, (0.0, 0.0, 1.61), (0.6, 0.6, 0.03)),
        *lathe(Material((0.55, 0.24, 0.08)), [(0.9, 0.06), (1.1, 0.16), (1.25, 0.06), (1.32,
            0.10)], 6),
    ], ("showcase", "museum case")),
    thing("church pew", (WOOD_BROWN,), lambda p: [
        box(p, (0.0, 0.0, 0.45), (0.42, 2.4, 0.05)), box(p, (-0.20, 0.0, 0.75), (0.05, 2.4, 0.62)),
        *(box(p, (0.0, y, 0.45), (0.46, 0.06, 0.9)) for y in (1.2, -1.2))], ("pew",)),
    thing("altar", ((0.62, 0.60, 0.55),), lambda p: [
        box(p, (0.0, 0.0, 0.5), (0.8, 1.8, 1.0)), box(PALE, (0.0, 0.0, 0.98), (0.86, 1.5, 0.08)),
        box(BRASS, (0.0, 0.0, 1.55), (0.06, 0.08, 1.0)), box(BRASS, (0.0, 0.0, 1.72), (0.06,
            0.55, 0.08)),
        *(post(PALE, (0.1, y, 1.2), (0.05, 0.05, 0.36)) for y in (0.6, -0.6)),
        *(ball(BULB, (0.1, y, 1.42), (0.04, 0.04, 0.08)) for y in (0.6, -0.6))]),
    thing("stained glass", ((0.30, 0.30, 0.30),), lambda p: [
        box(p, (0.0, 0.0, 2.1), (0.08, 1.1, 2.2)), disc(p, (0.0, 3.2), 0.55, 0.08),
        *(box(glowing(c, 0.7), (0.03, -0.30 + 0.3 * (k % 3), 1.25 + 0.42 * (k // 3)), (0.05,
            0.26, 0.38))
          for k, c in enumerate(((0.7, 0.05, 0.04), (0.05, 0.15, 0.7), (0.75, 0.55, 0.05)) * 4)),
        disc(glowing((0.70, 0.05, 0.05), 0.7), (0.0, 3.25), 0.36, 0.12)], ("stained glass window",
                                                                         "church window")),
    thing("stage curtain", ((0.45, 0.02, 0.03),), lambda p: [
        *(rod(p, (0.0, -1.1 + 0.22 * k, 0.0), (0.0, -1.1 + 0.22 * k, 3.0),
            0.13) for k in range(11)),
        box(BRASS, (0.0, 0.0, 2.95), (0.30, 2.5, 0.20))], ("theatre curtain", "theater curtain")),
    thing("operating table", ((0.10, 0.36, 0.32),), lambda p: [
        box(CHROME, (0.0, 0.0, 0.40), (0.36, 0.36, 0.80)), box(CHROME, (0.0, 0.0, 0.05), (0.6,
            1.2, 0.1)),
        box(p, (0.0, 0.0, 0.88), (0.62, 1.9, 0.14)), box(PALE, (0.0, -0.75, 0.98), (0.4, 0.3,
            0.10))]),
    thing("operating lamp", ((0.75, 0.76, 0.76),), lambda p: [
        post(p, (-0.5, 0.0, 0.03), (0.6, 0.6, 0.06)), rod(p, (-0.5, 0.0, 0.0), (-0.5, 0.0, 2.2),
            0.04),
        limb(p, (-0.5, 0.0, 2.2), (0.0, 0.0, 2.05), 0.05), post(p, (0.0, 0.0, 1.92), (0.9, 0.9,
            0.14)),
        *(post(glowing((1.0, 1.0, 0.95), 3.0), (0.28 * math.cos(a), 0.28 * math.sin(a), 1.845),
               (0.2, 0.2, 0.02)) for a in (0.0, 1.57, 3.14, 4.71))], ("surgical lamp",)),
    thing("medical monitor", ((0.70, 0.72, 0.72),), lambda p: [
        post(GREY_PLASTIC, (0.0, 0.0, 0.04), (0.5, 0.5, 0.06)), rod(p, (0.0, 0.0, 0.0), (0.0,
            0.0, 1.2),
                                                                     0.03),
        box(p, (0.0, 0.0, 1.40), (0.16, 0.60, 0.46)), box(INK, (0.082, 0.0, 1.40), (0.01, 0.52,
            0.38)),
        *(bar(glowing((0.1, 0.9, 0.2), 1.5), (a, 1.40 + b), (c, 1.40 + d), 0.015, 0.01, 0.09)
          for a, b, c, d in ((-0.25, 0, -0.1, 0), (-0.1, 0, -0.05, 0.14), (-0.05, 0.14, 0.0, -0.1),
                             (0.0, -0.1, 0.04, 0.0), (0.04, 0.0, 0.25, 0.0)))], ("heart monitor",)),
    thing("subway train", ((0.62, 0.63, 0.65),), lambda p: [
        box(p, (0.0, 0.0, 1.75), (2.4, 6.2, 2.7)), box(GREY_PLASTIC, (0.0, 0.0, 0.3), (2.0, 6.0,
            0.6)),
        box(RED_PAINT, (1.205, 0.0, 1.15), (0.01, 6.2, 0.16)),
        *(box(Material((0.70, 0.72, 0.60), emission=0.5), (1.205, y, 2.1), (0.02, 0.75, 0.8))
          for y in (-2.5, -0.45, 0.45, 2.5)),
        *(box(Material((0.75, 0.45, 0.02)), (1.21, y, 1.6), (0.02, 0.95, 2.1)) for y in (-2.2,
            2.2)),
        *(box(INK, (1.222, y, 1.6), (0.02, 0.03, 2.1)) for y in (-1.5, 1.5))],
        ("subway car", "metro train", "underground train", "metro", "subway")),
    thing("platform edge", ((0.42, 0.42, 0.41),), lambda p: [
        box(p, (0.0, 0.0, 0.008), (3.0, 12.0, 0.016)),
        box(Material((0.80, 0.60, 0.04)), (1.1, 0.0, 0.012), (0.30, 12.0, 0.02))]),
    thing("train seat", ((0.05, 0.14, 0.40),), lambda p: [
        *(box(p, (x, y, 0.45), (0.45, 0.46, 0.14)) for x in (0.5, -0.5) for y in (0.26, -0.26)),
        *(box(p, (1.35 * x, y, 0.85), (0.12, 0.46, 0.75)) for x in (0.55, -0.55) for y in (0.26,
            -0.26)),
        *(box(PALE, (1.36 * x, y, 1.20), (0.14, 0.30, 0.14)) for x in (0.55,
            -0.55) for y in (.26, -.26)),
        *(box(GREY_PLASTIC, (x, 0.0, 0.2), (0.4, 0.9, 0.38)) for x in (0.5, -0.5))],
            ("train seats",)),
    thing("train window", ((0.55, 0.56, 0.58),), lambda p: [
        *rectangle(p, (0.0, 1.45), (2.2, 1.0), 0.10, 0.10),
        box(glowing((0.30, 0.50, 0.75), 0.8), (0.0, 0.0, 1.62), (0.04, 2.05, 0.60)),
        box(glowing((0.10, 0.26, 0.05), 0.8), (0.005, 0.0, 1.16), (0.04, 2.05, 0.34)),
        *(rod(SILVER, (0.2, y, 2.05), (0.2, y, 2.25), 0.02) for y in (0.8, -0.8)),
        rod(SILVER, (0.2, -1.1, 2.05), (0.2, 1.1, 2.05), 0.03)]),
    thing("grocery shelf", ((0.70, 0.70, 0.68),), lambda p: _shelves(p, 2.4, 1.9, 7),
          ("supermarket shelf", "shop shelf"), plurals=("grocery shelves",)),
    thing("restaurant table", (DARK_WOOD,), lambda p: [
        post(PALE, (0.0, 0.0, 0.70), (0.98, 0.98, 0.12)), post(p, (0.0, 0.0, 0.37), (0.10, 0.10,
            0.74)),
        post(PALE, (0.0, 0.0, 0.76), (0.95, 0.95, 0.02)),
        *(post(SILVER, (0.26 * s, 0.0, 0.78), (0.24, 0.24, 0.02)) for s in (1.0, -1.0)),
        *(post(Material((0.35, 0.02, 0.05)), (0.1, 0.3 * s, 0.87), (0.07, 0.07,
            0.12)) for s in (1, -1)),
        post(BRASS, (0.0, 0.0, 0.84), (0.04, 0.04, 0.16)), ball(BULB, (0.0, 0.0, 0.95), (0.03,
            0.03, 0.05)),
        *(part for s in (1.0, -1.0) for part in (
            box(p, (0.72 * s, 0.0, 0.44), (0.40, 0.42, 0.05)), box(p, (0.92 * s, 0.0, 0.72),
                (0.05, 0.42, 0.55)),
            box(p, (0.72 * s, 0.0, 0.22), (0.32, 0.34, 0.42))))], ("dinner table", "cafe table")),
    thing("bar counter", (WOOD_BROWN,), lambda p: [
        box(p, (0.5, 0.0, 0.52), (0.5, 3.0, 1.04)), box(INK, (0.5, 0.0, 1.07), (0.66, 3.2, 0.06)),
        box(p, (-0.4, 0.0, 1.4), (0.10, 3.0, 1.4)), *(box(p, (-0.3, 0.0, z), (0.26, 3.0, 0.04))
                                                      for z in (1.25, 1.7)),
        *(part for k in range(9) for z in (1.27, 1.72) for part in (
            post(_GOODS[(k + int(z * 3)) % 4], (-0.28, -1.3 + 0.32 * k, z + 0.13), (0.09, 0.09,
                0.26)),))],
        ("saloon bar",)),
    thing("factory machine", ((0.10, 0.30, 0.32),), lambda p: [
        box(p, (0.0, 0.0, 0.9), (1.2, 2.2, 1.8)), box(GREY_PLASTIC, (0.61, -0.4, 1.1), (0.02,
            0.9, 0.8)),
        box(SCREEN, (0.62, 0.6, 1.35), (0.02, 0.36, 0.26)), post(IRON, (0.0, 0.7, 2.1), (0.4,
            0.4, 0.7)),
        rod(IRON, (0.5, -1.1, 0.4), (0.5, -1.7, 0.4), 0.18), *(
            ball(c, (0.62, 0.45 + 0.14 * k, 1.05), (0.05, 0.08, 0.08)) for k, c in enumerate(
                (RED_PAINT, Material((0.05, 0.5, 0.1)), Material((0.75, 0.5, 0.02))))),
        box(striped(RED, WHITE, 4.0), (0.61, 0.0, 0.16), (0.03, 2.2, 0.2))],
            ("industrial machine",)),
    thing("tyre stack", ((0.03, 0.03, 0.03),), lambda p: [
        part for k in range(4) for part in ring(p, (0.0, 0.0, 0.12 + 0.22 * k), (0.26, 0.26), 0.11,
                                                axis="z", pieces=10)], ("tire stack",
                        )),
    thing("car lift", ((0.60, 0.05, 0.03),), lambda p: [
        *(box(p, (0.0, 1.5 * s, 1.4), (0.35, 0.3, 2.8)) for s in (1.0, -1.0)),
        *(box(p, (0.3 * d, 0.9 * s, 0.5), (1.0, 1.0, 0.10)) for s in (1.0, -1.0) for d in (1.0,)),
        box(p, (0.0, 0.0, 2.75), (0.3, 3.2, 0.2))]),
    thing("rink boards", ((0.80, 0.80, 0.79),), lambda p: [
        box(p, (0.0, 0.0, 0.6), (0.12, 3.4, 1.2)), box(Material((0.75, 0.55, 0.03)), (0.005, 0.0,
            0.12),
                                                        (0.13, 3.4, 0.24)),
        box(Material((0.03, 0.10, 0.45)), (0.0, 0.0, 1.22), (0.16, 3.4, 0.06)),
        box(RED_PAINT, (0.065, 0.8, 0.65), (0.01, 0.9, 0.4)), box(_CLEAR, (0.0, 0.0, 1.98),
                                                                  (0.03, 3.4, 0.04)),
        *(box(SILVER, (0.0, y, 1.6), (0.05, 0.05, 0.8)) for y in (-1.7, 0.0, 1.7))]),
    thing("car wash brush", ((0.03, 0.20, 0.65),), lambda p: [
        *(limb(p, (0.0, 0.0, z), (0.42 * math.cos(a), 0.42 * math.sin(a), z), 0.07)
          for z in (0.35, 0.8, 1.25, 1.7) for a in (0.0, 1.05, 2.09, 3.14, 4.19, 5.24)),
        post(p, (0.0, 0.0, 1.0), (0.55, 0.55, 1.8)), rod(STEEL, (0.0, 0.0, 0.0), (0.0, 0.0, 2.4),
            0.06)],
        ("car wash roller",)),
    thing("stalagmite", ((0.30, 0.25, 0.20),), lambda p: [
        peak(p, (0.0, 0.0, 0.7), (0.7, 0.7, 1.4)), peak(p, (0.3, 0.4, 0.4), (0.5, 0.5, 0.8)),
        peak(p, (-0.2, -0.4, 0.28), (0.4, 0.4, 0.56))], ()),
    thing("cell bars", (SILVERY,), lambda p: [
        *(rod(p, (0.0, -1.2 + 0.2 * k, 0.0), (0.0, -1.2 + 0.2 * k, 2.4),
            0.025) for k in range(13)),
        box(p, (0.0, 0.0, 2.4), (0.06, 2.5, 0.08)), box(p, (0.0, 0.0, 1.2), (0.06, 2.5,
            0.06))]),
    thing("disco lights", ((0.10, 0.10, 0.11),), lambda p: [
        rod(p, (0.0, -1.2, 2.4), (0.0, 1.2, 2.4), 0.05), *(rod(p, (0.0, 1.1 * s, 0.0), (0.0,
            1.1 * s, 2.4), .04)
                                                       for s in (1.0, -1.0)),
        *(ball(glowing(c, 3.0), (0.1, -0.9 + 0.45 * k, 2.25), (0.2, 0.2, 0.2)) for k,
            c in enumerate((
            (1.0, 0.1, 0.1), (0.1, 0.3, 1.0), (0.1, 1.0, 0.2), (1.0, 0.1, 0.9), (1.0, 0.8,
                0.1))))]),
    thing("hall mirror", (BRASS.colour,), lambda p: [
        *rectangle(p, (0.0, 1.7), (1.3, 2.4), 0.12, 0.10), box(Material((0.55, 0.60, 0.64)),
            (0.0, 0.0, 1.7), (
            0.04, 1.1, 2.2)), *(rod(BRASS, (0.15, y, 1.5), (0.15, y, 1.8), 0.03) for y in (0.8,
                -0.8)),
        *(ball(BULB, (0.15, y, 1.88), (0.07, 0.07, 0.12)) for y in (0.8, -0.8))]),
    thing("hall column", ((0.72, 0.69, 0.62),), lambda p: [
        post(p, (0.0, 0.0, 1.4), (0.42, 0.42, 2.8)), box(p, (0.0, 0.0, 0.12), (0.62, 0.62, 0.24)),
        box(BRASS, (0.0, 0.0, 2.75), (0.60, 0.60, 0.18))]),
)  # fmt: skip

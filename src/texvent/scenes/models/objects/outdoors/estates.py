"""Large buildings, and what golf courses, junkyards, ball parks and glaciers are known by."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, foliage, grass_like, plaster, stone
from texvent.scenes.models.objects.figures import disc, lathe, placed, thing, toned
from texvent.scenes.models.objects.palette import (
    BRASS,
    BRICK,
    INK,
    IRON,
    LEAF,
    PALE,
    RED_PAINT,
    ROOF,
    SILVER,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Point,
    ball,
    box,
    gable,
    moved,
    peak,
    plank,
    post,
    rod,
    shift,
    spike,
    turn_z,
)
from texvent.scenes.scene import Colour

_PANE = Material((0.06, 0.09, 0.13))
_STONES: tuple[Colour, ...] = ((0.62, 0.56, 0.44), (0.64, 0.62, 0.58))
_ICE = Material((0.62, 0.76, 0.84))
_ICE_SHADE = Material((0.26, 0.50, 0.66))


def _windows(
    x: float, wide: float, rows: tuple[float, ...], columns: int, size: tuple[float, float]
) -> list[ModelPart]:
    """Windows with pale frames in a grid over a front at x."""
    parts: list[ModelPart] = []
    for z in rows:
        for k in range(columns):
            y = wide * ((k + 0.5) / columns - 0.5)
            parts.append(box(PALE, (x, y, z), (0.06, size[0] + 0.3, size[1] + 0.3)))
            parts.append(box(_PANE, (x + 0.04, y, z), (0.06, size[0], size[1])))
    return parts


def _portico(x: float, wide: float, tall: float, columns: int) -> list[ModelPart]:
    """Columns under a pediment, steps and a door."""
    each = wide / (columns - 1)
    return [
        *(post(PALE, (x, k * each - 0.5 * wide, 0.5 * tall + 0.4), (0.7, 0.7, tall))
          for k in range(columns)),
        box(PALE, (x - 0.4, 0.0, tall + 0.6), (2.2, wide + 1.6, 0.7)),
        plank(PALE, (x, -0.5 * wide - 0.8, tall + 0.9), (x, 0.0, tall + 2.8),
              chord=(1.8, 0.0, 0.0), thickness=(0.0, 0.25, 0.45)),
        plank(PALE, (x, 0.5 * wide + 0.8, tall + 0.9), (x, 0.0, tall + 2.8),
              chord=(1.8, 0.0, 0.0), thickness=(0.0, -0.25, 0.45)),
        box(PALE, (x - 0.6, 0.0, tall + 1.5), (0.6, 0.6 * wide, 1.2)),
        box(Material((0.16, 0.06, 0.03)), (x - 1.45, 0.0, 1.8), (0.3, 1.8, 2.8)),
        *(box(PALE, (x + 0.5 * k, 0.0, 0.38 - 0.12 * k), (1.2, wide + 1.6 - 0.4 * k, 0.2))
          for k in range(3)),
    ]  # fmt: skip


def _mansion(skin: Material) -> list[ModelPart]:
    """Two storeys of many windows, wings, a hipped roof with chimneys, columns at the door."""
    wall = plaster(skin.colour)
    parts = [
        box(wall, (0.0, 0.0, 3.6), (9.0, 22.0, 7.2)),
        *(box(wall, (1.0, 9.2 * s, 3.6), (9.6, 4.6, 7.2)) for s in (1, -1)),
        gable(ROOF, (0.0, 0.0, 7.2), (10.4, 23.0, 3.2)),
        *(box(BRICK, (-1.0, y, 10.0), (1.0, 1.2, 3.2)) for y in (-6.5, 6.5)),
        *_windows(4.5, 13.6, (2.0, 5.4), 6, (1.1, 1.7)),
        *_portico(6.0, 5.2, 6.0, 4),
    ]
    for side in (1, -1):
        for z in (2.0, 5.4):
            for y in (8.2, 10.2):
                parts.append(box(PALE, (5.80, y * side, z), (0.06, 1.4, 2.0)))
                parts.append(box(_PANE, (5.84, y * side, z), (0.06, 1.1, 1.7)))
    return parts


def _palace(skin: Material) -> list[ModelPart]:
    """A long front with columns in the middle, a dome, corner pavilions and flags."""
    wall = Material(skin.colour)
    copper = Material((0.10, 0.34, 0.28))
    parts = [
        box(wall, (0.0, 0.0, 5.0), (12.0, 44.0, 10.0)),
        box(PALE, (0.2, 0.0, 10.2), (12.4, 44.6, 0.7)),
        box(wall, (1.0, 0.0, 6.0), (13.0, 12.0, 12.0)),
        *_portico(8.4, 10.0, 9.6, 6),
        post(wall, (0.0, 0.0, 13.2), (8.6, 8.6, 3.0)),
        ball(copper, (0.0, 0.0, 14.6), (8.6, 8.6, 9.0)),
        post(BRASS, (0.0, 0.0, 19.6), (1.2, 1.2, 1.6)),
        spike(BRASS, (0.0, 0.0, 20.2), (0.0, 0.0, 22.6), 0.4),
        *(
            one
            for s in (1, -1)
            for one in moved(_windows(6.0, 11.0, (2.6, 6.8), 3, (1.5, 2.4)), shift(y=11.7 * s))
        ),
    ]
    for side in (1, -1):
        parts += [
            box(wall, (1.0, 20.4 * side, 6.2), (13.4, 6.0, 12.4)),
            peak(copper, (1.0, 20.4 * side, 14.2), (9.0, 7.2, 4.0)),
            *(box(_PANE, (7.75, 20.4 * side, z), (0.06, 2.2, 2.4)) for z in (2.8, 7.0, 10.6)),
            rod(PALE, (1.0, 20.4 * side, 15.5), (1.0, 20.4 * side, 20.0), 0.12),
            box(RED_PAINT, (1.0, (20.4 + 1.3) * side, 19.2), (0.1, 2.6, 1.5)),
        ]  # fmt: skip
    return parts


def _skyscraper(skin: Material) -> list[ModelPart]:
    """A slim tower of glass in three steps with bands of floors and a mast."""
    glass = Material(skin.colour)
    steps = ((0.0, 46.0, 16.0), (46.0, 74.0, 12.5), (74.0, 92.0, 8.5))
    parts: list[ModelPart] = []
    for low, high, side in steps:
        parts.append(box(glass, (0.0, 0.0, 0.5 * (low + high)), (side, side, high - low)))
        floors = int((high - low) / 4.0)
        parts += [box(PALE, (0.0, 0.0, low + 4.0 * (k + 1)), (side + 0.3, side + 0.3, 0.5))
                  for k in range(floors)]  # fmt: skip
        parts += [
            box(toned(glass, 0.5), (0.5 * side * sx, side * y, 0.5 * (low + high)),
                (0.4, 0.35, high - low))
            for sx in (1, -1) for y in (-0.5, -0.25, 0.0, 0.25, 0.5)
        ]  # fmt: skip
    parts += [
        box(INK, (8.1, 0.0, 2.2), (0.3, 5.0, 4.4)),
        rod(SILVER, (0.0, 0.0, 92.0), (0.0, 0.0, 112.0), 0.5),
    ]
    return parts


def _factory(skin: Material) -> list[ModelPart]:
    """Halls with saw-tooth roofs, tall chimneys with red bands, a silo and a gate."""
    parts = [box(skin, (0.0, 0.0, 3.2), (14.0, 26.0, 6.4))]
    for k in range(5):
        y = 5.2 * (k - 2)
        parts.append(plank(toned(skin, 0.6), (0.0, y - 2.6, 6.4), (0.0, y + 2.6, 9.0),
                           chord=(14.0, 0.0, 0.0), thickness=(0.0, -0.2, 0.4)))  # fmt: skip
        parts.append(box(_PANE, (0.0, y + 2.5, 7.6), (14.0, 0.2, 2.6)))
        parts.append(box(Material((0.45, 0.55, 0.60)), (7.05, y, 4.2), (0.1, 3.6, 1.6)))
    parts.append(box(IRON, (7.05, 0.0, 1.5), (0.2, 3.6, 3.0)))
    for y, tall in ((-8.0, 26.0), (-3.5, 22.0), (7.0, 28.0)):
        shaft = lathe(Material((0.50, 0.47, 0.44)), [(0.0, 1.5), (tall, 0.95)], 4)
        parts += moved(shaft, shift(-5.0, y))
        parts.append(post(RED_PAINT, (-5.0, y, tall - 2.0), (2.2, 2.2, 1.4)))
        parts.append(post(RED_PAINT, (-5.0, y, tall - 5.0), (2.3, 2.3, 1.4)))
    parts += [
        post(SILVER, (2.0, 16.0, 4.0), (5.0, 5.0, 8.0)),
        ball(SILVER, (2.0, 16.0, 8.0), (5.0, 5.0, 3.0)),
        rod(SILVER, (2.0, 13.0, 7.0), (2.0, 16.0, 7.0), 0.4),
    ]
    return parts


def _hospital(skin: Material) -> list[ModelPart]:
    """A white block with rows of windows, a red cross, and a porch with an ambulance bay."""
    return [
        box(skin, (0.0, 0.0, 7.5), (12.0, 28.0, 15.0)),
        *_windows(6.0, 26.0, (5.4, 8.8, 12.2), 7, (2.0, 1.5)),
        box(PALE, (6.3, 0.0, 10.6), (0.5, 6.4, 6.4)),
        box(RED_PAINT, (6.6, 0.0, 10.6), (0.3, 4.8, 1.6)),
        box(RED_PAINT, (6.6, 0.0, 10.6), (0.3, 1.6, 4.8)),
        box(RED_PAINT, (8.6, 0.0, 3.7), (6.0, 9.0, 0.7)),
        *(post(PALE, (11.2, y, 1.8), (0.5, 0.5, 3.4)) for y in (-4.0, 4.0)),
        box(_PANE, (6.1, 0.0, 1.6), (0.2, 6.0, 3.2)),
        box(SILVER, (6.2, 0.0, 1.6), (0.2, 0.15, 3.2)),
    ]


def _shop(skin: Material) -> list[ModelPart]:
    """A shop front: big windows with goods, a door, a striped awning, a sign board."""
    wall = plaster((0.56, 0.50, 0.42))
    parts = [
        box(wall, (-3.0, 0.0, 3.4), (6.0, 9.0, 6.8)),
        box(skin, (0.1, 0.0, 3.55), (0.3, 8.6, 0.9)),
        *(box(PALE, (0.28, 0.5 * k - 1.5, 3.55), (0.06, 0.3, 0.4 + 0.12 * (k % 3)))
          for k in range(7)),
        box(Material((0.16, 0.06, 0.03)), (0.08, 0.0, 1.15), (0.2, 1.2, 2.3)),
        box(_PANE, (0.2, 0.0, 1.4), (0.06, 0.8, 1.5)),
    ]  # fmt: skip
    for side in (1, -1):
        parts.append(box(PALE, (0.06, 2.5 * side, 1.55), (0.2, 3.3, 2.3)))
        parts.append(box(Material((0.30, 0.40, 0.44)), (0.14, 2.5 * side, 1.55), (0.1, 3.0, 2.0)))
        for k in range(4):
            goods = (RED_PAINT, YELLOW_PAINT, LEAF, PALE)[k]
            parts.append(box(goods, (0.22, 2.5 * side + 0.7 * (k - 1.5), 0.85), (0.1, 0.5, 0.6)))
        parts.append(box(PALE, (0.04, 2.2 * side, 5.4), (0.1, 1.5, 1.7)))
        parts.append(box(_PANE, (0.1, 2.2 * side, 5.4), (0.1, 1.2, 1.4)))
    parts += [
        plank(skin if k % 2 else PALE, (0.2, 0.72 * (k - 5.5), 3.1), (1.6, 0.72 * (k - 5.5), 2.5),
              chord=(0.0, 0.72, 0.0), thickness=(0.03, 0.0, 0.06))
        for k in range(12)
    ]  # fmt: skip
    return parts


def _clock_tower(skin: Material) -> list[ModelPart]:
    """A square tower with a clock on every side below a pointed roof."""
    parts = [
        box(skin, (0.0, 0.0, 8.0), (4.4, 4.4, 16.0)),
        box(toned(skin, 0.8), (0.0, 0.0, 0.6), (5.2, 5.2, 1.2)),
        box(skin, (0.0, 0.0, 18.0), (5.0, 5.0, 4.8)),
        *(box(PALE, (0.0, 0.0, z), (5.4, 5.4, 0.4)) for z in (15.6, 20.5)),
        peak(Material((0.10, 0.20, 0.20)), (0.0, 0.0, 23.2), (5.8, 5.8, 5.2)),
        spike(BRASS, (0.0, 0.0, 25.4), (0.0, 0.0, 28.0), 0.25),
        box(Material((0.16, 0.06, 0.03)), (2.22, 0.0, 1.5), (0.1, 1.5, 2.6)),
        *(box(_PANE, (2.22, 0.0, z), (0.1, 0.8, 1.8)) for z in (6.0, 10.0, 13.4)),
    ]
    face = [
        disc(INK, (0.0, 18.0), 2.15, 0.16, 2.52), disc(PALE, (0.0, 18.0), 1.95, 0.16, 2.57),
        *(box(INK, (2.68, 1.6 * math.sin(a), 18.0 + 1.6 * math.cos(a)), (0.06, 0.22, 0.22))
          for a in (0.0, 0.5 * math.pi, math.pi, 1.5 * math.pi)),
        plank(INK, (2.70, 0.0, 18.0), (2.70, 0.95, 18.6), chord=(0.0, -0.12, 0.2),
              thickness=(0.05, 0.0, 0.0)),
        plank(INK, (2.70, 0.0, 18.0), (2.70, -0.35, 19.5), chord=(0.0, 0.2, 0.05),
              thickness=(0.05, 0.0, 0.0)),
    ]  # fmt: skip
    return [*parts, *(one for k in range(4) for one in moved(face, turn_z(0.5 * k * math.pi)))]


def _scrap(skin: Material) -> list[ModelPart]:
    """A heap of crushed car bodies, tyres and sheets of metal."""
    paints = (skin, Material((0.05, 0.16, 0.36)), Material((0.38, 0.34, 0.10)), IRON,
              Material((0.40, 0.40, 0.40)))  # fmt: skip
    parts: list[ModelPart] = []
    for k, (y, z) in enumerate(((-2.6, 0.6), (0.2, 0.6), (2.8, 0.6), (-1.4, 1.7), (1.4, 1.7),
                                (0.0, 2.8))):  # fmt: skip
        paint = paints[k % 5]
        parts += [
            box(paint, (0.1 * (k % 3), y, z), (1.7, 2.6, 0.62), lean=0.06 * (k % 3 - 1)),
            box(toned(paint, 0.7), (0.0, y + 0.2, z + 0.44), (1.3, 1.5, 0.34), lean=0.15),
            box(_PANE, (0.66, y + 0.2, z + 0.42), (0.06, 1.2, 0.24)),
            *(disc(INK, (y + d, z - 0.25), 0.30, 0.2, 0.82) for d in (-0.8, 0.8)),
            *(disc(SILVER, (y + d, z - 0.25), 0.13, 0.22, 0.84) for d in (-0.8, 0.8)),
        ]
    for k in range(4):
        parts.append(post(INK, (1.8, 2.6 + 0.1 * (k % 2), 0.12 + 0.24 * k), (0.66, 0.66, 0.2)))
    return parts


def _golf_green(skin: Material) -> list[ModelPart]:
    """A putting green with a hole and its flag."""
    return [
        post(grass_like((0.10, 0.32, 0.04)), (0.0, 0.0, 0.02), (8.0, 9.0, 0.04)),
        post(INK, (0.0, 0.0, 0.04), (0.30, 0.30, 0.02)),
        rod(PALE, (0.0, 0.0, 0.0), (0.0, 0.0, 2.4), 0.03),
        box(skin, (0.0, 0.42, 2.12), (0.03, 0.80, 0.50)),
        ball(PALE, (1.6, -1.2, 0.10), (0.14, 0.14, 0.14)),
    ]


def _bunker(skin: Material) -> list[ModelPart]:
    """A hollow of pale sand with a green lip."""
    return [
        ball(grass_like((0.07, 0.20, 0.03)), (0.0, 0.0, 0.16), (5.4, 8.4, 0.4)),
        ball(skin, (0.4, 0.0, 0.20), (4.4, 7.0, 0.42)),
        ball(skin, (0.4, 2.6, 0.20), (3.6, 3.6, 0.40)),
    ]


def _diamond(skin: Material) -> list[ModelPart]:
    """Lines, bases and the mound of a baseball field, flat on the grass."""
    corners: list[Point] = [(0.0, -11.0, 0.02), (11.0, 0.0, 0.02), (0.0, 11.0, 0.02),
                            (-11.0, 0.0, 0.02)]  # fmt: skip
    path = box(skin, (0.0, 7.8, 0.01), (15.6, 2.4, 0.02))
    parts = [one for k in range(4) for one in moved([path], turn_z((0.25 + 0.5 * k) * math.pi))]
    parts += [post(skin, (x, y, 0.012), (3.6, 3.6, 0.024)) for x, y, _ in corners]
    parts += [post(skin, (0.0, 0.0, 0.04), (3.0, 3.0, 0.10)), box(PALE, (0.0, 0.0, 0.13),
              (0.2, 0.7, 0.04))]  # fmt: skip
    parts += [box(PALE, corner, (0.9, 0.9, 0.10)) for corner in corners]
    for far in ((34.0, -23.0), (34.0, 23.0)):
        parts.append(plank(PALE, (-11.0, 0.0, 0.02), (far[0], far[1] * 1.95, 0.02),
                           chord=(0.0, 0.3, 0.0), thickness=(0.0, 0.0, 0.02)))  # fmt: skip
    return parts


def _flower_bed(skin: Material) -> list[ModelPart]:
    """A bordered bed of soil with rows of flowers in several colours."""
    blooms = (skin, YELLOW_PAINT, Material((0.50, 0.10, 0.50)), PALE, Material((0.75, 0.25, 0.30)))
    parts = [
        box(stone((0.40, 0.36, 0.30)), (0.0, 0.0, 0.10), (1.5, 3.4, 0.20)),
        box(Material((0.10, 0.06, 0.035)), (0.0, 0.0, 0.13), (1.3, 3.2, 0.20)),
    ]
    for row in range(3):
        for k in range(9):
            x, y, tall = 0.4 * (1 - row), 0.36 * (k - 4), 0.42 + 0.10 * row
            parts.append(ball(foliage(LEAF.colour), (x, y, 0.30), (0.26, 0.30, 0.30)))
            parts.append(ball(blooms[(k // 2 + row) % 5], (x + 0.04, y, tall), (0.18, 0.22, 0.16)))
    return parts


def _ice_wall(skin: Material) -> list[ModelPart]:
    """The torn front of a glacier: blocks and spires of ice, blue in their clefts."""
    parts: list[ModelPart] = []
    for k in range(9):
        y, tall = 3.4 * (k - 4), 6.5 + 2.2 * math.sin(2.1 * k) + 0.8 * math.cos(5.0 * k)
        pale = Material(skin.colour) if k % 3 else _ICE_SHADE
        parts.append(box(pale, (0.8 * math.sin(1.7 * k), y, 0.5 * tall), (6.0, 3.5, tall),
                         lean=0.10 * math.sin(3.0 * k)))  # fmt: skip
        parts.append(spike(pale, (1.2, y + 0.6, 0.8 * tall), (0.4, y + 0.3, tall + 2.0), 1.5))
        parts.append(box(_ICE_SHADE, (3.1, y + 1.7, 0.4 * tall), (0.6, 0.35, 0.8 * tall)))
    parts += [ball(_ICE, (4.4 + 0.5 * (k % 2), 4.5 * (k - 3), 0.6), (2.4, 2.0, 1.3))
              for k in range(7)]  # fmt: skip
    return parts


def _kerb(skin: Material) -> list[ModelPart]:
    """A low kerb of red and white blocks with a wall of tyres behind it."""
    parts = [
        box(skin if k % 2 else PALE, (0.4, 1.0 * (k - 5.5), 0.08), (0.6, 1.0, 0.16))
        for k in range(12)
    ]
    for k in range(12):
        paint = (RED_PAINT, PALE, INK)[k % 3]
        parts.append(post(paint, (-0.5, 1.0 * (k - 5.5), 0.5), (0.9, 0.9, 1.0)))
    return parts


def _start_arch(skin: Material) -> list[ModelPart]:
    """A gantry over a track with a chequered board."""
    parts = [rod(SILVER, (0.0, y, 0.0), (0.0, y, 6.0), 0.2) for y in (-6.5, 6.5)]
    parts.append(box(skin, (0.0, 0.0, 6.2), (0.5, 13.6, 1.9)))
    for row in range(3):
        for k in range(16):
            if (row + k) % 2:
                parts.append(box(INK, (0.28, 0.6 * (k - 7.5), 5.65 + 0.6 * row), (0.1, 0.6, 0.6)))
    return parts


NOUNS = (
    *placed("grass", (
        thing("mansion", _STONES, _mansion,
              ("manor", "manor house", "villa", "stately home")),
        thing("palace", _STONES, _palace, ("royal palace", "chateau")),
        thing("golf green", (RED_PAINT.colour,), _golf_green,
              ("putting green", "golf hole", "golf flag")),
        thing("sand bunker", ((0.74, 0.64, 0.42),), _bunker, ("sand trap",)),
        thing("flower bed", (RED_PAINT.colour,), _flower_bed, ("flowerbed", "bed of flowers")),
    )),
    *placed("city", (
        thing("skyscraper", ((0.10, 0.20, 0.32), (0.16, 0.24, 0.28)), _skyscraper,
              ("high-rise", "glass tower")),
        thing("factory building", ((0.36, 0.16, 0.11),), _factory,
              ("industrial building", "power plant", "industrial plant")),
        thing("hospital building", ((0.66, 0.67, 0.66),), _hospital, ()),
        thing("clock tower", ((0.56, 0.44, 0.30), (0.42, 0.18, 0.12)), _clock_tower),
        thing("shop", ((0.05, 0.26, 0.10), (0.45, 0.05, 0.05), (0.05, 0.12, 0.36)), _shop,
              ("storefront", "shop front", "shopfront", "boutique", "store front")),
    )),
    thing("scrap heap", ((0.36, 0.12, 0.05),), _scrap,
          ("junk heap", "scrap metal")),
    thing("baseball diamond", ((0.40, 0.20, 0.10),), _diamond, ("infield",)),
    thing("glacier front", ((0.70, 0.82, 0.88),), _ice_wall, ("wall of ice", "ice wall")),
    thing("race kerb", (RED_PAINT.colour,), _kerb, ("tyre wall", "tire wall")),
    thing("start arch", (PALE.colour,), _start_arch, ("starting gate", "finish arch")),
)  # fmt: skip
"""Buildings face +x; what lies flat on the ground has its middle at the origin."""

"""What open places are known by: stalls, stands, rails, nets, crops, cliffs, lines of courts."""

from __future__ import annotations

import math
from dataclasses import replace

from texvent.scenes.models.materials import (
    RED,
    WHITE,
    Material,
    foliage,
    glowing,
    grass_like,
    mottled,
    shade,
    stone,
    striped,
)
from texvent.scenes.models.objects.figures import bar, disc, rectangle, thing
from texvent.scenes.models.objects.palette import (
    BRICK,
    GREY_PLASTIC,
    INK,
    IRON,
    PALE,
    PALE_WOOD,
    RED_PAINT,
    ROOF,
    SILVER,
    SILVERY,
    STONE,
    WATER,
    WOOD_BROWN,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, box, limb, moved, plank, post, rod, turn_z

_LINE = Material((0.85, 0.85, 0.83))
_ORANGES = (Material((0.80, 0.28, 0.01)), Material((0.60, 0.03, 0.02)), Material((0.20, 0.42,
    0.05)),
            Material((0.80, 0.60, 0.05)))  # fmt: skip
_HAZE = Material((0.80, 0.88, 0.92), emission=0.12)


def _line(x: float, y: float, long: float, wide: float) -> ModelPart:
    """White paint on the ground."""
    return box(_LINE, (x, y, 0.012), (long, wide, 0.024))


def _court(size: tuple[float, float], inner: float) -> list[ModelPart]:
    """The outer lines of a court, and two parallel to its sides."""
    long, wide = size
    return [
        *(_line(0.0, s * 0.5 * wide, long, 0.06) for s in (1.0, -1.0)),
        *(_line(s * 0.5 * long, 0.0, 0.06, wide) for s in (1.0, -1.0)),
        *(_line(0.0, s * 0.5 * inner, long, 0.05) for s in (1.0, -1.0)),
        _line(0.0, 0.0, 0.05, wide),
    ]


def _net(p: Material, wide: float, tall: float, low: float, count: int) -> list[ModelPart]:
    """A net between two posts, across y."""
    step = wide / count
    return [
        *(rod(IRON, (0.0, s * 0.5 * wide, 0.0), (0.0, s * 0.5 * wide, tall), 0.04) for s in (1.0,
            -1.0)),
        box(_LINE, (0.0, 0.0, tall - 0.03), (0.03, wide, 0.07)),
        *(box(p, (0.0, -0.5 * wide + step * (k + 0.5), 0.5 * (tall + low)), (0.012, 0.014,
            tall - low))
          for k in range(count)),
        *(box(p, (0.0, 0.0, low + (tall - low) * k / 5), (0.012, wide, 0.014)) for k in range(5)),
    ]  # fmt: skip


def _stall(p: Material) -> list[ModelPart]:
    """A market stall: striped awning, crates of fruit."""
    canvas = striped(p.colour, WHITE, 3.0)
    parts = [
        *(rod(Material(PALE_WOOD), (x, y, 0.0), (x, y, 2.1), 0.035)
          for x in (0.6, -0.6) for y in (1.1, -1.1)),
        *(plank(p if k % 2 else PALE, (-0.75, -1.1 + 0.275 * k, 2.55), (0.95, -1.1 + 0.275 * k,
            2.0),
                chord=(0.0, 0.275, 0.0), thickness=(0.01, 0.0, 0.04)) for k in range(9)),
        box(Material(WOOD_BROWN), (0.0, 0.0, 0.40), (1.0, 2.2, 0.80)),
        box(canvas, (0.52, 0.0, 0.5), (0.02, 2.2, 0.6)),
    ]  # fmt: skip
    for k in range(4):
        y = -0.82 + 0.55 * k
        parts.append(box(Material(PALE_WOOD), (0.15, y, 0.88), (0.7, 0.5, 0.16)))
        for x, side in ((0.0, 0.1), (0.3, -0.1), (0.3, 0.14), (0.05, -0.12)):
            parts.append(ball(_ORANGES[k], (x, y + side, 1.0), (0.28, 0.24, 0.22)))
    return parts


def _stand(p: Material) -> list[ModelPart]:
    """Rows of spectators on steps."""
    crowd = (RED_PAINT, Material((0.03, 0.10, 0.45)), PALE, Material((0.75, 0.45, 0.02)), INK)
    parts = []
    for row in range(5):
        x, z = -1.0 * row, 0.8 * row
        parts.append(box(p, (x, 0.0, 0.5 * (z + 0.8)), (1.0, 24.0, z + 0.8)))
        parts += [ball(crowd[(3 * k + row) % 5], (x, -10.6 + 2.7 * k + 0.5 * (row % 2), z + 1.2),
                       (0.55, 1.6, 0.95)) for k in range(8)]  # fmt: skip
    parts += [box(GREY_PLASTIC, (-2.4, 0.0, 6.2), (6.2, 25.0, 0.2)),
              *(rod(STEEL_POST, (-4.9, y, 0.0), (-4.9, y, 6.2), 0.15) for y in (-11.0, 0.0,
                  11.0))]  # fmt: skip
    return parts


STEEL_POST = Material((0.45, 0.46, 0.48))


def _rock_wall(p: Material, size: Point, layers: int) -> list[ModelPart]:
    """A steep face of layered rock."""
    long, wide, tall = size
    parts: list[ModelPart] = []
    count = layers
    for k in range(count):
        high = tall * (0.86 + 0.14 * math.sin(2.4 * k) ** 2)
        skin = replace(stone(shade(p.colour, 0.75 + 0.12 * (k % 3))), scale=3.0)
        y = wide * ((k + 0.5) / count - 0.5)
        deep = long * (0.75 + 0.25 * math.cos(1.9 * k))
        buttress = box(skin, (0.5 * (deep - long), y, 0.5 * high), (
            deep, 2.1 * wide / count, high), lean=-0.16)  # fmt: skip
        parts += moved([buttress], turn_z(0.8 * math.sin(2.1 * k + 0.4), (0.0, y, 0.0)))
        rubble = (0.5 * long + 0.10 * long * math.sin(5.0 * k), y, 0.085 * tall)
        parts.append(ball(skin, rubble, (0.14 * tall, 0.12 * tall, 0.16 * tall)))
    return parts


def _platform(p: Material) -> list[ModelPart]:
    """A raised platform with its yellow line, a roof on posts, a name board and the station."""
    house, roof = Material((0.50, 0.22, 0.14)), Material((0.06, 0.22, 0.16))
    return [
        box(mottled(p.colour), (-2.2, 0.0, 0.45), (4.4, 60.0, 0.9)),
        box(Material((0.80, 0.60, 0.04)), (-0.5, 0.0, 0.91), (0.3, 60.0, 0.03)),
        box(house, (-6.0, 0.0, 2.9), (3.0, 46.0, 4.2)),
        *(box(PALE, (-4.49, -20.0 + 5.0 * k, 2.4), (0.04, 1.6, 1.7)) for k in range(9)),
        box(roof, (-2.4, 0.0, 4.5), (4.6, 50.0, 0.3)),
        *(rod(IRON, (-1.4, 6.0 * k, 0.9), (-1.4, 6.0 * k, 4.4), 0.12) for k in range(-4, 5)),
        *(
            box(Material((0.02, 0.08, 0.35)), (-1.0, 15.0 * k, 3.6), (0.1, 4.0, 0.8))
            for k in (-1, 0, 1)
        ),
        *(box(Material(WHITE), (-0.94, 15.0 * k, 3.6), (0.02, 3.0, 0.25)) for k in (-1, 0, 1)),
    ]


def _row(skin: Material, count: int, tall: float) -> list[ModelPart]:
    """Plants in a row along y."""
    return [
        ball(skin, (0.0, 1.0 * (k - 0.5 * count), 0.5 * tall), (0.8, 1.1, tall))
        for k in range(count)
    ]


def _track(sleeper: Material, long: float) -> list[ModelPart]:
    """Rails on sleepers in ballast."""
    ballast = mottled((0.30, 0.28, 0.26), contrast=0.5, scale=30.0)
    count = min(round(long), 54)
    step = long / count
    return [
        box(ballast, (0.0, 0.0, 0.03), (long, 3.2, 0.06)),
        *(box(sleeper, (step * (k + 0.5) - 0.5 * long, 0.0, 0.09), (0.3, 2.5, 0.08))
          for k in range(count)),
        *(box(SILVER, (0.0, 0.75 * s, 0.19), (long, 0.09, 0.14)) for s in (1.0, -1.0)),
    ]  # fmt: skip


NOUNS = (
    thing("market stall", ((0.55, 0.03, 0.02), (0.03, 0.12, 0.45), (0.05, 0.30, 0.08)), _stall,
          ("stall", "fruit stall", "food stall", "market stand", "vegetable stall",
              "street stall")),
    thing("grandstand", ((0.45, 0.45, 0.44),), _stand, ("bleachers", "stands", "tribune")),
    thing("floodlight mast", (SILVERY,), lambda p: [
        rod(p, (0.0, 0.0, 0.0), (0.0, 0.0, 14.0), 0.22), box(p, (0.0, 0.0, 14.6), (0.3, 3.2, 2.0)),
        *(disc(glowing((1.0, 1.0, 0.9), 2.0), (-1.1 + 0.73 * k, 14.1 + 0.95 * j), 0.3, 0.1, 0.2)
          for k in range(4) for j in range(2))], ("stadium light",)),
    thing("guard rail", (SILVERY,), lambda p: [
        *(box(p, (0.0, y, 0.35), (0.12, 0.12, 0.7)) for y in (-2.7, -0.9, 0.9, 2.7)),
        *(box(p, (0.08, 0.0, z), (0.06, 6.0, 0.12)) for z in (0.50, 0.68)),
        box(INK, (0.07, 0.0, 0.59), (0.05, 6.0, 0.06))], ("crash barrier", "guardrail")),
    thing("motorway sign", ((0.02, 0.12, 0.50),), lambda p: [
        *(rod(IRON, (0.0, y, 0.0), (0.0, y, 4.6), 0.10) for y in (-1.6, 1.6)),
        box(p, (0.05, 0.0, 3.9), (0.08, 4.4, 2.2)), *rectangle(PALE, (0.0, 3.9), (4.3, 2.1),
            0.08, 0.20),
        *(bar(PALE, (-1.6, 4.4 - 0.5 * k), (0.4 + 0.3 * k, 4.4 - 0.5 * k), 0.18,
            0.2) for k in range(3)),
        *(bar(PALE, (1.3, 3.3), (1.3, 4.5), 0.16, 0.2) for _ in range(1)),
        bar(PALE, (1.3, 4.5), (0.95, 4.1), 0.14, 0.2), bar(PALE, (1.3, 4.5), (1.65, 4.1), 0.14,
            0.2)],
        ("highway sign", "road sign gantry")),
    thing("runway light", ((0.05, 0.20, 1.0),), lambda p: [
        post(IRON, (0.0, 0.0, 0.15), (0.16, 0.16, 0.30)),
        ball(glowing(p.colour, 3.0), (0.0, 0.0, 0.40), (0.34, 0.34, 0.34))],
            ("blue runway light",)),
    thing("runway markings", (PALE.colour,), lambda p: [
        box(Material((0.06, 0.06, 0.063)), (0.0, 0.0, 0.004), (160.0, 26.0, 0.008)),
        *(_line(-72.0 + 12.0 * k, 0.0, 7.0, 0.7) for k in range(13)),
        *(_line(0.0, 12.0 * s, 160.0, 0.45) for s in (1.0, -1.0))]),
    thing("control tower", ((0.70, 0.70, 0.68),), lambda p: [
        post(p, (0.0, 0.0, 7.0), (3.0, 3.0, 14.0)), post(Material((0.05, 0.12, 0.16)), (0.0, 0.0,
            15.2),
                                                          (6.0, 6.0, 2.2)),
        post(p, (0.0, 0.0, 16.5), (6.6, 6.6, 0.5)), post(p, (0.0, 0.0, 14.0), (5.4, 5.4, 0.6)),
        rod(IRON, (0.0, 0.0, 16.5), (0.0, 0.0, 20.0), 0.12)], ("air traffic control tower",)),
    thing("hangar", ((0.42, 0.45, 0.48),), lambda p: [
        rod(p, (-8.0, 0.0, 1.0), (8.0, 0.0, 1.0), 9.0), box(INK, (7.9, 0.0, 3.2), (0.4, 12.0, 6.4)),
        *(box(p, (8.1, y, 3.2), (0.2, 0.3, 6.4)) for y in (-3.0, 0.0, 3.0))], ("aircraft hangar",)),
    thing("tennis court net", (INK.colour,), lambda p: _net(p, 11.0, 1.0, 0.0, 30)),
    thing("high net", (INK.colour,), lambda p: _net(p, 9.0, 2.4, 1.4, 24), ()),
    thing("tennis court lines", (PALE.colour,), lambda p: [
        box(Material((0.03, 0.16, 0.32)), (0.0, 0.0, 0.004), (26.0, 13.0, 0.008)),
        *_court((23.8, 10.9), 8.2), *_net(INK, 11.6, 1.0, 0.0, 26)], ()),
    thing("basketball court lines", (PALE.colour,), lambda p: [
        *_court((5.6, 5.2), 2.0), *(limb(_LINE, (0.9 * math.cos(a), 0.9 * math.sin(a), 0.0),
            (0.9 * math.cos(a + 0.42), 0.9 * math.sin(a + 0.42), 0.0), 0.03)
            for a in (0.42 * k for k in range(15)))]),
    thing("pitch lines", (PALE.colour,), lambda p: [
        *_court((60.0, 40.0), 18.0), *(_line(18.0 * s, 0.0, 0.12, 18.0) for s in (1.0, -1.0)),
        *(_line(9.0 * math.cos(a), 9.0 * math.sin(a), 0.1, 0.1) for a in (0.0, 1.57)),
        *(limb(_LINE, (4.5 * math.cos(a), 4.5 * math.sin(a), 0.0),
               (4.5 * math.cos(a + 0.42), 4.5 * math.sin(a + 0.42), 0.0), 0.04)
          for a in (0.42 * k for k in range(15)))], ("football pitch lines",)),
    thing("running lanes", ((0.42, 0.09, 0.05),), lambda p: [
        box(p, (0.0, 0.0, 0.004), (90.0, 9.0, 0.008)), *(_line(0.0, -4.4 + 1.1 * k, 90.0, 0.07)
                                                         for k in range(9))]),
    thing("hurdle", (PALE.colour,), lambda p: [
        *(rod(STEEL_POST, (0.0, y, 0.0), (0.0, y, 0.95), 0.025) for y in (-0.55, 0.55)),
        *(rod(STEEL_POST, (0.0, y, 0.03), (-0.5, y, 0.03), 0.025) for y in (-0.55, 0.55)),
        *(box(c, (0.0, -0.45 + 0.3 * k, 0.95), (0.03, 0.3, 0.10)) for k, c in enumerate(
            (p, RED_PAINT, p, RED_PAINT)))], ("track hurdle",)),
    thing("boxing ring ropes", (PALE.colour,), lambda p: [
        box(Material((0.10, 0.25, 0.50)), (0.0, 0.0, 0.006), (5.4, 5.4, 0.012)),
        *(rod(RED_PAINT, (2.6 * a, 2.6 * b, 0.0), (2.6 * a, 2.6 * b, 1.4), 0.09)
          for a in (1, -1) for b in (1, -1)),
        *(rod(p, (-2.6, 2.6, z), (2.6, 2.6, z), 0.025) for z in (0.45, 0.85, 1.25)),
        *(rod(p, (2.6 * s, -2.6, z), (2.6 * s, 2.6, z), 0.025) for z in (0.45, 0.85, 1.25)
          for s in (1, -1))]),
    thing("gravel path lines", ((0.48, 0.40, 0.28),), lambda p: [
        box(mottled(p.colour), (0.0, 0.0, 0.006), (60.0, 2.4, 0.012)),
        *(box(STONE, (0.0, 1.25 * s, 0.03), (60.0, 0.12, 0.06)) for s in (1, -1))], ()),
    thing("railway track", ((0.16, 0.09, 0.05),), lambda p: _track(p, 40.0),
        ("train track", "rail", "train tracks", "railroad track", "tracks", "railway line"),
        plurals=("rails", "railway tracks")),
    thing("station platform", ((0.46, 0.45, 0.43),), _platform),
    thing("long railway track", ((0.16, 0.09, 0.05),), lambda p: _track(p, 80.0)),
    thing("parking lines", (PALE.colour,), lambda p: [
        *(_line(0.0, -12.5 + 2.5 * k, 5.0, 0.12) for k in range(11)), _line(-2.5, 0.0, 0.12,
            25.0)]),
    thing("sun lounger", (PALE.colour,), lambda p: [
        box(p, (0.2, 0.0, 0.32), (1.2, 0.6, 0.08)), plank(p, (-0.4, 0.0, 0.32), (-0.9, 0.0, 0.8),
            chord=(
            0.0, 0.6, 0.0), thickness=(0.05, 0.0, 0.05)),
        *(box(PALE, (x, y, 0.15), (0.05, 0.05, 0.3)) for x in (-0.3, 0.7) for y in (0.25, -0.25))],
        ("lounger", "deckchair", "sunbed", "beach chair")),
    thing("diving board", ((0.10, 0.35, 0.60),), lambda p: [
        box(p, (0.6, 0.0, 1.0), (3.0, 0.5, 0.08)), *(rod(SILVER, (-0.5, y, 0.0), (-0.5, y, 1.8),
            0.04)
                                                      for y in (0.28, -0.28)),
        rod(SILVER, (-0.5, 0.28, 1.8), (0.5, 0.28, 1.8), 0.03), rod(SILVER, (-0.5, -0.28, 1.8),
                                                                    (0.5, -0.28, 1.8), 0.03),
        box(STONE, (-0.5, 0.0, 0.48), (0.6, 0.7, 0.96))], ("springboard",)),
    thing("lane rope", ((0.55, 0.03, 0.02),), lambda p: [
        ball(p if k % 2 else PALE, (-9.5 + 1.0 * k, 0.0, 0.05), (0.95, 0.22,
            0.20)) for k in range(20)]),
    thing("mooring post", ((0.16, 0.09, 0.05),), lambda p: [
        post(p, (0.0, 0.0, 0.5), (0.28, 0.28, 1.0)), post(INK, (0.0, 0.0, 0.96), (0.36, 0.36,
            0.12)),
        *(ball(Material((0.50, 0.38, 0.2)), (0.0, 0.0, 0.62 + 0.07 * k), (0.42, 0.42, 0.08))
          for k in range(3))], ("mooring",)),
    thing("crop row", ((0.55, 0.40, 0.10),), lambda p: _row(grass_like(p.colour), 10, 0.9),
          ("wheat row",)),
    thing("corn row", ((0.08, 0.26, 0.03),), lambda p: [
        part for k in range(9) for part in (
            limb(p, (0.0, 1.0 * (k - 4.0), 0.0), (0.0, 1.0 * (k - 4.0), 2.0), 0.05),
            plank(p, (0.0, 1.0 * (k - 4.0), 0.8), (0.0, 1.0 * (k - 4.0) + 0.5, 1.5), chord=(0.10,
                0.0, 0.0),
                  thickness=(0.0, 0.02, 0.02)),
            plank(p, (0.0, 1.0 * (k - 4.0), 1.1), (0.0, 1.0 * (k - 4.0) - 0.5, 1.7), chord=(0.10,
                0.0, 0.0),
                  thickness=(0.0, 0.02, 0.02)),
            ball(Material((0.75, 0.50, 0.06)), (0.08, 1.0 * (k - 4.0), 1.1), (0.10, 0.10, 0.28)))],
        ("corn stalk", "maize row")),
    thing("vine row", ((0.06, 0.22, 0.03),), lambda p: [
        *_row(foliage(p.colour), 7, 1.5), *(rod(Material(PALE_WOOD), (0.0, 3.5 * s, 0.0), (0.0,
            3.5 * s, 1.8),
                                                0.06) for s in (1, -1)),
        *(ball(Material((0.16, 0.02, 0.16)), (0.4, -2.6 + k, 0.6), (0.14, 0.14,
            0.24)) for k in range(6))],
        ("grapevine row", "grape vines")),
    thing("gravestone", ((0.42, 0.42, 0.40),), lambda p: [
        box(p, (0.0, 0.0, 0.45), (0.16, 0.7, 0.9)), disc(p, (0.0, 0.9), 0.35, 0.16),
        bar(INK, (0.0, 0.55), (0.0, 1.05), 0.06, 0.20), bar(INK, (-0.16, 0.85), (0.16, 0.85),
            0.06, 0.20)],
        ("tombstone", "grave", "headstone", )),
    thing("slalom gate", ((0.60, 0.03, 0.02),), lambda p: [
        *(rod(p, (0.0, y, 0.0), (0.0, y, 1.9), 0.04) for y in (-0.9, 0.9)),
        box(p, (0.0, 0.0, 1.45), (0.02, 1.8, 0.6))], ("ski gate",)),
    thing("ski lift", (RED,), lambda p: [
        rod(IRON, (0.0, 0.0, 0.0), (0.0, 0.0, 8.0), 0.25), box(IRON, (0.0, 0.0, 7.8), (0.3, 4.0,
            0.3)),
        *(rod(INK, (-20.0, y, 7.6), (20.0, y, 7.6), 0.03) for y in (-1.8, 1.8)),
        *(part for x, y in ((-9.0, 1.8), (6.0, -1.8), (12.0, 1.8)) for part in (
            rod(IRON, (x, y, 7.6), (x, y, 5.6), 0.05), box(p, (x, y, 5.3), (0.5, 1.6,
                0.5))))],
        ("chairlift", "chair lift")),
    thing("dune mound", ((0.62, 0.46, 0.24),), lambda p: [
        ball(mottled(p.colour, contrast=0.12), (0.0, 0.0, 0.0), (14.0, 24.0, 7.0)),
        ball(mottled((0.50, 0.36, 0.18), contrast=0.12), (1.6, 3.0, -0.2), (13.0, 15.0, 6.0))],
        ()),
    thing("green hill", ((0.09, 0.20, 0.03),), lambda p: [
        ball(grass_like(p.colour), (0.0, 0.0, 0.0), (26.0, 44.0, 15.0)),
        ball(grass_like(shade(p.colour, 0.8)), (-5.0, 13.0, 0.0), (24.0, 30.0, 19.0))],
        ("grassy hill", "hillock", "knoll")),
    thing("cliff", ((0.44, 0.36, 0.28),), lambda p: _rock_wall(p, (9.0, 22.0, 18.0), 9),
          ("cliff face", "rock face", "crag", "bluff")),
    thing("canyon wall", ((0.56, 0.24, 0.10),), lambda p: _rock_wall(p, (10.0, 24.0, 20.0), 8),
          ("red cliff",)),
    thing("rock waterfall", ((0.34, 0.32, 0.29),), lambda p: [
        *_rock_wall(p, (4.0, 12.0, 9.0), 5)[:5],
        *(limb(_HAZE, (1.9 - 0.05 * k, -1.2 + 0.4 * k, 0.2), (1.4, -1.0 + 0.34 * k, 8.8), 0.42)
          for k in range(7)),
        *(ball(_HAZE, (2.6, -1.6 + 0.8 * k, 0.3), (1.6, 1.4, 1.0)) for k in range(5)),
        ball(WATER, (4.0, 0.0, 0.0), (6.0, 8.0, 0.12))], ()),
    thing("lava flow", ((0.05, 0.04, 0.04),), lambda p: [
        ball(mottled(p.colour), (0.0, 0.0, 0.0), (14.0, 5.0, 0.9)),
        *(limb(glowing((0.9, 0.16, 0.01), 0.9), (-6.5 + 2.2 * k, 0.7 * math.sin(1.4 * k), 0.42),
               (-4.3 + 2.2 * k, 0.7 * math.sin(1.4 * k + 1.4), 0.40), 0.36) for k in range(5)),
        *(ball(glowing((1.0, 0.35, 0.02), 1.2), (-5.0 + 2.6 * k, 0.5 * math.sin(2.0 * k), 0.6),
               (0.9, 0.5, 0.3)) for k in range(4))], ("lava", "lava stream", "magma")),
    thing("wooden house", ((0.62, 0.58, 0.46),), lambda p: [
        box(p, (0.0, 0.0, 1.5), (5.0, 7.0, 3.0)), *(plank(ROOF, (2.9 * s, 0.0, 2.8), (0.0, 0.0,
            4.8), chord=(
            0.0, 7.6, 0.0), thickness=(0.0, 0.0, 0.16)) for s in (1.0, -1.0)),
        box(Material((0.20, 0.10, 0.05)), (2.52, -1.0, 1.0), (0.06, 0.95, 2.0)),
        *(box(Material((0.30, 0.42, 0.50)), (2.52, y, 1.7), (0.06, 1.1, 0.9)) for y in (0.9, 2.4)),
        *(box(PALE, (2.54, y, 1.7), (0.06, 0.06, 0.9)) for y in (0.9, 2.4)),
        box(BRICK, (-1.0, 2.2, 4.6), (0.6, 0.6, 1.4))], ("suburban house", "country house",
            "cottage")),
    thing("garden fence", ((0.78, 0.77, 0.74),), lambda p: [
        *(box(p, (0.0, -1.9 + 0.2 * k, 0.55), (0.03, 0.12, 1.1)) for k in range(20)),
        *(box(p, (-0.04, 0.0, z), (0.03, 4.0, 0.10)) for z in (0.3, 0.85))], ("paling",)),
    thing("corral fence", (WOOD_BROWN,), lambda p: [
        *(rod(p, (0.0, y, 0.0), (0.0, y, 1.5), 0.09) for y in (-2.0, 0.0, 2.0)),
        *(rod(p, (0.06, -2.2, z), (0.06, 2.2, z), 0.055) for z in (0.5, 0.95, 1.35))],
            ("rail fence",)),
    thing("bowling lane", ((0.55, 0.34, 0.15),), lambda p: [
        box(p, (0.0, 0.0, 0.010), (6.0, 1.1, 0.02)), *(box(INK, (0.0, 0.66 * s, 0.006), (16.0,
            0.22, 0.012))
                                                          for s in (1, -1)),
        *(part for x, y in ((1.7, 0.0), (2.0, 0.17), (2.0, -0.17), (2.3, 0.34), (2.3, 0.0), (2.3,
            -0.34),
                            (2.6, 0.5), (2.6, 0.17), (2.6, -0.17), (2.6, -0.5)) for part in (
            ball(PALE, (x, y, 0.15), (0.15, 0.15, 0.28)), ball(PALE, (x, y, 0.36), (0.09, 0.09,
                0.16)),
            post(RED_PAINT, (x, y, 0.28), (0.075, 0.075, 0.04))))], ("bowling alley lane",)),
    thing("barrier tape", (RED,), lambda p: [
        *(rod(striped(RED, WHITE, 3.0), (0.0, y, 0.0), (0.0, y, 1.0), 0.05) for y in (-1.5, 1.5)),
        *(box(p if k % 2 else PALE, (0.0, -1.35 + 0.3 * k, 0.9), (0.02, 0.3, 0.12))
          for k in range(10))], ("police tape",)),
)  # fmt: skip

"""What rooms are furnished with: fitted kitchens, work places, counters, shelves, seats in rows."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, glowing
from texvent.scenes.models.objects.figures import (
    chain,
    disc,
    lathe,
    placed,
    rectangle,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLACK_PLASTIC,
    BREAD,
    CHINA,
    DARK_WOOD,
    GREY_PLASTIC,
    INK,
    IRON,
    LEAF,
    PALE,
    PALE_WOOD,
    RED_PAINT,
    SCREEN,
    SILVER,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, limb, post, rod
from texvent.scenes.scene import Colour

_FRONTS: tuple[Colour, ...] = ((0.62, 0.60, 0.55), (0.34, 0.18, 0.08), (0.20, 0.28, 0.34))
_TOP = Material((0.11, 0.11, 0.12))
_GREEN_CROSS = glowing((0.02, 0.45, 0.12), 0.6)
_GOODS = (RED_PAINT, YELLOW_PAINT, Material((0.05, 0.30, 0.08)), Material((0.03, 0.12, 0.45)),
          PALE, Material((0.45, 0.10, 0.40)))  # fmt: skip


def _door(skin: Material, y: float, z: float, wide: float, tall: float) -> list[ModelPart]:
    """A door of a cabinet at x = 0.3: panel, frame, handle."""
    return [
        box(toned(skin, 0.62), (0.30, y, z), (0.02, wide, tall)),
        box(skin, (0.312, y, z), (0.02, wide - 0.03, tall - 0.03)),
        box(SILVER, (0.335, y + 0.36 * wide, z), (0.03, 0.018, 0.16)),
    ]


def _base(skin: Material, wide: float, doors: int) -> list[ModelPart]:
    """Base units of a kitchen under a worktop."""
    each = wide / doors
    fronts = [
        part for n in range(doors)
        for part in _door(skin, (n + 0.5) * each - 0.5 * wide, 0.48, each - 0.02, 0.72)
    ]  # fmt: skip
    return [
        box(toned(skin, 0.8), (0.0, 0.0, 0.49), (0.58, wide, 0.78)),
        box(INK, (-0.04, 0.0, 0.05), (0.5, wide, 0.10)),
        *fronts,
        box(_TOP, (0.01, 0.0, 0.90), (0.66, wide + 0.02, 0.05)),
    ]


def _wall_units(skin: Material, wide: float, doors: int) -> list[ModelPart]:
    """Cabinets on the wall above it."""
    each = wide / doors
    units = [box(toned(skin, 0.8), (-0.12, 0.0, 1.80), (0.34, wide, 0.66))]
    for n in range(doors):
        y = (n + 0.5) * each - 0.5 * wide
        units.append(box(toned(skin, 0.62), (0.05, y, 1.80), (0.02, each - 0.01, 0.66)))
        units.append(box(skin, (0.062, y, 1.80), (0.02, each - 0.04, 0.63)))
        units.append(box(SILVER, (0.085, y + 0.33 * each, 1.60), (0.03, 0.018, 0.14)))
    return units


def _basin(y: float) -> list[ModelPart]:
    """A basin let into a worktop, with its tap."""
    neck = [(-0.20, y, 1.20), (-0.16, y, 1.28), (-0.08, y, 1.30), (-0.01, y, 1.26), (0.0, y, 1.18)]
    return [
        box(SILVER, (0.03, y, 0.930), (0.52, 0.84, 0.02)),
        box(toned(SILVER, 0.3), (0.05, y, 0.936), (0.40, 0.72, 0.02)),
        rod(SILVER, (-0.20, y, 0.92), (-0.20, y, 1.22), 0.025),
        *chain(SILVER, neck, 0.022),
        *(rod(SILVER, (-0.2, y + s * 0.14, 0.93), (-0.2, y + s * 0.14, 1.0), 0.03)
          for s in (1, -1)),
    ]  # fmt: skip


def _pleats(skin: Material, wide: float, low: float, high: float) -> list[ModelPart]:
    """A drawn curtain that hangs in folds across x = 0."""
    count = 17
    each = wide / count
    return [
        rod(skin if n % 2 else toned(skin, 0.72),
            (0.05 if n % 2 else 0.01, (n + 0.5) * each - 0.5 * wide, low),
            (0.03 if n % 2 else 0.0, (n + 0.5) * each - 0.5 * wide, high), 0.72 * each)
        for n in range(count)
    ]  # fmt: skip


def _shower_curtain(skin: Material) -> list[ModelPart]:
    """A curtain on rings from a rail over the side of a tub."""
    return [
        rod(SILVER, (0.0, -0.92, 2.02), (0.0, 0.92, 2.02), 0.018),
        *(disc(SILVER, (0.92 * s, 2.02), 0.05, 0.05) for s in (1, -1)),
        *(box(SILVER, (0.02, 0.2 * k, 1.99), (0.03, 0.02, 0.07)) for k in range(-4, 5)),
        *_pleats(skin, 1.74, 0.24, 1.97),
        box(Material(CHINA), (-0.38, 0.0, 0.27), (0.74, 1.80, 0.54)),
        box(PALE, (-0.38, 0.0, 0.55), (0.80, 1.86, 0.05)),
    ]


def _shelving(skin: Material, wide: float) -> list[ModelPart]:
    """Four boards between two sides and a back; goods stand at z of `_LEVELS`."""
    return [
        box(toned(skin, 0.7), (-0.2, 0.0, 1.0), (0.04, wide, 2.0)),
        *(box(skin, (0.0, 0.5 * s * wide, 1.0), (0.42, 0.05, 2.0)) for s in (1, -1)),
        *(box(skin, (0.0, 0.0, z), (0.42, wide, 0.04)) for z in _LEVELS),
    ]


_LEVELS = (0.12, 0.58, 1.04, 1.50)


def _loaves(wide: float) -> list[ModelPart]:
    """Loaves, rolls and baguettes on the boards of shelves."""
    brown = Material((0.42, 0.20, 0.06))
    parts: list[ModelPart] = []
    for level, z in enumerate(_LEVELS):
        for k in range(5):
            y = wide * (k - 2.0) / 5.4
            if level % 2:
                parts.append(ball(brown if k % 2 else BREAD, (0.04, y, z + 0.11),
                                  (0.26, 0.27, 0.20)))  # fmt: skip
            else:
                parts.append(limb(BREAD, (0.0, y, z + 0.08), (0.10, y, z + 0.26), 0.10))
    return parts


def _packets(wide: float) -> list[ModelPart]:
    """Bottles and packets in rows on the boards of shelves."""
    parts: list[ModelPart] = []
    for level, z in enumerate(_LEVELS):
        for k in range(9):
            y = wide * (k - 4.0) / 9.6
            skin = _GOODS[(k + 2 * level) % 6]
            if (k + level) % 3:
                parts.append(box(skin, (0.05, y, z + 0.13), (0.14, 0.12, 0.22)))
            else:
                parts.append(post(skin, (0.05, y, z + 0.12), (0.11, 0.11, 0.20)))
                parts.append(post(PALE, (0.05, y, z + 0.24), (0.06, 0.06, 0.05)))
    return parts


def _cross(z: float) -> list[ModelPart]:
    """The lit green cross of a pharmacy on a white board."""
    return [
        box(PALE, (0.05, 0.0, z), (0.06, 0.62, 0.56)),
        box(_GREEN_CROSS, (0.09, 0.0, z), (0.04, 0.48, 0.16)),
        box(_GREEN_CROSS, (0.09, 0.0, z), (0.04, 0.16, 0.46)),
    ]


def _dishes_behind_glass() -> list[ModelPart]:
    """Trays of food in the top of a serving counter."""
    skins = (RED_PAINT, LEAF, YELLOW_PAINT, Material((0.40, 0.18, 0.06)), PALE)
    return [
        part
        for k, skin in enumerate(skins)
        for part in (
            box(SILVER, (0.06, 0.42 * (k - 2), 0.94), (0.44, 0.38, 0.06)),
            ball(skin, (0.06, 0.42 * (k - 2), 0.97), (0.38, 0.32, 0.12)),
        )
    ]


def _food_counter(skin: Material) -> list[ModelPart]:
    """A counter with trays of food, a glass hood and lamps over it."""
    return [
        box(skin, (0.0, 0.0, 0.45), (0.70, 2.2, 0.90)),
        *_dishes_behind_glass(),
        *(rod(SILVER, (0.28, y, 0.92), (0.28, y, 1.36), 0.02) for y in (-1.08, 1.08)),
        box(Material((0.60, 0.74, 0.78)), (0.14, 0.0, 1.37), (0.34, 2.2, 0.025)),
        box(SILVER, (0.50, 0.0, 0.82), (0.30, 2.2, 0.03)),
    ]


def _canteen_table(skin: Material) -> list[ModelPart]:
    """A long table with benches on both sides and trays on it."""
    parts = [box(skin, (0.0, 0.0, 0.74), (0.80, 2.2, 0.05))]
    for y in (-0.9, 0.9):
        parts.append(box(SILVER, (0.0, y, 0.36), (0.5, 0.06, 0.72)))
    for side in (1, -1):
        parts.append(box(RED_PAINT, (0.68 * side, 0.0, 0.44), (0.32, 2.2, 0.06)))
        parts += [box(SILVER, (0.68 * side, y, 0.22), (0.2, 0.05, 0.42)) for y in (-0.9, 0.9)]
        for y in (-0.7, 0.0, 0.7):
            parts.append(box(YELLOW_PAINT, (0.2 * side, y, 0.775), (0.28, 0.40, 0.02)))
            parts.append(post(PALE, (0.2 * side, y, 0.80), (0.20, 0.20, 0.025)))
    return parts


def _work_place(skin: Material) -> list[ModelPart]:
    """A desk with a monitor, keyboard and mouse, drawers and an office chair."""
    return [
        box(skin, (0.0, 0.0, 0.72), (0.75, 1.5, 0.04)),
        *(box(toned(skin, 0.7), (0.0, y, 0.35), (0.7, 0.04, 0.70)) for y in (-0.72, 0.72)),
        box(toned(skin, 0.85), (0.05, -0.52, 0.42), (0.6, 0.36, 0.55)),
        *(box(SILVER, (0.36, -0.52, z), (0.02, 0.14, 0.02)) for z in (0.30, 0.48, 0.62)),
        box(BLACK_PLASTIC, (-0.18, 0.1, 1.06), (0.04, 0.66, 0.42)),
        box(SCREEN, (-0.155, 0.1, 1.06), (0.02, 0.60, 0.36)),
        box(PALE, (-0.15, 0.0, 1.08), (0.02, 0.24, 0.20)),
        box(BLACK_PLASTIC, (-0.2, 0.1, 0.80), (0.05, 0.08, 0.16)),
        box(BLACK_PLASTIC, (-0.18, 0.1, 0.75), (0.2, 0.28, 0.02)),
        box(GREY_PLASTIC, (0.16, 0.1, 0.755), (0.18, 0.46, 0.03)),
        *(box(PALE, (0.11 + 0.05 * k, 0.1, 0.772), (0.03, 0.42, 0.01)) for k in range(3)),
        ball(BLACK_PLASTIC, (0.18, 0.46, 0.76), (0.12, 0.07, 0.05)),
        *_swivel_chair(),
    ]


def _swivel_chair() -> list[ModelPart]:
    """A chair beside the knees of who would sit there, turned aside."""
    cloth = Material((0.04, 0.08, 0.20))
    return [
        box(cloth, (0.78, 0.70, 0.48), (0.46, 0.46, 0.08)),
        box(cloth, (0.98, 0.80, 0.76), (0.10, 0.42, 0.44)),
        rod(IRON, (0.78, 0.70, 0.10), (0.78, 0.70, 0.46), 0.03),
        *(rod(IRON, (0.78, 0.70, 0.10),
              (0.78 + 0.28 * math.cos(a), 0.70 + 0.28 * math.sin(a), 0.04), 0.025)
          for a in (0.3, 1.56, 2.8, 4.1, 5.3)),
    ]  # fmt: skip


def _cinema_seats(skin: Material) -> list[ModelPart]:
    """A row of folding seats, seen from behind by who looks at the screen."""
    parts: list[ModelPart] = []
    for k in range(5):
        y = 0.62 * (k - 2)
        parts += [
            box(skin, (0.0, y, 0.72), (0.14, 0.52, 0.72)),
            ball(skin, (0.0, y, 1.08), (0.14, 0.52, 0.22)),
            box(toned(skin, 0.8), (-0.26, y, 0.42), (0.46, 0.50, 0.12)),
        ]
    parts += [box(INK, (-0.14, 0.62 * (k - 2.5), 0.50), (0.44, 0.07, 0.34)) for k in range(6)]
    return [*parts, box(INK, (-0.06, 0.0, 0.18), (0.2, 3.1, 0.36))]


def _film_screen(skin: Material) -> list[ModelPart]:
    """A wide lit screen between red curtains."""
    cloth = Material((0.40, 0.02, 0.03))
    return [
        box(INK, (0.0, 0.0, 1.2), (0.06, 3.8, 1.7)),
        box(glowing(skin.colour, 0.9), (0.04, 0.0, 1.2), (0.04, 3.6, 1.5)),
        box(glowing((0.06, 0.22, 0.05), 0.9), (0.05, 0.0, 0.70), (0.04, 3.6, 0.5)),
        disc(glowing((1.0, 0.85, 0.40), 1.2), (0.9, 1.55), 0.24, 0.04, 0.06),
        *(rod(cloth if k % 2 else toned(cloth, 0.7), (0.1, s * (2.0 + 0.12 * k), 0.05),
              (0.1, s * (2.0 + 0.12 * k), 2.05), 0.09) for k in range(3) for s in (1, -1)),
    ]  # fmt: skip


def _mixing_desk(skin: Material) -> list[ModelPart]:
    """A sloped console of faders and knobs with two loudspeakers and a screen on it."""
    parts = [
        box(skin, (0.0, 0.0, 0.42), (0.70, 2.0, 0.84)),
        box(toned(skin, 0.5), (0.0, 0.0, 0.92), (0.72, 2.0, 0.10), lean=0.0),
        box(BLACK_PLASTIC, (-0.28, 0.0, 1.28), (0.05, 0.9, 0.54)),
        box(SCREEN, (-0.25, 0.0, 1.28), (0.02, 0.84, 0.48)),
    ]
    parts += [box(LEAF if k % 3 else RED_PAINT, (-0.235, 0.09 * (k - 4), 1.14 + 0.04 * (k % 4)),
                  (0.02, 0.05, 0.12 + 0.08 * (k % 4))) for k in range(9)]  # fmt: skip
    for k in range(11):
        y = 0.17 * (k - 5.0)
        parts.append(box(INK, (0.14, y, 0.975), (0.30, 0.02, 0.01)))
        parts.append(box(PALE, (0.06 + 0.15 * ((k * 5) % 7) / 7, y, 0.99), (0.05, 0.06, 0.03)))
        parts.append(post(RED_PAINT if k % 2 else YELLOW_PAINT, (-0.12, y, 0.99),
                          (0.05, 0.05, 0.04)))  # fmt: skip
    for y in (-0.8, 0.8):
        parts += [
            box(BLACK_PLASTIC, (-0.22, y, 1.27), (0.26, 0.32, 0.58)),
            disc(GREY_PLASTIC, (y, 1.18), 0.12, 0.03, -0.08),
            disc(PALE, (y, 1.18), 0.04, 0.04, -0.075),
            disc(GREY_PLASTIC, (y, 1.43), 0.06, 0.03, -0.08),
        ]
    return parts


def _pool(skin: Material) -> list[ModelPart]:
    """A basin of blue water let into the floor: rim, lane ropes, starting blocks, a ladder."""
    rope = (RED_PAINT, PALE)
    parts = [
        box(PALE, (0.0, 0.0, 0.02), (6.2, 6.6, 0.04)),
        box(skin, (0.0, 0.0, 0.03), (5.6, 6.0, 0.04)),
    ]
    for lane in (-1.9, -0.63, 0.63, 1.9):
        parts += [
            ball(rope[k % 2], (lane, 0.66 * (k - 4.0), 0.06), (0.10, 0.66, 0.10)) for k in range(9)
        ]
    for lane in (-1.33, 0.0, 1.33):
        parts.append(box(PALE, (lane, 3.05, 0.3), (0.4, 0.4, 0.6)))
        parts.append(box(RED_PAINT, (lane, 2.83, 0.3), (0.4, 0.04, 0.5)))
    for y in (-2.4, -1.9):
        parts += chain(
            SILVER, [(2.6, y, 0.0), (2.65, y, 0.7), (2.9, y, 0.85), (3.05, y, 0.0)], 0.03
        )
    return parts


def _wash_stand(skin: Material) -> list[ModelPart]:
    """A cabinet with a white top, basin and tap, and a mirror over it."""
    return [
        box(toned(skin, 0.8), (0.0, 0.0, 0.43), (0.50, 1.1, 0.74)),
        *_door(skin, -0.27, 0.44, 0.50, 0.64), *_door(skin, 0.27, 0.44, 0.50, 0.64),
        box(PALE, (0.02, 0.0, 0.83), (0.60, 1.16, 0.06)),
        *lathe(Material(CHINA), [(0.85, 0.20), (0.96, 0.25)], 3),
        post(toned(PALE, 0.5), (0.0, 0.0, 0.962), (0.42, 0.42, 0.01)),
        rod(SILVER, (-0.24, 0.0, 0.86), (-0.24, 0.0, 1.14), 0.02),
        rod(SILVER, (-0.24, 0.0, 1.12), (-0.08, 0.0, 1.10), 0.02),
        box(Material((0.55, 0.64, 0.70)), (-0.25, 0.0, 1.65), (0.03, 0.86, 0.90)),
        *rectangle(toned(skin, 1.1), (0.0, 1.65), (0.94, 0.98), 0.06, 0.06),
    ]  # fmt: skip


NOUNS = placed("indoor", (
    *placed("kitchen", (
        thing("kitchen cabinet", _FRONTS,
              lambda p: [*_base(p, 1.8, 3), *_wall_units(p, 1.8, 3),
                         box(PALE, (-0.29, 0.0, 1.2), (0.02, 1.8, 0.56))],
              ("kitchen cupboard", "cabinetry", "kitchen unit", "fitted kitchen")),
        thing("kitchen counter", _FRONTS, lambda p: _base(p, 1.8, 3),
              ("counter", "countertop", "counter top", "worktop", "kitchen island",
               "kitchen countertop", "counter space")),
        thing("kitchen sink", _FRONTS, lambda p: [*_base(p, 1.2, 2), *_basin(0.0)]),
    )),
    *placed("bathroom", (
        thing("shower curtain", ((0.70, 0.72, 0.74), (0.20, 0.42, 0.60), (0.62, 0.20, 0.22)),
              _shower_curtain),
        thing("wash stand", ((0.34, 0.18, 0.08), (0.62, 0.60, 0.55)), _wash_stand,
              ("washstand", "bathroom vanity", "bathroom counter", "vanity unit")),
    )),
    *placed("office", (
        thing("computer desk", ((0.50, 0.32, 0.16), (0.62, 0.60, 0.56)), _work_place,
              ("workstation", "cubicle desk", "work station")),
    )),
    thing("bread shelf", (PALE_WOOD, WOOD_BROWN),
          lambda p: [*_shelving(p, 1.8), *_loaves(1.8)], ("bakery shelf",)),
    thing("medicine shelf", (PALE.colour,),
          lambda p: [*_shelving(p, 1.8), *_packets(1.8), *_cross(2.32)], ("pharmacy shelf",)),
    thing("food counter", (SILVER.colour, (0.20, 0.30, 0.34)), _food_counter,
          ("serving counter", "buffet", "salad bar", "deli counter", "food display")),
    thing("canteen table", ((0.62, 0.60, 0.55),), _canteen_table, ("cafeteria table",)),
    thing("cinema seats", ((0.42, 0.02, 0.03),), _cinema_seats, ("cinema seat",)),
    thing("film screen", ((0.30, 0.48, 0.75),), _film_screen),
    thing("pool basin", ((0.04, 0.34, 0.55),), _pool),
    thing("mixing desk", (DARK_WOOD,), _mixing_desk,
          ("soundboard", "sound board", "audio mixer")),
))  # fmt: skip
"""Furniture that tells one room from another; what stands at a wall has its back at -x."""

"""Things with a flat face that can show a picture: screens, posters, boards, pages, signs.

The face is always the first part: a box whose side at its own x = 1 shows the picture, the
picture's right along the box's y, its top along the box's z.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from texvent.scenes.models.materials import Material, glowing, striped
from texvent.scenes.models.objects.figures import (
    bar,
    chain,
    disc,
    lying,
    placed,
    rectangle,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLACKISH,
    BLUE_PAINT,
    BRASS,
    GREY_PLASTIC,
    INK,
    IRON,
    LEAF,
    PALE,
    PAPER,
    RED_PAINT,
    SCREEN,
    SILVER,
    SILVERY,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    ball,
    box,
    compose,
    moved,
    plank,
    post,
    rod,
    shift,
    turn_y,
)


@dataclass(frozen=True)
class PictureFace:
    """Where a thing can show a picture."""

    part: int = 0
    """Index of the box in `Model.parts`."""
    face: str = "+x"
    """Side of the box, in the box's own axes."""


_DISPLAY = glowing((0.10, 0.30, 0.55), 0.8)
_KEYS = striped((0.02, 0.02, 0.022), (0.16, 0.16, 0.17), 7.0)
_LEAN = -0.20
_HINGE = compose(shift(-0.115, 0.0, 0.012), turn_y(-0.30))
"""How a laptop's lid stands."""


def _windows(x: float, z: float, wide: float, tall: float) -> list[ModelPart]:
    """A few coloured fields on a display that is switched on."""
    return [
        box(PALE, (x, -0.18 * wide, z + 0.08 * tall), (0.004, 0.42 * wide, 0.55 * tall)),
        box(YELLOW_PAINT, (x, 0.26 * wide, z + 0.18 * tall), (0.004, 0.28 * wide, 0.30 * tall)),
        box(INK, (x, 0.0, z - 0.44 * tall), (0.004, 0.98 * wide, 0.08 * tall)),
    ]  # fmt: skip


def _phone(skin: Material, wide: float, tall: float) -> list[ModelPart]:
    """A flat slab with a display, leaning back a little on its lower edge."""
    deep, z = 0.05 * tall, 0.5 * tall
    icons = [
        box(hue, (0.5 * deep + 0.002 + _LEAN * dz * tall, dy * wide, z + dz * tall),
            (0.003 * tall / 0.15, 0.18 * wide, 0.18 * wide),
            lean=_LEAN)
        for hue, dy, dz in ((PALE, -0.27, 0.25), (YELLOW_PAINT, 0.0, 0.25), (RED_PAINT, 0.27, 0.25),
                            (LEAF, -0.27, 0.10), (PALE, 0.0, 0.10), (PALE, 0.27, -0.30))
    ]  # fmt: skip
    return [
        box(_DISPLAY, (0.002, 0.0, z), (deep, 0.90 * wide, 0.88 * tall), lean=_LEAN),
        box(skin, (0.0, 0.0, z), (deep, wide, tall), lean=_LEAN),
        *icons,
    ]


def _standing(
    skin: Material, face: Material, wide: float, tall: float, foot: float
) -> list[ModelPart]:
    """A flat screen on a foot."""
    z = foot + 0.5 * tall
    return [
        box(face, (0.012, 0.0, z), (0.03, wide - 0.03, tall - 0.03)),
        box(skin, (0.0, 0.0, z), (0.045, wide, tall)),
        box(skin, (-0.02, 0.0, 0.5 * foot), (0.03, 0.12 * wide, foot + 0.02)),
        box(skin, (0.0, 0.0, 0.008), (0.22, 0.42 * wide, 0.016)),
    ]  # fmt: skip


def _open_book(skin: Material) -> list[ModelPart]:
    """Two pages that rise towards the back of the book, on its cover."""
    return [
        plank_page(PAPER, 1.0), plank_page(PAPER, -1.0),
        box(skin, (0.0, 0.0, 0.004), (0.255, 0.36, 0.008)),
        *(box(INK, (-0.09 + 0.022 * i, y, 0.036 + (0.008 if abs(y) < 0.1 else 0.0)),
            (0.005, 0.12, 0.002)) for i in range(9) for y in (0.09, -0.09)),
    ]  # fmt: skip


def plank_page(material: Material, side: float) -> ModelPart:
    """One block of pages of an open book, its upper side the box's own +x."""
    lifted = moved([box(material, (0.0, 0.0, 0.0), (0.03, 0.168, 0.24))], turn_y(-0.5 * math.pi))
    return moved(lifted, shift(0.0, side * 0.086, 0.02))[0]


def _cover(skin: Material) -> ModelPart:
    """The upper cover of a closed book, its upper side the box's own +x."""
    cover = moved([box(skin, (0.0, 0.0, 0.0), (0.006, 0.24, 0.17))], turn_y(-0.5 * math.pi))
    return moved(cover, shift(z=0.043))[0]


def _board_on_posts(
    face: Material, posts: Material, size: tuple[float, float], low: float
) -> list[ModelPart]:
    wide, tall = size
    z = low + 0.5 * tall
    return [
        box(face, (0.03, 0.0, z), (0.04, wide, tall)),
        *rectangle(toned(posts, 0.8), (0.0, z), (wide + 0.04, tall + 0.04), 0.04, 0.05),
        *(bar(posts, (y, 0.0), (y, z + 0.4 * tall), 0.06 * wide, 0.06)
            for y in (0.38 * wide, -0.38 * wide)),
    ]  # fmt: skip


_INDOOR = placed("indoor", (
    thing("tv", (BLACKISH,),
        lambda p: [*_standing(p, SCREEN, 1.20, 0.70, 0.08), *_windows(0.029, 0.43, 1.1, 0.6)],
          ("television", "tv set", "television set", "flat screen", "flatscreen")),
    thing("monitor", (BLACKISH,),
        lambda p: [*_standing(p, SCREEN, 0.58, 0.36, 0.14), *_windows(0.029, 0.32, 0.54, 0.32)],
          ("computer monitor", "computer screen")),
    thing("screen", ((0.80, 0.80, 0.78),), lambda p: [
        box(p, (0.02, 0.0, 1.40), (0.02, 1.80, 1.30)),
        *rectangle(INK, (0.0, 1.40), (1.90, 1.40), 0.05, 0.03),
        rod(INK, (-0.03, 0.0, 0.0), (-0.03, 0.0, 2.10), 0.025),
        *(rod(INK, (-0.03, 0.0, 0.40), (x, y, 0.01), 0.02) for x,
            y in ((0.4, 0.3), (0.4, -0.3), (-0.4, 0.0)))],
        ("projection screen", "projector screen", "cinema screen", "movie screen")),
    thing("laptop", (SILVERY, BLACKISH), lambda p: [
        *moved([box(SCREEN, (0.003, 0.0, 0.115), (0.008, 0.31, 0.195))], _HINGE),
        *moved([box(p, (0.0, 0.0, 0.115), (0.010, 0.34, 0.23))], _HINGE),
        *moved(_windows(0.0075, 0.115, 0.30, 0.19), _HINGE),
        box(p, (0.0, 0.0, 0.010), (0.24, 0.34, 0.018)),
        *(plank(_KEYS, (x, -0.145, 0.020), (x, 0.145, 0.020), chord=(0.020, 0.0, 0.0),
            thickness=(0.0, 0.0, 0.004)) for x in (-0.085, -0.06, -0.035, -0.01)),
        box(toned(p, 0.7), (0.06, 0.0, 0.0195), (0.06, 0.10, 0.002))],
        ("notebook computer", "laptop computer")),
    thing("tablet", (BLACKISH,), lambda p: _phone(p, 0.17, 0.24), ("tablet computer", "ipad")),
    thing("cell phone", (BLACKISH,), lambda p: _phone(p, 0.074, 0.15),
          ("phone", "mobile phone", "smartphone", "cellphone", "cellular telephone", "iphone")),
    thing("poster", (PAPER.colour,), lambda p: [
        box(p, (0.0, 0.0, 0.50), (0.016, 0.70, 1.00)),
        *moved([box(RED_PAINT, (0.006, 0.0, 0.0), (0.010, 0.34, 0.34))], shift(0.0, 0.0, 0.60)),
        disc(YELLOW_PAINT, (0.0, 0.60), 0.14, 0.012, 0.008),
        *(bar(INK, (-w, z), (w, z), h, 0.012, 0.004) for z, w,
            h in ((0.90, 0.28, 0.07), (0.26, 0.24, 0.04), (0.18, 0.20, 0.03), (0.11, 0.15, 0.03)))],
        ("placard",)),
    thing("picture frame", (WOOD_BROWN, BRASS.colour), lambda p: [
        box(Material((0.25, 0.42, 0.62)), (0.0, 0.0, 0.30), (0.02, 0.64, 0.44)),
        *rectangle(p, (0.0, 0.30), (0.80, 0.60), 0.08, 0.05),
        box(LEAF, (0.004, 0.0, 0.16), (0.02, 0.64, 0.16)),
        ball(Material((0.12, 0.22, 0.08)), (0.0, -0.12, 0.24), (0.03, 0.26, 0.20)),
        disc(YELLOW_PAINT, (0.20, 0.44), 0.04, 0.022, 0.003)],
        ("painting", "framed picture", "photo frame", "artwork", "photograph frame")),
    thing("checkerboard", (BLACKISH,), lambda p: [
        box(PALE, (0.0, 0.0, 0.34), (0.014, 0.88, 0.68)),
        *(box(p, (0.006, -0.35 + 0.1 * column, 0.09 + 0.1 * row), (0.004, 0.1, 0.1))
          for column in range(8) for row in range(6) if (column + row) % 2),
        rod(IRON, (-0.03, 0.0, 0.5), (-0.28, 0.0, 0.0), 0.012)],
        ("chessboard pattern", "calibration board", "calibration target", "checker board",
            "chequerboard", "checkerboard pattern")),
    thing("book", ((0.45, 0.05, 0.04), (0.05, 0.14, 0.42), (0.06, 0.26, 0.12)), _open_book,
        ("open book",)),
    thing("closed book", ((0.45, 0.05, 0.04), (0.05, 0.14, 0.42), (0.06, 0.26, 0.12)), lambda p: [
        _cover(p),
        box(PAPER, (0.004, 0.0, 0.022), (0.16, 0.234, 0.036)),
        box(p, (0.0, 0.0, 0.003), (0.17, 0.24, 0.006)),
        box(p, (-0.082, 0.0, 0.023), (0.008, 0.24, 0.046)),
        box(BRASS, (0.0, 0.0, 0.044), (0.05, 0.14, 0.006))]),
    thing("page", (PAPER.colour,), lambda p: lying([
        box(p, (0.0, 0.0, 0.149), (0.006, 0.21, 0.297)),
        *(bar(INK, (-0.08, 0.26 - 0.018 * i),
            (0.08 - (0.05 if i % 5 == 4 else 0.0), 0.26 - 0.018 * i), 0.006, 0.004, 0.002)
            for i in range(13))]),
        ("sheet of paper", "paper", "piece of paper"),
        plurals=("sheets of paper",)),
    thing("newspaper", (PAPER.colour,), lambda p: lying([
        box(p, (0.0, 0.0, 0.20), (0.02, 0.30, 0.40)),
        *(part for s in (1.0, -1.0) for part in (
            bar(INK, (-0.12, 0.37), (0.12, 0.37), 0.03, 0.006, 0.01 * s),
            box(GREY_PLASTIC, (0.01 * s, 0.07 * s, 0.26), (0.006, 0.12, 0.12)),
            *(bar(INK, (min(y * s, (y + 0.11) * s), 0.31 - 0.018 * i),
                (max(y * s, (y + 0.11) * s), 0.31 - 0.018 * i), 0.007, 0.006, 0.009 * s)
                for i in range(16) for y in ((-0.13, 0.01) if i > 7 else (-0.13,)))))])),
    thing("map", (PAPER.colour,), lambda p: lying([
        box(p, (0.0, 0.0, 0.20), (0.006, 0.60, 0.40)),
        *(ball(Material((0.20, 0.42, 0.14)), (0.002, y, z), (0.006, w, h)) for y, z, w,
            h in ((-0.16, 0.26, 0.20, 0.16), (0.14, 0.20, 0.26, 0.28), (-0.10, 0.09, 0.12, 0.12))),
        *chain(Material((0.5, 0.05, 0.03)),
            [(0.005, -0.2, 0.28), (0.005, -0.05, 0.22), (0.005, 0.1, 0.28), (0.005, 0.2, 0.12)],
            0.005), disc(BLUE_PAINT, (-0.22, 0.12), 0.03, 0.008)])),
    thing("blackboard", ((0.02, 0.06, 0.04),), lambda p: [
        box(p, (0.02, 0.0, 1.30), (0.02, 1.80, 1.00)),
        *rectangle(Material(WOOD_BROWN), (0.0, 1.30), (1.92, 1.12), 0.06, 0.06),
        *(bar(Material(WOOD_BROWN), (y, 0.0), (y, 1.4), 0.07, 0.04, -0.03) for y in (0.8, -0.8)),
        *(bar(PALE, (y, z), (y + w, z), 0.02, 0.006, 0.031) for y, z,
            w in ((-0.7, 1.6, 0.5), (-0.7, 1.45, 0.8), (-0.6, 1.30, 0.6)))],
        ("chalkboard",)),
    thing("whiteboard", (PALE.colour,), lambda p: [
        box(p, (0.02, 0.0, 1.30), (0.02, 1.80, 1.00)),
        *rectangle(SILVER, (0.0, 1.30), (1.88, 1.08), 0.04, 0.05),
        *(bar(SILVER, (y, 0.0), (y, 1.4), 0.05, 0.04, -0.03) for y in (0.8, -0.8)),
        *(bar(BLUE_PAINT, (y, z), (y + w, z), 0.02, 0.006, 0.031) for y, z,
            w in ((-0.7, 1.6, 0.5), (-0.7, 1.45, 0.8))),
            *chain(RED_PAINT, [(0.03, 0.2, 1.0), (0.03, 0.4, 1.35), (0.03, 0.55, 1.15),
                (0.03, 0.75, 1.55)], 0.012)],
        ("flip chart",)),
    thing("card", (PAPER.colour,), lambda p: [
        box(p, (0.0, 0.0, 0.044), (0.004, 0.063, 0.088), lean=_LEAN),
        *(box(RED_PAINT, (0.001 + _LEAN * z, y, 0.044 + z), (0.004, w, w), lean=_LEAN)
          for y, z, w in ((0.0, 0.0, 0.022), (-0.022, 0.032, 0.010), (0.022, -0.032, 0.010)))],
        ("playing card", "postcard", "business card")),
))  # fmt: skip

_STREET = placed("city", (
    thing("sign", ((0.04, 0.16, 0.45), (0.05, 0.30, 0.10)), lambda p: [
        box(p, (0.045, 0.0, 1.95), (0.02, 0.90, 0.60)),
        *rectangle(PALE, (0.0, 1.95), (0.94, 0.64), 0.05, 0.03),
        post(SILVER, (0.0, 0.0, 1.10), (0.07, 0.07, 2.20)),
        *(bar(PALE, (-0.30, z), (w, z), 0.09, 0.006, 0.056) for z,
            w in ((2.06, 0.30), (1.86, 0.10)))],
        ("road sign", "street sign", "signboard", "signpost", "notice board", "information board",
            "traffic sign")),
    thing("billboard", (PAPER.colour,), lambda p: [
        *_board_on_posts(p, IRON, (6.0, 3.0), 3.0),
        box(RED_PAINT, (0.04, -1.5, 4.5), (0.04, 2.2, 2.2)),
        *(bar(INK, (0.2, z), (w, z), 0.30, 0.04, 0.04) for z,
            w in ((5.3, 2.6), (4.6, 2.2), (3.9, 1.6)))],
        ("hoarding", "advertising board", "advertisement")),
))  # fmt: skip

NOUNS = (*_INDOOR, *_STREET)
"""Nouns that can show a picture, and what is like them."""

PICTURE_FACES: Mapping[str, PictureFace] = MappingProxyType(
    {noun.name: PictureFace() for noun in NOUNS}
)
"""Where each of these nouns shows a picture."""

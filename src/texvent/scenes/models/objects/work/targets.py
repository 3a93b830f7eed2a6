"""Printed targets that stand upright and face the camera: an edge, dots, codes and tags.

They are drawn as figures are: y to the right, z up, x towards the viewer.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Iterator, Sequence

from texvent.scenes.models.materials import Material
from texvent.scenes.models.objects.figures import placed, thing
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import box, rod
from texvent.scenes.scene import Colour, Texture

_BLACK: Colour = (0.008, 0.008, 0.009)
_PAPER = Material((0.9, 0.9, 0.9), texture=Texture.PLAIN)
_SIDE, _THIN, _INK = 1.0, 0.02, 0.006
"""Side and thickness of a board, and height of the print on it, m."""
_DOTS, _BARS, _MODULES = 55, 26, 17
"""Dots, bars of a barcode, and modules along the side of a code."""
_FINDER = 7
"""Modules along the side of a corner of a QR code (ISO/IEC 18004)."""
_TAG = ("11111111", "10010111", "10110011", "11011011", "10100101", "11110001", "10011011",
        "11111111")  # fmt: skip
"""A square tag: a black border around 6x6 bits."""


def _board(wide: float = _SIDE, high: float = _SIDE) -> ModelPart:
    return box(_PAPER, (0.0, 0.0, 0.5 * high), (_THIN, wide, high))


def _print(ink: Material, left: float, low: float, wide: float, high: float) -> ModelPart:
    """A rectangle on the board, from its left and lower edge, m."""
    size = (_INK, wide, high)
    return box(ink, (0.5 * _THIN, left + 0.5 * wide, low + 0.5 * high), size)


def _flat(skin: Material) -> Material:
    return Material(skin.colour, texture=Texture.PLAIN)


def _edge(skin: Material) -> list[ModelPart]:
    return [_board(1.6, 1.0), _print(_flat(skin), -0.8, 0.0, 0.8, 1.0)]


def _dots(skin: Material) -> list[ModelPart]:
    """Dots of 5 cm that do not touch, at places drawn once."""
    draw, ink, places = random.Random(1), _flat(skin), list[tuple[float, float]]()
    while len(places) < _DOTS:
        y, z = draw.uniform(-0.66, 0.66), draw.uniform(0.04, 0.96)
        if all((y - a) ** 2 + (z - b) ** 2 > 0.07**2 for a, b in places):
            places.append((y, z))
    front = 0.5 * _THIN
    return [
        _board(1.4, 1.0),
        *(rod(ink, (front, y, z), (front + _INK, y, z), 0.025) for y, z in places),
    ]


def _circle_grid(skin: Material) -> list[ModelPart]:
    """Rows of circles, every other one shifted by half a step."""
    ink, front, step = _flat(skin), 0.5 * _THIN, 0.2
    places = [
        (step * (column - 3.25 + 0.5 * (row % 2)), 0.14 + 0.12 * row)
        for row in range(7)
        for column in range(7)
    ]
    return [
        _board(1.6, 1.0),
        *(rod(ink, (front, y, z), (front + _INK, y, z), 0.045) for y, z in places),
    ]


def _barcode(skin: Material) -> list[ModelPart]:
    draw, ink = random.Random(2), _flat(skin)
    edges = list(itertools.accumulate(draw.randint(1, 3) for _ in range(2 * _BARS)))
    unit = 1.2 / edges[-1]
    return [
        _board(1.4, 0.8),
        *(_print(ink, -0.6 + unit * left, 0.1, unit * (right - left), 0.6)
          for left, right in zip(edges[0::2], edges[1::2], strict=True)),
    ]  # fmt: skip


def _runs(rows: Sequence[str]) -> Iterator[tuple[int, int, int]]:
    """Row, first column and length of each run of dark modules."""
    for number, row in enumerate(rows):
        at = 0
        for dark, run in itertools.groupby(row):
            length = len(list(run))
            if dark == "1":
                yield number, at, length
            at += length


def _modules(skin: Material, rows: Sequence[str]) -> list[ModelPart]:
    """A square code on a board; around it is a tenth of the board's side."""
    ink, unit = _flat(skin), 0.8 * _SIDE / len(rows)
    return [
        _board(),
        *(_print(ink, unit * at - 0.4, 0.9 - unit * (row + 1), unit * length, unit)
          for row, at, length in _runs(rows)),
    ]  # fmt: skip


def _corner(ink: Material, y: float, z: float, unit: float) -> list[ModelPart]:
    """Three squares in each other around a point of the board."""
    return [
        box(one, (0.5 * _THIN, y, z), (_INK + 0.004 * number, side * unit, side * unit))
        for number, (one, side) in enumerate(((ink, 7), (_PAPER, 5), (ink, 3)))
    ]


def _qr_code(skin: Material) -> list[ModelPart]:
    """Three corners of a QR code, the rest at random: nobody can read it."""
    draw, unit = random.Random(3), 0.8 * _SIDE / _MODULES
    last = _MODULES - _FINDER - 1
    rows = []
    for row in range(_MODULES):
        is_top, is_bottom = row <= _FINDER, row >= last
        free = range(_FINDER + 1 if is_top or is_bottom else 0, last if is_top else _MODULES)
        drawn = (draw.random() < 0.5 and column in free for column in range(_MODULES))
        rows.append("".join("01"[is_dark] for is_dark in drawn))
    out = 0.4 - 0.5 * _FINDER * unit
    corners = ((-out, 0.5 + out), (out, 0.5 + out), (-out, 0.5 - out))
    ink = _flat(skin)
    return [*_modules(skin, rows), *(part for at in corners for part in _corner(ink, *at, unit))]


NOUNS = placed("plain", (
    thing("vertical edge", (_BLACK,), _edge,
          ("step edge", "contrast edge", "moving edge", "black and white edge", "edge pattern")),
    thing("random dots", (_BLACK,), _dots,
          ("dot pattern", "random dot pattern", "random dot stimulus", "dots pattern",
           "speckle pattern", "random dot field"), plurals=("random dots",)),
    thing("circle grid", (_BLACK,), _circle_grid,
          ("circles grid", "grid of circles", "grid of dots", "dot grid", "asymmetric circle grid",
           "symmetric circle grid", "circle grid calibration pattern", "circle calibration pattern",
           "circle grid pattern", "asymmetric circle grid calibration pattern")),
    thing("barcode", (_BLACK,), _barcode, ("bar code", "barcode pattern")),
    thing("qr code", (_BLACK,), _qr_code, ("qr tag", "data matrix")),
    thing("april tag", (_BLACK,), lambda skin: _modules(skin, _TAG),
          ("apriltag", "aruco marker", "aruco tag", "aruco", "fiducial marker", "fiducial tag",
           "fiducial", "ar marker")),
))  # fmt: skip
"""Nouns of targets."""

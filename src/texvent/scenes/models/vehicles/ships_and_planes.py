"""Boats, ships and aircraft, told by their body."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, glowing
from texvent.scenes.models.objects.figures import (
    Moving,
    placed,
    spinning,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLUE_PAINT,
    GREY_PLASTIC,
    INK,
    IRON,
    PALE,
    RED_PAINT,
    SILVER,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, box, limb, plank, post, rod, spike

_PANE = Material((0.05, 0.08, 0.11))
_BLUE_LAMP = glowing((0.05, 0.15, 1.0), 3.0)
_CANVAS = Material((0.80, 0.78, 0.72))


def _hull(p: Material, long: float, wide: float, tall: float) -> list[ModelPart]:
    """An open hull on the waterline, pointed at the front."""
    return [
        box(p, (-0.08 * long, 0.0, 0.1 * tall), (0.66 * long, wide, 0.9 * tall)),
        spike(p, (0.24 * long, 0.0, 0.1 * tall), (0.55 * long, 0.0, 0.3 * tall), 0.5 * tall),
        plank(p, (0.22 * long, 0.5 * wide, 0.1 * tall), (0.50 * long, 0.0, 0.25 * tall), chord=(
            0.0, 0.0, 0.9 * tall), thickness=(0.05, 0.12, 0.0)),
        plank(p, (0.22 * long, -0.5 * wide, 0.1 * tall), (0.50 * long, 0.0, 0.25 * tall), chord=(
            0.0, 0.0, 0.9 * tall), thickness=(0.05, -0.12, 0.0)),
        box(toned(p, 0.45), (-0.08 * long, 0.0, 0.52 * tall), (0.60 * long, 0.84 * wide,
            0.08 * tall)),
    ]  # fmt: skip


_WATER = (
    thing("rowing boat", (WOOD_BROWN, (0.10, 0.25, 0.35)), lambda p: [
        *_hull(p, 3.6, 1.2, 0.55), *(box(Material((0.5, 0.32, 0.16)), (x, 0.0, 0.32), (0.26, 1.1,
            0.05)) for x in (-0.9, 0.1)),
        *(rod(Material((0.5, 0.32, 0.16)), (0.1, s * 0.5, 0.35), (-0.2, s * 1.9, 0.02),
            0.03) for s in (1, -1)),
        *(box(Material((0.5, 0.32, 0.16)), (-0.24, s * 2.0, 0.0), (0.18, 0.5, 0.04)) for s in (1,
            -1))],
        ("rowboat", "row boat", "wooden boat", "dinghy"), goes=("water", "sail", 1.2)),
    thing("kayak", (YELLOW_PAINT.colour, RED_PAINT.colour), lambda p: [
        spike(p, (0.0, 0.0, 0.1), (2.2, 0.0, 0.2), 0.32), spike(p, (0.0, 0.0, 0.1), (-2.2, 0.0,
            0.2), 0.32),
        ball(INK, (-0.1, 0.0, 0.32), (0.8, 0.5, 0.14)), rod(Material(WOOD_BROWN), (0.3, -1.2,
            0.3), (0.3, 1.2, 0.7), 0.025),
        *(ball(RED_PAINT, (0.3, s * 1.25, 0.5 + 0.22 * s), (0.06, 0.5, 0.2)) for s in (1, -1))],
            ("sea kayak",), goes=("water", "sail", 1.5)),
    thing("catamaran", (PALE.colour,), lambda p: [
        *(part for s in (1.0, -1.0) for part in (
            box(p, (-0.4, s * 1.8, 0.2), (4.6, 0.6, 0.8)), spike(p, (1.8, s * 1.8, 0.25), (4.2,
                s * 1.8, 0.45), 0.38))),
        box(INK, (-0.6, 0.0, 0.62), (3.4, 3.2, 0.10)), box(p, (-0.8, 0.0, 1.0), (2.0, 2.2, 0.7)),
            box(_PANE, (0.22, 0.0, 1.05), (.05, 1.9, .35)),
        rod(SILVER, (0.4, 0.0, 0.6), (0.4, 0.0, 8.0), 0.07), rod(SILVER, (0.4, 0.0, 1.7), (-2.6,
            0.0, 1.7), 0.05),
        plank(_CANVAS, (-1.0, 0.0, 1.8), (0.2, 0.0, 7.8), chord=(2.4, 0.0, 0.4), thickness=(0.0,
            0.05, 0.0)),
        plank(_CANVAS, (1.9, 0.0, 1.0), (0.6, 0.0, 6.2), chord=(1.6, 0.0, 0.0), thickness=(0.0,
            0.04, 0.0))],
        (), goes=("water", "sail", 5.0)),
    thing("gondola", ((0.02, 0.02, 0.022),), lambda p: [
        *_hull(p, 7.0, 1.1, 0.6), limb(p, (3.3, 0.0, 0.3), (3.9, 0.0, 1.5), 0.12), limb(p, (-2.7,
            0.0, 0.3), (-3.6, 0.0, 1.0), 0.12),
        box(RED_PAINT, (-0.4, 0.0, 0.5), (1.0, 0.9, 0.35)), rod(Material(WOOD_BROWN), (-2.4, 0.4,
            1.3), (-3.2, 1.4, 0.0), 0.03)],
        ("venetian gondola",), goes=("water", "sail", 1.2)),
    thing("cargo ship", ((0.40, 0.05, 0.04), (0.04, 0.10, 0.24)), lambda p: [
        box(p, (-2.0, 0.0, 1.6), (56.0, 9.0, 5.0)), plank(p, (25.0, 0.0, 1.0), (32.0, 0.0, 2.6),
            chord=(0.0, 4.5, 0.0), thickness=(2.0, 0.0, 5.0)),
        *(box((RED_PAINT, BLUE_PAINT, YELLOW_PAINT, Material((0.06, 0.30, 0.10)),
            GREY_PLASTIC)[(x * 2 + z) % 5], (
            -12.0 + 6.2 * x, 0.0, 5.4 + 2.4 * z), (5.8, 8.0,
                2.3)) for x in range(6) for z in range(3)),
        box(PALE, (-24.0, 0.0, 8.0), (6.0, 8.0, 9.0)), box(_PANE, (-20.9, 0.0, 11.3), (0.2, 7.4,
            1.2)), post(p, (-26.0, 0.0, 13.6), (2.4, 2.4, 3.0))],
        ("container ship", "freighter"), goes=("water", "sail", 6.0)),
    thing("cruise ship", (PALE.colour,), lambda p: [
        box(p, (-2.0, 0.0, 2.0), (60.0, 10.0, 6.0)), plank(p, (27.0, 0.0, 1.6), (35.0, 0.0, 3.6),
            chord=(0.0, 5.0, 0.0), thickness=(2.0, 0.0, 6.0)),
        *(box(p, (-4.0 - k, 0.0, 6.2 + 2.4 * k), (48.0 - 5.0 * k, 9.0, 2.2)) for k in range(4)),
        *(box(_PANE, (-4.0 - k, s * 4.52, 6.3 + 2.4 * k), (45.0 - 5.0 * k, 0.05,
            0.9)) for k in range(4) for s in (1, -1)),
        box(BLUE_PAINT, (-2.0, 0.0, 0.4), (60.2, 10.1, 0.6)), *(post(RED_PAINT, (x, 0.0, 16.8),
            (3.0, 3.0, 4.0)) for x in (-12.0, -4.0))],
        ("ocean liner", "liner"), goes=("water", "sail", 7.0)),
)  # fmt: skip


def _wings(p: Material, x: float, span: float, chord: float, z: float) -> ModelPart:
    return box(p, (x, 0.0, z), (chord, span, 0.14))


def _propeller(at: Point, reach: float) -> Moving:
    x, y, z = at
    return Moving(lambda p: [box(INK, at, (0.06, 0.16, 2.0 * reach)), ball(RED_PAINT, at, (0.4,
        0.3, 0.3))],
                  spinning("x", 9.3, (x, y, z)))  # fmt: skip


_AIR = placed("sky", (
    thing("propeller plane", (PALE.colour, YELLOW_PAINT.colour), lambda p: [
        limb(p, (-3.4, 0.0, 0.2), (2.2, 0.0, 0.0), 0.62), ball(_PANE, (0.7, 0.0, 0.45), (1.5,
            1.0, 0.8)),
        _wings(p, 0.5, 10.0, 1.4, 0.78), _wings(p, -3.5, 3.2, 0.8, 0.35), plank(p, (-3.5, 0.0,
            0.3), (-3.9, 0.0, 1.7), chord=(
            0.9, 0.0, 0.0), thickness=(0.0, 0.1, 0.0)), *(box(RED_PAINT, (0.5, s * 4.4, 0.79),
                (1.42, 0.8, 0.15)) for s in (1, -1)),
        *(rod(SILVER, (0.5, s * 0.5, -0.3), (0.5, s * 2.4, 0.75), 0.05) for s in (1, -1)),
        *(rod(IRON, (0.6, s * 0.4, -0.3), (0.6, s * 1.0, -1.1), 0.05) for s in (1, -1)),
            *(ball(INK, (0.6, s * 1.0, -1.2), (.5, .2, .5)) for s in (1, -1))],
        ("light aircraft", "small plane", "cessna", "prop plane", "crop duster"),
            moving=(_propeller((2.75, 0.0, 0.0), 1.0),), goes=("air", "fly", 30.0)),
    thing("biplane", (RED_PAINT.colour, YELLOW_PAINT.colour), lambda p: [
        limb(p, (-3.0, 0.0, 0.1), (1.8, 0.0, 0.0), 0.55), _wings(p, 0.6, 8.0, 1.3, -0.35),
            _wings(p, 0.8, 8.4, 1.3, 1.35),
        *(rod(Material(WOOD_BROWN), (x, y, -0.35), (x + 0.2, y, 1.35), 0.05) for x in (0.2,
            0.9) for y in (2.8, -2.8, 0.6, -0.6)),
        _wings(p, -2.9, 2.8, 0.8, 0.2), plank(p, (-2.9, 0.0, 0.1), (-3.3, 0.0, 1.4), chord=(0.9,
            0.0, 0.0), thickness=(0.0, 0.1, 0.0)),
        ball(INK, (-0.5, 0.0, 0.5), (0.8, 0.5, 0.3)), *(ball(INK, (0.9, s * 0.8, -1.2), (0.6,
            0.2, 0.6)) for s in (1, -1)),
        *(rod(IRON, (0.9, s * 0.4, -0.4), (0.9, s * 0.8, -1.2), 0.05) for s in (1, -1))],
        ("double decker plane", "stunt plane"), moving=(_propeller((2.25, 0.0, 0.0), 1.0),),
            goes=("air", "fly", 25.0)),
    thing("fighter jet", ((0.30, 0.32, 0.34),), lambda p: [
        limb(p, (-4.5, 0.0, 0.0), (2.5, 0.0, 0.0), 0.7), spike(p, (2.2, 0.0, 0.0), (6.2, 0.0,
            -0.1), 0.55),
        ball(_PANE, (2.0, 0.0, 0.6), (2.2, 0.8, 0.8)), *(plank(p, (-1.6, s * 0.4, 0.0), (-3.2,
            s * 4.2, 0.0), chord=(3.6, 0.0, 0.0), thickness=(
            0.0, 0.0, 0.14)) for s in (1, -1)), *(plank(p, (-4.2, s * 0.6, 0.2), (-5.2, s * 1.0,
                2.2), chord=(1.4, 0.0, 0.0), thickness=(
                0.0, 0.12, 0.0)) for s in (1, -1)), *(rod(glowing((1.0, 0.5, 0.1), 2.0), (-5.3,
                    s * 0.4, 0.0), (-4.9, s * 0.4, 0.0), 0.32) for s in (1, -1))],
        ("fighter plane", "military jet", "warplane", "jet fighter"), goes=("air",
            "fly", 60.0)),
    thing("glider", (PALE.colour,), lambda p: [
        limb(p, (-3.6, 0.0, 0.1), (1.6, 0.0, 0.0), 0.34), ball(_PANE, (0.9, 0.0, 0.22), (1.4,
            0.5, 0.45)), _wings(p, 0.3, 15.0, 0.8, 0.22),
        _wings(p, -3.9, 2.6, 0.5, 1.05), plank(p, (-3.6, 0.0, 0.1), (-3.9, 0.0, 1.1), chord=(0.7,
            0.0, 0.0), thickness=(0.0, 0.08, 0.0))],
        ("sailplane",), goes=("air", "fly", 20.0)),
    thing("hang glider", (RED_PAINT.colour, BLUE_PAINT.colour), lambda p: [
        *(plank(p if s > 0 else YELLOW_PAINT, (0.3, s * 0.05, 0.9), (-1.0, s * 4.5, 0.7),
            chord=(1.8, 0.0, 0.0), thickness=(0.0, 0.0, 0.05)) for s in (1, -1)),
        limb(BLUE_PAINT, (-1.4, 0.0, -0.3), (0.2, 0.0, -0.2), 0.2), ball(YELLOW_PAINT, (0.4, 0.0,
            -0.1), (0.3, 0.26, 0.28)),
        *(rod(SILVER, (0.0, 0.0, 0.85), (0.3, s * 0.6, -0.5), 0.03) for s in (1, -1)),
            rod(SILVER, (0.3, -0.6, -0.5), (0.3, 0.6, -0.5), 0.03)],
        ("deltaplane",), goes=("air", "fly", 9.0)),
    thing("paraglider", (YELLOW_PAINT.colour, RED_PAINT.colour), lambda p: [
        *(box(p if k % 2 else PALE, (0.0, 4.2 * math.sin(0.16 * (k - 4.5)) * 1.25,
            5.2 * math.cos(0.16 * (k - 4.5)) - 2.2), (1.8, 0.85, 0.22))
          for k in range(10)), *(rod(INK, (0.0, s * 3.4, 1.9), (0.0, s * 0.2, -1.6),
              0.02) for s in (1, -1)),
        *(rod(INK, (0.0, s * 1.5, 2.8), (0.0, s * 0.1, -1.6), 0.02) for s in (1, -1)),
            limb(BLUE_PAINT, (0.0, 0.0, -2.2), (0.0, 0.0, -1.6), 0.22),
        ball(RED_PAINT, (0.0, 0.0, -1.35), (0.26, 0.26, 0.28)), limb(INK, (0.1, 0.0, -2.3), (0.7,
            0.0, -2.4), 0.13)],
        ("parasail",), goes=("air", "fly", 7.0)),
    thing("airship", (SILVER.colour,), lambda p: [
        ball(p, (0.0, 0.0, 0.0), (20.0, 5.4, 5.4)), box(GREY_PLASTIC, (1.5, 0.0, -3.0), (4.0,
            1.2, 0.9)), *(plank(RED_PAINT, (-7.5, 0.0, 0.0), (
            -9.5, y, z), chord=(2.4, 0.0, 0.0), thickness=(0.0, 0.1 + 0.1 * abs(z),
                0.1 + 0.1 * abs(y))) for y, z in ((0.0, 3.4), (0.0, -3.4), (3.4, 0.0), (-3.4,
                    0.0))),
        *(box(RED_PAINT, (0.0, s * 2.62, 0.0), (8.0, 0.14, 0.8)) for s in (1, -1))], ("blimp",
            "zeppelin", "dirigible"), goes=("air", "fly", 8.0)),
))  # fmt: skip

NOUNS = (*_WATER, *_AIR)

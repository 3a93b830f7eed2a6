"""Vehicles told by their body: ambulance, double-decker, tram, dump truck, carriage, catamaran."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import HEADLIGHT, TAILLIGHT, Material, glowing
from texvent.scenes.models.objects.figures import (
    Moving,
    placed,
    spinning,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLUE_PAINT,
    BRASS,
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
from texvent.scenes.models.vehicles.wheels import Wheel

_PANE = Material((0.05, 0.08, 0.11))
_BLUE_LAMP = glowing((0.05, 0.15, 1.0), 3.0)
_CANVAS = Material((0.80, 0.78, 0.72))


def _wheels(
    xs: tuple[float, ...], half: float, radius: float, wide: float = 0.26
) -> tuple[Wheel, ...]:
    return tuple(Wheel((x, s * half, radius), radius, wide) for x in xs for s in (1.0, -1.0))


def _lamps(front: float, half: float, high: float, back: float) -> list[ModelPart]:
    return [
        *(ball(HEADLIGHT, (front, s * half, high), (0.10, 0.26, 0.20)) for s in (1.0, -1.0)),
        *(box(TAILLIGHT, (back, s * half, high), (0.05, 0.22, 0.14)) for s in (1.0, -1.0)),
    ]


def _panes(
    x0: float, x1: float, count: int, half: float, low: float, tall: float
) -> list[ModelPart]:
    """A row of windows on both sides."""
    step = (x1 - x0) / count
    return [box(_PANE, (x0 + step * (k + 0.5), s * half, low + 0.5 * tall), (0.84 * step, 0.03,
        tall))
            for k in range(count) for s in (1.0, -1.0)]  # fmt: skip


def _cab(p: Material, x: float, wide: float, low: float, tall: float) -> list[ModelPart]:
    """A lorry's cab with its windscreen at the front."""
    return [
        box(p, (x, 0.0, low + 0.5 * tall), (1.7, wide, tall)),
        box(_PANE, (x + 0.86, 0.0, low + 0.72 * tall), (0.04, 0.86 * wide, 0.38 * tall)),
        *(box(_PANE, (x + 0.1, s * 0.5 * wide, low + 0.72 * tall), (0.9, 0.04,
            0.36 * tall)) for s in (1, -1)),
        box(IRON, (x + 0.9, 0.0, low + 0.2), (0.10, wide, 0.24)),
    ]  # fmt: skip


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


_LAND = placed("road", (
    thing("ambulance", (PALE.colour,), lambda p: [
        box(p, (-0.8, 0.0, 1.55), (3.6, 2.1, 2.2)), box(p, (1.55, 0.0, 1.0), (1.5, 2.0, 1.1)),
        plank(_PANE, (1.9, 0.0, 1.5), (1.15, 0.0, 2.2), chord=(0.0, 1.8, 0.0), thickness=(0.05,
            0.0, 0.05)),
        *(box(RED_PAINT, (-0.4, s * 1.055, 1.15), (4.4, 0.02, 0.28)) for s in (1.0, -1.0)),
        *(box(RED_PAINT, (-1.2, s * 1.06, 1.95), w) for s in (1.0, -1.0) for w in ((0.8, .02,
            .24), (.24, .02, .8))),
        *(box(_PANE, (1.15, s * 1.0, 1.65), (0.7, 0.04, 0.5)) for s in (1.0, -1.0)),
        box(_BLUE_LAMP, (0.75, 0.0, 2.75), (0.35, 1.5, 0.2)), *_lamps(2.3, 0.75, 0.85, -2.6)],
        ("rescue vehicle",), wheels=_wheels((1.5, -1.6), 0.95, 0.38), goes=("ground", "drive",
            12.0)),
    thing("double-decker bus", (RED_PAINT.colour,), lambda p: [
        box(p, (0.0, 0.0, 2.35), (9.0, 2.4, 4.0)), *_panes(-4.2, 4.2, 7, 1.2, 1.3, 0.8),
        *_panes(-4.2, 4.2, 7, 1.2, 2.95, 0.8), box(_PANE, (4.5, 0.0, 1.75), (0.05, 2.1, 1.1)),
        box(_PANE, (4.5, 0.0, 3.4), (0.05, 2.1, 0.8)), box(PALE, (4.52, 0.0, 2.55), (0.04, 1.2,
            0.35)),
        *(box(PALE, (0.0, s * 1.21, 2.5), (9.0, 0.02, 0.12)) for s in (1.0, -1.0)), *_lamps(4.5,
            0.9, 0.8, -4.5)],
        ("double decker", "double decker bus", "london bus"), plurals=("double-decker buses",
            "double deckers"),
        wheels=_wheels((2.8, -2.6), 1.05, 0.5), goes=("ground", "drive", 10.0)),
    thing("tram", ((0.60, 0.45, 0.05), (0.05, 0.25, 0.12)), lambda p: [
        *(part for x in (-4.6, 4.6) for part in (
            box(p, (x, 0.0, 1.3), (8.6, 2.4, 1.4)), box(PALE, (x, 0.0, 2.75), (8.6, 2.4, 1.5)))),
        box(INK, (0.0, 0.0, 1.9), (0.7, 2.1, 2.6)), *_panes(-8.6, -0.6, 6, 1.2, 2.1, 0.9),
        *_panes(0.6, 8.6, 6, 1.2, 2.1, 0.9), *(box(_PANE, (s * 8.9, 0.0, 2.5), (0.06, 2.1,
            1.0)) for s in (1, -1)),
        *(box(INK, (x, 0.0, 0.35), (2.2, 1.8, 0.6)) for x in (-6.0, 6.0)),
        rod(IRON, (-3.0, 0.0, 3.5), (-2.0, 0.0, 4.6), 0.05), rod(IRON, (-2.0, 0.0, 4.6), (-3.0,
            0.0, 5.4), 0.05),
        rod(IRON, (-3.0, -0.8, 5.4), (-3.0, 0.8, 5.4), 0.05), *_lamps(8.92, 0.85, 1.1, -8.92)],
        ("streetcar", "trolley car", "tramcar"), goes=("ground", "drive", 8.0)),
    thing("dump truck", (YELLOW_PAINT.colour, BLUE_PAINT.colour), lambda p: [
        *_cab(p, 2.2, 2.2, 0.9, 1.9), box(IRON, (-0.6, 0.0, 0.85), (5.0, 1.0, 0.3)),
        plank(toned(p, 0.8), (1.1, 0.0, 1.25), (-3.2, 0.0, 1.15), chord=(0.0, 2.4, 0.0),
            thickness=(0.0, 0.0, 0.14)),
        *(plank(p, (1.1, s * 1.2, 1.75), (-3.2, s * 1.2, 1.65), chord=(0.0, 0.0, 1.0),
            thickness=(0.0, 0.1, 0.0))
          for s in (1.0, -1.0)), box(p, (1.15, 0.0, 1.95), (0.12, 2.4, 1.4)),
        ball(Material((0.32, 0.24, 0.16)), (-1.0, 0.0, 2.0), (3.6, 2.1, 1.5)), *_lamps(3.1, 0.8,
            1.2, -3.2)],
        ("tipper", "tipper truck", "dumper"), wheels=_wheels((2.2, -1.2, -2.4), 1.0, 0.5),
            goes=("ground", "drive", 8.0)),
    thing("garbage truck", ((0.10, 0.35, 0.12), (0.75, 0.35, 0.02)), lambda p: [
        *_cab(PALE, 2.6, 2.2, 0.7, 2.0), box(p, (-0.6, 0.0, 1.95), (4.4, 2.4, 2.3)),
        plank(toned(p, 0.7), (-2.7, 0.0, 2.0), (-3.8, 0.0, 1.4), chord=(0.0, 2.3, 0.0),
            thickness=(0.9, 0.0, 1.8)),
        *(box(toned(p, 0.6), (x, s * 1.21, 1.95), (0.12, 0.05, 2.2)) for x in (-2.0, -0.6,
            0.8) for s in (1, -1)),
        *_lamps(3.5, 0.8, 1.0, -3.6)], ("bin lorry", "refuse truck", "trash truck"),
        wheels=_wheels((2.5, -1.4), 1.0, 0.5), goes=("ground", "drive", 8.0)),
    thing("tanker truck", (PALE.colour, SILVER.colour), lambda p: [
        *_cab(RED_PAINT, 3.6, 2.2, 0.8, 2.0), rod(p, (-4.2, 0.0, 2.1), (2.4, 0.0, 2.1), 1.1),
        box(IRON, (-0.8, 0.0, 0.9), (7.0, 1.0, 0.25)), *(rod(RED_PAINT, (x, 0.0, 2.1), (x + 0.1,
            0.0, 2.1), 1.13)
                                                          for x in (-3.0, -0.9, 1.2)),
                        *_lamps(4.5, 0.8, 1.1, -4.2)],
        ("tank truck", "fuel truck", "oil truck"), wheels=_wheels((3.5, -2.2, -3.4), 1.0, 0.5),
            goes=("ground", "drive", 9.0)),
    thing("school bus", ((0.80, 0.48, 0.02),), lambda p: [
        box(p, (-0.7, 0.0, 1.75), (7.4, 2.4, 2.3)), box(p, (3.7, 0.0, 1.15), (1.6, 2.1, 1.1)),
        *_panes(-4.2, 2.8, 8, 1.2, 1.95, 0.65), box(_PANE, (3.02, 0.0, 2.25), (0.05, 2.1, 0.9)),
        *(box(INK, (-0.7, s * 1.21, z), (7.4, 0.02, 0.07)) for s in (1.0, -1.0) for z in (1.15,
            1.6)),
        *_lamps(4.5, 0.75, 1.0, -4.4)], (), plurals=("school buses",), wheels=_wheels((3.4,
            -2.4), 1.0, 0.48),
        goes=("ground", "drive", 9.0)),
    thing("racing car", (RED_PAINT.colour, BLUE_PAINT.colour), lambda p: [
        box(p, (-0.4, 0.0, 0.40), (2.4, 0.7, 0.40)), spike(p, (0.8, 0.0, 0.40), (2.6, 0.0, 0.28),
            0.26),
        *(box(p, (-0.5, s * 0.6, 0.36), (1.5, 0.5, 0.34)) for s in (1.0, -1.0)), box(p, (2.5,
            0.0, 0.20), (0.5, 1.7, 0.05)),
        box(p, (-2.0, 0.0, 0.85), (0.5, 1.2, 0.06)), *(box(p, (-2.0, s * 0.6, 0.7), (0.55, 0.05,
            0.5)) for s in (1, -1)),
        spike(p, (-0.4, 0.0, 0.75), (-1.8, 0.0, 0.5), 0.26), ball(YELLOW_PAINT, (-0.1, 0.0,
            0.72), (0.32, 0.3, 0.3)),
        ball(_PANE, (0.05, 0.0, 0.72), (0.12, 0.26, 0.12))],
        ("formula one car", "race car", "go kart", "kart"),
        wheels=_wheels((1.6, -1.6), 0.75, 0.34, 0.34), goes=("ground", "drive", 25.0)),
    thing("steamroller", (YELLOW_PAINT.colour,), lambda p: [
        box(p, (-0.6, 0.0, 1.3), (2.2, 1.4, 0.8)), box(p, (0.2, 0.0, 2.6), (2.0, 1.5, 0.1)),
        *(rod(IRON, (x, y, 1.6), (x, y, 2.6), 0.04) for x in (-0.6, 1.0) for y in (0.65, -0.65)),
        box(IRON, (1.4, 0.0, 1.3), (1.4, 0.3, 0.2)), box(INK, (-0.2, 0.0, 1.9), (0.5, 0.5, 0.5)),
        *(box(p, (1.9, s * 0.85, 1.0), (1.0, 0.1, 0.3)) for s in (1.0, -1.0))],
        ("road roller", "steam roller", "compactor"), wheels=(Wheel((1.9, 0.0, 0.75), 0.75, 1.5),
            *_wheels(
            (-1.0,), 0.7, 0.6, 0.4)), goes=("ground", "drive", 1.5)),
    thing("bulldozer", (YELLOW_PAINT.colour,), lambda p: [
        box(p, (-0.3, 0.0, 1.3), (2.4, 1.2, 0.8)), box(p, (-0.9, 0.0, 2.1), (1.1, 1.2, 0.9)),
        box(_PANE, (-0.9, 0.0, 2.2), (1.13, 1.23, 0.5)), *(box(INK, (-0.2, s * 0.95, 0.5), (3.2,
            0.5, 1.0)) for s in (1, -1)),
        *(box(p, (0.9, s * 0.95, 0.6), (2.2, 0.14, 0.2)) for s in (1, -1)),
        plank(IRON, (2.1, 0.0, 0.1), (2.0, 0.0, 1.3), chord=(0.0, 3.0, 0.0), thickness=(0.16,
            0.0, 0.05)),
        rod(IRON, (0.5, 0.4, 1.7), (0.5, 0.4, 2.6), 0.08)], ("crawler dozer",), goes=("ground",
            "drive", 2.0)),
    thing("combine harvester", ((0.55, 0.05, 0.02), (0.08, 0.30, 0.06)), lambda p: [
        box(p, (-0.8, 0.0, 2.1), (4.4, 2.6, 1.9)), box(_PANE, (2.0, 0.0, 2.6), (1.2, 1.6, 1.3)),
        box(p, (2.0, 0.0, 3.3), (1.4, 1.8, 0.14)), plank(toned(p, 0.7), (2.0, 0.0, 1.4), (3.2,
            0.0, 0.6), chord=(
            0.0, 1.2, 0.0), thickness=(0.1, 0.0, 0.4)), box(YELLOW_PAINT, (3.5, 0.0, 0.5), (0.5,
                5.0, 0.6)),
        limb(p, (-1.0, 1.2, 3.0), (-1.0, 3.2, 3.4), 0.16)], ("combine", "harvester"),
        wheels=(*_wheels((1.6,), 1.3, 0.85, 0.5), *_wheels((-2.2,), 1.2, 0.5, 0.3)),
            goes=("ground", "drive", 2.0),
        moving=(Moving(lambda p: [box(YELLOW_PAINT, (4.0 + 0.5 * math.cos(a), 0.0,
            0.85 + 0.5 * math.sin(a)), (
            0.08, 4.8, 0.08)) for a in (0.0, 1.26, 2.51, 3.77, 5.03)], spinning("y", 0.5, (4.0,
                0.0, 0.85))),)),
    thing("carriage", ((0.10, 0.02, 0.02), (0.02, 0.03, 0.10)), lambda p: [
        box(p, (-0.2, 0.0, 1.5), (1.7, 1.3, 1.2)), box(toned(p, 1.5), (-0.2, 0.0, 2.15), (1.9,
            1.5, 0.12)),
        *(box(_PANE, (-0.2, s * 0.66, 1.75), (0.9, 0.03, 0.5)) for s in (1, -1)), box(BRASS,
            (-0.2, 0.0, 1.35), (1.72, 1.34, .06)),
        box(p, (1.2, 0.0, 1.45), (0.5, 1.0, 0.12)), box(p, (0.95, 0.0, 1.75), (0.08, 1.0, 0.6)),
        *(ball(glowing((1.0, 0.7, 0.3), 1.5), (0.75, s * 0.75, 1.9), (0.16, 0.16,
            0.26)) for s in (1, -1)),
        *(rod(Material(WOOD_BROWN), (1.3, s * 0.35, 0.8), (3.2, s * 0.35, 0.9),
            0.04) for s in (1, -1))],
        ("horse carriage", "coach and horses", "stagecoach", "horse drawn carriage", "buggy"),
        wheels=(*_wheels((-0.9,), 0.8, 0.62, 0.08), *_wheels((1.2,), 0.7, 0.48, 0.08)),
            goes=("ground", "roll", 2.5)),
    thing("covered wagon", (WOOD_BROWN,), lambda p: [
        box(p, (0.0, 0.0, 1.0), (3.0, 1.4, 0.5)), rod(_CANVAS, (-1.5, 0.0, 1.5), (1.5, 0.0, 1.5),
            0.85),
        rod(INK, (1.5, 0.0, 1.55), (1.52, 0.0, 1.55), 0.6)], ("pioneer wagon", "ox cart",
            "horse cart"),
        wheels=_wheels((1.0, -1.0), 0.8, 0.55, 0.1), goes=("ground", "roll", 1.5)),
    thing("rickshaw", ((0.05, 0.25, 0.10), YELLOW_PAINT.colour), lambda p: [
        box(p, (-0.3, 0.0, 0.8), (1.5, 1.2, 0.8)), box(INK, (-0.2, 0.0, 1.85), (1.9, 1.25, 0.10)),
        *(rod(INK, (x, y, 1.1), (x, y, 1.85), 0.03) for x in (-0.9, 0.6) for y in (0.58, -0.58)),
        spike(p, (0.5, 0.0, 0.75), (1.4, 0.0, 0.6), 0.45), box(_PANE, (0.65, 0.0, 1.45), (0.04,
            1.1, 0.6)),
        ball(HEADLIGHT, (1.25, 0.0, 0.75), (0.14, 0.2, 0.2))], ("auto rickshaw", "tuk tuk",
            "tricycle taxi"),
        wheels=(Wheel((1.0, 0.0, 0.26), 0.26, 0.14), *_wheels((-0.7,), 0.55, 0.26, 0.14)),
            goes=("ground", "drive", 7.0)),
    thing("steam locomotive", ((0.03, 0.03, 0.035), (0.05, 0.18, 0.08)), lambda p: [
        rod(p, (-1.5, 0.0, 2.2), (4.2, 0.0, 2.2), 0.95), rod(INK, (4.2, 0.0, 2.2), (4.4, 0.0,
            2.2), 0.85),
        post(INK, (3.5, 0.0, 3.6), (0.6, 0.6, 1.2)), ball(BRASS, (1.5, 0.0, 3.2), (0.8, 0.8, 0.7)),
        box(p, (-2.6, 0.0, 2.6), (2.2, 2.5, 2.6)), box(INK, (-2.6, 0.0, 4.0), (2.6, 2.8, 0.14)),
        *(box(_PANE, (-2.6, s * 1.26, 3.1), (1.1, 0.03, 0.8)) for s in (1, -1)), box(RED_PAINT,
            (1.0, 0.0, 1.05), (7.0, 2.2, 0.2)),
        plank(RED_PAINT, (4.4, 0.0, 0.9), (5.3, 0.0, 0.15), chord=(0.0, 2.0, 0.0),
            thickness=(0.3, 0.0, 0.3)),
        ball(HEADLIGHT, (4.4, 0.0, 3.1), (0.25, 0.4, 0.4)), box(INK, (-5.4, 0.0, 1.9), (2.8, 2.3,
            1.6)),
        *(rod(SILVER, (-1.2, s * 1.2, 0.75), (3.0, s * 1.2, 0.75), 0.07) for s in (1, -1))],
        ("steam train", "steam engine"), wheels=(*_wheels((-1.2, 0.6, 2.4), 0.95, 0.72, 0.2),
            *_wheels(
            (-5.4,), 0.95, 0.45, 0.2)), goes=("ground", "drive", 12.0)),
))  # fmt: skip

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
        ("trimaran",), goes=("water", "sail", 5.0)),
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
        ("container ship", "freighter", "tanker", "oil tanker"), goes=("water", "sail", 6.0)),
    thing("cruise ship", (PALE.colour,), lambda p: [
        box(p, (-2.0, 0.0, 2.0), (60.0, 10.0, 6.0)), plank(p, (27.0, 0.0, 1.6), (35.0, 0.0, 3.6),
            chord=(0.0, 5.0, 0.0), thickness=(2.0, 0.0, 6.0)),
        *(box(p, (-4.0 - k, 0.0, 6.2 + 2.4 * k), (48.0 - 5.0 * k, 9.0, 2.2)) for k in range(4)),
        *(box(_PANE, (-4.0 - k, s * 4.52, 6.3 + 2.4 * k), (45.0 - 5.0 * k, 0.05,
            0.9)) for k in range(4) for s in (1, -1)),
        box(BLUE_PAINT, (-2.0, 0.0, 0.4), (60.2, 10.1, 0.6)), *(post(RED_PAINT, (x, 0.0, 16.8),
            (3.0, 3.0, 4.0)) for x in (-12.0, -4.0))],
        ("ocean liner", "liner", "ferry", "passenger ship"), goes=("water", "sail", 7.0)),
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
        ("fighter plane", "military jet", "warplane", "jet fighter", "fighter"), goes=("air",
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

NOUNS = (*_LAND, *_WATER, *_AIR)

"""Trucks, buses, machines on wheels, carriages and a locomotive, told by their body."""

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
    INK,
    IRON,
    PALE,
    RED_PAINT,
    SILVER,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, limb, plank, post, rod, spike
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


NOUNS = placed("road", (
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
        ("formula one car", "race car"),
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
            0.08, 4.8, 0.08)) for a in (0.0, 1.26, 2.51, 3.77, 5.03)], spinning("y", 0.4, (4.0,
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
        rod(INK, (1.5, 0.0, 1.55), (1.52, 0.0, 1.55), 0.6)], ("pioneer wagon",),
        wheels=_wheels((1.0, -1.0), 0.8, 0.55, 0.1), goes=("ground", "roll", 1.5)),
    thing("rickshaw", ((0.05, 0.25, 0.10), YELLOW_PAINT.colour), lambda p: [
        box(p, (-0.3, 0.0, 0.8), (1.5, 1.2, 0.8)), box(INK, (-0.2, 0.0, 1.85), (1.9, 1.25, 0.10)),
        *(rod(INK, (x, y, 1.1), (x, y, 1.85), 0.03) for x in (-0.9, 0.6) for y in (0.58, -0.58)),
        spike(p, (0.5, 0.0, 0.75), (1.4, 0.0, 0.6), 0.45), box(_PANE, (0.65, 0.0, 1.45), (0.04,
            1.1, 0.6)),
        ball(HEADLIGHT, (1.25, 0.0, 0.75), (0.14, 0.2, 0.2))], ("tricycle taxi",),
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

"""What corridors, airports, stations, cafes outdoors, driveways and car washes are known by."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import STEEL, Material, mottled, striped
from texvent.scenes.models.objects.figures import disc, placed, rectangle, thing, toned
from texvent.scenes.models.objects.palette import (
    BLUE_PAINT,
    BRASS,
    DARK_WOOD,
    INK,
    IRON,
    PALE,
    PALE_WOOD,
    SILVER,
    STEELY,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, limb, peak, post, rod

_BRISTLES = Material((0.03, 0.20, 0.65))


def _brush(x: float, y: float) -> list[ModelPart]:
    tufts = [
        limb(_BRISTLES, (x, y, z), (x + 0.5 * math.cos(a), y + 0.5 * math.sin(a), z), 0.09)
        for z in (0.5, 1.1, 1.7)
        for a in (0.0, 1.257, 2.513, 3.77, 5.03)
    ]
    return [post(toned(_BRISTLES, 0.7), (x, y, 1.1), (0.6, 0.6, 1.9)), *tufts]


def _wash_arch(p: Material) -> list[ModelPart]:
    """A portal over the lane, upright brushes at its sides and one above; it stands along x."""
    roller = [
        limb(_BRISTLES, (0.9, y, 2.5), (0.9 + 0.42 * math.cos(a), y, 2.5 + 0.42 * math.sin(a)),
             0.09)
        for y in (-0.9, 0.0, 0.9) for a in (0.0, 1.57, 3.14, 4.71)
    ]  # fmt: skip
    return [
        *(box(p, (0.9, 1.9 * s, 1.6), (0.9, 0.4, 3.2)) for s in (1.0, -1.0)),
        box(p, (0.9, 0.0, 3.1), (0.9, 4.2, 0.4)), box(YELLOW_PAINT, (0.9, 0.0, 3.35),
            (0.95, 4.25, 0.16)), rod(STEEL, (0.9, -1.7, 2.5), (0.9, 1.7, 2.5), 0.22), *roller,
        *_brush(-1.6, 1.75), *_brush(-1.6, -1.75),
        *(box(Material((0.20, 0.34, 0.40)), (0.0, 1.2 * s, 0.006), (6.0, 0.7, 0.01))
          for s in (1.0, -1.0)),
    ]  # fmt: skip


def _check_in(p: Material) -> list[ModelPart]:
    return [
        box(p, (0.0, 0.0, 0.55), (0.6, 1.3, 1.1)), box(PALE, (0.0, 0.0, 1.12), (0.7, 1.4, 0.05)),
        box(INK, (0.1, 1.1, 0.22), (1.2, 0.7, 0.30)), box(STEEL, (0.1, 1.1, 0.38),
            (1.2, 0.6, 0.02)), box(INK, (-0.1, 0.2, 1.34), (0.05, 0.42, 0.30)),
        *(rod(IRON, (-0.5, y, 0.0), (-0.5, y, 2.5), 0.04) for y in (0.6, -0.6)),
        box(BLUE_PAINT, (-0.45, 0.0, 2.4), (0.08, 1.6, 0.45)),
        *(box(PALE, (-0.40, y, 2.4), (0.02, 0.32, 0.2)) for y in (-0.5, 0.0, 0.5)),
    ]  # fmt: skip


def _flight_board(p: Material) -> list[ModelPart]:
    rows = [
        box(YELLOW_PAINT, (0.05, y, 2.75 - 0.16 * k), (0.01, wide, 0.06))
        for k in range(7)
        for y, wide in ((-0.95, 0.35), (-0.2, 0.75), (0.65, 0.4), (1.1, 0.2))
    ]
    return [box(p, (0.0, 0.0, 2.3), (0.08, 2.7, 1.4)), *rows,
            *(rod(IRON, (0.0, y, 0.0), (0.0, y, 1.6), 0.05) for y in (1.1, -1.1))]  # fmt: skip


def _lockers(p: Material) -> list[ModelPart]:
    return [
        part
        for k in range(6)
        for part in (
            box(toned(p, 1.0 + 0.15 * (k % 2)), (0.0, -1.0 + 0.4 * k, 0.95), (0.45, 0.39, 1.9)),
            box(INK, (0.23, -1.0 + 0.4 * k, 1.6), (0.01, 0.2, 0.02)),
            box(INK, (0.23, -1.0 + 0.4 * k, 1.54), (0.01, 0.2, 0.02)),
            box(SILVER, (0.24, -0.87 + 0.4 * k, 0.95), (0.02, 0.03, 0.12)),
        )
    ]


def _corridor_door(p: Material) -> list[ModelPart]:
    return [
        box(p, (0.0, 0.0, 1.02), (0.05, 0.92, 2.04)),
        *rectangle(PALE, (0.0, 1.05), (1.14, 2.16), 0.10, 0.10),
        *(box(toned(p, 0.75), (0.03, 0.0, z), (0.01, 0.6, 0.7)) for z in (0.55, 1.5)),
        ball(BRASS, (0.07, 0.36, 1.0), (0.07, 0.06, 0.06)), box(BRASS, (0.04, 0.0, 1.62),
            (0.02, 0.16, 0.09)),
    ]  # fmt: skip


def _terrace_table(p: Material) -> list[ModelPart]:
    chairs = [
        part
        for s in (1.0, -1.0)
        for part in (
            box(Material(PALE_WOOD), (0.0, 0.75 * s, 0.45), (0.42, 0.42, 0.04)),
            box(Material(PALE_WOOD), (0.0, 0.95 * s, 0.75), (0.42, 0.04, 0.55)),
            *(rod(IRON, (x, y * s, 0.0), (x, y * s, 0.45), 0.02)
              for x in (0.18, -0.18) for y in (0.57, 0.93)),
        )
    ]  # fmt: skip
    return [
        post(PALE, (0.0, 0.0, 0.74), (0.8, 0.8, 0.04)), rod(IRON, (0.0, 0.0, 0.0), (0.0, 0.0, 2.4),
            0.03), post(IRON, (0.0, 0.0, 0.02), (0.5, 0.5, 0.04)),
        peak(striped(p.colour, (0.80, 0.80, 0.78), 3.0), (0.0, 0.0, 2.35), (2.3, 2.3, 0.55)),
        post(PALE, (0.15, 0.2, 0.80), (0.08, 0.08, 0.09)), post(PALE, (-0.1, -0.2, 0.80),
            (0.08, 0.08, 0.09)), *chairs,
    ]  # fmt: skip


def _ticket_gates(p: Material) -> list[ModelPart]:
    return [
        part
        for y in (-1.5, -0.5, 0.5, 1.5)
        for part in (
            box(p, (0.0, y, 0.5), (1.5, 0.24, 1.0)), box(INK, (0.5, y, 1.02), (0.3, 0.2, 0.06)),
            box(Material((0.05, 0.5, 0.15), emission=1.2), (0.752, y, 0.85), (0.01, 0.14, 0.10)),
        )
    ] + [
        box(Material((0.55, 0.10, 0.06)), (0.0, y + 0.22 * s, 0.75), (0.05, 0.36, 0.55))
        for y in (-1.0, 0.0, 1.0)
        for s in (1.0, -1.0)
    ]  # fmt: skip


def _drive(p: Material) -> list[ModelPart]:
    """A paved strip from the road to a garage; it lies flat."""
    slab = mottled(p.colour, contrast=0.15)
    joints = [
        box(toned(p, 0.6), (-5.0 + 2.0 * k, 0.0, 0.011), (0.05, 4.4, 0.006)) for k in range(6)
    ]
    return [box(slab, (0.0, 0.0, 0.005), (12.0, 4.4, 0.01)), *joints,
            *(box(PALE, (0.0, 2.25 * s, 0.03), (12.0, 0.1, 0.06)) for s in (1.0, -1.0)),
    ]  # fmt: skip


def _garage_front(p: Material) -> list[ModelPart]:
    return [
        box(p, (-2.5, 0.0, 1.5), (5.0, 4.0, 3.0)), box(Material(DARK_WOOD), (-2.5, 0.0, 3.06),
            (5.4, 4.4, 0.16)),
        *(box(PALE, (0.03, 0.0, 0.3 + 0.48 * k), (0.05, 2.9, 0.45)) for k in range(5)),
        *(box(toned(PALE, 0.6), (0.06, -1.05 + 0.7 * k, 2.22), (0.02, 0.5, 0.28))
          for k in range(4)), disc(SILVER, (0.0, 0.9), 0.06, 0.08, 0.08),
    ]  # fmt: skip


NOUNS = (
    *placed("indoor", (
        thing("car wash arch", (STEELY,), _wash_arch, ("car wash gantry", "car wash portal")),
        thing("check-in desk", ((0.10, 0.16, 0.30),), _check_in, ("check-in counter",
              "airport counter")),
        thing("flight board", (INK.colour,), _flight_board, ("departure board", "arrivals board",
              "departures board", "flight information board")),
        thing("locker row", ((0.05, 0.18, 0.36), (0.40, 0.06, 0.05)), _lockers,
              ("row of lockers", "school locker", "locker")),
        thing("corridor door", ((0.42, 0.24, 0.11), WOOD_BROWN), _corridor_door, ("hotel door",
              "closed door")),
        thing("ticket gate", (STEELY,), _ticket_gates, ("ticket barrier", "fare gate", "turnstile",
              "security gate")),
    )),
    thing("terrace table", ((0.50, 0.05, 0.04), (0.04, 0.22, 0.12)), _terrace_table,
          ("table with a parasol", "patio table with umbrella")),
    thing("drive slab", ((0.40, 0.39, 0.37),), _drive, ("paved drive",)),
    thing("garage front", ((0.60, 0.55, 0.46),), _garage_front, ("garage with a door",
          "home garage", "garage door", "double garage")),
)  # fmt: skip
"""Nouns that mark halls and forecourts."""

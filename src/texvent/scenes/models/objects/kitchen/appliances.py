"""Kitchen and bathroom appliances: refrigerator, oven, sink, toilet, washing machine."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, glowing
from texvent.scenes.models.objects.figures import (
    Moving,
    bar,
    chain,
    disc,
    lathe,
    placed,
    ring,
    spinning,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLACK_PLASTIC,
    BREAD,
    CHINA,
    GREY_PLASTIC,
    INK,
    IRON,
    PALE,
    RED_PAINT,
    SILVER,
    SILVERY,
    WATER,
)
from texvent.scenes.models.shapes import ball, blade, box, limb, post, rod

_DOOR = Material((0.03, 0.03, 0.035))
_DIGITS = glowing((0.10, 0.75, 0.35), 1.0)

NOUNS = placed("indoor", (
    thing("refrigerator", (CHINA, SILVERY), lambda p: [
        box(p, (0.0, 0.0, 0.875), (0.62, 0.70, 1.75)),
        box(toned(p, 1.1), (0.32, 0.0, 0.60), (0.05, 0.69, 1.08)),
        box(toned(p, 1.1), (0.32, 0.0, 1.455), (0.05, 0.69, 0.57)),
        box(GREY_PLASTIC, (0.31, 0.0, 1.155), (0.03, 0.70, 0.02)),
        box(IRON, (0.37, -0.28, 0.82), (0.03, 0.03, 0.42)),
        box(IRON, (0.37, -0.28, 1.40), (0.03, 0.03, 0.30)),
        box(INK, (0.31, 0.0, 0.03), (0.02, 0.66, 0.06))], ("fridge", "icebox")),
    thing("oven", (CHINA, SILVERY), lambda p: [
        box(p, (0.0, 0.0, 0.44), (0.60, 0.60, 0.88)),
        box(BLACK_PLASTIC, (0.0, 0.0, 0.885), (0.60, 0.60, 0.012)),
        *(post(Material((0.12, 0.12, 0.13)), (x, y, 0.895), (0.19, 0.19, 0.012))
            for x in (0.14, -0.14) for y in (0.14, -0.14)),
        box(toned(p, 0.8), (0.31, 0.0, 0.78), (0.03, 0.58, 0.12)),
        *(disc(INK, (y, 0.78), 0.028, 0.03, 0.335) for y in (-0.22, -0.13, 0.13, 0.22)),
        box(_DIGITS, (0.325, 0.0, 0.78), (0.01, 0.10, 0.05)),
        box(toned(p, 0.9), (0.31, 0.0, 0.42), (0.03, 0.56, 0.52)),
        box(_DOOR, (0.32, 0.0, 0.40), (0.03, 0.44, 0.32)),
        bar(SILVER, (-0.25, 0.64), (0.25, 0.64), 0.03, 0.03, 0.36)],
        ("stove", "cooker", "kitchen stove", "cooking stove")),
    thing("microwave", (CHINA, SILVERY, (0.03, 0.03, 0.035)), lambda p: [
        box(p, (0.0, 0.0, 0.15), (0.36, 0.50, 0.28)),
        box(toned(p, 0.75), (0.185, -0.06, 0.15), (0.02, 0.36, 0.26)),
        box(_DOOR, (0.19, -0.07, 0.15), (0.02, 0.28, 0.19)),
        box(SILVER, (0.205, 0.10, 0.15), (0.02, 0.02, 0.22)),
        box(_DIGITS, (0.185, 0.18, 0.25), (0.02, 0.09, 0.04)),
        *(box(GREY_PLASTIC, (0.185, y, z), (0.02, 0.024, 0.024)) for y in (0.15, 0.185, 0.22)
            for z in (0.07, 0.11, 0.15, 0.19)),
        *(box(INK, (0.1, y, 0.005), (0.04, 0.04, 0.012)) for y in (-0.2, 0.2))],
        ("microwave oven",)),
    thing("toaster", (SILVERY, (0.55, 0.04, 0.03)), lambda p: [
        box(p, (0.0, 0.0, 0.095), (0.16, 0.28, 0.17)),
        rod(p, (-0.0, -0.14, 0.17), (0.0, 0.14, 0.17), 0.018, side_radius=0.08),
        *(box(INK, (x, 0.0, 0.183), (0.025, 0.22, 0.012)) for x in (0.035, -0.035)),
        *(box(BREAD, (x, 0.0, 0.20), (0.016, 0.17, 0.09)) for x in (0.035, -0.035)),
        box(BLACK_PLASTIC, (0.0, 0.0, 0.008), (0.15, 0.27, 0.016)),
        box(BLACK_PLASTIC, (0.0, 0.15, 0.12), (0.05, 0.03, 0.018)),
        disc(INK, (0.09, 0.06), 0.018, 0.02, 0.085)]),
    thing("coffee machine", ((0.03, 0.03, 0.035), (0.50, 0.04, 0.03)), lambda p: [
        box(p, (-0.07, 0.0, 0.17), (0.10, 0.22, 0.34)),
        box(p, (0.02, 0.0, 0.29), (0.28, 0.22, 0.10)),
        box(p, (0.03, 0.0, 0.015), (0.28, 0.22, 0.03)),
        post(Material((0.10, 0.04, 0.02)), (0.06, 0.0, 0.09), (0.13, 0.13, 0.11)),
        post(Material((0.34, 0.44, 0.48)), (0.06, 0.0, 0.165), (0.13, 0.13, 0.05)),
        *ring(INK, (0.06, 0.065, 0.11), (0.05, 0.05), 0.010, span=(-90.0, 90.0), pieces=6),
        box(SILVER, (0.165, 0.0, 0.29), (0.01, 0.16, 0.05)),
        ball(RED_PAINT, (0.17, 0.06, 0.29), (0.01, 0.018, 0.018))],
        ("coffee maker", "espresso maker", "espresso machine")),
    thing("blender", ((0.55, 0.04, 0.03), SILVERY), lambda p: [
        *lathe(p, [(0.0, 0.09), (0.12, 0.065)], 4),
        *lathe(Material((0.34, 0.46, 0.50)), [(0.12, 0.055), (0.34, 0.08)], 6),
        post(Material((0.50, 0.10, 0.20)), (0.0, 0.0, 0.17), (0.125, 0.125, 0.09)),
        post(INK, (0.0, 0.0, 0.355), (0.165, 0.165, 0.03)),
        *ring(INK, (0.0, 0.075, 0.24), (0.05, 0.08), 0.010, span=(-90.0, 90.0), pieces=6),
        disc(SILVER, (0.0, 0.05), 0.022, 0.02, 0.08)]),
    thing("sink", (CHINA, SILVERY), lambda p: [
        box(p, (0.0, 0.0, 0.78), (0.50, 0.62, 0.16)),
        box(toned(p, 0.45), (0.03, 0.0, 0.861), (0.34, 0.48, 0.006)),
        post(INK, (0.03, 0.0, 0.865), (0.05, 0.05, 0.004)),
        post(toned(p, 0.9), (-0.02, 0.0, 0.36), (0.19, 0.19, 0.72)),
        post(toned(p, 0.9), (-0.02, 0.0, 0.03), (0.27, 0.27, 0.06)),
        *chain(SILVER, [(-0.20, 0.0, 0.86), (-0.20, 0.0, 1.04), (-0.12, 0.0, 1.10),
            (-0.04, 0.0, 1.03)], 0.016),
        *(post(SILVER, (-0.20, y, 0.89), (0.04, 0.04, 0.06)) for y in (0.11, -0.11)),
        *(limb(SILVER, (-0.20, y, 0.93), (-0.14, y, 0.935), 0.010) for y in (0.11, -0.11))],
        ("washbasin", "wash basin", "basin", "bathroom sink")),
    thing("faucet", (SILVERY,), lambda p: [
        post(p, (0.0, 0.0, 0.01), (0.07, 0.07, 0.02)),
        post(p, (0.0, 0.0, 0.08), (0.04, 0.04, 0.16)),
        *chain(p, [(0.0, 0.0, 0.14), (0.03, -0.07, 0.21), (0.04, -0.14, 0.21),
            (0.04, -0.17, 0.15)], 0.016),
        limb(p, (0.0, 0.0, 0.17), (0.0, 0.08, 0.20), 0.012)], ("tap", "water tap")),
    thing("toilet", (CHINA,), lambda p: [
        *lathe(p, [(0.0, 0.13), (0.14, 0.10), (0.30, 0.16), (0.40, 0.18)], 7),
        ball(p, (0.10, 0.0, 0.37), (0.52, 0.38, 0.12)),
        post(toned(p, 0.85), (0.09, 0.0, 0.425), (0.48, 0.37, 0.03)),
        post(toned(p, 0.35), (0.11, 0.0, 0.436), (0.30, 0.22, 0.012)),
        box(p, (-0.24, 0.0, 0.58), (0.18, 0.42, 0.36)),
        box(toned(p, 0.9), (-0.24, 0.0, 0.775), (0.20, 0.44, 0.04)),
        limb(SILVER, (-0.14, 0.16, 0.70), (-0.12, 0.09, 0.69), 0.010),
        blade(toned(p, 0.92), (-0.13, 0.0, 0.44), (-0.11, 0.0, 0.86), chord=(0.0, 0.36, 0.0),
            thickness=(0.03, 0.0, 0.0))],
        ("toilet seat", "toilet bowl", "commode")),
    thing("bathtub", (CHINA,), lambda p: [
        box(p, (0.0, 0.0, 0.28), (0.75, 1.60, 0.50)),
        box(WATER, (0.0, 0.0, 0.532), (0.58, 1.40, 0.006)),
        *(ball(SILVER, (x, y, 0.03), (0.09, 0.09, 0.09)) for x in (0.3, -0.3) for y in (0.7, -0.7)),
        *chain(SILVER, [(-0.30, -0.6, 0.53), (-0.30, -0.6, 0.72), (-0.18, -0.6, 0.70)], 0.02)],
        ("tub", "bath tub")),
    thing("shower", (SILVERY,), lambda p: [
        rod(p, (-0.1, 0.0, 0.0), (-0.1, 0.0, 2.05), 0.02),
        *chain(p, [(-0.1, 0.0, 2.05), (0.05, 0.0, 2.12), (0.15, 0.0, 2.05)], 0.02),
        *lathe(p, [(2.02, 0.12), (2.06, 0.05)], 2),
        box(PALE, (0.0, 0.0, 0.05), (0.80, 0.80, 0.10)), disc(INK, (0.0, 1.1), 0.06, 0.06, -0.08)],
        ("shower head",)),
    thing("washing machine", (CHINA,), lambda p: [
        box(p, (0.0, 0.0, 0.425), (0.58, 0.60, 0.85)),
        disc(SILVER, (0.0, 0.40), 0.21, 0.05, 0.295), disc(_DOOR, (0.0, 0.40), 0.165, 0.06, 0.30),
        box(toned(p, 0.75), (0.295, 0.0, 0.78), (0.02, 0.58, 0.10)),
        disc(INK, (0.10, 0.78), 0.035, 0.04, 0.305),
        box(toned(p, 0.6), (0.30, -0.18, 0.78), (0.02, 0.16, 0.07))],
        ("washer",), moving=(Moving(lambda p: [
            box(Material(hue), (0.322, 0.09 * math.cos(a), 0.40 + 0.09 * math.sin(a)),
                (0.02, 0.11, 0.08))
            for hue, a in (((0.50, 0.05, 0.05), 0.5), ((0.05, 0.15, 0.45), 2.6),
                ((0.7, 0.65, 0.6), 4.7))],
            spinning("x", 0.67, (0.0, 0.0, 0.40))),)),
    thing("iron", ((0.05, 0.20, 0.50), (0.50, 0.05, 0.10)), lambda p: [
        blade(SILVER, (0.0, -0.14, 0.008), (0.0, 0.13, 0.008), chord=(0.12, 0.0, 0.0),
            thickness=(0.0, 0.0, 0.016)),
        blade(p, (0.0, -0.12, 0.03), (0.0, 0.12, 0.03), chord=(0.10, 0.0, 0.0),
            thickness=(0.0, 0.0, 0.06)),
        *chain(p, [(0.0, 0.10, 0.04), (0.0, 0.10, 0.11), (0.0, -0.06, 0.11), (0.0, -0.09, 0.05)],
            0.014), ball(PALE, (0.0, 0.02, 0.122), (0.03, 0.03, 0.012))],
        ("clothes iron", "steam iron", "flat iron")),
    thing("vacuum cleaner", ((0.50, 0.04, 0.03), (0.05, 0.15, 0.45)), lambda p: [
        ball(p, (0.0, 0.20, 0.15), (0.28, 0.42, 0.28)),
        *(disc(INK, (0.30, 0.11), 0.11, 0.05, x) for x in (0.13, -0.13)),
        *chain(INK, [(0.0, 0.05, 0.22), (0.0, -0.15, 0.50), (0.0, -0.30, 0.80)], 0.03),
        rod(SILVER, (0.0, -0.30, 0.80), (0.0, -0.66, 0.06), 0.022),
        box(INK, (0.0, -0.68, 0.03), (0.28, 0.12, 0.06))], ("hoover", "vacuum")),
    thing("heater", (CHINA,), lambda p: [
        *(box(p, (0.0, -0.40 + 0.1 * i, 0.38), (0.10, 0.075, 0.60)) for i in range(9)),
        bar(toned(p, 0.85), (-0.42, 0.60), (0.42, 0.60), 0.04, 0.05),
        bar(toned(p, 0.85), (-0.42, 0.15), (0.42, 0.15), 0.04, 0.05),
        *(box(GREY_PLASTIC, (0.0, y, 0.04), (0.16, 0.05, 0.08)) for y in (0.3, -0.3))],
        ("radiator",)),
    thing("grill", ((0.03, 0.03, 0.035), (0.45, 0.04, 0.03)), lambda p: [
        ball(p, (0.0, 0.0, 0.72), (0.55, 0.55, 0.40)),
        post(INK, (0.0, 0.0, 0.78), (0.57, 0.57, 0.02)),
        ball(INK, (0.0, 0.0, 0.93), (0.10, 0.03, 0.04)),
        *(rod(SILVER, (0.10 * x, 0.12 * y, 0.60), (0.28 * x, 0.30 * y, 0.0), 0.014) for x,
            y in ((1, 1), (1, -1), (-1.2, 0)))],
        ("barbecue", "bbq")),
))  # fmt: skip
"""Nouns of appliances."""

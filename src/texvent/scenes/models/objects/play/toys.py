"""Toys, games and playgrounds."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, checked, glowing, mottled
from texvent.scenes.models.objects.figures import (
    Moving,
    bar,
    disc,
    lathe,
    nothing,
    placed,
    ring,
    spinning,
    swinging,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BRASS,
    DARK_WOOD,
    INK,
    IRON,
    PALE,
    PAPER,
    RED_PAINT,
    SILVER,
    STEELY,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Affine,
    ball,
    blade,
    box,
    compose,
    limb,
    moved,
    peak,
    plank,
    post,
    rod,
    shift,
    spike,
    turn_x,
    turn_z,
)
from texvent.scenes.models.vehicles.wheels import Wheel
from texvent.scenes.scene import Colour

_BRIGHT: tuple[Colour, ...] = ((0.55, 0.03, 0.02), (0.03, 0.15, 0.50), (0.05, 0.35, 0.08))
_HUES = tuple(
    Material(hue)
    for hue in ((0.55, 0.03, 0.02), (0.03, 0.15, 0.50), (0.75, 0.45, 0.02), (0.05, 0.35, 0.08))
)


def _dots(number: int, size: float) -> list[tuple[float, float]]:
    """Places of the dots of a die's side, m."""
    q = 0.26 * size
    rows = {1: [(0, 0)], 2: [(-1, -1), (1, 1)], 3: [(-1, -1), (0, 0), (1, 1)],
        4: [(-1, -1), (1, 1), (-1, 1), (1, -1)], 5: [(-1, -1), (1, 1), (-1, 1), (1, -1), (0, 0)],
            6: [(-1, -1), (-1, 0), (-1, 1), (1, -1), (1, 0), (1, 1)]}  # fmt: skip
    return [(q * a, q * b) for a, b in rows[number]]


def _die(skin: Material, size: float) -> list[ModelPart]:
    half, r = 0.5 * size, 0.09 * size
    thin = 0.02 * size
    parts = [box(skin, (0.0, 0.0, half), (size, size, size))]
    parts += [
        rod(INK, (half - thin, y, half + z), (half + thin, y, half + z), r)
        for y, z in _dots(5, size)
    ]
    parts += [post(INK, (x, y, size), (2 * r, 2 * r, 2 * thin)) for x, y in _dots(6, size)]
    parts += [
        rod(INK, (x, s * (half - thin), half + z), (x, s * (half + thin), half + z), r)
        for s, n in ((1.0, 3), (-1.0, 4))
        for x, z in _dots(n, size)
    ]
    return parts


def _bear(skin: Material) -> list[ModelPart]:
    """A sitting toy bear."""
    pale, nose = toned(skin, 1.7), INK
    return [
        ball(skin, (0.0, 0.0, 0.11), (0.17, 0.19, 0.20)),
        ball(pale, (0.045, 0.0, 0.11), (0.10, 0.13, 0.14)),
        ball(skin, (0.01, 0.0, 0.26), (0.15, 0.17, 0.15)),
        ball(pale, (0.075, 0.0, 0.245), (0.07, 0.08, 0.06)),
        ball(nose, (0.108, 0.0, 0.255), (0.02, 0.03, 0.02)),
        *(ball(nose, (0.072, 0.035 * s, 0.29), (0.018, 0.018, 0.018)) for s in (1.0, -1.0)),
        *(ball(skin, (0.0, 0.075 * s, 0.325), (0.03, 0.06, 0.06)) for s in (1.0, -1.0)),
        *(ball(pale, (0.012, 0.075 * s, 0.325), (0.02, 0.035, 0.035)) for s in (1.0, -1.0)),
        *(limb(skin, (0.01, 0.085 * s, 0.17), (0.08, 0.13 * s, 0.10), 0.033) for s in (1.0, -1.0)),
        *(limb(skin, (0.04, 0.06 * s, 0.045), (0.14, 0.09 * s, 0.045), 0.042)
            for s in (1.0, -1.0)),
            *(ball(pale, (0.185, 0.10 * s, 0.05), (0.015, 0.055, 0.06)) for s in (1.0, -1.0)),
    ]  # fmt: skip


def _toy_robot(skin: Material) -> list[ModelPart]:
    return [
        box(skin, (0.0, 0.0, 0.17), (0.09, 0.14, 0.13)),
        box(toned(skin, 1.4), (0.0, 0.0, 0.285), (0.08, 0.10, 0.08)),
        *(disc(glowing((0.95, 0.75, 0.1), 1.5), (0.024 * s, 0.295), 0.013, 0.01, 0.042)
            for s in (1.0, -1.0)), bar(INK, (-0.025, 0.262), (0.025, 0.262), 0.010, 0.01, 0.04),
        rod(SILVER, (0.0, 0.0, 0.32), (0.0, 0.0, 0.37), 0.004),
        ball(RED_PAINT, (0.0, 0.0, 0.375), (0.018, 0.018, 0.018)),
        disc(YELLOW_PAINT, (0.0, 0.19), 0.025, 0.01, 0.046),
        *(box(hue, (0.046, y, 0.14), (0.008, 0.02, 0.016)) for hue,
            y in zip(_HUES, (-0.042, -0.014, 0.014, 0.042), strict=True)),
        *(rod(SILVER, (0.0, 0.07 * s, 0.21), (0.04, 0.10 * s, 0.13), 0.012) for s in (1.0, -1.0)),
        *(ball(RED_PAINT, (0.045, 0.105 * s, 0.12), (0.035, 0.035, 0.035)) for s in (1.0, -1.0)),
        *(box(toned(skin, 0.7), (0.0, 0.035 * s, 0.06), (0.05, 0.045, 0.10)) for s in (1.0, -1.0)),
        *(box(INK, (0.015, 0.035 * s, 0.012), (0.10, 0.055, 0.024)) for s in (1.0, -1.0)),
    ]  # fmt: skip


def _chessmen() -> list[ModelPart]:
    """A few men in two colours on a board."""
    parts = []
    for hue, y in ((Material((0.55, 0.42, 0.26)), -0.131), (Material((0.05, 0.03, 0.02)), 0.131)):
        for x in (-0.131, -0.044, 0.044, 0.131):
            parts += [
                post(hue, (x, y, 0.045), (0.026, 0.026, 0.05)),
                ball(hue, (x, y, 0.075), (0.026, 0.026, 0.028)),
            ]
    return parts


def _seat(index: int) -> Affine:
    """Where a horse of a merry-go-round stands."""
    angle = 1.047 * index
    return compose(shift(1.2 * math.cos(angle), 1.2 * math.sin(angle)), turn_z(angle))


_INDOOR = placed("indoor", (
    thing("teddy bear", ((0.35, 0.17, 0.06), (0.50, 0.32, 0.16)), _bear,
        ("teddy", "stuffed bear", "toy bear", "plush bear")),
    thing("toy robot", (STEELY, (0.45, 0.05, 0.04), (0.04, 0.20, 0.42)), _toy_robot,
        ("robot toy", "tin robot")),
    thing("doll", ((0.60, 0.10, 0.25), (0.05, 0.20, 0.45)), lambda p: [
        peak(p, (0.0, 0.0, 0.15), (0.18, 0.20, 0.26)),
        ball(Material((0.66, 0.42, 0.31)), (0.0, 0.0, 0.32), (0.11, 0.11, 0.12)),
        ball(Material((0.40, 0.22, 0.04)), (-0.012, 0.0, 0.335), (0.125, 0.13, 0.12)),
        *(ball(INK, (0.05, 0.022 * s, 0.325), (0.012, 0.014, 0.014)) for s in (1.0, -1.0)),
        *(limb(Material((0.66, 0.42, 0.31)), (0.0, 0.03 * s, 0.25), (0.02, 0.11 * s, 0.17), 0.014)
            for s in (1.0, -1.0)),
            *(limb(Material((0.66, 0.42, 0.31)), (0.0, 0.03 * s, 0.02), (0.0, 0.03 * s, 0.08),
                0.018) for s in (1.0, -1.0)),
                *(ball(Material((0.40, 0.22, 0.04)), (0.0, 0.065 * s, 0.29), (0.045, 0.04, 0.09))
                    for s in (1.0, -1.0))]),
    thing("toy block", _BRIGHT,
        lambda p: [box(p, (0.0, -0.045, 0.035), (0.07, 0.07, 0.07)),
            box(_HUES[2], (0.0, 0.04, 0.035), (0.07, 0.07, 0.07)),
            *moved([box(_HUES[1], (0.0, 0.0, 0.105), (0.07, 0.07, 0.07))], turn_z(0.4)),
        *(box(PALE, (0.0355, y, 0.035), (0.002, 0.035, 0.035)) for y in (-0.045, 0.04))],
        ("building block", "wooden block", "toy brick")),
    thing("dice", (PALE.colour, (0.55, 0.03, 0.02)), lambda p: [*_die(p, 0.016)],
        ("die", "game die"), plurals=("dice",)),
    thing("domino", (INK.colour,),
        lambda p: [box(p, (0.0, 0.0, 0.024), (0.008, 0.024, 0.048)),
            box(PALE, (0.0035, 0.0, 0.024), (0.003, 0.02, 0.0012)),
            *(disc(PALE, (y, 0.012 + z), 0.0022, 0.002, 0.004) for y, z in _dots(4, 0.022)),
            *(disc(PALE, (y, 0.036 + z), 0.0022, 0.002, 0.004) for y, z in _dots(5, 0.022))],
            ("domino tile",), plurals=("dominoes",)),
    thing("chessboard", (DARK_WOOD,),
        lambda p: [box(p, (0.0, 0.0, 0.008), (0.40, 0.40, 0.016)),
            box(Material((0.55, 0.42, 0.26)), (0.0, 0.0, 0.0175), (0.35, 0.35, 0.004)),
        *(box(p, (0.04375 * (2 * i - 3 + k % 2) - 0.022, 0.04375 * (k - 3.5), 0.0182),
            (0.04375, 0.04375, 0.004)) for i in range(4) for k in range(8)),
        *_chessmen()], ("chess board", "chess set", "chess")),
    thing("roulette wheel", (WOOD_BROWN,),
        lambda p: [*lathe(p, [(0.0, 0.36), (0.10, 0.40)], 3),
            post(Material((0.12, 0.05, 0.02)), (0.0, 0.0, 0.101), (0.70, 0.70, 0.004))],
            ("roulette", "roulette table"), moving=(Moving(lambda p: [
        *(plank(RED_PAINT if k % 2 else INK, (0.19 * math.cos(a), 0.19 * math.sin(a), 0.106),
            (0.30 * math.cos(a), 0.30 * math.sin(a), 0.106),
            chord=(-0.125 * math.sin(a), 0.125 * math.cos(a), 0.0), thickness=(0.0, 0.0, 0.008))
            for k, a in ((k, 2 * math.pi * k / 14) for k in range(14))),
        post(p, (0.0, 0.0, 0.108), (0.36, 0.36, 0.012)),
        *lathe(BRASS, [(0.11, 0.06), (0.20, 0.012)], 4),
        *(rod(BRASS, (0.0, 0.0, 0.17), (0.11 * c, 0.11 * s, 0.17), 0.01) for c,
            s in ((1, 0), (-1, 0), (0, 1), (0, -1))),
            ball(PALE, (0.27, 0.05, 0.118), (0.024, 0.024, 0.024))], spinning("z", 0.6)),)),
    thing("toy car", _BRIGHT,
        lambda p: [box(p, (0.0, 0.0, 0.026), (0.14, 0.06, 0.026)),
            box(toned(p, 0.9), (-0.01, 0.0, 0.046), (0.07, 0.054, 0.022)),
            box(INK, (-0.01, 0.0, 0.047), (0.05, 0.056, 0.014)),
            *(ball(YELLOW_PAINT, (0.07, y, 0.028), (0.006, 0.012, 0.010)) for y in (0.02, -0.02))],
            ("model car", "rc car", "remote control car"), goes=("ground", "roll", 0.8),
            wheels=tuple(Wheel((x, y, 0.017), 0.017, 0.012) for x in (0.045, -0.045)
                for y in (0.029, -0.029))),
    thing("toy train", _BRIGHT, lambda p: [
        rod(p, (-0.02, 0.0, 0.075), (0.13, 0.0, 0.075), 0.035),
        box(_HUES[2], (-0.06, 0.0, 0.085), (0.09, 0.085, 0.11)),
        box(_HUES[1], (-0.06, 0.0, 0.145), (0.11, 0.10, 0.012)),
        box(INK, (0.03, 0.0, 0.035), (0.24, 0.08, 0.02)),
        post(INK, (0.09, 0.0, 0.12), (0.03, 0.03, 0.05)),
        box(INK, (-0.06, 0.0, 0.105), (0.05, 0.087, 0.04)),
        box(_HUES[3], (-0.21, 0.0, 0.065), (0.14, 0.085, 0.06)),
        box(INK, (-0.13, 0.0, 0.035), (0.05, 0.02, 0.01)),
        ], ("model train",), goes=("ground", "roll", 0.6),
            wheels=tuple(Wheel((x, y, 0.025), 0.025, 0.012) for y in (0.044, -0.044)
                for x in (0.11, 0.04, -0.06, -0.17, -0.25))),
    thing("rubik cube", (INK.colour,),
        lambda p: [box(p, (0.0, 0.0, 0.0285), (0.057, 0.057, 0.057)),
        *(box(_HUES[(i * 3 + k) % 4], (0.0285, 0.0185 * (i - 1), 0.0285 + 0.0185 * (k - 1)),
            (0.001, 0.016, 0.016)) for i in range(3) for k in range(3)),
            *(box(_HUES[(i + 2 * k) % 4], (0.0185 * (i - 1), 0.0185 * (k - 1), 0.057),
                (0.016, 0.016, 0.001)) for i in range(3) for k in range(3)),
        *(box(_HUES[(2 * i + k + 1) % 4],
            (0.0185 * (i - 1), 0.0285 * s, 0.0285 + 0.0185 * (k - 1)), (0.016, 0.001, 0.016))
            for i in range(3) for k in range(3) for s in (1.0, -1.0))],
            ("magic cube", "puzzle cube")),
    thing("rocking horse", (WOOD_BROWN,), nothing, moving=(Moving(lambda p: [
        limb(p, (-0.22, 0.0, 0.45), (0.20, 0.0, 0.45), 0.11),
        limb(p, (0.22, 0.0, 0.48), (0.34, 0.0, 0.74), 0.07),
        limb(p, (0.33, 0.0, 0.76), (0.46, 0.0, 0.68), 0.05),
        *(limb(p, (x, 0.07 * s, 0.42), (1.35 * x, 0.12 * s, 0.10), 0.035) for x in (0.2, -0.2)
            for s in (1.0, -1.0)),
        *(part for y in (0.13, -0.13)
            for part in ring(RED_PAINT, (0.0, y, 0.80), (0.52, 0.76), 0.02, axis="y",
                span=(220.0, 320.0), pieces=6)),
                limb(INK, (-0.30, 0.0, 0.48), (-0.42, 0.0, 0.25), 0.04),
                box(RED_PAINT, (-0.02, 0.0, 0.56), (0.20, 0.18, 0.03)),
                spike(p, (0.32, 0.03, 0.79), (0.31, 0.035, 0.87), 0.02)],
                swinging("y", 0.10, 0.7, (0.0, 0.0, 0.6))),)),
    thing("snow globe", ((0.55, 0.66, 0.70),),
        lambda p: [*lathe(Material(DARK_WOOD), [(0.0, 0.055), (0.03, 0.045)], 3),
            ball(p, (0.0, 0.0, 0.08), (0.11, 0.11, 0.11)),
            *(ball(PALE, (0.052 * math.cos(a) * math.cos(b), 0.052 * math.sin(a) * math.cos(b),
                0.08 + 0.052 * math.sin(b)), (0.008, 0.008, 0.008)) for a,
                b in ((0, 0.2), (0.7, 0.6), (-0.6, 0.4), (0.3, 0.9), (-0.3, -0.2), (1.2, 0.1),
                    (-1.2, 0.2), (0.9, -0.2)))]),
    thing("globe", ((0.03, 0.16, 0.45),),
        lambda p: [post(Material(DARK_WOOD), (0.0, 0.0, 0.012), (0.18, 0.18, 0.024)),
            *ring(BRASS, (0.0, 0.0, 0.21), (0.165, 0.165), 0.006, span=(-110.0, 90.0), pieces=12),
            rod(BRASS, (0.0, 0.0, 0.02), (0.0, 0.0, 0.06), 0.012)],
            ("earth globe", "terrestrial globe"), moving=(Moving(lambda p: [
        ball(p, (0.0, 0.0, 0.21), (0.30, 0.30, 0.30)),
        *(ball(Material((0.12, 0.32, 0.06)),
            (0.118 * math.cos(a) * math.cos(b), 0.118 * math.sin(a) * math.cos(b),
                0.21 + 0.118 * math.sin(b)), (0.075, 0.075, w)) for a, b,
                w in ((0.0, 0.3, 0.10), (0.5, 0.6, 0.07), (1.9, 0.2, 0.12), (2.4, -0.4, 0.10),
                    (3.6, 0.5, 0.10), (4.3, 0.4, 0.11), (5.2, -0.3, 0.09))),
                    ball(PALE, (0.0, 0.0, 0.345), (0.10, 0.10, 0.035))], spinning("z", 0.25)),)),
))  # fmt: skip

_OUTDOOR = placed("grass", (
    thing("swing", (RED_PAINT.colour, (0.03, 0.15, 0.45)),
        lambda p: [*(rod(p, (0.9 * t, 1.1 * s, 0.0), (0.0, 1.1 * s, 2.3), 0.05)
            for s in (1.0, -1.0) for t in (1.0, -1.0)),
            rod(p, (0.0, -1.15, 2.3), (0.0, 1.15, 2.3), 0.05)], ("playground swing", "swing set"),
            moving=(Moving(lambda p: [
        *(rod(SILVER, (0.0, 0.25 * s, 2.3), (0.0, 0.25 * s, 0.5), 0.014) for s in (1.0, -1.0)),
        box(INK, (0.0, 0.0, 0.5), (0.22, 0.56, 0.04))],
        swinging("y", 0.55, 0.35, (0.0, 0.0, 2.3))),)),
    thing("slide", (RED_PAINT.colour, (0.03, 0.15, 0.45), YELLOW_PAINT.colour), lambda p: [
        plank(p, (1.5, 0.0, 0.25), (-0.55, 0.0, 1.55), chord=(0.0, 0.55, 0.0),
            thickness=(0.03, 0.0, 0.05)),
            *(plank(toned(p, 0.7), (1.5, 0.28 * s, 0.32), (-0.55, 0.28 * s, 1.62),
                chord=(0.0, 0.05, 0.0), thickness=(0.06, 0.0, 0.10)) for s in (1.0, -1.0)),
                box(p, (1.7, 0.0, 0.24), (0.45, 0.55, 0.05)),
                box(INK, (-0.80, 0.0, 1.55), (0.5, 0.55, 0.05)),
        *(rod(SILVER, (-1.45, 0.26 * s, 0.0), (-0.95, 0.26 * s, 2.1), 0.03) for s in (1.0, -1.0)),
        *(rod(SILVER, (-1.38 + 0.09 * i, -0.26, 0.28 + 0.36 * i),
            (-1.38 + 0.09 * i, 0.26, 0.28 + 0.36 * i), 0.025) for i in range(4)),
            *(rod(SILVER, (-0.6, 0.26 * s, 0.0), (-0.6, 0.26 * s, 1.5), 0.03)
                for s in (1.0, -1.0))], ("playground slide", "sliding board")),
    thing("seesaw", (RED_PAINT.colour, (0.03, 0.15, 0.45)),
        lambda p: [*(rod(IRON, (0.3 * t, 0.2 * s, 0.0), (0.0, 0.12 * s, 0.5), 0.04)
            for s in (1.0, -1.0) for t in (1.0, -1.0))],
            ("teeter-totter", "teeter totter", "see-saw"), moving=(Moving(lambda p: [
        box(p, (0.0, 0.0, 0.53), (3.0, 0.26, 0.06)),
        *(box(INK, (1.3 * s, 0.0, 0.585), (0.34, 0.28, 0.05)) for s in (1.0, -1.0)),
        *(rod(SILVER, (1.05 * s, -0.13, 0.72), (1.05 * s, 0.13, 0.72), 0.02) for s in (1.0, -1.0)),
        *(rod(SILVER, (1.05 * s, 0.0, 0.55), (1.05 * s, 0.0, 0.72), 0.02) for s in (1.0, -1.0))],
        swinging("y", 0.24, 0.4, (0.0, 0.0, 0.5))),)),
    thing("merry-go-round", _BRIGHT, lambda p: [post(IRON, (0.0, 0.0, 0.3), (0.2, 0.2, 0.6))],
        ("carousel", "roundabout ride"), moving=(Moving(lambda p: [
        post(p, (0.0, 0.0, 0.32), (3.0, 3.0, 0.10)),
        post(PALE, (0.0, 0.0, 1.4), (0.16, 0.16, 2.2)), peak(p, (0.0, 0.0, 2.85), (3.3, 3.3, 0.9)),
        post(YELLOW_PAINT, (0.0, 0.0, 2.38), (3.3, 3.3, 0.14)),
        *(part for i in range(6)
            for part in (rod(BRASS, (1.2 * math.cos(1.047 * i), 1.2 * math.sin(1.047 * i), 0.3),
                (1.2 * math.cos(1.047 * i), 1.2 * math.sin(1.047 * i), 2.4), 0.03),
                *moved([limb(_HUES[i % 4], (0.0, -0.22, 1.0), (0.0, 0.22, 1.0), 0.15),
                    limb(_HUES[i % 4], (0.0, 0.25, 1.05), (0.0, 0.36, 1.35), 0.08),
                    limb(_HUES[i % 4], (0.0, 0.36, 1.36), (0.0, 0.52, 1.28), 0.06)],
            _seat(i)))), ], spinning("z", 0.12)),)),
    thing("ferris wheel", _BRIGHT,
        lambda p: [*(rod(SILVER, (1.2 * s, 3.5 * t, 0.0), (0.8 * s, 0.0, 9.0), 0.22)
            for s in (1.0, -1.0) for t in (1.0, -1.0)),
            rod(INK, (-1.0, 0.0, 9.0), (1.0, 0.0, 9.0), 0.4)], ("big wheel", "observation wheel"),
            moving=(Moving(lambda p: [
        *(part for x in (0.5,) for part in ring(p, (x, 0.0, 9.0), (7.5, 7.5), 0.16, pieces=20)),
        *(rod(PALE, (0.5, 0.0, 9.0), (0.5, 7.5 * math.cos(a), 9.0 + 7.5 * math.sin(a)), 0.09)
            for a in (0.785 * i for i in range(8))),
            *(ball(_HUES[i % 4], (0.5, 7.9 * math.cos(0.393 + 0.785 * i),
                9.0 + 7.9 * math.sin(0.393 + 0.785 * i)), (1.4, 1.4, 1.6)) for i in range(8))],
                spinning("x", 0.05, (0.0, 0.0, 9.0))),)),
    thing("sandcastle", ((0.55, 0.42, 0.22),), lambda p: [
        box(mottled(p.colour, contrast=0.2), (0.0, 0.0, 0.10), (0.5, 0.5, 0.20)),
        *(post(mottled(p.colour, contrast=0.2), (0.25 * s, 0.25 * t, 0.18), (0.18, 0.18, 0.36))
            for s in (1, -1) for t in (1, -1)),
            *(peak(mottled(p.colour, contrast=0.2), (0.25 * s, 0.25 * t, 0.44), (0.2, 0.2, 0.16))
                for s in (1, -1) for t in (1, -1)),
                post(mottled(p.colour, contrast=0.2), (0.0, 0.0, 0.28), (0.24, 0.24, 0.4)),
                rod(Material(WOOD_BROWN), (0.0, 0.0, 0.45), (0.0, 0.0, 0.68), 0.008),
                box(RED_PAINT, (0.0, 0.06, 0.64), (0.01, 0.12, 0.08)),
                box(INK, (0.252, 0.0, 0.06), (0.01, 0.1, 0.12))], ("sand castle",)),
    thing("snowman", (PALE.colour,),
        lambda p: [ball(p, (0.0, 0.0, 0.40), (0.85, 0.85, 0.80)),
            ball(p, (0.0, 0.0, 0.98), (0.62, 0.62, 0.58)),
            ball(p, (0.0, 0.0, 1.42), (0.44, 0.44, 0.42)),
            spike(Material((0.75, 0.20, 0.01)), (0.20, 0.0, 1.42), (0.45, 0.0, 1.40), 0.045),
            *(ball(INK, (0.195, 0.075 * s, 1.49), (0.04, 0.05, 0.05)) for s in (1.0, -1.0)),
        *(ball(INK, (0.30, 0.0, z), (0.05, 0.05, 0.05)) for z in (0.85, 1.0, 1.13)),
        *(rod(Material(WOOD_BROWN), (0.0, 0.28 * s, 1.02), (0.05, 0.72 * s, 1.25), 0.018)
            for s in (1.0, -1.0)), post(INK, (0.0, 0.0, 1.60), (0.50, 0.50, 0.03)),
            post(INK, (0.0, 0.0, 1.72), (0.32, 0.32, 0.24))], plurals=("snowmen",)),
    thing("scarecrow", ((0.45, 0.06, 0.04),),
        lambda p: [rod(Material(WOOD_BROWN), (0.0, 0.0, 0.0), (0.0, 0.0, 1.6), 0.04),
            rod(Material(WOOD_BROWN), (0.0, -0.75, 1.3), (0.0, 0.75, 1.3), 0.03),
            box(checked(p.colour, (0.10, 0.03, 0.03), 3.0), (0.0, 0.0, 1.12), (0.22, 0.42, 0.55)),
            *(limb(p, (0.0, 0.2 * s, 1.3), (0.0, 0.6 * s, 1.28), 0.075) for s in (1.0, -1.0)),
        *(limb(Material((0.04, 0.08, 0.20)), (0.0, 0.1 * s, 0.85), (0.0, 0.14 * s, 0.3), 0.09)
            for s in (1.0, -1.0)),
            ball(Material((0.55, 0.40, 0.18)), (0.0, 0.0, 1.6), (0.26, 0.26, 0.30)),
            *(ball(INK, (0.12, 0.05 * s, 1.64), (0.03, 0.04, 0.04)) for s in (1.0, -1.0)),
            post(Material((0.42, 0.28, 0.10)), (0.0, 0.0, 1.73), (0.56, 0.56, 0.025)),
            peak(Material((0.42, 0.28, 0.10)), (0.0, 0.0, 1.84), (0.28, 0.28, 0.22))]),
))  # fmt: skip

_AIR = placed("grass", (
    thing("paper plane", (PAPER.colour,), lambda p: moved([
        *(plank(p, (-0.12, 0.05 * s, 0.012), (0.12, 0.0, 0.0), chord=(0.0, 0.07, 0.014 * s),
            thickness=(0.0, 0.0, 0.003)) for s in (1.0, -1.0)),
        plank(toned(p, 0.75), (-0.10, 0.0, -0.014), (0.08, 0.0, -0.006), chord=(0.0, 0.0, 0.035),
            thickness=(0.0, 0.003, 0.0))], turn_x(0.5)),
        ("paper airplane", "paper aeroplane", "paper aircraft"), goes=("air", "fly", 1.5)),
    thing("water balloon", _BRIGHT,
        lambda p: [ball(Material(p.colour), (0.0, 0.0, 0.0), (0.11, 0.11, 0.12)),
            spike(p, (0.0, 0.0, 0.072), (0.0, 0.0, 0.05), 0.02),
            ball(toned(p, 2.2), (0.03, -0.025, 0.025), (0.04, 0.03, 0.035))],
            goes=("air", "fly", 3.0)),
    thing("soap bubble", ((0.62, 0.70, 0.78),),
        lambda p: [ball(Material(p.colour), (0.0, 0.0, 0.0), (0.10, 0.10, 0.10)),
            *(ball(PALE, (0.026 * a, 0.028 * b, 0.024), (0.02, 0.02, 0.02))
                for a in (1, -1) for b in (1, -1)),
            *(ball(Material((0.60, 0.45, 0.62)), (0.016 * a, -0.020 * b, -0.022),
                (0.045, 0.04, 0.036)) for a in (1, -1) for b in (1, -1))],
            ("bubble",), goes=("air", "float", 0.3)),
    thing("feather", (PALE.colour, (0.62, 0.44, 0.24)), nothing, ("plume", "quill"),
        moving=(Moving(lambda p: [
        *(blade(toned(p, 0.85 if k % 2 else 1.0), (0.022 * k - 0.07, 0.0, 0.0),
            (0.022 * k - 0.030, 0.010, s * (0.036 - 0.003 * abs(k - 3))),
            chord=(0.034, 0.0, 0.0), thickness=(0.0, 0.003, 0.0))
            for k in range(9) for s in (1.0, -1.0)),
        rod(toned(p, 0.6), (-0.16, 0.0, -0.012), (0.10, 0.0, 0.0), 0.003)],
        swinging("x", 0.9, 0.7)),), goes=("air", "float", 0.3)),
))  # fmt: skip

NOUNS = (*_INDOOR, *_OUTDOOR, *_AIR)
"""Nouns of toys and playgrounds."""

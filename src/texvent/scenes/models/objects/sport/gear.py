"""Rackets, bats, boards, skis, goals and other sports gear."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, mottled, striped
from texvent.scenes.models.objects.figures import (
    Moving,
    bar,
    chain,
    disc,
    lathe,
    lying,
    placed,
    rectangle,
    ring,
    struck,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BRASS,
    INK,
    IRON,
    PALE,
    PALE_WOOD,
    RED_PAINT,
    SILVER,
    SILVERY,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, blade, box, limb, peak, plank, post, rod, spike
from texvent.scenes.models.vehicles.wheels import Wheel
from texvent.scenes.scene import Colour

_BRIGHT: tuple[Colour, ...] = ((0.55, 0.03, 0.02), (0.03, 0.15, 0.50), (0.05, 0.35, 0.08))
_NET = Material((0.62, 0.62, 0.60))


def _racket(skin: Material, size: tuple[float, float], long: float) -> list[ModelPart]:
    """A frame with strings on a handle; `size` is half the head's extent, `long` the whole."""
    half_wide, half_tall = size
    middle = long - half_tall
    thin = 0.035 * half_wide + 0.0006
    strings = [bar(PALE, (y, middle - half_tall * math.sqrt(1 - (y / half_wide) ** 2)),
        (y, middle + half_tall * math.sqrt(1 - (y / half_wide) ** 2)), thin, 0.002)
               for y in (half_wide * k / 4 for k in range(-3, 4))]  # fmt: skip
    strings += [bar(PALE, (-half_wide * math.sqrt(1 - (z / half_tall) ** 2), middle + z),
        (half_wide * math.sqrt(1 - (z / half_tall) ** 2), middle + z), thin, 0.002)
                for z in (half_tall * k / 5 for k in range(-4, 5))]  # fmt: skip
    return lying([
        *ring(skin, (0.0, 0.0, middle), (half_wide, half_tall), 0.075 * half_wide, pieces=16),
        *strings, rod(INK, (0.0, 0.0, 0.0), (0.0, 0.0, 0.26 * long), 0.022 * long),
        *(limb(skin, (0.0, 0.0, 0.24 * long),
            (0.0, 0.45 * s * half_wide, middle - 0.88 * half_tall), 0.010 * long)
            for s in (1.0, -1.0)),
    ])  # fmt: skip


def _mesh(wide: float, tall: float, step: float, x: float, z0: float) -> list[ModelPart]:
    """Cords of a net that faces +x."""
    columns, rows = round(wide / step), round(tall / step)
    thin = 0.10 * step
    return [
        *(box(_NET, (x, -0.5 * wide + wide * i / columns, z0 + 0.5 * tall), (thin, thin, tall))
            for i in range(columns + 1)),
        *(box(_NET, (x, 0.0, z0 + tall * i / rows), (thin, wide, thin)) for i in range(rows + 1)),
    ]  # fmt: skip


def _board(skin: Material, long: float, wide: float, thick: float) -> list[ModelPart]:
    """A flat board with rounded ends along y."""
    straight = long - wide
    return [
        box(skin, (0.0, 0.0, 0.0), (wide, straight, thick)),
        *(post(skin, (0.0, 0.5 * s * straight, 0.0), (wide, wide, thick)) for s in (1.0, -1.0)),
    ]  # fmt: skip


_SPORT = placed("grass", (
    thing("tennis racket", _BRIGHT, lambda p: _racket(p, (0.13, 0.17), 0.69),
        ("tennis racquet", "racquet", "racket")),
    thing("badminton racket", _BRIGHT, lambda p: _racket(p, (0.10, 0.13), 0.67),
        ("badminton racquet",)),
    thing("baseball bat", (PALE_WOOD,), lambda p: lying([
        rod(toned(p, 0.5), (0.0, 0.0, 0.0), (0.0, 0.0, 0.02), 0.024),
        rod(INK, (0.0, 0.0, 0.02), (0.0, 0.0, 0.22), 0.015),
        rod(p, (0.0, 0.0, 0.22), (0.0, 0.0, 0.38), 0.017),
        limb(p, (0.0, 0.0, 0.34), (0.0, 0.0, 0.62), 0.028),
        rod(p, (0.0, 0.0, 0.50), (0.0, 0.0, 0.80), 0.032),
        ball(p, (0.0, 0.0, 0.80), (0.064, 0.064, 0.05))])),
    thing("baseball glove", ((0.34, 0.14, 0.05),), lambda p: lying([
        ball(p, (0.0, 0.0, 0.10), (0.08, 0.23, 0.22)),
        *(limb(p, (0.0, y, 0.13), (0.01, 1.25 * y, z), 0.031) for y,
            z in ((-0.090, 0.235), (-0.032, 0.275), (0.026, 0.275), (0.078, 0.235))),
        limb(p, (0.0, 0.09, 0.06), (0.01, 0.165, 0.17), 0.034),
        ball(toned(p, 0.35), (0.030, 0.0, 0.11), (0.04, 0.14, 0.14)),
        limb(toned(p, 0.7), (0.0, 0.0, 0.0), (0.0, 0.0, 0.04), 0.07),
        *(limb(toned(p, 0.5), (0.02, 0.10, z), (0.02, 0.16, z + 0.01), 0.012)
            for z in (0.13, 0.16, 0.19))]), ("baseball mitt", "mitt", "catcher mitt")),
    thing("cricket bat", (PALE_WOOD,),
        lambda p: lying([rod(INK, (0.0, 0.0, 0.0), (0.0, 0.0, 0.30), 0.017),
            bar(p, (0.0, 0.30), (0.0, 0.86), 0.108, 0.04),
            bar(RED_PAINT, (0.0, 0.50), (0.0, 0.58), 0.10, 0.042)])),
    thing("golf club", (SILVERY,),
        lambda p: lying([rod(INK, (0.0, 0.0, 0.85), (0.0, 0.0, 1.10), 0.013),
            rod(p, (0.0, 0.0, 0.06), (0.0, 0.0, 0.85), 0.007),
            limb(p, (0.0, 0.0, 0.05), (0.0, 0.10, 0.0), 0.026),
            ball(INK, (0.0, 0.07, 0.01), (0.06, 0.10, 0.06))]), ("golf driver",)),
    thing("hockey stick", (PALE_WOOD,),
        lambda p: lying([rod(INK, (0.0, 0.0, 1.15), (0.0, 0.0, 1.40), 0.017),
            bar(p, (0.0, 0.05), (0.0, 1.15), 0.03, 0.02),
            bar(INK, (0.0, 0.05), (0.28, 0.02), 0.065, 0.016)])),
    thing("pool cue", (PALE_WOOD,),
        lambda p: lying([*lathe(p, [(0.6, 0.011), (1.42, 0.006)], 3),
            *lathe(Material((0.10, 0.02, 0.02)), [(0.0, 0.016), (0.6, 0.012)], 3),
            rod(PALE, (0.0, 0.0, 1.42), (0.0, 0.0, 1.45), 0.006)]), ("billiard cue",)),
    thing("ping-pong paddle", _BRIGHT[:1],
        lambda p: lying([disc(p, (0.0, 0.18), 0.08, 0.012),
            disc(INK, (0.0, 0.18), 0.079, 0.010, -0.003),
            bar(Material(PALE_WOOD), (0.0, 0.0), (0.0, 0.11), 0.028, 0.018)]),
            ("table tennis bat", "table tennis racket", "paddle bat", "ping pong paddle")),
    thing("skateboard", _BRIGHT, lambda p: [
        box(p, (0.0, 0.0, 0.10), (0.56, 0.20, 0.012)),
        *(plank(p, (0.27 * s, 0.0, 0.10), (0.40 * s, 0.0, 0.135), chord=(0.0, 0.20, 0.0),
            thickness=(0.0, 0.0, 0.012)) for s in (1.0, -1.0)),
        box(INK, (0.0, 0.0, 0.107), (0.54, 0.18, 0.003)),
        *(box(SILVER, (x, 0.0, 0.065), (0.05, 0.14, 0.03)) for x in (0.2, -0.2)),
        box(YELLOW_PAINT, (0.0, 0.0, 0.109), (0.20, 0.05, 0.002))],
        ("longboard",), wheels=tuple(Wheel((x, y, 0.035), 0.035, 0.035) for x in (0.2, -0.2)
            for y in (0.085, -0.085)), goes=("ground", "roll", 2.5)),
    thing("scooter", _BRIGHT, lambda p: [
        box(p, (-0.02, 0.0, 0.09), (0.52, 0.11, 0.03)),
        box(INK, (-0.04, 0.0, 0.107), (0.40, 0.09, 0.004)),
        rod(SILVER, (0.34, 0.0, 0.10), (0.26, 0.0, 0.92), 0.018),
        plank(p, (0.22, 0.0, 0.09), (0.32, 0.0, 0.28), chord=(0.0, 0.05, 0.0),
            thickness=(0.04, 0.0, 0.0)),
        rod(INK, (0.26, -0.22, 0.93), (0.26, 0.22, 0.93), 0.018),
        box(INK, (-0.34, 0.0, 0.16), (0.10, 0.05, 0.012))],
        ("kick scooter", "push scooter", "e-scooter", "electric scooter"),
        wheels=(Wheel((0.36, 0.0, 0.09), 0.09, 0.03), Wheel((-0.36, 0.0, 0.09), 0.09, 0.03)),
        goes=("ground", "roll", 2.5)),
    thing("roller skate", _BRIGHT, lambda p: [
        box(INK, (0.0, 0.0, 0.075), (0.25, 0.06, 0.02)),
        limb(p, (-0.05, 0.0, 0.12), (0.08, 0.0, 0.11), 0.045),
        limb(p, (-0.06, 0.0, 0.12), (-0.055, 0.0, 0.25), 0.055),
        *(box(PALE, (0.02, 0.0, z), (0.012, 0.07, 0.01)) for z in (0.15, 0.18, 0.21))],
        ("rollerblade", "inline skate"),
        wheels=tuple(Wheel((x, 0.0, 0.035), 0.035, 0.024) for x in (0.11, 0.037, -0.037, -0.11)),
        goes=("ground", "roll", 2.5)),
    thing("ice skate", (PALE.colour,), lambda p: [
        box(SILVER, (0.01, 0.0, 0.02), (0.32, 0.006, 0.04)),
        *(box(INK, (x, 0.0, 0.05), (0.05, 0.02, 0.05)) for x in (0.09, -0.08)),
        limb(p, (-0.05, 0.0, 0.11), (0.08, 0.0, 0.10), 0.045),
        limb(p, (-0.06, 0.0, 0.12), (-0.055, 0.0, 0.25), 0.055)]),
    thing("basketball hoop", (PALE.colour,), lambda p: [
        rod(IRON, (-0.5, 0.0, 0.0), (-0.5, 0.0, 3.1), 0.07),
        rod(IRON, (-0.5, 0.0, 3.1), (0.0, 0.0, 3.3), 0.05),
        box(p, (0.02, 0.0, 3.45), (0.05, 1.80, 1.05)),
        *rectangle(RED_PAINT, (0.0, 3.30), (0.60, 0.45), 0.05, 0.11),
        *ring(Material((0.75, 0.18, 0.01)), (0.35, 0.0, 3.05), (0.24, 0.24), 0.018, axis="z",
            pieces=12),
        *(rod(_NET, (0.35 + 0.23 * math.cos(a), 0.23 * math.sin(a), 3.05),
            (0.35 + 0.14 * math.cos(a + 0.5), 0.14 * math.sin(a + 0.5), 2.62), 0.010)
            for a in (0.0, 0.785, 1.571, 2.356, 3.142, 3.927, 4.712, 5.498))],
        ("basketball net", "basketball basket", "hoop")),
    thing("goal", (PALE.colour,), lambda p: [
        *(rod(p, (0.0, 2.5 * s, 0.0), (0.0, 2.5 * s, 2.2), 0.06) for s in (1.0, -1.0)),
        rod(p, (0.0, -2.5, 2.2), (0.0, 2.5, 2.2), 0.06),
        *(rod(p, (0.0, 2.5 * s, 2.2), (-1.2, 2.5 * s, 0.0), 0.03) for s in (1.0, -1.0)),
        *_mesh(5.0, 2.1, 0.42, -0.5, 0.05)],
        ("soccer goal", "football goal", "goalpost")),
    thing("net", (PALE.colour,), lambda p: [
        *(rod(INK, (0.0, 2.1 * s, 0.0), (0.0, 2.1 * s, 1.07), 0.04) for s in (1.0, -1.0)),
        box(p, (0.0, 0.0, 0.98), (0.03, 4.2, 0.07)), *_mesh(4.2, 0.85, 0.21, 0.0, 0.10)],
        ("tennis net", "volleyball net", "badminton net")),
    thing("trampoline", _BRIGHT[1:2], lambda p: [
        *ring(p, (0.0, 0.0, 0.75), (1.35, 1.35), 0.10, axis="z", pieces=16),
        post(INK, (0.0, 0.0, 0.74), (2.5, 2.5, 0.03)),
        *(rod(SILVER, (1.3 * math.cos(a), 1.3 * math.sin(a), 0.0),
            (1.3 * math.cos(a), 1.3 * math.sin(a), 0.75), 0.035)
            for a in (0.0, 1.05, 2.09, 3.14, 4.19, 5.24))]),
    thing("archery target", (PALE.colour,), lambda p: [
        *(disc(hue, (0.0, 1.1), r, 0.10 + 0.01 * i, 0.0) for i,
            (hue, r) in enumerate(((p, 0.60), (INK, 0.48), (Material((0.04, 0.20, 0.50)), 0.36),
                (RED_PAINT, 0.24), (YELLOW_PAINT, 0.12)))),
        *(rod(Material(WOOD_BROWN), (-0.05, 0.05 * s, 1.6), (0.1, 0.6 * s, 0.0), 0.035)
            for s in (1.0, -1.0)),
            rod(Material(WOOD_BROWN), (-0.1, 0.0, 1.6), (-0.7, 0.0, 0.0), 0.035)],
            ("target", "bullseye", "shooting target")),
    thing("dartboard", (INK.colour,), lambda p: [
        disc(p, (0.0, 0.26), 0.226, 0.04),
        *(plank(PALE, (0.021, 0.0, 0.26), (0.021, 0.17 * math.cos(a), 0.26 + 0.17 * math.sin(a)),
            chord=(0.0, -0.05 * math.sin(a), 0.05 * math.cos(a)), thickness=(0.004, 0.0, 0.0))
            for a in (2 * math.pi * i / 10 for i in range(10))),
        *ring(RED_PAINT, (0.021, 0.0, 0.26), (0.17, 0.17), 0.005, pieces=20),
        *ring(RED_PAINT, (0.021, 0.0, 0.26), (0.10, 0.10), 0.005, pieces=16),
        disc(RED_PAINT, (0.0, 0.26), 0.02, 0.052),
        rod(IRON, (-0.02, 0.0, 0.4), (-0.2, 0.0, 0.0), 0.01)], ("dart board",)),
    thing("dart", _BRIGHT, lambda p: [
        rod(BRASS, (-0.01, 0.0, 0.03), (0.05, 0.0, 0.03), 0.0045),
        spike(SILVER, (0.05, 0.0, 0.03), (0.09, 0.0, 0.03), 0.002),
        rod(INK, (-0.05, 0.0, 0.03), (-0.01, 0.0, 0.03), 0.002),
        *(box(p, (-0.065, y, z), (0.035, w, h)) for y, z, w,
            h in ((0.0, 0.03, 0.001, 0.036), (0.0, 0.03, 0.036, 0.001)))],
            goes=("air", "fly", 3.0)),
    thing("arrow", (PALE_WOOD,), lambda p: [
        rod(p, (-0.38, 0.0, 0.0), (0.36, 0.0, 0.0), 0.0055),
        spike(SILVER, (0.35, 0.0, 0.0), (0.42, 0.0, 0.0), 0.014),
        *(box(RED_PAINT, (-0.33, 0.0, 0.0), (0.10, w, h)) for w,
            h in ((0.05, 0.002), (0.002, 0.05)))], goes=("air", "fly", 6.0)),
    thing("bow", (WOOD_BROWN,), lambda p: [
        *ring(p, (0.0, 0.14, 0.65), (0.30, 0.66), 0.014, span=(105.0, 255.0), pieces=8),
        rod(PALE, (0.0, 0.065, 0.02), (0.0, 0.065, 1.28), 0.003),
        limb(INK, (0.0, -0.155, 0.58), (0.0, -0.155, 0.72), 0.02)], ("archery bow", "longbow")),
    thing("dumbbell", (IRON.colour,),
        lambda p: [rod(SILVER, (0.0, -0.10, 0.06), (0.0, 0.10, 0.06), 0.014),
            *(rod(p, (0.0, y, 0.06), (0.0, y + d, 0.06), r) for y, d,
                r in ((0.07, 0.04, 0.06), (0.112, 0.03, 0.048), (-0.11, 0.04, 0.06),
                    (-0.142, 0.03, 0.048)))], ("hand weight", "free weight")),
    thing("barbell", (IRON.colour,),
        lambda p: [rod(SILVER, (0.0, -0.9, 0.22), (0.0, 0.9, 0.22), 0.016),
            *(rod(p, (0.0, y, 0.22), (0.0, y + 0.05, 0.22), r) for y,
                r in ((0.55, 0.22), (0.61, 0.17), (0.67, 0.12), (-0.60, 0.22), (-0.66, 0.17),
                    (-0.72, 0.12)))]),
    thing("boxing glove", _BRIGHT[:1],
        lambda p: [ball(p, (0.03, 0.0, 0.14), (0.18, 0.15, 0.16)),
            ball(p, (-0.02, 0.08, 0.13), (0.10, 0.07, 0.08)),
            *lathe(p, [(0.0, 0.05), (0.10, 0.06)], 2),
            post(PALE, (0.0, 0.0, 0.03), (0.115, 0.115, 0.03))]),
    thing("punching bag", ((0.50, 0.04, 0.03),),
        lambda p: [*(rod(IRON, (0.0, 0.8 * s, 0.0), (0.0, 0.5 * s, 2.4), 0.03)
            for s in (1.0, -1.0)), rod(IRON, (0.0, -0.52, 2.4), (0.0, 0.52, 2.4), 0.03),
            ], ("punch bag",), moving=(Moving(lambda p: [
            rod(SILVER, (0.0, 0.0, 1.85), (0.0, 0.0, 2.4), 0.012),
            rod(p, (0.0, 0.0, 0.65), (0.0, 0.0, 1.85), 0.18),
            post(INK, (0.0, 0.0, 1.3), (0.37, 0.37, 0.06))],
            struck(0.30, (0.0, 0.0, 2.4)), hangs=True),)),
    thing("hula hoop", ((0.75, 0.10, 0.35), (0.05, 0.35, 0.50)),
        lambda p: ring(p, (0.0, 0.0, 0.015), (0.45, 0.45), 0.015, axis="z", pieces=20)),
    thing("whistle", (SILVERY, (0.50, 0.04, 0.03)),
        lambda p: [rod(p, (-0.009, 0.0, 0.014), (0.009, 0.0, 0.014), 0.014),
            box(p, (0.0, 0.025, 0.021), (0.016, 0.045, 0.014)),
            box(INK, (0.0, 0.012, 0.0275), (0.012, 0.008, 0.003)),
            *ring(INK, (0.0, -0.02, 0.014), (0.008, 0.008), 0.0015, pieces=8)]),
    thing("trophy", (BRASS.colour,),
        lambda p: [box(INK, (0.0, 0.0, 0.03), (0.12, 0.12, 0.06)),
            *lathe(p, [(0.06, 0.045), (0.08, 0.014), (0.14, 0.014), (0.17, 0.05), (0.30, 0.075)],
                12), post(INK, (0.0, 0.0, 0.301), (0.13, 0.13, 0.003)),
        *(part for s in (1.0, -1.0)
            for part in ring(p, (0.0, 0.075 * s, 0.24), (0.045 * s, 0.05), 0.008,
                span=(-90.0, 90.0), pieces=6))], ("cup trophy", "golden cup")),
    thing("medal", (BRASS.colour,),
        lambda p: lying([disc(p, (0.0, 0.03), 0.03, 0.005),
            disc(toned(p, 0.7), (0.0, 0.03), 0.022, 0.006),
            *(bar(Material((0.05, 0.12, 0.45)) if s > 0 else RED_PAINT, (0.0, 0.06),
                (0.04 * s, 0.20), 0.022, 0.002) for s in (1.0, -1.0))])),
    thing("bowling pin", (PALE.colour,),
        lambda p: [post(p, (0.0, 0.0, 0.03), (0.055, 0.055, 0.06)),
            limb(p, (0.0, 0.0, 0.07), (0.0, 0.0, 0.17), 0.06),
            *lathe(p, [(0.19, 0.035), (0.28, 0.022)], 5),
            ball(p, (0.0, 0.0, 0.33), (0.065, 0.065, 0.10)),
            *(post(RED_PAINT, (0.0, 0.0, z), (w, w, 0.012)) for z,
                w in ((0.265, 0.055), (0.29, 0.053)))], ("ninepin", "skittle"),
        plurals=("bowling pins", "pins")),
    thing("parachute", _BRIGHT,
        lambda p: [*lathe(striped(p.colour, PALE.colour, 1.0),
            [(1.0, 2.0), (1.6, 1.7), (2.1, 0.9), (2.2, 0.3)], 7),
            *(rod(PALE, (1.9 * math.cos(a), 1.9 * math.sin(a), 1.0), (0.0, 0.0, -1.6), 0.012)
                for a in (0.0, 1.05, 2.09, 3.14, 4.19, 5.24)),
                box(INK, (0.0, 0.0, -1.75), (0.3, 0.4, 0.5))], goes=("air", "float", 1.5)),
))  # fmt: skip

_SNOW = placed("snow", (
    thing("ski", _BRIGHT, lambda p: [
        *(box(p, (0.0, y, 0.012), (1.55, 0.085, 0.02)) for y in (0.13, -0.13)),
        *(plank(p, (0.76, y, 0.012), (0.92, y, 0.10), chord=(0.0, 0.085, 0.0),
            thickness=(0.0, 0.0, 0.02)) for y in (0.13, -0.13)),
        *(box(INK, (-0.02, y, 0.04), (0.30, 0.07, 0.05)) for y in (0.13, -0.13)),
        *(box(PALE, (0.45, y, 0.023), (0.30, 0.05, 0.002)) for y in (0.13, -0.13))],
        ("skis", "pair of skis", "a pair of skis"), goes=("ground", "slide", 3.0)),
    thing("snowboard", _BRIGHT, lambda p: [
        box(p, (0.0, 0.0, 0.015), (1.15, 0.26, 0.02)),
        *(plank(p, (0.56 * s, 0.0, 0.015), (0.76 * s, 0.0, 0.07), chord=(0.0, 0.25, 0.0),
            thickness=(0.0, 0.0, 0.02)) for s in (1.0, -1.0)),
        *(box(INK, (x, 0.0, 0.05), (0.12, 0.22, 0.05)) for x in (0.25, -0.25)),
        box(YELLOW_PAINT, (0.0, 0.0, 0.0265), (0.24, 0.16, 0.002))], goes=("ground", "slide", 3.0)),
    thing("sled", (WOOD_BROWN,), lambda p: [
        *(box(p, (0.0, 0.08 * i, 0.24), (0.90, 0.06, 0.02)) for i in (-2, -1, 0, 1, 2)),
        *(part for y in (0.20, -0.20)
            for part in chain(RED_PAINT,
                [(-0.5, y, 0.02), (0.35, y, 0.02), (0.55, y, 0.14), (0.5, y, 0.26)], 0.016)),
        *(box(RED_PAINT, (x, y, 0.13), (0.03, 0.03, 0.22)) for x in (-0.3, 0.25)
            for y in (0.2, -0.2))], ("sledge", "toboggan"),
            goes=("ground", "slide", 2.5)),
))  # fmt: skip

_SEA = placed("sea", (
    thing("surfboard", ((0.75, 0.45, 0.02), PALE.colour, (0.05, 0.35, 0.50)), lambda p: [
        blade(p, (-1.0, 0.0, 0.10), (1.0, 0.0, 0.10), chord=(0.0, 0.55, 0.0),
            thickness=(0.0, 0.0, 0.09)),
            blade(RED_PAINT, (-0.98, 0.0, 0.107), (0.98, 0.0, 0.107), chord=(0.0, 0.10, 0.0),
                thickness=(0.0, 0.0, 0.085)),
        spike(INK, (-0.80, 0.0, 0.08), (-0.90, 0.0, -0.06), 0.05)],
        ("surf board",), goes=("water", "sail", 2.5)),
    thing("buoy", ((0.55, 0.03, 0.02), (0.75, 0.30, 0.02)), lambda p: [
        ball(p, (0.0, 0.0, 0.05), (0.9, 0.9, 0.6)), *lathe(p, [(0.2, 0.28), (1.1, 0.10)], 5),
        post(PALE, (0.0, 0.0, 0.65), (0.42, 0.42, 0.2)),
        ball(Material((1.0, 0.85, 0.4), emission=1.5), (0.0, 0.0, 1.2), (0.18, 0.18, 0.2))],
        goes=("water", "sail", 0.3)),
    thing("rubber duck", ((0.78, 0.55, 0.03),), lambda p: [
        ball(p, (0.0, 0.0, 0.02), (0.11, 0.085, 0.07)),
        ball(p, (0.032, 0.0, 0.072), (0.06, 0.056, 0.056)),
        spike(p, (-0.04, 0.0, 0.03), (-0.07, 0.0, 0.06), 0.02),
        blade(Material((0.75, 0.20, 0.01)), (0.055, 0.0, 0.068), (0.078, 0.0, 0.066),
            chord=(0.0, 0.03, 0.0), thickness=(0.0, 0.0, 0.012)),
        *(ball(INK, (0.054, y, 0.082), (0.010, 0.010, 0.012)) for y in (0.016, -0.016)),
        *(blade(toned(p, 0.85), (0.02, y, 0.025), (-0.04, 1.1 * y, 0.045), chord=(0.0, 0.01, 0.0),
            thickness=(0.0, 0.0, 0.035)) for y in (0.042, -0.042))], ("toy duck",),
            goes=("water", "paddle", 0.2)),
    thing("paper boat", (PALE.colour,), lambda p: [
        plank(p, (0.0, 0.0, -0.01), (0.0, 0.0, 0.05), chord=(0.14, 0.0, 0.0),
            thickness=(0.0, 0.06, 0.0)),
            *(plank(p, (0.05 * s, 0.0, 0.0), (0.13 * s, 0.0, 0.07), chord=(0.02, 0.0, 0.0),
                thickness=(0.0, 0.06, 0.0)) for s in (1.0, -1.0)),
                peak(toned(p, 0.9), (0.0, 0.0, 0.07), (0.11, 0.05, 0.10))],
                ("origami boat",), goes=("water", "sail", 0.3)),
    thing("raft", (WOOD_BROWN,),
        lambda p: [*(rod(mottled(p.colour), (-1.2, 0.22 * i, 0.08), (1.2, 0.22 * i, 0.08), 0.11)
            for i in range(-4, 5)),
            *(box(toned(p, 0.6), (x, 0.0, 0.20), (0.12, 2.0, 0.05)) for x in (0.8, -0.8))],
            ("wooden raft",), goes=("water", "sail", 0.8)),
    thing("canoe", ((0.50, 0.10, 0.03), (0.05, 0.25, 0.12)), lambda p: [
        blade(p, (-2.2, 0.0, 0.12), (2.2, 0.0, 0.12), chord=(0.0, 0.85, 0.0),
            thickness=(0.0, 0.0, 0.50)),
            blade(toned(p, 0.35), (-1.8, 0.0, 0.345), (1.8, 0.0, 0.345), chord=(0.0, 0.60, 0.0),
                thickness=(0.0, 0.0, 0.10)),
                *(box(Material(PALE_WOOD), (x, 0.0, 0.39), (0.16, 0.55, 0.03))
                    for x in (0.8, -0.8))], (),
                    goes=("water", "sail", 1.5)),
))  # fmt: skip

NOUNS = (*_SPORT, *_SNOW, *_SEA)
"""Nouns of sports gear."""

"""Street furniture, and what stands along roads and rails."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, glowing, mottled
from texvent.scenes.models.objects.figures import (
    Motion,
    Moving,
    bar,
    chain,
    disc,
    lathe,
    placed,
    ring,
    swinging,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLUE_PAINT,
    INK,
    IRON,
    PALE,
    RED_PAINT,
    SILVER,
    STEELY,
    STONE,
    WATER,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, box, limb, peak, plank, post, rod, turn_x

_PANE = Material((0.22, 0.34, 0.40))


def _octagon(skin: Material, z: float, size: float, x: float) -> list[ModelPart]:
    """A plate with eight sides: four bars across its middle."""
    side = 0.4142 * size
    return [
        bar(skin, (-0.5 * size * math.cos(a), z - 0.5 * size * math.sin(a)),
            (0.5 * size * math.cos(a), z + 0.5 * size * math.sin(a)), side, 0.02, x)
        for a in (0.0, 0.7854, 1.5708, 2.3562)
    ]  # fmt: skip


def _letters(z: float, x: float) -> list[ModelPart]:
    """The word STOP in strokes."""
    h, w = 0.085, 0.055

    def stroke(y0: float, z0: float, y1: float, z1: float) -> ModelPart:
        return bar(PALE, (y0, z + z0), (y1, z + z1), 0.022, 0.01, x)

    s, t, o, q = -0.24, -0.10, 0.07, 0.225
    return [
        stroke(s - w, h, s + w, h), stroke(s - w, h, s - w, 0.0), stroke(s - w, 0.0, s + w, 0.0),
        stroke(s + w, 0.0, s + w, -h), stroke(s - w, -h, s + w, -h), stroke(t - w, h, t + w, h),
        stroke(t, h, t, -h - 0.01), stroke(o - w, h, o + w, h),
        stroke(o - w, -h, o + w, -h), stroke(o - w, h, o - w, -h), stroke(o + w, h, o + w, -h),
        stroke(q - w, h + 0.01, q - w, -h - 0.01), stroke(q - w, h, q + w, h),
        stroke(q - w, 0.0, q + w, 0.0), stroke(q + w, h, q + w, 0.0),
    ]  # fmt: skip


def _rising(reach_rad: float, rate_hz: float, pivot: Point) -> Motion:
    """A barrier that lifts and comes down again."""
    return lambda pose: turn_x(
        -0.5 * reach_rad * (1.0 - math.cos(2.0 * math.pi * rate_hz * pose.time_s)), pivot
    )


NOUNS = placed("city", (
    thing("fire hydrant", (RED_PAINT.colour, YELLOW_PAINT.colour), lambda p: [
        post(p, (0.0, 0.0, 0.03), (0.34, 0.34, 0.06)),
        post(p, (0.0, 0.0, 0.28), (0.23, 0.23, 0.50)),
        post(toned(p, 0.8), (0.0, 0.0, 0.54), (0.29, 0.29, 0.05)),
        ball(p, (0.0, 0.0, 0.57), (0.25, 0.25, 0.22)),
        post(SILVER, (0.0, 0.0, 0.70), (0.07, 0.07, 0.06)),
        rod(p, (0.0, -0.20, 0.42), (0.0, 0.20, 0.42), 0.065),
        *(rod(SILVER, (0.0, 0.20 * s, 0.42), (0.0, 0.225 * s, 0.42), 0.075) for s in (1.0, -1.0)),
        disc(p, (0.0, 0.40), 0.085, 0.18, 0.10), disc(SILVER, (0.0, 0.40), 0.095, 0.03, 0.20),
        disc(INK, (0.0, 0.40), 0.03, 0.04, 0.21),
        post(toned(p, 0.8), (0.0, 0.0, 0.10), (0.27, 0.27, 0.04))], ("hydrant",)),
    thing("stop sign", (RED_PAINT.colour,),
        lambda p: [post(SILVER, (0.0, 0.0, 1.2), (0.07, 0.07, 2.4)),
            *_octagon(PALE, 2.2, 0.80, 0.04), *_octagon(p, 2.2, 0.74, 0.046),
            *_letters(2.2, 0.058)]),
    thing("parking meter", (STEELY, (0.03, 0.10, 0.30)),
        lambda p: [post(IRON, (0.0, 0.0, 0.50), (0.08, 0.08, 1.0)),
            post(IRON, (0.0, 0.0, 0.02), (0.2, 0.2, 0.04)),
            box(p, (0.0, 0.0, 1.10), (0.13, 0.20, 0.26)), disc(p, (0.0, 1.23), 0.10, 0.13),
            disc(Material((0.60, 0.66, 0.68)), (0.0, 1.24), 0.07, 0.138),
            bar(RED_PAINT, (0.0, 1.21), (0.03, 1.28), 0.01, 0.145),
            box(INK, (0.066, 0.0, 1.12), (0.006, 0.06, 0.012)),
            disc(SILVER, (0.0, 1.06), 0.025, 0.15),
            box(YELLOW_PAINT, (0.066, 0.0, 1.01), (0.006, 0.12, 0.04))]),
    thing("mailbox", ((0.03, 0.10, 0.42), RED_PAINT.colour),
        lambda p: [box(p, (0.0, 0.0, 0.62), (0.46, 0.50, 0.78)),
            rod(p, (-0.23, 0.0, 1.0), (0.23, 0.0, 1.0), 0.25),
            *(box(p, (x, y, 0.12), (0.06, 0.06, 0.26)) for x in (0.18, -0.18)
                for y in (0.2, -0.2)), box(INK, (0.235, 0.0, 1.05), (0.01, 0.34, 0.035)),
                box(toned(p, 1.6), (0.235, 0.0, 0.98), (0.02, 0.38, 0.06)),
                box(PALE, (0.232, 0.0, 0.70), (0.01, 0.24, 0.14)),
                bar(RED_PAINT, (-0.06, 0.70), (0.06, 0.70), 0.05, 0.02, 0.232)],
                ("letter box", "letterbox", "postbox", "post box", "mail box")),
    thing("dustbin", ((0.05, 0.26, 0.12), STEELY),
        lambda p: [*lathe(p, [(0.0, 0.22), (0.80, 0.28)], 6),
            post(toned(p, 0.7), (0.0, 0.0, 0.82), (0.60, 0.60, 0.05)),
            ball(toned(p, 0.8), (0.0, 0.0, 0.84), (0.56, 0.56, 0.16)),
            box(IRON, (0.0, 0.0, 0.93), (0.04, 0.18, 0.03)),
            *(box(IRON, (0.0, 0.29 * s, 0.62), (0.16, 0.04, 0.03)) for s in (1.0, -1.0))],
            ("trash can", "garbage can", "ashcan", "rubbish bin", "bin", "wastebin", "waste bin",
                "litter bin", "trash bin", "ash bin")),
    thing("dumpster", ((0.05, 0.26, 0.12), (0.03, 0.15, 0.40)),
        lambda p: [plank(p, (0.0, 0.0, 0.12), (0.0, 0.0, 1.20), chord=(1.1, 0.0, 0.0),
            thickness=(0.0, 1.9, 0.0)),
            *(plank(toned(p, 0.6), (-0.55, 0.48 * s, 1.30), (0.55, 0.48 * s, 1.18),
                chord=(0.0, 0.93, 0.0), thickness=(0.0, 0.0, 0.04)) for s in (1.0, -1.0)),
                *(bar(toned(p, 0.8), (y, 0.2), (y, 1.15), 0.06, 0.05, 0.56)
                    for y in (-0.8, -0.4, 0.0, 0.4, 0.8)),
                    *(ball(INK, (x, y, 0.07), (0.14, 0.10, 0.14)) for x in (0.4, -0.4)
                        for y in (0.8, -0.8))], ("waste container",)),
    thing("bus stop", (STEELY,),
        lambda p: [*(rod(IRON, (x, y, 0.0), (x, y, 2.4), 0.04) for x in (0.55, -0.55)
            for y in (1.5, -1.5)), box(p, (0.0, 0.0, 2.43), (1.4, 3.4, 0.10)),
            box(_PANE, (-0.55, 0.0, 1.3), (0.03, 3.0, 1.7)),
            box(_PANE, (0.0, -1.5, 1.3), (1.0, 0.03, 1.7)),
            box(Material(WOOD_BROWN), (-0.30, 0.2, 0.48), (0.35, 1.8, 0.06)),
            *(box(IRON, (-0.30, y, 0.23), (0.30, 0.05, 0.46)) for y in (-0.5, 0.9)),
            box(BLUE_PAINT, (0.45, 1.9, 2.35), (0.04, 0.5, 0.5)),
            rod(SILVER, (0.45, 1.9, 0.0), (0.45, 1.9, 2.6), 0.03),
            bar(PALE, (1.78, 2.35), (2.02, 2.35), 0.14, 0.01, 0.475)],
            ("bus shelter",)),
    thing("phone booth", (RED_PAINT.colour,),
        lambda p: [box(p, (0.0, 0.0, 2.25), (0.92, 0.92, 0.35)),
            box(p, (0.0, 0.0, 0.15), (0.92, 0.92, 0.30)),
            *(box(p, (0.42 * a, 0.42 * b, 1.2), (0.08, 0.08, 2.1)) for a in (1, -1)
                for b in (1, -1)), box(_PANE, (0.0, 0.0, 1.2), (0.84, 0.84, 1.9)),
                *(box(p, (0.0, 0.0, z), (0.87, 0.87, 0.03))
                    for z in (0.62, 0.96, 1.30, 1.64, 1.92)),
                    *(box(p, (0.0, y, 1.2), (0.87, 0.03, 1.8)) for y in (0.15, -0.15)),
                    box(PALE, (0.462, 0.0, 2.27), (0.01, 0.6, 0.12)),
                    ball(p, (0.0, 0.0, 2.42), (0.85, 0.85, 0.26))],
                    ("telephone box", "telephone booth", "phone box", "call box", "pay-phone")),
    thing("bollard", ((0.75, 0.45, 0.02), IRON.colour),
        lambda p: [post(p, (0.0, 0.0, 0.45), (0.18, 0.18, 0.90)),
            ball(p, (0.0, 0.0, 0.90), (0.18, 0.18, 0.14)),
            *(post(INK, (0.0, 0.0, z), (0.183, 0.183, 0.10)) for z in (0.35, 0.65))]),
    thing("gas pump", (RED_PAINT.colour, PALE.colour),
        lambda p: [box(p, (0.0, 0.0, 0.85), (0.50, 0.70, 1.5)),
            box(STONE, (0.0, 0.0, 0.05), (0.7, 0.9, 0.10)),
            box(PALE, (0.255, 0.0, 1.30), (0.02, 0.52, 0.40)),
            box(INK, (0.262, 0.0, 1.36), (0.02, 0.40, 0.14)),
            box(INK, (0.262, 0.0, 1.19), (0.02, 0.40, 0.08)),
            box(IRON, (0.10, 0.38, 1.05), (0.12, 0.07, 0.26)),
            *chain(INK, [(0.10, 0.40, 0.98), (0.12, 0.50, 0.50), (0.10, 0.42, 0.22),
                (0.0, 0.36, 0.40)], 0.022),
                box(toned(p, 0.7), (0.0, 0.0, 1.68), (0.54, 0.74, 0.14))],
                ("petrol pump", "fuel pump", "gasoline pump")),
    thing("vending machine", (RED_PAINT.colour, (0.03, 0.12, 0.42)),
        lambda p: [box(p, (0.0, 0.0, 0.92), (0.75, 0.95, 1.84)),
            box(glowing((0.55, 0.65, 0.75), 0.4), (0.37, -0.12, 1.10), (0.03, 0.60, 1.20)),
            *(box(INK, (0.39, -0.12, z), (0.012, 0.60, 0.02)) for z in (0.75, 1.0, 1.25, 1.5)),
            *(post(Material(h), (0.385, -0.32 + 0.1 * k, z), (0.06, 0.06, 0.14))
                for z in (0.83, 1.08, 1.33) for k,
                h in enumerate(((0.5, 0.03, 0.02), (0.05, 0.3, 0.08), (0.75, 0.4, 0.02),
                    (0.03, 0.15, 0.45), (0.5, 0.03, 0.02)))),
                    box(INK, (0.38, 0.34, 1.25), (0.01, 0.14, 0.30)),
                    box(INK, (0.38, -0.12, 0.30), (0.01, 0.55, 0.20))],
                    ("snack machine",)),
    thing("fountain", (STONE.colour,),
        lambda p: [*lathe(mottled(p.colour, contrast=0.2), [(0.0, 1.6), (0.45, 1.7)], 2),
            post(WATER, (0.0, 0.0, 0.452), (3.0, 3.0, 0.02)),
            *lathe(mottled(p.colour, contrast=0.2), [(0.4, 0.25), (1.0, 0.16)], 3),
            *lathe(mottled(p.colour, contrast=0.2), [(1.0, 0.2), (1.15, 0.75)], 3),
            post(WATER, (0.0, 0.0, 1.16), (1.3, 1.3, 0.02)),
            *lathe(mottled(p.colour, contrast=0.2), [(1.15, 0.12), (1.5, 0.10)], 2)],
            ("water fountain", "water feature"), moving=(Moving(lambda p: [
        *(limb(Material((0.72, 0.80, 0.84)), (0.05 * math.cos(a), 0.05 * math.sin(a), 1.5),
            (0.40 * math.cos(a), 0.40 * math.sin(a), 2.1), 0.05)
            for a in (1.047 * i for i in range(6))),
            *(limb(Material((0.72, 0.80, 0.84)), (0.40 * math.cos(a), 0.40 * math.sin(a), 2.1),
                (0.62 * math.cos(a), 0.62 * math.sin(a), 1.25), 0.05)
                for a in (1.047 * i for i in range(6)))], swinging("z", 0.15, 1.2)),)),
    thing("statue", (STONE.colour, (0.22, 0.34, 0.28)),
        lambda p: [box(STONE, (0.0, 0.0, 0.45), (0.9, 0.9, 0.9)),
            box(STONE, (0.0, 0.0, 0.06), (1.2, 1.2, 0.12)),
            *(limb(p, (0.0, 0.09 * s, 1.65), (0.03 * s, 0.11 * s, 0.98), 0.10)
                for s in (1.0, -1.0)), limb(p, (0.0, 0.0, 1.65), (0.0, 0.0, 2.15), 0.20),
                ball(p, (0.0, 0.0, 2.50), (0.22, 0.20, 0.27)),
                limb(p, (0.0, 0.22, 2.22), (0.02, 0.48, 2.62), 0.065),
                limb(p, (0.0, -0.22, 2.22), (0.05, -0.26, 1.78), 0.065),
                rod(p, (0.02, 0.48, 2.55), (0.02, 0.50, 3.0), 0.02),
                peak(p, (-0.04, 0.0, 1.65), (0.4, 0.52, 1.0))], ("sculpture",)),
    thing("chimney", (STEELY, (0.36, 0.10, 0.06)),
        lambda p: [*lathe(mottled(p.colour, contrast=0.2), [(0.0, 1.8), (30.0, 1.0)], 8),
            *(post(h, (0.0, 0.0, z), (w, w, 2.0)) for h, z,
                w in ((RED_PAINT, 28.4, 2.25), (PALE, 26.4, 2.32), (RED_PAINT, 24.4, 2.42))),
                post(INK, (0.0, 0.0, 29.5), (1.8, 1.8, 0.1)),
                box(Material((0.40, 0.38, 0.35)), (0.0, 4.0, 2.5), (6.0, 6.0, 5.0))],
                ("smokestack", "factory chimney")),
    thing("power pylon", (STEELY,),
        lambda p: [*(rod(p, (2.2 * a, 2.2 * b, 0.0), (0.5 * a, 0.5 * b, 16.0), 0.16)
            for a in (1, -1) for b in (1, -1)),
            *(rod(p, (0.5 * a, 0.5 * b, 16.0), (0.0, 0.0, 24.0), 0.12) for a in (1, -1)
                for b in (1, -1)), *(bar(p, (-y, z), (y, z), 0.25, 0.3) for y,
                z in ((4.5, 17.0), (3.5, 20.0))),
                *(bar(p, (s * 1.7 * (1 - z / 20.0), z), (-s * 1.7 * (1 - (z + 4) / 20.0), z + 4.0),
                    0.12, 0.12, 1.7 * (1 - z / 18.0)) for z in (0.5, 4.5, 8.5) for s in (1, -1)),
                    *(rod(Material((0.35, 0.15, 0.08)), (0.0, y, 16.9), (0.0, y, 15.8), 0.12)
                        for y in (4.3, -4.3))],
                        ("electricity pylon",)),
    thing("park lamp", (IRON.colour,),
        lambda p: [*lathe(p, [(0.0, 0.16), (0.4, 0.08)], 3),
            post(p, (0.0, 0.0, 1.4), (0.08, 0.08, 2.4)),
            ball(glowing((1.0, 0.88, 0.62), 2.0), (0.0, 0.0, 2.8), (0.36, 0.36, 0.40)),
            post(p, (0.0, 0.0, 2.62), (0.2, 0.2, 0.06)),
            post(p, (0.0, 0.0, 3.02), (0.12, 0.12, 0.10))],
            ("gas lamp", "garden lamp", "garden light")),
    thing("railway crossing", (RED_PAINT.colour,),
        lambda p: [post(SILVER, (0.0, 1.6, 1.5), (0.12, 0.12, 3.0)),
            *(bar(PALE, (1.6 - 0.5 * s, 2.3), (1.6 + 0.5 * s, 2.9), 0.14, 0.02, 0.08)
                for s in (1.0, -1.0)),
                *(disc(glowing((0.9, 0.03, 0.02), 1.5), (1.6 + 0.22 * s, 1.95), 0.12, 0.06, 0.10)
                    for s in (1.0, -1.0)), box(INK, (0.06, 1.6, 1.95), (0.05, 0.8, 0.32)),
                    box(IRON, (0.0, 1.6, 0.5), (0.3, 0.3, 1.0))],
                    ("level crossing", "railroad crossing", "crossing gate", "boom barrier"),
                    moving=(Moving(lambda p: [*(bar(p if k % 2 else PALE, (1.6 - 0.5 * k, 0.95),
                        (1.6 - 0.5 * (k + 1), 0.95), 0.12, 0.06, 0.16) for k in range(8))],
                        _rising(0.9, 0.15, (0.0, 1.6, 0.95))),)),
    thing("manhole cover", (IRON.colour,),
        lambda p: [post(p, (0.0, 0.0, 0.02), (0.66, 0.66, 0.04)),
            *ring(toned(p, 2.5), (0.0, 0.0, 0.04), (0.29, 0.29), 0.012, axis="z", pieces=20),
            *(box(toned(p, 2.5), (x, y, 0.04), (0.05, 0.05, 0.014))
                for x in (-0.16, -0.05, 0.05, 0.16) for y in (-0.16, -0.05, 0.05, 0.16))],
                ("manhole",)),
    thing("landing pad", (IRON.colour,),
        lambda p: [post(p, (0.0, 0.0, 0.02), (2.0, 2.0, 0.04)),
            *ring(PALE, (0.0, 0.0, 0.04), (0.85, 0.85), 0.03, axis="z", pieces=32),
            box(PALE, (0.0, 0.0, 0.045), (0.12, 0.5, 0.01)),
            *(box(PALE, (0.0, y, 0.045), (0.8, 0.12, 0.01)) for y in (-0.28, 0.28))],
        ("helipad", "landing platform", "takeoff pad", "launch pad", "helicopter pad",
         "landing zone")),
    thing("tent", ((0.75, 0.30, 0.02), (0.05, 0.28, 0.15)),
        lambda p: [*(plank(p, (0.0, 1.05 * s, 0.0), (0.0, 0.0, 1.35), chord=(2.2, 0.0, 0.0),
            thickness=(0.0, 0.03, 0.02)) for s in (1.0, -1.0)),
            *(bar(toned(p, 0.5), (0.48 * s, 0.0), (0.02 * s, 1.24), 0.22, 0.03, 1.06 - 0.001 * k)
                for k, s in ((0, 1.0), (1, -1.0))),
                *(rod(PALE, (1.1 * a, 0.0, 1.33), (1.9 * a, 0.0, 0.0), 0.012)
                    for a in (1.0, -1.0)),
                    rod(Material(WOOD_BROWN), (1.1, 0.0, 0.0), (1.1, 0.0, 1.4), 0.025)],
                    ("camping tent", "mountain tent")),
))  # fmt: skip
"""Nouns of street furniture."""

"""Tools of workshop, house and garden, and what they work on."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, glowing, striped
from texvent.scenes.models.objects.figures import (
    Motion,
    Moving,
    bar,
    chain,
    disc,
    lathe,
    lying,
    placed,
    rectangle,
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
    PALE_WOOD,
    RED_PAINT,
    SILVER,
    SILVERY,
    STEELY,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    ball,
    blade,
    box,
    compose,
    limb,
    plank,
    post,
    rod,
    shift,
    spike,
    turn_x,
)
from texvent.scenes.scene import Colour

_GRIPS: tuple[Colour, ...] = ((0.55, 0.03, 0.02), (0.75, 0.45, 0.02), (0.03, 0.15, 0.50))
_WOOD = Material(PALE_WOOD)


def _staff(
    skin: Material, long: float, head: list[ModelPart], radius: float = 0.014
) -> list[ModelPart]:
    """A long handle with a head at its upper end, laid down."""
    return lying([rod(skin, (0.0, 0.0, 0.0), (0.0, 0.0, long), radius), *head])


def _teeth(skin: Material, radius: float, count: int, size: float, deep: float) -> list[ModelPart]:
    """Teeth of a gear that faces +x, around its middle."""
    angles = [2.0 * math.pi * k / count for k in range(count)]
    return [
        bar(
            skin,
            (0.9 * radius * math.cos(a), 0.9 * radius * math.sin(a)),
            ((radius + size) * math.cos(a), (radius + size) * math.sin(a)),
            1.1 * size,
            deep,
        )
        for a in angles
    ]


def _gear(skin: Material, radius: float, count: int) -> list[ModelPart]:
    return [disc(skin, (0.0, 0.0), radius, 0.05),
        *_teeth(skin, radius, count, 0.16 * radius, 0.05),
        disc(toned(skin, 0.5), (0.0, 0.0), 0.72 * radius, 0.054),
            *(bar(skin, (-0.75 * radius * math.cos(a), -0.75 * radius * math.sin(a)),
                (0.75 * radius * math.cos(a), 0.75 * radius * math.sin(a)), 0.16 * radius, 0.058)
                for a in (0.0, 1.047, 2.094)),
                disc(INK, (0.0, 0.0), 0.14 * radius, 0.064)]  # fmt: skip


def _geared(y: float, ratio: float, start: float) -> Motion:
    """A gear at a place along y, which turns `ratio` times as fast as the first."""
    return lambda pose: compose(
        shift(0.0, y, 0.24), turn_x(2.0 * math.pi * 0.25 * ratio * pose.time_s + start)
    )


NOUNS = placed("indoor", (
    thing("hammer", (_GRIPS[0], PALE_WOOD), lambda p: lying([
        bar(p, (0.0, 0.0), (0.0, 0.25), 0.030, 0.022),
        bar(SILVER, (0.0, 0.24), (0.0, 0.31), 0.024, 0.018),
        rod(IRON, (0.0, -0.06, 0.30), (0.0, 0.03, 0.30), 0.017),
        rod(IRON, (0.0, -0.075, 0.30), (0.0, -0.055, 0.30), 0.021),
        *chain(IRON, [(0.0, 0.02, 0.305), (0.0, 0.06, 0.30), (0.0, 0.09, 0.27)], 0.011)]),
        ("claw hammer",)),
    thing("mallet", (PALE_WOOD,),
        lambda p: _staff(p, 0.32,
            [rod(toned(p, 0.8), (0.0, -0.08, 0.32), (0.0, 0.08, 0.32), 0.05)])),
    thing("sledgehammer", (PALE_WOOD,),
        lambda p: _staff(p, 0.85, [box(IRON, (0.0, 0.0, 0.85), (0.07, 0.20, 0.07))], 0.018)),
    thing("axe", (PALE_WOOD, _GRIPS[0]),
        lambda p: _staff(p, 0.60,
            [box(IRON, (0.0, 0.0, 0.55), (0.035, 0.07, 0.07)),
                bar(IRON, (0.02, 0.55), (0.10, 0.55), 0.10, 0.022),
                bar(SILVER, (0.10, 0.55), (0.14, 0.55), 0.16, 0.012)], 0.016),
                ("ax", "hatchet")),
    thing("screwdriver", _GRIPS,
        lambda p: lying([rod(p, (0.0, 0.0, 0.0), (0.0, 0.0, 0.10), 0.015),
            ball(p, (0.0, 0.0, 0.0), (0.030, 0.030, 0.03)),
            *(rod(toned(p, 0.4), (0.0, 0.0, z), (0.0, 0.0, z + 0.008), 0.0155)
                for z in (0.02, 0.08)), rod(SILVER, (0.0, 0.0, 0.10), (0.0, 0.0, 0.21), 0.0042),
                bar(SILVER, (0.0, 0.20), (0.0, 0.225), 0.009, 0.003)])),
    thing("wrench", (SILVERY,),
        lambda p: lying([bar(p, (0.0, 0.03), (0.0, 0.20), 0.020, 0.008),
            *ring(p, (0.0, 0.0, 0.02), (0.018, 0.018), 0.007, pieces=10),
            *(bar(p, (0.012 * s, 0.205), (0.022 * s, 0.245), 0.016, 0.010) for s in (1.0, -1.0)),
            bar(p, (-0.02, 0.205), (0.02, 0.205), 0.02, 0.010)]), ("spanner", "monkey wrench")),
    thing("pliers", _GRIPS,
        lambda p: lying([*(part for s in (1.0, -1.0)
            for part in chain(p, [(0.0, 0.035 * s, 0.0), (0.0, 0.03 * s, 0.07),
                (0.0, 0.008 * s, 0.11)], 0.009)), disc(SILVER, (0.0, 0.12), 0.016, 0.014),
                *(bar(SILVER, (0.006 * s, 0.12), (0.004 * s, 0.175), 0.011, 0.010)
                    for s in (1.0, -1.0))]),
                    ("pair of pliers", "a pair of pliers"),
                    plurals=("pliers",)),
    thing("saw", (PALE_WOOD, _GRIPS[0]),
        lambda p: lying([bar(SILVER, (0.0, 0.04), (0.42, 0.06), 0.085, 0.004),
            *(bar(SILVER, (0.01 + 0.03 * i, 0.004), (0.02 + 0.03 * i, -0.012), 0.012, 0.004)
                for i in range(13)), *rectangle(p, (-0.05, 0.04), (0.13, 0.12), 0.035, 0.024)]),
                ("handsaw", "hand saw")),
    thing("chainsaw", ((0.75, 0.22, 0.01),),
        lambda p: lying([box(p, (0.0, -0.10, 0.10), (0.12, 0.26, 0.18)),
            bar(SILVER, (0.0, 0.08), (0.42, 0.08), 0.075, 0.008),
            disc(SILVER, (0.42, 0.08), 0.038, 0.008),
            bar(INK, (0.0, 0.118), (0.42, 0.118), 0.010, 0.014),
            bar(INK, (0.0, 0.042), (0.42, 0.042), 0.010, 0.014),
            *chain(INK, [(0.0, -0.02, 0.19), (0.0, -0.02, 0.26), (0.0, -0.16, 0.25),
                (0.0, -0.24, 0.16)], 0.014)]), ("chain saw", "power saw")),
    thing("drill", ((0.75, 0.45, 0.02), (0.03, 0.20, 0.45)), lambda p: lying([
        rod(p, (0.0, -0.06, 0.20), (0.0, 0.08, 0.20), 0.034),
        bar(p, (-0.03, 0.02), (-0.01, 0.18), 0.045, 0.036),
        box(INK, (0.0, -0.03, 0.01), (0.07, 0.11, 0.05)),
        rod(INK, (0.0, 0.08, 0.20), (0.0, 0.13, 0.20), 0.020),
        rod(SILVER, (0.0, 0.13, 0.20), (0.0, 0.24, 0.20), 0.004),
        box(RED_PAINT, (0.0, 0.025, 0.14), (0.02, 0.02, 0.03)),
        rod(INK, (0.0, -0.085, 0.20), (0.0, -0.06, 0.20), 0.030)]),
        ("power drill", "electric drill", "cordless drill")),
    thing("nail", (SILVERY,),
        lambda p: [post(p, (0.0, 0.0, 0.0775), (0.012, 0.012, 0.003)),
            rod(p, (0.0, 0.0, 0.012), (0.0, 0.0, 0.078), 0.0022),
            spike(p, (0.0, 0.0, 0.012), (0.0, 0.0, 0.0), 0.0022)]),
    thing("screw", (SILVERY, BRASS.colour),
        lambda p: [*lathe(p, [(0.038, 0.003), (0.044, 0.008)], 3),
            box(INK, (0.0, 0.0, 0.0445), (0.013, 0.002, 0.002)),
            rod(toned(p, 0.6), (0.0, 0.0, 0.008), (0.0, 0.0, 0.04), 0.0022),
            spike(p, (0.0, 0.0, 0.010), (0.0, 0.0, 0.0), 0.0025),
            *(post(p, (0.0, 0.0, 0.010 + 0.004 * i), (0.0075, 0.0075, 0.0012)) for i in range(7))],
            ("wood screw", "bolt")),
    thing("tape measure", ((0.75, 0.45, 0.02),),
        lambda p: [disc(p, (0.0, 0.035), 0.035, 0.03), disc(INK, (0.0, 0.035), 0.02, 0.032),
            box(YELLOW_PAINT, (0.0, 0.10, 0.003), (0.018, 0.16, 0.002)),
            *(box(INK, (0.004, 0.05 + 0.02 * i, 0.0042), (0.01, 0.002, 0.001)) for i in range(7))],
            ("measuring tape",)),
    thing("ruler", ((0.70, 0.50, 0.14),),
        lambda p: lying([bar(p, (-0.155, 0.0), (0.155, 0.0), 0.035, 0.004),
            *(bar(INK, (-0.15 + 0.015 * i, 0.005 if i % 2 else 0.0), (-0.15 + 0.015 * i, 0.016),
                0.0016, 0.005, 0.001) for i in range(21))]), ("yardstick",)),
    thing("shovel", (PALE_WOOD,),
        lambda p: _staff(p, 1.10,
            [ball(Material(STEELY), (0.0, 0.0, 1.24), (0.03, 0.24, 0.36)),
                bar(Material(STEELY), (0.0, 1.05), (0.0, 1.15), 0.05, 0.03),
                rod(p, (0.0, -0.06, 0.0), (0.0, 0.06, 0.0), 0.016)]), ("spade", "snow shovel")),
    thing("rake", (PALE_WOOD,),
        lambda p: _staff(p, 1.30,
            [bar(IRON, (-0.20, 1.30), (0.20, 1.30), 0.03, 0.02),
                *(bar(IRON, (-0.19 + 0.042 * i, 1.30), (-0.19 + 0.042 * i, 1.38), 0.010, 0.01)
                    for i in range(10))])),
    thing("pitchfork", (PALE_WOOD,),
        lambda p: _staff(p, 1.10,
            [bar(IRON, (-0.10, 1.10), (0.10, 1.10), 0.02, 0.02),
                *(bar(IRON, (y, 1.10), (y, 1.40), 0.012, 0.012)
                    for y in (-0.1, -0.033, 0.033, 0.1))]), ("garden fork",)),
    thing("broom", (PALE_WOOD, _GRIPS[0]),
        lambda p: _staff(p, 1.20,
            [bar(Material((0.55, 0.04, 0.03)), (-0.16, 1.21), (0.16, 1.21), 0.05, 0.05),
                *(bar(Material((0.60, 0.42, 0.14)), (-0.14 + 0.031 * i, 1.22),
                    (-0.17 + 0.038 * i, 1.38), 0.028, 0.04) for i in range(10))])),
    thing("mop", (PALE_WOOD,),
        lambda p: _staff(p, 1.20,
            [*(limb(PALE, (0.0, 0.0, 1.20),
                (0.01, -0.13 + 0.043 * i, 1.42 - 0.3 * abs(-0.13 + 0.043 * i)), 0.022)
                for i in range(7)), bar(RED_PAINT, (-0.05, 1.2), (0.05, 1.2), 0.05, 0.05)])),
    thing("plunger", (PALE_WOOD,),
        lambda p: [rod(p, (0.0, 0.0, 0.1), (0.0, 0.0, 0.55), 0.012),
            *lathe(Material((0.40, 0.05, 0.03)), [(0.0, 0.075), (0.06, 0.065), (0.11, 0.025)], 6)]),
    thing("ladder", (PALE_WOOD, SILVERY),
        lambda p: [*(plank(p, (0.55, 0.22 * s, 0.0), (0.0, 0.18 * s, 2.2), chord=(0.0, 0.05, 0.0),
            thickness=(0.07, 0.0, 0.0)) for s in (1.0, -1.0)),
            *(plank(toned(p, 0.7), (-0.50, 0.22 * s, 0.0), (0.0, 0.18 * s, 2.2),
                chord=(0.0, 0.04, 0.0), thickness=(0.05, 0.0, 0.0)) for s in (1.0, -1.0)),
        *(box(p, (0.55 - 0.25 * z, 0.0, z), (0.10, 0.42, 0.03))
            for z in (0.3, 0.65, 1.0, 1.35, 1.7)), box(p, (0.0, 0.0, 2.2), (0.20, 0.42, 0.04)),
            bar(toned(p, 0.6), (-0.2, 0.8), (0.2, 0.8), 0.04, 0.03, -0.32)],
            ("stepladder", "step ladder")),
    thing("gear", (STEELY, BRASS.colour),
        lambda p: [box(INK, (-0.06, 0.08, 0.02), (0.10, 0.62, 0.04)),
            *(box(INK, (-0.07, y, h), (0.03, 0.06, 2 * h)) for y,
                h in ((-0.05, 0.12), (0.23, 0.12)))],
                ("cog", "cogwheel", "gears", "gear wheel", "pair of gears"), moving=(
        Moving(lambda p: _gear(p, 0.16, 14), _geared(-0.05, 1.0, 0.0)),
        Moving(lambda p: _gear(toned(p, 0.75), 0.0914, 8), _geared(0.23, -14 / 8, 0.39)))),
    thing("propeller", ((0.36, 0.37, 0.39), (0.30, 0.15, 0.06)),
        lambda p: [post(IRON, (-0.10, 0.0, 0.35), (0.07, 0.07, 0.70)),
            box(IRON, (-0.10, 0.0, 0.02), (0.35, 0.35, 0.04)),
            rod(IRON, (-0.15, 0.0, 0.72), (0.0, 0.0, 0.72), 0.055)],
            ("airscrew", "propellor"), moving=(Moving(lambda p: [
        *(blade(p, (0.02, 0.04 * math.sin(a), 0.72 + 0.04 * math.cos(a)),
            (0.02, 0.62 * math.sin(a), 0.72 + 0.62 * math.cos(a)),
            chord=(0.05, 0.11 * math.cos(a), -0.11 * math.sin(a)), thickness=(0.02, 0.0, 0.0))
            for a in (0.0, 2.094, 4.189)),
            spike(RED_PAINT, (-0.02, 0.0, 0.72), (0.14, 0.0, 0.72), 0.06),
        *(disc(YELLOW_PAINT, (0.57 * math.sin(a), 0.72 + 0.57 * math.cos(a)), 0.03, 0.02, 0.02)
            for a in (0.0, 2.094, 4.189))], spinning("x", 2.24, (0.0, 0.0, 0.72))),)),
    thing("pinwheel", (_GRIPS[0],),
        lambda p: [rod(PALE, (0.0, 0.0, 0.0), (0.0, 0.0, 0.42), 0.006)],
        ("toy windmill", "paper windmill"), moving=(Moving(lambda p: [
        *(plank(Material(hue), (0.015, 0.01 * math.sin(a), 0.42 + 0.01 * math.cos(a)),
            (0.015, 0.12 * math.sin(a) + 0.05 * math.cos(a),
                0.42 + 0.12 * math.cos(a) - 0.05 * math.sin(a)),
                chord=(0.03, 0.07 * math.cos(a), -0.07 * math.sin(a)),
                thickness=(0.004, 0.0, 0.0)) for a,
                hue in zip((0.0, 1.571, 3.142, 4.712), (p.colour, *_GRIPS[1:], (0.05, 0.35, 0.08)),
                    strict=True)), disc(PALE, (0.0, 0.42), 0.018, 0.05, 0.015)],
                    spinning("x", 0.9, (0.0, 0.0, 0.42))),)),
    thing("spring", (SILVERY,),
        lambda p: chain(p, [(0.05 * math.cos(0.785 * i), 0.05 * math.sin(0.785 * i),
            0.01 + 0.0048 * i) for i in range(41)], 0.006), ("coil spring",)),
    thing("rope", ((0.50, 0.36, 0.16),),
        lambda p: [*(part for i in range(3)
            for part in ring(striped(p.colour, toned(p, 0.6).colour, 3.0),
                (0.0, 0.0, 0.03 + 0.045 * i), (0.26 - 0.02 * i, 0.26 - 0.02 * i), 0.03, axis="z",
                pieces=12)), limb(striped(p.colour, toned(p, 0.6).colour, 3.0), (0.12, 0.24, 0.02),
                (0.15, 0.62, 0.02), 0.026)], ("coil of rope",)),
    thing("hose", ((0.05, 0.30, 0.08),),
        lambda p: [*(part for i in range(3)
            for part in ring(p, (0.0, 0.0, 0.025 + 0.04 * i), (0.24 - 0.02 * i, 0.24 - 0.02 * i),
                0.022, axis="z", pieces=12)),
                *chain(p, [(0.1, 0.22, 0.02), (0.2, 0.42, 0.02), (0.12, 0.6, 0.02)], 0.022),
                rod(YELLOW_PAINT, (0.12, 0.58, 0.022), (0.09, 0.72, 0.022), 0.024)],
                ("garden hose",)),
    thing("pipe", (STEELY, SILVERY),
        lambda p: [rod(p, (0.0, -0.9, 0.11), (0.0, 0.9, 0.11), 0.09),
            *(rod(toned(p, 0.7), (0.0, y, 0.11), (0.0, y + 0.08, 0.11), 0.11)
                for y in (-0.9, -0.04, 0.82)),
                rod(INK, (0.0, 0.9, 0.11), (0.0, 0.903, 0.11), 0.075),
                rod(INK, (0.0, -0.903, 0.11), (0.0, -0.9, 0.11), 0.075)],
                ("metal pipe",)),
    thing("chain", (SILVERY, IRON.colour),
        lambda p: [part for i in range(7)
            for part in ring(p, (0.0, 0.11 * i - 0.33, 0.03), (0.08, 0.035), 0.014,
                axis="z" if i % 2 else "x", pieces=8)], ("metal chain",)),
    thing("magnet", ((0.55, 0.03, 0.02),),
        lambda p: lying([*ring(p, (0.0, 0.0, 0.06), (0.04, 0.045), 0.016, span=(180.0, 360.0),
            pieces=8), *(bar(p, (0.04 * s, 0.06), (0.04 * s, 0.11), 0.03, 0.03)
                for s in (1.0, -1.0)),
                *(bar(SILVER, (0.04 * s, 0.11), (0.04 * s, 0.14), 0.03, 0.03)
                    for s in (1.0, -1.0))]), ("horseshoe magnet",)),
    thing("syringe", (PALE.colour,),
        lambda p: lying([rod(Material((0.40, 0.55, 0.60)), (0.0, 0.0, 0.04), (0.0, 0.0, 0.12),
            0.010), rod(p, (0.0, 0.0, 0.12), (0.0, 0.0, 0.17), 0.004),
            bar(p, (-0.02, 0.12), (0.02, 0.12), 0.005, 0.014),
            bar(p, (-0.014, 0.17), (0.014, 0.17), 0.005, 0.014),
            spike(SILVER, (0.0, 0.0, 0.04), (0.0, 0.0, 0.0), 0.0035),
            *(bar(INK, (0.0, 0.05 + 0.014 * i), (0.008, 0.05 + 0.014 * i), 0.0015, 0.021)
                for i in range(5))])),
    thing("magnifying glass", (INK.colour, WOOD_BROWN),
        lambda p: lying([rod(p, (0.0, 0.0, 0.0), (0.0, 0.0, 0.10), 0.010),
            *ring(SILVER, (0.0, 0.0, 0.155), (0.05, 0.05), 0.006, pieces=14),
            disc(Material((0.50, 0.62, 0.68)), (0.0, 0.155), 0.047, 0.006)]),
            ("magnifier", "loupe")),
    thing("telescope", (PALE.colour, (0.03, 0.10, 0.35)),
        lambda p: [*(rod(INK, (0.0, 0.0, 0.95), (0.45 * c, 0.45 * s, 0.0), 0.02) for c,
            s in ((1, 0), (-0.5, 0.87), (-0.5, -0.87))),
            rod(p, (0.0, -0.42, 0.85), (0.0, 0.38, 1.32), 0.075),
            rod(INK, (0.0, 0.36, 1.31), (0.0, 0.46, 1.37), 0.09),
            rod(INK, (0.0, -0.50, 0.80), (0.0, -0.42, 0.85), 0.03),
            ball(INK, (0.0, 0.0, 1.0), (0.12, 0.12, 0.12))]),
    thing("microscope", (PALE.colour, IRON.colour),
        lambda p: [box(IRON, (0.0, 0.0, 0.02), (0.16, 0.22, 0.04)),
            box(p, (0.0, 0.08, 0.16), (0.05, 0.05, 0.26)),
            box(IRON, (0.0, -0.02, 0.12), (0.12, 0.14, 0.015)),
            rod(p, (0.0, -0.03, 0.17), (0.0, 0.01, 0.34), 0.022),
            rod(IRON, (0.0, 0.01, 0.34), (0.0, 0.022, 0.39), 0.016),
            rod(SILVER, (0.0, -0.036, 0.135), (0.0, -0.03, 0.17), 0.012),
            box(p, (0.0, 0.035, 0.28), (0.04, 0.10, 0.04)), disc(IRON, (0.08, 0.10), 0.025, 0.08),
            ball(glowing((1.0, 0.9, 0.7), 1.0), (0.0, -0.03, 0.055), (0.05, 0.05, 0.03))]),
    thing("compass", (BRASS.colour,),
        lambda p: [post(p, (0.0, 0.0, 0.008), (0.07, 0.07, 0.016)),
            post(PALE, (0.0, 0.0, 0.0165), (0.06, 0.06, 0.002)),
            *(box(INK, (0.026 * c, 0.026 * s, 0.0178), (0.004, 0.004, 0.001)) for c,
                s in ((1, 0), (-1, 0), (0, 1), (0, -1)))], ("magnetic compass",),
                moving=(Moving(lambda p: [
        blade(RED_PAINT, (0.0, 0.0, 0.019), (0.024, 0.0, 0.019), chord=(0.0, 0.008, 0.0),
            thickness=(0.0, 0.0, 0.002)),
            blade(INK, (0.0, 0.0, 0.019), (-0.024, 0.0, 0.019), chord=(0.0, 0.008, 0.0),
                thickness=(0.0, 0.0, 0.002))], spinning("z", 0.1)),)),
    thing("scale", (RED_PAINT.colour, STEELY),
        lambda p: [box(p, (0.0, 0.0, 0.08), (0.20, 0.24, 0.16)),
            disc(PALE, (0.0, 0.085), 0.065, 0.02, 0.10),
            post(SILVER, (0.0, 0.0, 0.18), (0.04, 0.04, 0.05)),
            *lathe(SILVER, [(0.20, 0.05), (0.23, 0.13)], 3),
            bar(RED_PAINT, (0.0, 0.085), (0.03, 0.125), 0.006, 0.024, 0.10)],
            ("kitchen scale", "weighing machine")),
    thing("hourglass", (WOOD_BROWN,),
        lambda p: [*(post(p, (0.0, 0.0, z), (0.12, 0.12, 0.015)) for z in (0.008, 0.212)),
            *(rod(p, (0.05 * c, 0.05 * s, 0.01), (0.05 * c, 0.05 * s, 0.21), 0.005) for c,
                s in ((0.5, 0.87), (0.5, -0.87), (-1, 0))),
                *lathe(Material((0.50, 0.62, 0.66)),
                    [(0.015, 0.04), (0.07, 0.035), (0.11, 0.006), (0.15, 0.035), (0.205, 0.04)],
                    14), *lathe(Material((0.60, 0.42, 0.16)), [(0.0155, 0.041), (0.06, 0.037)],
                    3)], ("sand timer",)),
    thing("bell", (BRASS.colour,),
        lambda p: [*(rod(Material(DARK_WOOD), (0.0, 0.22 * s, 0.0), (0.0, 0.22 * s, 0.52), 0.02)
            for s in (1.0, -1.0)),
            rod(Material(DARK_WOOD), (0.0, -0.24, 0.52), (0.0, 0.24, 0.52), 0.022)],
            (), moving=(Moving(lambda p: [
        *lathe(p, [(0.12, 0.145), (0.16, 0.115), (0.34, 0.085), (0.42, 0.05)], 10),
        rod(p, (0.0, 0.0, 0.42), (0.0, 0.0, 0.52), 0.02),
        ball(IRON, (0.0, 0.0, 0.11), (0.06, 0.06, 0.06))],
        swinging("x", 0.5, 0.7, (0.0, 0.0, 0.52))),)),
    thing("anchor", (IRON.colour,),
        lambda p: [rod(p, (0.0, 0.0, 0.05), (0.0, 0.0, 1.05), 0.045),
            *ring(p, (0.0, 0.0, 1.14), (0.10, 0.10), 0.03, pieces=10),
            rod(p, (0.0, -0.3, 0.92), (0.0, 0.3, 0.92), 0.035),
            *ring(p, (0.0, 0.0, 0.48), (0.46, 0.44), 0.045, span=(195.0, 345.0), pieces=9),
            *(spike(p, (0.0, 0.40 * s, 0.30), (0.0, 0.47 * s, 0.55), 0.09) for s in (1.0, -1.0))]),
    thing("anvil", (IRON.colour,),
        lambda p: [box(p, (0.0, 0.0, 0.05), (0.22, 0.36, 0.10)),
            box(p, (0.0, 0.0, 0.16), (0.12, 0.20, 0.14)),
            box(toned(p, 1.4), (0.0, 0.04, 0.27), (0.14, 0.40, 0.10)),
            spike(toned(p, 1.4), (0.0, -0.15, 0.275), (0.0, -0.40, 0.30), 0.06)]),
    thing("sword", (SILVERY,),
        lambda p: lying([bar(p, (0.0, 0.16), (0.0, 0.88), 0.045, 0.008),
            spike(p, (0.0, 0.0, 0.88), (0.0, 0.0, 0.98), 0.02),
            bar(BRASS, (-0.10, 0.155), (0.10, 0.155), 0.025, 0.025),
            rod(Material(DARK_WOOD), (0.0, 0.0, 0.02), (0.0, 0.0, 0.15), 0.014),
            ball(BRASS, (0.0, 0.0, 0.0), (0.04, 0.04, 0.04))])),
    thing("shield", ((0.45, 0.04, 0.03), (0.04, 0.12, 0.40)),
        lambda p: [disc(IRON, (0.0, 0.42), 0.40, 0.05), disc(p, (0.0, 0.42), 0.36, 0.06),
            bar(YELLOW_PAINT, (0.0, 0.08), (0.0, 0.76), 0.08, 0.066),
            bar(YELLOW_PAINT, (-0.34, 0.42), (0.34, 0.42), 0.08, 0.066),
            ball(BRASS, (0.03, 0.0, 0.42), (0.08, 0.18, 0.18)),
            rod(IRON, (-0.02, 0.0, 0.4), (-0.28, 0.0, 0.0), 0.012)]),
    thing("watering can", ((0.05, 0.30, 0.10), SILVERY),
        lambda p: [post(p, (0.0, 0.0, 0.11), (0.18, 0.18, 0.22)),
            rod(p, (0.0, -0.07, 0.06), (0.0, -0.26, 0.25), 0.014),
            spike(p, (0.0, -0.30, 0.29), (0.0, -0.22, 0.21), 0.05),
            *ring(p, (0.0, 0.06, 0.20), (0.10, 0.11), 0.010, span=(-60.0, 120.0), pieces=8),
            post(INK, (0.0, 0.0, 0.221), (0.15, 0.15, 0.004))]),
    thing("lawn mower", (RED_PAINT.colour, (0.05, 0.30, 0.08)),
        lambda p: [box(p, (0.0, 0.0, 0.20), (0.60, 0.46, 0.14)),
            post(INK, (0.05, 0.0, 0.33), (0.26, 0.26, 0.16)),
            *(rod(INK, (-0.25, 0.2 * s, 0.25), (-0.95, 0.2 * s, 0.95), 0.018)
                for s in (1.0, -1.0)), rod(INK, (-0.95, -0.2, 0.95), (-0.95, 0.2, 0.95), 0.018),
                *(rod(INK, (x, y, 0.10), (x, y + 0.06, 0.10), 0.10) for x in (0.24, -0.24)
                    for y in (0.22, -0.28))], ("lawnmower", "mower")),
))  # fmt: skip
"""Nouns of tools."""

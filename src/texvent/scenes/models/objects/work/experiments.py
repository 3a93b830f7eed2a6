"""Props of experiments, patterns of cameras, machines of workshops."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import CHROME, STEEL, Material, glowing
from texvent.scenes.models.objects.figures import (
    Draw,
    Moving,
    bar,
    disc,
    lathe,
    placed,
    rectangle,
    spinning,
    swinging,
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
    PALE_WOOD,
    RED_PAINT,
    SILVER,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, compose, limb, peak, plank, post, rod, shift

_CLAY = Material((0.42, 0.20, 0.10))
_WOOD = Material(WOOD_BROWN)
_UPPER_ARM = swinging("x", 0.9, 0.7, (0.0, 0.0, 0.98))
_LOWER_ARM = swinging("x", 1.5, 0.45, (0.0, 0.0, 0.60))
"""About the end of the upper arm of a double pendulum."""


def _wedges(count: int, radius: float, x: float) -> list[ModelPart]:
    """Black sectors of a disc that faces +x, each of three bars."""
    parts = []
    for k in range(count):
        a = 2.0 * math.pi * k / count
        for share in (0.25, 0.5, 0.75):
            wide = 2.0 * share * radius * math.sin(0.5 * math.pi / count)
            inner, outer = (share - 0.125) * radius, (share + 0.125) * radius
            parts.append(bar(INK, (inner * math.cos(a), inner * math.sin(a)), (
                outer * math.cos(a), outer * math.sin(a)), wide, 0.01, x))  # fmt: skip
    return parts


def _lifted(parts: list[ModelPart], z: float) -> list[ModelPart]:
    moved_up = []
    for each in parts:
        to_body = each.to_body.copy()
        to_body[2, 3] += z
        moved_up.append(each.at(to_body))
    return moved_up


def _stand(p: Material, tall: float) -> list[ModelPart]:
    return [
        post(p, (-0.04, 0.0, 0.015), (0.24, 0.24, 0.03)),
        rod(p, (-0.04, 0.0, 0.0), (-0.04, 0.0, tall), 0.012),
    ]


def _matrix(p: Material) -> list[ModelPart]:
    lit = (
        (0, 2),
        (0, 5),
        (1, 1),
        (1, 2),
        (1, 5),
        (1, 6),
        (2, 2),
        (2, 5),
        (5, 1),
        (5, 6),
        (6, 2),
        (6, 3),
        (6, 4),
        (6, 5),
    )
    return [
        box(INK, (0.0, 0.0, 0.15), (0.03, 0.32, 0.30)),
        *(ball(glowing(p.colour, 2.5) if (7 - r, c) in lit else Material((0.10, 0.03, 0.03)), (
            0.018, -0.125 + 0.0357 * c, 0.03 + 0.0345 * r), (0.014, 0.028,
                0.028)) for r in range(7) for c in range(8)),
    ]  # fmt: skip


def _track(p: Material) -> list[ModelPart]:
    parts: list[ModelPart] = []
    for k in range(4):
        s, z = (1.0 if k % 2 else -1.0), 0.9 - 0.22 * k
        parts.append(bar(p, (-0.5 * s, z), (0.5 * s, z - 0.16), 0.03, 0.10))
        parts.append(bar(p, (-0.5 * s, z + 0.03), (0.5 * s, z - 0.13), 0.03, 0.02, 0.06))
    parts += [box(_WOOD, (0.0, y, 0.5), (0.06, 0.05, 1.0)) for y in (-0.55, 0.55)]
    parts += [box(_WOOD, (0.0, 0.0, 0.02), (0.3, 1.2, 0.04)), ball(RED_PAINT, (0.02, -0.3, 0.92),
        (0.06, 0.06, 0.06)),
              ball(BLUE_PAINT, (0.02, 0.2, 0.66), (0.06, 0.06, 0.06))]  # fmt: skip
    return parts


def _gear(y: float, z: float, r: float) -> Draw:
    """A toothed wheel that faces +x."""

    def draw(p: Material) -> list[ModelPart]:
        teeth = [
            bar(p, (y, z), (y + 1.15 * r * math.cos(0.524 * k), z + 1.15 * r * math.sin(0.524 * k)),
                0.22 * r, 0.02, 0.03)
            for k in range(12)
        ]  # fmt: skip
        hub = [
            disc(INK, (y, z), 0.4 * r, 0.022, 0.03),
            disc(RED_PAINT, (y, z), 0.14 * r, 0.03, 0.03),
        ]
        return [disc(p, (y, z), r, 0.02, 0.03), *hub, *teeth]

    return draw


def _contrasting(p: Material) -> Material:
    """Black on what is bright, white on what is dark."""
    return INK if max(p.colour) > 0.25 else PALE


_SCIENCE = (
    thing("siemens star", (PALE.colour,), lambda p: [*_stand(IRON, 0.3), *_lifted([disc(p, (0.0,
        0.0), 0.26, 0.02),
        *_wedges(16, 0.25, 0.012)], 0.34)], ("siemens star chart", "star chart",
            "resolution chart")),
    thing("dotted disc", (PALE.colour,), lambda p: _stand(IRON, 0.3), (),
        moving=(Moving(lambda p: _lifted([disc(p, (0.0, 0.0), 0.26, 0.02),
            *(disc(_contrasting(p), (r * math.cos(a), r * math.sin(a)), 0.03, 0.012, 0.012)
            for r, a in ((0.20, 0.0), (0.12, 2.0), (0.18, 4.1)))], 0.34), spinning("x", 2.3,
                (0.0, 0.0, 0.34))),)),
    thing("spiral disc", (PALE.colour,), lambda p: _stand(IRON, 0.3), ("hypnotic spiral",
        "spiral"), moving=(Moving(lambda p: _lifted([
        disc(p, (0.0, 0.0), 0.26, 0.02), *(disc(INK, ((0.02 + 0.0075 * k) * math.cos(0.45 * k),
            (0.02 + 0.0075 * k) * math.sin(0.45 * k)), 0.016, 0.012, 0.012)
            for k in range(30))], 0.34), spinning("x", 1.1, (0.0, 0.0, 0.34))),)),
    thing("led matrix", ((1.0, 0.05, 0.03),), _matrix, ("led array", "led panel",
        "dot matrix display", "led board", "led display", "led grid", "led wall")),
    thing("double pendulum", (BRASS.colour,), lambda p: [rod(IRON, (-0.1, 0.0, 0.0), (-0.1, 0.0,
        1.0), 0.02), post(IRON, (-0.1, 0.0, 0.02), (0.4, 0.4, 0.04)),
        rod(IRON, (-0.1, 0.0, 0.98), (0.03, 0.0, 0.98), 0.02)], ("chaotic pendulum",), moving=(
        Moving(lambda p: [bar(p, (0.0, 0.98), (0.0, 0.60), 0.03, 0.02), ball(p, (0.0, 0.0, 0.60),
            (0.08, 0.08, 0.08))], _UPPER_ARM),
        Moving(lambda p: [bar(RED_PAINT, (0.0, 0.60), (0.0, 0.24), 0.025, 0.02, 0.03),
            ball(RED_PAINT, (0.03, 0.0, 0.24), (0.08, 0.08, 0.08))],
               lambda pose: compose(_UPPER_ARM(pose), _LOWER_ARM(pose))))),
    thing("zoetrope", (INK.colour,), lambda p: [post(_WOOD, (0.0, 0.0, 0.03), (0.26, 0.26,
        0.06)), rod(IRON, (0.0, 0.0, 0.0), (0.0, 0.0, 0.14), 0.015)],
        (), moving=(Moving(lambda p: [post(toned(p, 0.6), (0.0, 0.0, 0.15), (0.40,
            0.40, 0.02)), *(box(p, (0.19 * math.cos(a), 0.19 * math.sin(a), 0.24), (
            0.05, 0.05, 0.18)) for a in (2.0 * math.pi * k / 16 for k in range(16))),
                *(ball(RED_PAINT, (0.15 * math.cos(a), 0.15 * math.sin(a), 0.21 + 0.02 * (k % 3)), (
                0.03, 0.03, 0.05)) for k,
                    a in enumerate(2.0 * math.pi * k / 8 for k in range(8)))], spinning("z",
                        1.3)),)),
    thing("tuning fork", (SILVER.colour,), lambda p: [rod(p, (0.0, 0.0, 0.0), (0.0, 0.0, 0.08),
        0.006), bar(p, (-0.02, 0.08), (0.02, 0.08), 0.012, 0.01),
        *(box(p, (0.0, 0.018 * s, 0.15), (0.008, 0.008, 0.14)) for s in (1, -1)), box(_WOOD,
            (0.0, 0.0, 0.01), (0.06, 0.14, 0.03))]),
    thing("marble run", (PALE_WOOD,), _track, ("marble track", "zigzag track",
        "wooden marble run", "ball track")),
    thing("bunsen burner", (IRON.colour,), lambda p: [post(p, (0.0, 0.0, 0.01), (0.10, 0.10,
        0.02)), rod(SILVER, (0.0, 0.0, 0.0), (0.0, 0.0, 0.14), 0.012),
        peak(glowing((0.1, 0.25, 1.0), 2.0), (0.0, 0.0, 0.20), (0.04, 0.04, 0.12)),
            peak(glowing((0.9, 0.5, 0.1), 1.5), (0.0, 0.0, 0.18), (0.02, 0.02, 0.06))],
        ("gas burner",)),
    thing("prism", ((0.70, 0.78, 0.82),), lambda p: [plank(p, (0.0, -0.06, 0.0), (0.0, 0.0,
        0.10), chord=(0.2, 0.0, 0.0), thickness=(0.0, 0.03, 0.0)),
        plank(p, (0.0, 0.06, 0.0), (0.0, 0.0, 0.10), chord=(0.2, 0.0, 0.0), thickness=(0.0,
            -0.03, 0.0)), *(bar(glowing(c, 1.0), (0.04, 0.05), (0.4, 0.10 - 0.035 * k), 0.012, 0.01)
            for k, c in enumerate(((0.8, 0.05, 0.04), (0.8, 0.6, 0.05), (0.1, 0.6, 0.1), (0.1,
                0.2, 0.8)))), bar(glowing((1.0, 1.0, 1.0), 1.0), (-0.4, 0.02), (-0.04, 0.05),
                    0.012, 0.01)],
        ("glass prism",)),
    thing("watch movement", (BRASS.colour,), lambda p: [disc(SILVER, (0.0, 0.2), 0.2, 0.03)],
        ("clockwork", "watch gears", "clock mechanism", "clock gears"),
        moving=tuple(Moving(_gear(y, z, r), spinning("x", f, (0.03, y, z)))
            for y, z, r, f in ((0.05, 0.26, 0.085, 0.4), (-0.085, 0.17, 0.06, -0.6),
                (0.07, 0.11, 0.045, 0.9)))),
    thing("filament printer", (INK.colour,), lambda p: [*rectangle(p, (0.0, 0.28), (0.5, 0.56),
        0.05,
        0.4), box(SILVER, (0.0, 0.0, 0.08), (0.36, 0.36, 0.02)),
        peak(Material((0.75, 0.30, 0.02)), (0.0, 0.0, 0.17), (0.16, 0.16, 0.16))],
            ("3d printer",), moving=(Moving(lambda p: [
            box(RED_PAINT, (0.0, 0.0, 0.32), (0.08, 0.10, 0.10)), peak(BRASS, (0.0, 0.0, 0.26),
                (0.03, 0.03, 0.03))], lambda pose: shift(y=0.14 * math.sin(2.0 * pose.time_s))),)),
)  # fmt: skip


def _on_table(parts: list[ModelPart]) -> list[ModelPart]:
    return [box(IRON, (0.0, s * 0.6, 0.4), (0.5, 0.3, 0.8)) for s in (1.0, -1.0)] + _lifted(
        parts, 0.8
    )


_WORKSHOP = placed("workshop", (
    thing("lathe machine", ((0.10, 0.26, 0.20), (0.36, 0.37, 0.39)), lambda p: _on_table([box(p,
        (0.0, 0.0, 0.06), (0.4, 1.8, 0.14)),
        box(p, (0.0, -0.65, 0.32), (0.42, 0.45, 0.42)), box(p, (0.0, 0.7, 0.25), (0.26, 0.28,
            0.26)), box(STEEL, (0.14, 0.1, 0.22), (0.2, 0.2, 0.16)),
        box(RED_PAINT, (0.22, -0.7, 0.4), (0.02, 0.08, 0.08))]), ("lathe", "metal lathe",
            "wood lathe", "turning machine"), moving=(Moving(lambda p: [
            rod(STEEL, (0.0, -0.44, 1.12), (0.0, -0.30, 1.12), 0.14), rod(_WOOD, (0.0, -0.30,
                1.12), (0.0, 0.55, 1.12), 0.06),
            *(box(INK, (0.0, -0.37, 1.12), (0.06, 0.15, 0.27)) for _ in (1,)), box(INK, (0.04,
                0.1, 1.12), (0.05, 0.84, 0.02))], spinning("y", 4.3, (0.0, 0.0, 1.12))),)),
    thing("potter wheel", (GREY_PLASTIC.colour,), lambda p: [box(p, (0.0, 0.0, 0.25), (0.6, 0.7,
        0.5)), box(_WOOD, (0.0, 0.0, 0.52), (0.66, 0.76, 0.05))],
        ("pottery wheel", "potter s wheel", "potters wheel", "spinning clay wheel"),
            moving=(Moving(lambda p: [post(STEEL, (0.0, 0.0, 0.58), (0.44, 0.44, 0.04)),
            *_lifted(lathe(_CLAY, [(0.0, 0.10), (0.08, 0.15), (0.18, 0.12), (0.24, 0.07), (0.28,
                0.10)], 8), 0.60), box(INK, (0.15, 0.0, 0.70), (0.02, 0.03, 0.05)),
            box(toned(_CLAY, 0.5), (-0.14, 0.0, 0.72), (0.03, 0.05, 0.06))], spinning("z", 1.3)),)),
    thing("angle grinder", ((0.03, 0.22, 0.25), YELLOW_PAINT.colour), lambda p: [rod(p, (0.0,
        -0.22, 0.10), (0.0, 0.08, 0.10), 0.045), rod(INK, (0.0, -0.34, 0.10), (0.0, -0.22, 0.10),
            0.03),
        box(SILVER, (0.0, 0.12, 0.10), (0.08, 0.10, 0.10)), rod(INK, (0.0, 0.12, 0.12), (0.0,
            0.12, 0.26), 0.022), plank(INK, (0.05, 0.05, 0.10), (0.05, 0.14, 0.20), chord=(
            0.04, 0.0, 0.0), thickness=(0.0, 0.08, 0.0))], ("grinder", "disc grinder",
                "power grinder"), moving=(Moving(lambda p: [disc(Material((0.25, 0.20, 0.18)),
                    (0.14, 0.10), 0.11, 0.012, 0.07),
            bar(PALE, (0.14, 0.10), (0.14, 0.20), 0.02, 0.016, 0.07)], spinning("x", 13.3, (0.07,
                0.14, 0.10))),)),
    thing("drill press", ((0.05, 0.22, 0.35),), lambda p: [box(IRON, (0.0, 0.0, 0.03), (0.4, 0.3,
        0.06)), rod(STEEL, (-0.12, 0.0, 0.0), (-0.12, 0.0, 1.1), 0.04), box(p, (0.0, 0.0, 1.0),
            (0.5, 0.24, 0.26)),
        box(IRON, (0.02, 0.0, 0.45), (0.34, 0.30, 0.04)), *(rod(STEEL, (0.0, 0.12, 0.95),
            (0.12 * math.cos(a), 0.14, 0.95 + 0.16 * math.sin(a)), 0.012) for a in (0.5, 2.6,
                4.7))],
        ("pillar drill", "bench drill"), moving=(Moving(lambda p: [rod(STEEL, (0.12, 0.0, 0.62),
            (0.12, 0.0, 0.88), 0.02), rod(SILVER, (0.12, 0.0, 0.52), (0.12, 0.0, 0.62), 0.01),
            box(INK, (0.13, 0.0, 0.75), (0.03, 0.03, 0.05))], spinning("z", 7.3, (0.12, 0.0,
                0.0))),)),
    thing("table saw", (STEEL.colour,), lambda p: [box(RED_PAINT, (0.0, 0.0, 0.4), (0.7, 0.8,
        0.8)), box(p, (0.0, 0.0, 0.83), (1.0, 1.2, 0.05)), box(_WOOD, (0.0, 0.35, 0.87), (0.8,
            0.3, 0.03))],
        ("bench saw", "saw bench"), moving=(Moving(lambda p: [rod(SILVER, (0.0,
            -0.006, 0.90), (0.0, 0.006, 0.90), 0.18), *(box(INK, (
            0.16 * math.cos(a), 0.0, 0.90 + 0.16 * math.sin(a)), (0.03, 0.016,
                0.03)) for a in (0.0, 1.05, 2.09, 3.14, 4.19, 5.24))], spinning("y", 11.3, (0.0,
                    0.0, 0.90))),)),
    thing("bench vise", (BLUE_PAINT.colour,), lambda p: [box(p, (0.0, 0.0, 0.06), (0.2, 0.16,
        0.12)), box(p, (0.06, 0.0, 0.16), (0.06, 0.20, 0.12)), box(p, (0.20, 0.0, 0.16), (0.06,
            0.20, 0.12)),
        rod(STEEL, (0.1, 0.0, 0.10), (0.36, 0.0, 0.10), 0.02), rod(STEEL, (0.35, -0.12, 0.10),
            (0.35, 0.12, 0.10), 0.012), box(CHROME, (0.13, 0.0, 0.22), (0.07, 0.06, 0.16))],
                ("vise", "vice")),
    thing("loom", (WOOD_BROWN,), lambda p: [*rectangle(p, (0.0, 0.7), (1.4, 1.4), 0.10, 0.12),
        *(rod(PALE, (0.0, -0.55 + 0.09 * k, 0.1), (0.0, -0.55 + 0.09 * k, 1.3),
            0.008) for k in range(13)),
        *(box(c, (0.02, 0.0, 0.25 + 0.12 * k), (0.02, 1.16, 0.11)) for k,
            c in enumerate((RED_PAINT, YELLOW_PAINT, BLUE_PAINT, RED_PAINT)))], ("weaving loom",)),
    thing("spinning wheel", (WOOD_BROWN,), lambda p: [box(p, (0.1, 0.0, 0.45), (1.0, 0.2, 0.06)),
        *(rod(p, (x, y, 0.0), (x, 0.0, 0.45), 0.025) for x in (-0.3, 0.5) for y in (0.15, -0.15)),
        rod(p, (0.5, 0.0, 0.45), (0.5, 0.0, 0.85), 0.025), ball(PALE, (0.5, 0.0, 0.9), (0.16,
            0.16, 0.3))], moving=(Moving(lambda p: [*(limb(p, (-0.25, 0.0, 0.8), (
            -0.25 + 0.36 * math.cos(a), 0.0, 0.8 + 0.36 * math.sin(a)),
                0.014) for a in (0.785 * k for k in range(8))), *(limb(p,
                    (-0.25 + 0.36 * math.cos(a), 0.0, 0.8 + 0.36 * math.sin(a)), (
                -0.25 + 0.36 * math.cos(a + 0.524), 0.0, 0.8 + 0.36 * math.sin(a + 0.524)),
                    0.024) for a in (0.524 * k for k in range(12)))], spinning("y", 0.8, (-0.25,
                        0.0, 0.8))),)),
))  # fmt: skip

NOUNS = (*_SCIENCE, *_WORKSHOP)

"""Robots, machines of a workshop, and what goods and people are moved with."""

from __future__ import annotations

import math

from texvent.scenes.models.machine_acts import LIFT
from texvent.scenes.models.materials import HEADLIGHT, Material, glowing, mottled
from texvent.scenes.models.objects.figures import (
    Draw,
    Motion,
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
    BLACKISH,
    BRASS,
    CHINA,
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
from texvent.scenes.models.people.timing import ease
from texvent.scenes.models.protocol import ModelPart, Pose
from texvent.scenes.models.shapes import (
    Affine,
    ball,
    box,
    compose,
    plank,
    post,
    rod,
    shift,
    turn_x,
    turn_y,
)
from texvent.scenes.models.vehicles.wheels import Wheel
from texvent.scenes.scene import Colour

_BRIGHT: tuple[Colour, ...] = ((0.75, 0.22, 0.01), (0.75, 0.45, 0.02), (0.03, 0.15, 0.50))
_GLOW = glowing((0.15, 0.70, 0.95), 1.5)


def _cart_wheels(x: float, y: float, radius: float, wide: float) -> tuple[Wheel, ...]:
    return tuple(
        Wheel((a * x, b * y, radius), radius, wide) for a in (1.0, -1.0) for b in (1.0, -1.0)
    )


def _parcel(skin: Material) -> list[ModelPart]:
    card, tape = Material((0.38, 0.23, 0.11)), Material((0.60, 0.48, 0.30))
    return [
        box(card, (0.0, 0.0, 0.80), (0.34, 0.36, 0.24)),
        box(tape, (0.0, 0.0, 0.80), (0.345, 0.05, 0.245)),
    ]


def _carried(start_m: float) -> Motion:
    """Along a belt of 2.4 m; what reaches its end sinks below it and comes up at its start."""

    def motion(pose: Pose) -> Affine:
        along = (0.4 * pose.time_s + start_m) % 2.4
        return shift(along - 1.2, 0.0, -0.28 * max(0.0, 1.0 - 5.0 * min(along, 2.4 - along)))

    return motion


def _hung(y: float) -> Draw:
    """A ball of a Newton's cradle at its place, on two threads."""
    return lambda skin: [
        ball(skin, (0.0, y, 0.06), (0.026, 0.026, 0.026)),
        *(rod(PALE, (x, y, 0.17), (0.0, y, 0.072), 0.0012) for x in (0.05, -0.05)),
    ]


def _half_swing(y: float) -> Motion:
    """Swinging outwards only, in turn with the ball of the other end."""
    side = 1.0 if y > 0.0 else -1.0
    return lambda pose: turn_x(
        side * max(0.0, 0.6 * side * math.sin(2.0 * math.pi * pose.time_s)), (0.0, y, 0.17)
    )


def _mixing() -> Motion:
    """Turning about an axis that leans."""
    spin = spinning("z", 0.4)
    return lambda pose: compose(shift(z=0.85), compose(turn_y(0.9), spin(pose)))


_INDOOR = placed("indoor", (
    thing("mobile robot", (INK.colour, CHINA),
        lambda p: [box(p, (0.0, 0.0, 0.20), (0.50, 0.36, 0.16)),
            box(YELLOW_PAINT, (0.0, 0.0, 0.29), (0.46, 0.32, 0.02)),
            post(INK, (0.12, 0.0, 0.36), (0.12, 0.12, 0.12)),
            post(_GLOW, (0.12, 0.0, 0.37), (0.122, 0.122, 0.03)),
            rod(IRON, (-0.15, 0.0, 0.30), (-0.15, 0.0, 0.62), 0.02),
            box(INK, (-0.13, 0.0, 0.65), (0.08, 0.20, 0.07)),
            *(disc(_GLOW, (0.05 * s, 0.65), 0.022, 0.02, -0.09) for s in (1.0, -1.0)),
            box(RED_PAINT, (0.255, 0.0, 0.20), (0.02, 0.28, 0.05))],
        ("wheeled robot", "ground robot"),
        wheels=_cart_wheels(0.17, 0.21, 0.11, 0.07), goes=("ground", "roll", 0.8)),
    thing("robot vacuum", (INK.colour, CHINA),
        lambda p: [post(p, (0.0, 0.0, 0.05), (0.34, 0.34, 0.08)),
            post(toned(p, 2.0), (0.0, 0.0, 0.092), (0.30, 0.30, 0.006)),
            post(INK, (-0.03, 0.0, 0.105), (0.09, 0.09, 0.025)),
            post(_GLOW, (0.08, 0.0, 0.096), (0.03, 0.03, 0.004)),
            box(INK, (0.16, 0.0, 0.04), (0.03, 0.20, 0.04)),
            ], ("vacuum robot", "robotic vacuum", "roomba"), goes=("ground", "roll", 0.4),
            wheels=tuple(Wheel((0.0, y, 0.03), 0.03, 0.02) for y in (0.13, -0.13))),
    thing("conveyor belt", (STEELY,),
        lambda p: [*(box(p, (0.0, y, 0.62), (2.4, 0.05, 0.16)) for y in (0.33, -0.33)),
            box(INK, (0.0, 0.0, 0.66), (2.4, 0.60, 0.03)),
            *(box(p, (x, y, 0.28), (0.06, 0.06, 0.56)) for x in (1.0, -1.0) for y in (0.3, -0.3)),
            *(rod(IRON, (x, -0.30, 0.62), (x, 0.30, 0.62), 0.055) for x in (1.2, -1.2))],
            ("conveyor",),
        moving=tuple(Moving(_parcel, _carried(0.8 * k)) for k in range(3))),
    thing("crate", (PALE_WOOD,),
        lambda p: [box(toned(p, 0.6), (0.0, 0.0, 0.25), (0.56, 0.56, 0.48)),
            *(box(p, (0.0, 0.0, 0.05 + 0.133 * i), (0.60, 0.60, 0.10)) for i in range(4)),
            *(box(toned(p, 0.85), (0.29 * a, 0.29 * b, 0.25), (0.08, 0.08, 0.51)) for a in (1, -1)
                for b in (1, -1))], ("wooden crate", "wooden box")),
    thing("pallet", (PALE_WOOD,),
        lambda p: [*(box(p, (-0.5 + 0.25 * i, 0.0, 0.135), (0.14, 0.80, 0.022)) for i in range(5)),
            *(box(toned(p, 0.8), (x, y, 0.075), (0.14, 0.10, 0.10)) for x in (-0.5, 0.0, 0.5)
                for y in (-0.35, 0.0, 0.35)),
                *(box(toned(p, 0.7), (0.0, y, 0.012), (1.14, 0.10, 0.024))
                    for y in (-0.35, 0.0, 0.35))]),
    thing("barrel", (WOOD_BROWN, (0.03, 0.15, 0.45)),
        lambda p: [post(mottled(p.colour, contrast=0.25), (0.0, 0.0, 0.45), (0.58, 0.58, 0.88)),
            *(post(mottled(p.colour, contrast=0.25), (0.0, 0.0, 0.45), (w, w, h)) for w,
                h in ((0.62, 0.66), (0.65, 0.44), (0.665, 0.22))),
                *(post(IRON, (0.0, 0.0, z), (w, w, 0.05)) for z,
                    w in ((0.06, 0.60), (0.26, 0.655), (0.64, 0.655), (0.84, 0.60))),
                    post(toned(p, 0.6), (0.0, 0.0, 0.892), (0.52, 0.52, 0.004))],
                    ("keg", "cask", "wooden barrel")),
    thing("shopping cart", (SILVERY,),
        lambda p: [*(bar(p, (-0.26, z), (0.26, z), 0.012, 0.012, x) for x in (0.42, -0.36)
            for z in (0.50, 0.65, 0.80, 0.95)),
            *(rod(p, (-0.36, 0.26 * s, z), (0.42, 0.26 * s, z), 0.007) for s in (1.0, -1.0)
                for z in (0.50, 0.65, 0.80, 0.95)),
                *(rod(p, (x, 0.26 * s, 0.50), (x, 0.26 * s, 0.95), 0.006) for s in (1.0, -1.0)
                    for x in (-0.36, -0.10, 0.16, 0.42)),
        box(toned(p, 0.6), (0.03, 0.0, 0.50), (0.78, 0.50, 0.012)),
        *(rod(p, (-0.36, 0.24 * s, 0.50), (-0.40, 0.24 * s, 0.13), 0.014) for s in (1.0, -1.0)),
        *(rod(p, (-0.40, 0.24 * s, 0.16), (0.40, 0.20 * s, 0.16), 0.014) for s in (1.0, -1.0)),
        *(rod(p, (-0.36, 0.26 * s, 0.95), (-0.52, 0.26 * s, 1.02), 0.014) for s in (1.0, -1.0)),
        rod(RED_PAINT, (-0.52, -0.27, 1.02), (-0.52, 0.27, 1.02), 0.02)],
        ("shopping trolley", "grocery cart", "supermarket trolley"),
        wheels=_cart_wheels(0.38, 0.22, 0.065, 0.03), goes=("ground", "roll", 1.2)),
    thing("trolley", (STEELY, _BRIGHT[2]),
        lambda p: [box(p, (0.0, 0.0, 0.20), (0.90, 0.56, 0.05)),
            *(rod(SILVER, (-0.42, 0.24 * s, 0.20), (-0.48, 0.24 * s, 0.95), 0.018)
                for s in (1.0, -1.0)),
                rod(SILVER, (-0.48, -0.24, 0.95), (-0.48, 0.24, 0.95), 0.018),
                box(Material((0.38, 0.23, 0.11)), (0.10, 0.0, 0.40), (0.46, 0.44, 0.34)),
                box(Material((0.60, 0.48, 0.30)), (0.10, 0.0, 0.40), (0.47, 0.06, 0.35))],
                ("hand cart", "handcart", "platform trolley"),
          wheels=_cart_wheels(0.34, 0.22, 0.085, 0.05),
                    goes=("ground", "roll", 1.2)),
    thing("wheelchair", (INK.colour, (0.03, 0.12, 0.40)),
        lambda p: [box(p, (0.0, 0.0, 0.48), (0.42, 0.42, 0.05)),
            box(p, (-0.22, 0.0, 0.74), (0.04, 0.42, 0.48)),
            *(rod(SILVER, (-0.24, 0.22 * s, 0.30), (-0.26, 0.22 * s, 0.98), 0.014)
                for s in (1.0, -1.0)),
                *(rod(INK, (-0.26, 0.22 * s, 0.98), (-0.38, 0.22 * s, 0.98), 0.018)
                    for s in (1.0, -1.0)),
                    *(rod(SILVER, (-0.24, 0.22 * s, 0.68), (0.18, 0.22 * s, 0.68), 0.016)
                        for s in (1.0, -1.0)),
                        *(rod(SILVER, (0.20, 0.20 * s, 0.50), (0.36, 0.18 * s, 0.14), 0.014)
                            for s in (1.0, -1.0)),
                            *(box(INK, (0.42, 0.12 * s, 0.12), (0.16, 0.14, 0.02))
                                for s in (1.0, -1.0))],
                                wheels=(*(Wheel((-0.12, 0.27 * s, 0.30), 0.30, 0.03)
                                    for s in (1.0, -1.0)),
                                    *(Wheel((0.26, 0.22 * s, 0.08), 0.08, 0.03)
                                        for s in (1.0, -1.0))), goes=("ground", "roll", 1.0)),
    thing("stroller", ((0.05, 0.14, 0.40), (0.45, 0.05, 0.08)),
        lambda p: [box(p, (0.02, 0.0, 0.55), (0.50, 0.40, 0.22)),
            *(rod(toned(p, 0.9 + 0.1 * k), (-0.16, -0.21, 0.70), (-0.16, 0.21, 0.70), 0.26)
                for k in (0,)), ball(Material((0.66, 0.42, 0.31)), (0.12, 0.0, 0.74),
                (0.17, 0.16, 0.18)), rod(SILVER, (-0.30, -0.20, 0.16), (0.28, -0.20, 0.50), 0.014),
                rod(SILVER, (-0.30, 0.20, 0.16), (0.28, 0.20, 0.50), 0.014),
                *(rod(SILVER, (0.30, 0.20 * s, 0.14), (-0.42, 0.20 * s, 1.02), 0.014)
                    for s in (1.0, -1.0)),
                    rod(INK, (-0.44, -0.21, 1.03), (-0.44, 0.21, 1.03), 0.02)],
                    ("pram", "baby carriage", "pushchair", "baby buggy"),
                    wheels=_cart_wheels(0.30, 0.24, 0.13, 0.035), goes=("ground", "roll", 1.1)),
    thing("sewing machine", (BLACKISH, (0.55, 0.05, 0.05)),
        lambda p: [box(Material(WOOD_BROWN), (0.0, 0.0, 0.025), (0.20, 0.44, 0.05)),
            box(p, (0.0, 0.14, 0.17), (0.09, 0.09, 0.26)),
            box(p, (0.0, -0.03, 0.27), (0.08, 0.36, 0.08)),
            box(p, (0.0, -0.17, 0.19), (0.07, 0.06, 0.14)),
            rod(SILVER, (0.0, -0.17, 0.06), (0.0, -0.17, 0.12), 0.005),
            rod(SILVER, (0.0, 0.19, 0.25), (0.0, 0.215, 0.25), 0.06),
            post(RED_PAINT, (0.0, 0.03, 0.34), (0.035, 0.035, 0.06)),
            bar(BRASS, (-0.12, 0.27), (0.08, 0.27), 0.025, 0.085)]),
    thing("engine", (STEELY,),
        lambda p: [box(p, (0.0, 0.0, 0.30), (0.36, 0.60, 0.34)),
            box(IRON, (0.0, 0.0, 0.06), (0.30, 0.50, 0.12)),
            *(box(toned(p, 1.3), (0.0, -0.21 + 0.14 * k, 0.53), (0.20, 0.10, 0.14))
                for k in range(4)), *(rod(Material((0.42, 0.22, 0.10)),
                    (0.10, -0.21 + 0.14 * k, 0.42), (0.26, -0.21 + 0.10 * k, 0.26), 0.035)
                    for k in range(4))], ("motor", "combustion engine"),
                    moving=(Moving(lambda p: [disc(IRON, (0.0, 0.30), 0.15, 0.04, 0.22),
                        *(box(YELLOW_PAINT, (0.245, 0.09 * math.cos(a), 0.30 + 0.09 * math.sin(a)),
                            (0.01, 0.05, 0.05)) for a in (0.0, 2.094, 4.189))],
                            spinning("x", 2.0, (0.0, 0.0, 0.30))),)),
    thing("newton cradle", (SILVERY,),
        lambda p: [box(INK, (0.0, 0.0, 0.01), (0.12, 0.20, 0.02)),
            *(part for x in (0.05, -0.05)
                for part in chain(SILVER,
                    [(x, -0.09, 0.02), (x, -0.09, 0.17), (x, 0.09, 0.17), (x, 0.09, 0.02)],
                    0.004)), *(ball(p, (0.0, -0.026 + 0.026 * k, 0.06), (0.026, 0.026, 0.026))
                    for k in range(3)), *(rod(PALE, (x, -0.026 + 0.026 * k, 0.17),
                        (0.0, -0.026 + 0.026 * k, 0.072), 0.0012) for k in range(3)
                        for x in (0.05, -0.05))], (),
        moving=tuple(Moving(_hung(0.052 * s), _half_swing(0.052 * s)) for s in (1.0, -1.0))),
))  # fmt: skip


def _raised(pose: Pose) -> Affine:
    """Where the forks are: up in 1.6 s where a load is lifted."""
    share = ease(pose.time_s, 0.2, 1.8) if pose.activity == LIFT else 0.0
    return shift(z=1.05 * share)


_SITE = placed("construction site", (
    thing("forklift", (YELLOW_PAINT.colour, _BRIGHT[0]),
        lambda p: [box(p, (-0.35, 0.0, 0.62), (1.50, 1.05, 0.62)),
            box(INK, (-0.95, 0.0, 0.75), (0.35, 1.0, 0.70)),
            *(rod(INK, (x, 0.46 * s, 0.9), (x, 0.46 * s, 2.1), 0.035) for x in (0.30, -0.80)
                for s in (1.0, -1.0)), box(INK, (-0.25, 0.0, 2.12), (1.25, 1.05, 0.06)),
                box(INK, (-0.35, 0.0, 1.05), (0.45, 0.5, 0.14)),
                box(INK, (-0.62, 0.0, 1.30), (0.10, 0.5, 0.5)),
                *(box(IRON, (0.52, 0.32 * s, 1.15), (0.12, 0.10, 2.25)) for s in (1.0, -1.0)),
        *(ball(HEADLIGHT, (0.42, 0.40 * s, 0.80), (0.06, 0.16, 0.16)) for s in (1.0, -1.0)),
        rod(INK, (0.16, 0.0, 1.0), (0.02, 0.0, 1.25), 0.02),
        *ring(INK, (0.0, 0.0, 1.27), (0.16, 0.16), 0.015, axis="z", pieces=8)],
        ("fork lift", "forklift truck"), moving=(Moving(lambda p: [
            box(IRON, (0.60, 0.0, 0.40), (0.05, 0.85, 0.40)),
            *(box(IRON, (1.10, 0.26 * s, 0.24), (1.0, 0.12, 0.05)) for s in (1.0, -1.0))],
            _raised),),
        wheels=(*(Wheel((0.25, 0.44 * s, 0.30), 0.30, 0.22) for s in (1.0, -1.0)),
            *(Wheel((-0.85, 0.42 * s, 0.24), 0.24, 0.18) for s in (1.0, -1.0))),
            goes=("ground", "drive", 2.0)),
    thing("wheelbarrow", ((0.05, 0.28, 0.10), RED_PAINT.colour),
        lambda p: [plank(p, (0.05, 0.0, 0.33), (0.0, 0.0, 0.62), chord=(0.75, 0.0, 0.06),
            thickness=(0.0, 0.60, 0.0)),
            box(Material((0.10, 0.06, 0.035)), (0.03, 0.0, 0.63), (0.66, 0.52, 0.03)),
            *(rod(Material(PALE_WOOD), (0.62, 0.05 * s, 0.22), (-0.80, 0.30 * s, 0.55), 0.022)
                for s in (1.0, -1.0)),
                *(rod(IRON, (-0.25, 0.24 * s, 0.40), (-0.30, 0.26 * s, 0.0), 0.02)
                    for s in (1.0, -1.0))], ("barrow",),
                    wheels=(Wheel((0.62, 0.0, 0.20), 0.20, 0.09),), goes=("ground", "roll", 1.0)),
    thing("cement mixer", (_BRIGHT[0], YELLOW_PAINT.colour),
        lambda p: [*(rod(IRON, (0.3 * a, 0.35 * b, 0.0), (0.0, 0.25 * b, 0.75), 0.03)
            for a in (1, -1) for b in (1, -1)),
            rod(IRON, (0.0, -0.36, 0.75), (0.0, 0.36, 0.75), 0.03)], ("concrete mixer",),
            moving=(Moving(lambda p: [ball(p, (0.0, 0.0, 0.0), (0.68, 0.68, 0.76)),
                *lathe(p, [(0.15, 0.33), (0.52, 0.17)], 6),
                post(INK, (0.0, 0.0, 0.521), (0.28, 0.28, 0.006)),
                *(box(IRON, (0.33 * math.cos(a), 0.33 * math.sin(a), 0.0), (0.06, 0.06, 0.30))
                    for a in (0.0, 1.571, 3.142, 4.712))], _mixing()),)),
    thing("brick", ((0.36, 0.10, 0.06),),
        lambda p: [box(mottled(p.colour, contrast=0.3, scale=5.0), (0.0, 0.0, 0.033),
            (0.105, 0.22, 0.065)),
            *(post(INK, (0.0, y, 0.066), (0.03, 0.03, 0.003)) for y in (-0.06, 0.0, 0.06))],
            ("clay brick",)),
))  # fmt: skip

NOUNS = (*_INDOOR, *_SITE)
"""Nouns of machines."""

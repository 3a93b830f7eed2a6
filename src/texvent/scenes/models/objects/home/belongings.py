"""Things that rooms and hands hold: blankets, easels, sacks, boots, arms, steering wheels."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, checked, cloth, leather, mottled, striped
from texvent.scenes.models.objects.figures import (
    Moving,
    bar,
    chain,
    disc,
    lathe,
    lying,
    placed,
    ring,
    spinning,
    swinging,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLACKISH,
    BLUE_PAINT,
    BRASS,
    DARK_WOOD,
    INK,
    IRON,
    PALE,
    PALE_WOOD,
    PAPER,
    RED_PAINT,
    SILVER,
    SILVERY,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart, Pose
from texvent.scenes.models.shapes import (
    Affine,
    ball,
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
    turn_y,
    turn_z,
)

_WOOD = Material(WOOD_BROWN)


def _fan_blades(p: Material) -> list[ModelPart]:
    """Four pitched blades below a ceiling, one of them pale."""
    parts = []
    for k in range(4):
        wing = box(p if k else PALE, (0.0, 0.0, 0.0), (0.56, 0.17, 0.02))
        place = compose(shift(0.38, 0.0, 1.10), turn_x(0.6))
        parts += moved([wing], compose(turn_z(0.5 * math.pi * k), place))
    return parts


def _windshield(p: Material) -> list[ModelPart]:
    """A windscreen with what is before it inside: dashboard and steering wheel."""
    glass = Material((0.30, 0.42, 0.50))
    return [
        plank(glass, (0.25, 0.0, 0.55), (-0.25, 0.0, 1.15), chord=(0.0, 1.36, 0.0),
              thickness=(0.01, 0.0, 0.01)),
        *(limb(p, (0.25, 0.70 * s, 0.52), (-0.27, 0.66 * s, 1.18), 0.04) for s in (1.0, -1.0)),
        rod(p, (-0.27, -0.68, 1.18), (-0.27, 0.68, 1.18), 0.04),
        box(p, (0.42, 0.0, 0.42), (0.5, 1.6, 0.24)), box(p, (0.35, 0.0, 0.15), (0.7, 1.6, 0.3)),
        box(INK, (-0.05, 0.0, 0.52), (0.30, 1.36, 0.10)),
        *ring(INK, (-0.20, -0.35, 0.72), (0.17, 0.17), 0.022, pieces=14),
        box(INK, (-0.30, 0.0, 1.05), (0.03, 0.26, 0.07)),
    ]  # fmt: skip


def _wiper(y: float) -> Moving:
    def draw(p: Material) -> list[ModelPart]:
        return [
            limb(INK, (0.27, y, 0.56), (0.03, y + 0.32, 0.86), 0.016),
            limb(INK, (0.18, y + 0.02, 0.70), (-0.12, y + 0.44, 1.02), 0.020),
        ]

    return Moving(draw, swinging("x", 0.55, 0.8, (0.27, y, 0.56)))


def _clock_case(p: Material) -> list[ModelPart]:
    return [
        box(p, (0.0, 0.0, 0.14), (0.36, 0.56, 0.28)), box(p, (0.0, 0.0, 0.85), (0.28, 0.40, 1.2)),
        box(INK, (0.142, 0.0, 0.85), (0.01, 0.26, 0.95)),
        box(p, (0.0, 0.0, 1.65), (0.34, 0.52, 0.48)),
        peak(p, (0.0, 0.0, 1.98), (0.34, 0.52, 0.2)), disc(PAPER, (0.0, 1.65), 0.20, 0.02, 0.175),
        *(box(INK, (0.188, 0.16 * math.sin(a), 1.65 + 0.16 * math.cos(a)), (0.006, 0.02, 0.02))
          for a in (0.5236 * k for k in range(12))),
        bar(INK, (0.0, 1.65), (0.0, 1.78), 0.02, 0.006, 0.19),
        bar(INK, (0.0, 1.65), (0.08, 1.70), 0.02, 0.006, 0.19),
    ]  # fmt: skip


def _easel(p: Material) -> list[ModelPart]:
    return [
        *(bar(p, (0.42 * s, 0.0), (0.06 * s, 1.75), 0.05, 0.04) for s in (1.0, -1.0)),
        limb(p, (-0.5, 0.0, 0.0), (0.0, 0.0, 1.7), 0.025),
        bar(p, (-0.5, 0.72), (0.5, 0.72), 0.05, 0.10, 0.03),
        box(PAPER, (0.05, 0.0, 1.16), (0.03, 0.78, 0.84)),
        box(BLUE_PAINT, (0.068, 0.0, 1.36), (0.006, 0.70, 0.36)),
        ball(Material((0.06, 0.24, 0.05)), (0.066, -0.12, 1.06), (0.01, 0.46, 0.28)),
        ball(YELLOW_PAINT, (0.069, 0.20, 1.42), (0.01, 0.14, 0.14)),
    ]  # fmt: skip


def _coat_rack(p: Material) -> list[ModelPart]:
    return [
        rod(p, (0.0, 0.0, 0.0), (0.0, 0.0, 1.8), 0.03),
        *(limb(p, (0.0, 0.0, 0.12), (0.3 * c, 0.3 * s, 0.0), 0.025) for c, s in
          ((1, 0), (-1, 0), (0, 1), (0, -1))),
        *(limb(p, (0.0, 0.0, 1.6), (0.2 * c, 0.2 * s, 1.78), 0.018) for c, s in
          ((1, 0), (-1, 0), (0, 1), (0, -1))),
        limb(cloth((0.05, 0.12, 0.30)), (0.0, 0.22, 1.68), (0.0, 0.24, 0.85), 0.13),
        ball(cloth((0.20, 0.10, 0.05)), (0.0, -0.2, 1.80), (0.28, 0.28, 0.16)),
    ]  # fmt: skip


def _gun(p: Material) -> list[ModelPart]:
    return lying([
        box(p, (0.0, 0.02, 0.14), (0.03, 0.22, 0.045)), plank(p, (0.0, -0.06, 0.12),
            (0.0, -0.09, 0.0), chord=(0.0, 0.055, 0.0), thickness=(0.03, 0.0, 0.0)),
        *ring(p, (0.0, -0.005, 0.095), (0.03, 0.025), 0.006, span=(180.0, 360.0), pieces=6),
        rod(INK, (0.0, 0.125, 0.145), (0.0, 0.136, 0.145), 0.010)])  # fmt: skip


def _rifle(p: Material) -> list[ModelPart]:
    return lying([
        rod(INK, (0.0, 0.05, 0.2), (0.0, 0.75, 0.2), 0.014), box(p, (0.0, 0.12, 0.185),
            (0.04, 0.45, 0.045)), plank(p, (0.0, -0.10, 0.18), (0.0, -0.42, 0.10),
            chord=(0.0, 0.02, 0.11), thickness=(0.04, 0.0, 0.0)),
        box(INK, (0.0, -0.03, 0.185), (0.045, 0.18, 0.055)), rod(INK, (0.0, -0.08, 0.255),
            (0.0, 0.14, 0.255), 0.018), box(INK, (0.0, 0.0, 0.11), (0.03, 0.05, 0.10)),
    ])  # fmt: skip


def _boot(p: Material, y: float) -> list[ModelPart]:
    return [
        rod(leather(p.colour), (-0.05, y, 0.08), (-0.06, y, 0.34), 0.055),
        ball(leather(p.colour), (0.03, y, 0.055), (0.28, 0.10, 0.11)),
        box(INK, (0.02, y, 0.012), (0.29, 0.105, 0.025)),
        rod(toned(p, 0.7), (-0.06, y, 0.32), (-0.06, y, 0.35), 0.062),
    ]


def _heel(p: Material, y: float) -> list[ModelPart]:
    sole = plank(p, (-0.10, y, 0.115), (0.06, y, 0.02), chord=(0.0, 0.07, 0.0),
                 thickness=(0.0, 0.0, 0.018))  # fmt: skip
    return [
        sole, box(p, (0.10, y, 0.012), (0.10, 0.07, 0.018)),
        ball(p, (0.11, y, 0.03), (0.12, 0.072, 0.045)),
        *(plank(p, (-0.10, y + 0.033 * s, 0.13), (0.06, y + 0.033 * s, 0.035),
                chord=(0.0, 0.0, 0.035), thickness=(0.0, 0.008, 0.0)) for s in (1.0, -1.0)),
        ball(p, (-0.095, y, 0.14), (0.05, 0.074, 0.07)),
        rod(toned(p, 0.5), (-0.105, y, 0.11), (-0.115, y, 0.0), 0.010),
    ]  # fmt: skip


def _sandal(p: Material, y: float) -> list[ModelPart]:
    return [
        ball(p, (0.0, y, 0.015), (0.28, 0.10, 0.03)),
        *ring(toned(p, 0.5), (0.06, y, 0.02), (0.048, 0.045), 0.012, span=(0.0, 180.0), pieces=6),
    ]


def _leg(x: float, y: float, side: float) -> Moving:
    """A leg of a robot dog, which steps with the distance that it has gone."""

    def draw(p: Material) -> list[ModelPart]:
        return [
            ball(p, (x, y, 0.48), (0.16, 0.12, 0.16)),
            limb(p, (x, y, 0.48), (x - 0.14, y, 0.26), 0.045),
            limb(INK, (x - 0.14, y, 0.26), (x + 0.01, y, 0.03), 0.030),
            ball(INK, (x + 0.01, y, 0.03), (0.07, 0.06, 0.06)),
        ]

    def step(pose: Pose) -> Affine:
        reach = 0.30 if pose.speed_m_s > 0.0 else 0.0
        return turn_y(reach * side * math.sin(12.0 * pose.distance_m), (x, y, 0.48))

    return Moving(draw, step)


_ROOM = placed("indoor", (
    thing("blanket", ((0.36, 0.12, 0.10), (0.10, 0.20, 0.36), (0.55, 0.48, 0.36)), lambda p: [
        *(box(checked(p.colour, toned(p, 1.9).colour, 2.0), (0.0, 0.0, 0.03 + 0.05 * k),
            (0.62 - 0.03 * k, 0.82 - 0.04 * k, 0.045)) for k in range(3)),
        *(limb(p, (-0.29, 0.40 - 0.02 * k, 0.03 + 0.05 * k), (0.29, 0.40 - 0.02 * k,
            0.03 + 0.05 * k), 0.028) for k in range(3)),
        *(limb(PALE, (0.30, -0.38 + 0.076 * k, 0.04), (0.37, -0.38 + 0.076 * k, 0.01), 0.010)
            for k in range(11))],
        ("duvet", "bedsheet", "bed sheet", "comforter", "bedspread", "quilted blanket",
         "picnic blanket", "wool blanket", "bed cover")),
    thing("grandfather clock", (DARK_WOOD,), _clock_case, ("pendulum clock", "longcase clock"),
          moving=(Moving(lambda p: [
              rod(BRASS, (0.15, 0.0, 1.3), (0.15, 0.0, 0.62), 0.008),
              disc(BRASS, (0.0, 0.58), 0.07, 0.012, 0.152)],
              swinging("x", 0.12, 0.5, (0.15, 0.0, 1.3))),)),
    thing("coat rack", (WOOD_BROWN,), _coat_rack, ("hat stand", "coat stand", "coat hook",
          "clothes rack", "coat tree", "clothes stand")),
    thing("easel", (PALE_WOOD,), _easel, ("painter easel", "canvas on an easel")),
    thing("rolling pin", (PALE_WOOD,), lambda p: [
        rod(p, (0.0, -0.14, 0.035), (0.0, 0.14, 0.035), 0.035),
        *(limb(toned(p, 0.7), (0.0, 0.15 * s, 0.035), (0.0, 0.24 * s, 0.035), 0.014)
            for s in (1.0, -1.0))]),
    thing("sack", ((0.42, 0.31, 0.17),), lambda p: [
        ball(cloth(p.colour), (0.0, 0.0, 0.26), (0.52, 0.58, 0.54)),
        *(ball(cloth(p.colour), (0.10 * a, 0.13 * b, 0.13), (0.32, 0.34, 0.26))
            for a in (1, -1) for b in (1, -1)),
        spike(cloth(p.colour), (0.0, 0.0, 0.40), (0.0, 0.0, 0.78), 0.24),
        *ring(Material((0.75, 0.68, 0.50)), (0.0, 0.0, 0.63), (0.10, 0.10), 0.022, axis="z"),
        *(spike(cloth(toned(p, 1.2).colour), (0.09 * math.cos(a), 0.11 * math.sin(a), 0.84),
            (0.0, 0.0, 0.60), 0.085) for a in (0.0, 1.26, 2.5, 3.8, 5.0))],
        ("burlap sack", "potato sack", "sack of potatoes", "sack of flour", "sack of grain")),
    thing("fire extinguisher", (RED_PAINT.colour,), lambda p: [
        post(p, (0.0, 0.0, 0.24), (0.17, 0.17, 0.44)), ball(p, (0.0, 0.0, 0.46),
            (0.17, 0.17, 0.12)), post(INK, (0.0, 0.0, 0.54), (0.05, 0.05, 0.08)),
        limb(INK, (0.0, 0.0, 0.58), (0.0, 0.13, 0.61), 0.014), *chain(INK,
            [(0.0, -0.03, 0.56), (0.0, -0.14, 0.50), (0.0, -0.14, 0.22)], 0.014),
        box(PALE, (0.084, 0.0, 0.26), (0.006, 0.10, 0.14))]),
    thing("music stand", (BLACKISH,), lambda p: [
        rod(p, (0.0, 0.0, 0.1), (0.0, 0.0, 1.1), 0.014), *(limb(p, (0.0, 0.0, 0.12),
            (0.26 * c, 0.26 * s, 0.0), 0.014) for c, s in ((1, 0), (-0.5, 0.87), (-0.5, -0.87))),
        box(p, (0.0, 0.0, 1.22), (0.02, 0.52, 0.34), lean=-0.3), box(PAPER, (0.022, 0.0, 1.24),
            (0.008, 0.42, 0.28), lean=-0.3),
        *(box(INK, (0.027 - 0.3 * (z - 1.24), 0.0, z), (0.006, 0.34, 0.008))
            for z in (1.13, 1.18, 1.23, 1.28, 1.33))], ("sheet music stand", "note stand")),
    thing("steering wheel", (BLACKISH,), lambda p: [
        *ring(p, (0.0, 0.0, 0.20), (0.19, 0.19), 0.020, pieces=18),
        ball(p, (0.0, 0.0, 0.20), (0.05, 0.13, 0.11)), bar(p, (-0.18, 0.20), (0.18, 0.20),
            0.05, 0.02), bar(p, (0.0, 0.20), (0.0, 0.02), 0.05, 0.02),
        disc(SILVER, (0.0, 0.20), 0.025, 0.06)], ("car steering wheel",)),
    thing("windshield", (BLACKISH, (0.40, 0.03, 0.02)), _windshield, ("windscreen",
          "car windshield"),
          moving=(_wiper(-0.5), _wiper(0.05))),
    thing("pistol", (BLACKISH, SILVERY), _gun, ("gun", "handgun", "revolver", "toy gun",
          "water gun", "water pistol", "squirt gun")),
    thing("rifle", (WOOD_BROWN,), _rifle, ("shotgun", "hunting rifle", "musket")),
    thing("round bomb", (BLACKISH,), lambda p: [
        ball(p, (0.0, 0.0, 0.14), (0.28, 0.28, 0.28)), post(p, (0.0, 0.0, 0.29),
            (0.09, 0.09, 0.05)), *chain(Material((0.55, 0.42, 0.22)), [(0.0, 0.0, 0.31),
            (0.0, 0.03, 0.38), (0.0, 0.09, 0.40)], 0.010)], ("bomb",)),
    thing("boot", ((0.14, 0.07, 0.03), BLACKISH, (0.55, 0.40, 0.02)), lambda p: [
        *_boot(p, 0.09), *moved(_boot(p, -0.09), shift(x=0.06))],
        ("rain boot", "cowboy boot", "wellington boot", "rubber boot", "leather boot",
         "hiking boot", "winter boot", "work boot", "pair of boots", "a pair of boots",
         "wellington")),
    thing("high heel", (RED_PAINT.colour, BLACKISH), lambda p: [
        *_heel(p, 0.06), *moved(_heel(p, -0.06), shift(x=0.04))],
        ("high heel shoe", "stiletto", "high heeled shoe", "pair of high heels")),
    thing("sandal", ((0.30, 0.16, 0.07), BLUE_PAINT.colour), lambda p: [
        *_sandal(p, 0.07), *moved(_sandal(p, -0.07), shift(x=0.04))],
        ("flip flop", "flip-flop", "pair of sandals", "pair of flip flops")),
    thing("belt", ((0.16, 0.07, 0.03),), lambda p: [
        *ring(leather(p.colour), (0.0, 0.0, 0.02), (0.16, 0.13), 0.018, axis="z", pieces=20),
        *(box(SILVER, (0.13, y, 0.02), (0.012, 0.012, 0.05)) for y in (0.03, -0.03)),
        *(box(SILVER, (0.135, 0.0, z), (0.012, 0.06, 0.010)) for z in (0.0, 0.04))],
        ("leather belt", "waist belt")),
    thing("molecule", (RED_PAINT.colour,), lambda p: [
        ball(p, (0.0, 0.0, 0.16), (0.16, 0.16, 0.16)), *(part for (x, y, z), skin in
            (((0.05, 0.17, 0.26), PALE), ((0.0, -0.18, 0.24), PALE), ((0.02, 0.05, 0.38),
            BLUE_PAINT), ((-0.05, 0.20, 0.06), INK)) for part in (
            rod(IRON, (0.0, 0.0, 0.16), (x, y, z), 0.016), ball(skin, (x, y, z), (0.11,) * 3)))],
        ("atom model", "molecule model")),
    thing("plastic heart", (RED_PAINT.colour,), lambda p: [
        *(limb(p, (0.0, 0.085 * s, 0.22), (0.0, 0.0, 0.06), 0.085) for s in (1.0, -1.0)),
        spike(p, (0.0, 0.0, 0.12), (0.0, 0.0, 0.0), 0.10)], ("heart", "red heart", "heart shape")),
    thing("ceiling fan", ((0.36, 0.20, 0.08),), lambda p: [
        rod(SILVER, (0.0, 0.0, 1.14), (0.0, 0.0, 1.55), 0.025),
        post(PALE, (0.0, 0.0, 1.57), (1.0, 1.0, 0.04)), post(SILVER, (0.0, 0.0, 1.10),
            (0.22, 0.22, 0.14))], ("ceiling ventilator",),
        moving=(Moving(_fan_blades, spinning("z", 1.3)),)),
    thing("pendant lamp", ((0.10, 0.30, 0.28),), lambda p: [
        peak(p, (0.0, 0.0, 0.22), (0.56, 0.56, 0.30)), ball(Material((1.0, 0.85, 0.55),
            emission=2.5), (0.0, 0.0, 0.08), (0.13, 0.13, 0.13))],
        ("hanging lamp", "pendant light", "ceiling lamp", "ceiling light")),
    thing("laser dot", ((1.0, 0.02, 0.02),), lambda p: [
        ball(Material(p.colour, emission=4.0), (0.0, 0.0, 0.0), (0.10, 0.10, 0.10))],
        ("laser point", "laser spot", "red laser dot"), goes=("air", "slide", 0.5)),
    thing("tilting platform", ((0.45, 0.30, 0.16),), lambda p: [
        box(p, (0.0, 0.0, 0.52), (1.2, 1.2, 0.06)), post(IRON, (0.0, 0.0, 0.25),
            (0.16, 0.16, 0.50)), *(box(toned(p, 0.7), (0.0, -0.5 + 0.25 * k, 0.552),
            (1.2, 0.02, 0.006)) for k in range(5))],
        ("balance platform", "rotating platform", "tilt platform")),
    thing("maraca", ((0.62, 0.20, 0.02),), lambda p: [
        part for y in (0.08, -0.08) for part in (
            limb(_WOOD, (0.0, y, 0.02), (0.0, 1.2 * y, 0.16), 0.014),
            ball(p, (0.0, 1.3 * y, 0.22), (0.10, 0.10, 0.13)),
            *ring(YELLOW_PAINT, (0.0, 1.3 * y, 0.22), (0.05, 0.05), 0.008, axis="z"))],
        ("pair of maracas", "rumba shaker")),
    thing("robot dog", ((0.62, 0.45, 0.03), SILVERY), lambda p: [
        box(p, (0.0, 0.0, 0.50), (0.75, 0.24, 0.18)), box(INK, (0.0, 0.0, 0.60),
            (0.45, 0.20, 0.05)), box(INK, (0.42, 0.0, 0.51), (0.12, 0.20, 0.15)),
        *(disc(Material((0.1, 0.5, 0.9), emission=1.5), (0.05 * s, 0.52), 0.02, 0.01, 0.485)
            for s in (1.0, -1.0))],
        ("robotic dog", "quadruped robot", "four legged robot", "robot quadruped"),
        moving=(_leg(0.30, 0.17, 1.0), _leg(0.30, -0.17, -1.0), _leg(-0.26, 0.17, -1.0),
                _leg(-0.26, -0.17, 1.0)), goes=("ground", "walk", 0.7)),
    thing("powder heap", ((0.78, 0.76, 0.70),), lambda p: [
        peak(mottled(p.colour, contrast=0.1), (0.0, 0.0, 0.07), (0.30, 0.30, 0.14)),
        ball(mottled(p.colour, contrast=0.1), (0.0, 0.0, 0.02), (0.36, 0.36, 0.06))],
        ("heap of flour", "heap of sand", "sand pile",
         "heap of salt")),
    thing("dough", ((0.68, 0.56, 0.36),), lambda p: [
        ball(mottled(p.colour, contrast=0.1), (0.0, 0.0, 0.055), (0.30, 0.34, 0.13)),
        ball(mottled(p.colour, contrast=0.1), (0.02, 0.06, 0.09), (0.18, 0.18, 0.10)),
        *lathe(PALE, [(0.0, 0.24), (0.006, 0.24)], 1)],
        ("bread dough", "pizza dough", "ball of dough", "lump of dough")),
    thing("french fries", ((0.70, 0.46, 0.08),), lambda p: [
        box(RED_PAINT, (0.0, 0.0, 0.05), (0.05, 0.11, 0.10)), *(box(p, (-0.015 + 0.01 * (k % 4),
            -0.045 + 0.0128 * k, 0.10 + 0.012 * ((k * 5) % 4)), (0.010, 0.010, 0.10))
            for k in range(8))], ("fries", "chips", "french fry", "potato fries"),
        plurals=("french fries",)),
    thing("chocolate bar", ((0.10, 0.035, 0.015),), lambda p: [
        box(p, (0.0, 0.0, 0.008), (0.20, 0.10, 0.016)), *(box(toned(p, 1.3),
            (-0.075 + 0.05 * i, -0.03 + 0.03 * j, 0.018), (0.04, 0.023, 0.008))
            for i in range(4) for j in range(3))], ("chocolate", "bar of chocolate",
            "candy bar", "chocolate candy")),
    thing("roast chicken", ((0.45, 0.20, 0.05),), lambda p: [
        post(PALE, (0.0, 0.0, 0.012), (0.42, 0.34, 0.024)), ball(p, (0.0, 0.0, 0.10),
            (0.26, 0.20, 0.16)), *(part for s in (1.0, -1.0) for part in (
            limb(p, (0.08, 0.09 * s, 0.08), (0.16, 0.07 * s, 0.15), 0.032),
            limb(PALE, (0.16, 0.07 * s, 0.15), (0.20, 0.065 * s, 0.19), 0.010),
            limb(p, (-0.06, 0.10 * s, 0.10), (0.0, 0.13 * s, 0.06), 0.022))),
        *(ball(Material((0.06, 0.22, 0.03)), (0.15 * math.cos(a), 0.13 * math.sin(a), 0.03),
            (0.05, 0.05, 0.02)) for a in (0.4, 1.6, 2.8, 4.0, 5.2))],
        ("roasted chicken",)),
    thing("shrimp", ((0.75, 0.30, 0.16),), lambda p: lying([
        *ring(striped(p.colour, toned(p, 1.4).colour, 2.0), (0.0, 0.0, 0.05), (0.035, 0.04), 0.016,
            span=(-60.0, 190.0), pieces=9), *(limb(p, (0.0, 0.02, 0.01), (0.0, 0.05 + 0.012 * k,
            0.0), 0.004) for k in range(3)), *(limb(p, (0.0, -0.035, 0.05),
            (0.0, -0.06 - 0.02 * k, 0.09), 0.002) for k in range(2))]), ("prawn", "king prawn"),
        plurals=("shrimp",)),
    thing("bacon", ((0.48, 0.10, 0.06),), lambda p: [
        box(p if k % 2 else Material((0.72, 0.52, 0.40)), (-0.10 + 0.025 * i,
            -0.03 + 0.012 * k + 0.004 * (i % 2), 0.008 + 0.006 * (i % 2)), (0.026, 0.012, 0.006))
        for i in range(9) for k in range(6)], ("bacon strip", "slice of bacon"),
        plurals=("bacon",)),
))  # fmt: skip

NOUNS = _ROOM
"""Nouns of belongings."""

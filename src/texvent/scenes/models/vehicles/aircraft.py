"""Aircraft: aeroplane, helicopter, drone, rocket, hot-air balloon, UFO; rotors turn with time."""

from __future__ import annotations

import math

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    DARK,
    GLASS,
    RED,
    STEEL,
    TAILLIGHT,
    WHITE,
    YELLOW,
    Material,
    glowing,
    striped,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import (
    Point,
    ball,
    box,
    compose,
    fin,
    level_wing,
    limb,
    moved,
    peak,
    post,
    rod,
    shift,
    spike,
    turn_y,
    turn_z,
    upright_fin,
)
from texvent.scenes.models.variation import choose, fraction, paint
from texvent.scenes.scene import Colour


def build_airplane(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make an airliner, 30 m, with windows, engines and a painted tail; `colour` is its body."""
    body = Material(colour if colour is not None else WHITE)
    accent = Material(choose(seed, "tail", ((0.05, 0.15, 0.5), RED, (0.04, 0.3, 0.2))))
    grey = Material((0.50, 0.52, 0.54))
    parts = [
        rod(body, (-8.0, 0.0, 0.0), (11.0, 0.0, 0.0), 1.8),
        limb(body, (8.0, 0.0, 0.0), (13.0, 0.0, -0.15), 1.75),
        spike(body, (-8.0, 0.0, 0.0), (-16.5, 0.0, 1.1), 1.8),
        box(GLASS, (12.6, 0.0, 0.75), (1.1, 2.0, 0.5)),
        box(GLASS, (1.5, 0.0, 0.45), (17.0, 3.62, 0.38)),
        box(accent, (1.5, 0.0, -0.35), (18.0, 3.60, 0.28)),
        upright_fin(accent, (-11.8, 0.0, 1.0), (-15.8, 0.0, 6.6), 4.6, 0.5),
    ]
    for x, y in ((9.5, 0.0), (-1.5, 2.6), (-1.5, -2.6)):
        parts += [
            rod(STEEL, (x, y, -1.2), (x, y, -3.4), 0.2),
            rod(DARK, (x, y - 0.45, -3.4), (x, y + 0.45, -3.4), 0.7),
        ]
    for side in (1.0, -1.0):
        bend, tail = (-2.5, side * 8.0, -0.2), (-16.2, side * 5.4, 1.4)
        parts += [
            level_wing(grey, (1.2, side * 1.2, -0.8), bend, 4.6, 0.5),
            level_wing(grey, bend, (-6.2, side * 15.0, 0.4), 2.8, 0.35),
            level_wing(grey, (-13.0, side * 0.4, 0.8), tail, 2.4, 0.3),
            rod(accent, (-0.6, side * 5.2, -1.6), (2.8, side * 5.2, -1.6), 0.95),
            rod(DARK, (2.7, side * 5.2, -1.6), (2.9, side * 5.2, -1.6), 0.75),
        ]
    return ArticulatedModel(parts, scale=scale, is_centred=True)


def build_helicopter(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a helicopter, 11 m, with turning main and tail rotors; `colour` is its body."""
    body = Material(paint(colour, seed, "body", (RED, (0.04, 0.12, 0.40), (0.10, 0.20, 0.06))))
    rigid = [
        ball(body, (0.6, 0.0, -0.1), (4.4, 2.0, 2.3)),
        ball(GLASS, (1.45, 0.0, 0.15), (2.6, 1.9, 1.7)),
        box(body, (0.6, 0.0, -0.75), (3.2, 1.7, 0.5)),
        rod(body, (-1.0, 0.0, 0.35), (-6.0, 0.0, 0.75), 0.26),
        limb(body, (-1.8, 0.0, 0.30), (0.4, 0.0, 0.55), 0.65),
        upright_fin(body, (-5.6, 0.0, 0.7), (-6.4, 0.0, 2.2), 1.1, 0.2),
        box(body, (-5.0, 0.0, 0.70), (0.6, 2.0, 0.08)),
        rod(STEEL, (0.3, 0.0, 1.0), (0.3, 0.0, 1.6), 0.12),
    ]
    for side in (1.0, -1.0):
        y = side * 1.05
        rigid.append(rod(DARK, (-1.0, y, -1.65), (2.4, y, -1.65), 0.09))
        rigid += [rod(DARK, (x, side * 0.6, -1.0), (x, y, -1.65), 0.07) for x in (0.0, 1.4)]
    start = fraction(seed, "rotor")
    blades = [
        box(DARK, (0.0, 0.0, 0.0), (9.6, 0.34, 0.08)),
        box(DARK, (0.0, 0.0, 0.0), (0.34, 9.6, 0.08)),
        ball(STEEL, (0.0, 0.0, 0.0), (0.6, 0.6, 0.3)),
    ]
    tail_blades = [
        box(DARK, (0.0, 0.0, 0.0), (1.7, 0.06, 0.16)),
        box(DARK, (0.0, 0.0, 0.0), (0.16, 0.06, 1.7)),
    ]

    def articulate(pose: Pose) -> list[ModelPart]:
        turn = 2.0 * math.pi * (4.0 * pose.time_s + start)
        main = moved(blades, compose(shift(0.3, 0.0, 1.62), turn_z(turn)))
        tail = moved(tail_blades, compose(shift(-6.1, -0.25, 1.1), turn_y(3.0 * turn)))
        return [*main, *tail]

    return ArticulatedModel(rigid, scale=scale, articulate=articulate, is_centred=True)


def build_drone(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a quadrotor drone, 0.9 m, with turning propellers; `colour` is its body."""
    body = Material(colour if colour is not None else (0.10, 0.10, 0.11))
    propeller = Material((0.55, 0.55, 0.57))
    corners = [(x, y, 0.04) for x in (0.30, -0.30) for y in (0.30, -0.30)]
    rigid = [
        ball(body, (0.0, 0.0, 0.0), (0.44, 0.26, 0.15)),
        *(rod(body, (0.0, 0.0, 0.0), corner, 0.024) for corner in corners),
        *(post(DARK, (x, y, z), (0.08, 0.08, 0.09)) for x, y, z in corners),
        ball(GLASS, (0.19, 0.0, -0.07), (0.10, 0.10, 0.10)),
        ball(glowing((0.1, 0.9, 0.2), 2.0), (-0.22, 0.0, 0.0), (0.04, 0.06, 0.04)),
        ball(TAILLIGHT, (0.22, 0.0, 0.03), (0.04, 0.06, 0.03)),
        *(
            rod(DARK, (0.10 * x, 0.10 * y, -0.04), (0.12 * x, 0.15 * y, -0.20), 0.014)
            for x in (1.0, -1.0)
            for y in (1.0, -1.0)
        ),
        *(rod(DARK, (0.16, y, -0.20), (-0.16, y, -0.20), 0.014) for y in (0.15, -0.15)),
    ]
    start = fraction(seed, "rotor")
    blade_pair = [box(propeller, (0.0, 0.0, 0.0), (0.38, 0.045, 0.012))]

    def articulate(pose: Pose) -> list[ModelPart]:
        parts: list[ModelPart] = []
        for index, (x, y, z) in enumerate(corners):
            sign = 1.0 if index in (0, 3) else -1.0
            turn = sign * 2.0 * math.pi * (6.0 * pose.time_s + start) + index
            parts += moved(blade_pair, compose(shift(x, y, z + 0.06), turn_z(turn)))
        return parts

    return ArticulatedModel(rigid, scale=scale, articulate=articulate, is_centred=True)


def build_rocket(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make an upright rocket, 10 m, whose flame flickers; `colour` is its nose and fins."""
    accent = Material(colour if colour is not None else RED)
    body = Material(WHITE)
    rigid = [
        post(body, (0.0, 0.0, 0.2), (1.8, 1.8, 6.0)),
        peak(accent, (0.0, 0.0, 4.3), (1.8, 1.8, 2.2)),
        post(accent, (0.0, 0.0, 0.6), (1.84, 1.84, 0.5)),
        ball(GLASS, (0.86, 0.0, 2.0), (0.3, 0.8, 0.8)),
        ball(GLASS, (0.0, -0.86, 2.0), (0.8, 0.3, 0.8)),
        peak(DARK, (0.0, 0.0, -2.95), (1.3, 1.3, 0.9)),
    ]
    for x, y in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)):
        root, tip = (0.8 * x, 0.8 * y, -1.8), (2.0 * x, 2.0 * y, -3.4)
        thin = (-0.16 * y, 0.16 * x, 0.0)
        rigid.append(fin(accent, root, tip, chord=(0.0, 0.0, 2.2), thickness=thin))
    start = fraction(seed, "flame")

    def articulate(pose: Pose) -> list[ModelPart]:
        burst = math.sin(2.0 * math.pi * (7.0 * pose.time_s + start))
        long = 2.2 + 0.35 * burst
        outer, inner = glowing((1.0, 0.35, 0.03), 2.5), glowing((1.0, 0.80, 0.30), 4.0)
        return [
            spike(outer, (0.0, 0.0, -3.2), (0.0, 0.0, -3.2 - long), 0.62),
            spike(inner, (0.0, 0.0, -3.2), (0.0, 0.0, -3.2 - 0.6 * long), 0.40),
        ]

    return ArticulatedModel(rigid, scale=scale, articulate=articulate, is_centred=True)


def build_hot_air_balloon(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a hot-air balloon, 18 m, with a banded envelope and a basket."""
    hue = paint(colour, seed, "cloth", (RED, (0.05, 0.2, 0.6)))
    cloth, second = striped(hue, YELLOW, 3.0), Material(hue)
    basket = striped((0.26, 0.14, 0.06), (0.16, 0.08, 0.03), 5.0)
    parts = [
        ball(cloth, (0.0, 0.0, 3.0), (12.0, 12.0, 12.0)),
        spike(second, (0.0, 0.0, 0.6), (0.0, 0.0, -6.6), 5.45),
        box(basket, (0.0, 0.0, -7.8), (1.9, 1.9, 1.5)),
        ball(glowing((1.0, 0.5, 0.1), 2.0), (0.0, 0.0, -6.2), (0.5, 0.5, 0.9)),
        *(rod(DARK, (x, y, -7.2), (x, y, -4.6), 0.06) for y in (0.9, -0.9) for x in (0.9, -0.9)),
    ]
    return ArticulatedModel(parts, scale=scale, is_centred=True)


def build_ufo(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a flying saucer, 6 m, that spins; `colour` is its disc."""
    disc = Material(colour if colour is not None else (0.40, 0.42, 0.45))
    rigid = [
        ball(disc, (0.0, 0.0, 0.0), (6.0, 6.0, 1.1)),
        ball(GLASS, (0.0, 0.0, 0.45), (2.4, 2.4, 1.8)),
        ball(Material((0.25, 0.26, 0.28)), (0.0, 0.0, -0.30), (3.0, 3.0, 0.9)),
    ]
    lamps = []
    for index in range(8):
        angle = 2.0 * math.pi * index / 8.0
        hue = (0.2, 1.0, 0.4) if index % 2 else (1.0, 0.6, 0.1)
        at: Point = (2.45 * math.cos(angle), 2.45 * math.sin(angle), 0.12)
        lamps.append(ball(glowing(hue, 2.5), at, (0.5, 0.5, 0.5)))
    start = fraction(seed, "spin")

    def articulate(pose: Pose) -> list[ModelPart]:
        return moved(lamps, turn_z(2.0 * math.pi * (0.4 * pose.time_s + start)))

    return ArticulatedModel(rigid, scale=scale, articulate=articulate, is_centred=True)


NOUNS = (
    Noun(
        "airplane", build_airplane, "air", 40.0, "fly",
        ("plane", "aeroplane", "jet", "aircraft", "airliner"), ("aircraft",),
    ),
    Noun("helicopter", build_helicopter, "air", 12.0, "fly", ("chopper",)),
    Noun("drone", build_drone, "air", 2.5, "fly", ("quadcopter", "quadrotor", "uav")),
    Noun(
        "rocket", build_rocket, "air", 8.0, "fly",
        (),
    ),
    Noun("hot air balloon", build_hot_air_balloon, "air", 2.0, "float", ("hot-air balloon",)),
    Noun("ufo", build_ufo, "air", 6.0, "fly", ("flying saucer", "alien ship")),
)  # fmt: skip

"""Objects in a room: cup, bottle, clock, lamp, candle, fan, pendulum, umbrella."""

from __future__ import annotations

import itertools
import math

from texvent.scenes.models.articulated_model import STANDING_POSES, ArticulatedModel
from texvent.scenes.models.materials import (
    BLACK,
    CHROME,
    DARK,
    RED,
    STEEL,
    WHITE,
    WOOD,
    YELLOW,
    Material,
    glowing,
    shade,
)
from texvent.scenes.models.protocol import ModelPart, Pose, fixed_noun, working_noun
from texvent.scenes.models.shapes import (
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
    turn_x,
    turn_y,
    turn_z,
)
from texvent.scenes.models.variation import fraction, paint
from texvent.scenes.scene import Colour

_GLAZES: tuple[Colour, ...] = (RED, (0.05, 0.20, 0.45), WHITE, YELLOW)


def build_cup(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a coffee cup on a saucer, 10 cm; `colour` is its glaze."""
    glaze = Material(paint(colour, seed, "glaze", _GLAZES))
    white = Material(WHITE)
    parts = [
        post(white, (0.0, 0.0, 0.005), (0.15, 0.15, 0.010)),
        post(glaze, (0.0, 0.0, 0.055), (0.084, 0.084, 0.090)),
        post(Material((0.05, 0.022, 0.01)), (0.0, 0.0, 0.0975), (0.074, 0.074, 0.006)),
        limb(glaze, (0.0, -0.040, 0.082), (0.0, -0.066, 0.078), 0.007),
        limb(glaze, (0.0, -0.068, 0.080), (0.0, -0.068, 0.048), 0.007),
        limb(glaze, (0.0, -0.066, 0.046), (0.0, -0.040, 0.036), 0.007),
    ]
    return ArticulatedModel(parts, scale=scale)


def build_bottle(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a bottle with a label, 30 cm; `colour` is its glass."""
    glass = Material(colour if colour is not None else (0.02, 0.12, 0.04))
    parts = [
        post(glass, (0.0, 0.0, 0.09), (0.08, 0.08, 0.18)),
        ball(glass, (0.0, 0.0, 0.18), (0.08, 0.08, 0.08)),
        post(glass, (0.0, 0.0, 0.24), (0.030, 0.030, 0.10)),
        post(Material(WHITE), (0.0, 0.0, 0.09), (0.082, 0.082, 0.08)),
        post(Material(RED), (0.0, 0.0, 0.092), (0.083, 0.083, 0.025)),
        post(Material((0.35, 0.22, 0.10)), (0.0, 0.0, 0.285), (0.034, 0.034, 0.025)),
    ]
    return ArticulatedModel(parts, scale=scale)


def build_clock(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a round clock on a foot, 0.5 m, facing +x; its hands run fast enough to watch."""
    rim = Material(paint(colour, seed, "rim", (RED, (0.04, 0.15, 0.4))))
    face, dark = Material(WHITE), Material(BLACK)
    middle = (0.0, 0.0, 0.30)
    rigid = [
        rod(rim, (-0.05, 0.0, 0.30), (0.040, 0.0, 0.30), 0.24),
        rod(face, (0.0, 0.0, 0.30), (0.045, 0.0, 0.30), 0.205),
        box(rim, (0.0, 0.12, 0.04), (0.12, 0.06, 0.10)),
        box(rim, (0.0, -0.12, 0.04), (0.12, 0.06, 0.10)),
    ]
    tick = box(dark, (0.046, 0.0, 0.475), (0.006, 0.020, 0.045))
    for hour in range(12):
        rigid += moved([tick], turn_x(math.pi * hour / 6.0, middle))
    hour_hand = [box(dark, (0.050, 0.0, 0.36), (0.006, 0.026, 0.13))]
    minute_hand = [box(dark, (0.055, 0.0, 0.38), (0.006, 0.018, 0.18))]
    second_hand = [box(Material(RED), (0.060, 0.0, 0.37), (0.006, 0.010, 0.21))]
    start = 12.0 * fraction(seed, "hour")

    def articulate(pose: Pose) -> list[ModelPart]:
        # Seconds are true; minutes and hours run 60 times as fast, so that a clip shows them.
        seconds = -2.0 * math.pi * pose.time_s / 60.0
        minutes = seconds - 2.0 * math.pi * start
        hours = minutes / 12.0
        return [
            *moved(hour_hand, turn_x(hours, middle)),
            *moved(minute_hand, turn_x(minutes, middle)),
            *moved(second_hand, turn_x(6.0 * seconds, middle)),
        ]

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


def build_lamp(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a floor lamp with a glowing shade, 1.6 m; `colour` is its shade."""
    hue = colour if colour is not None else (0.90, 0.72, 0.42)
    parts = [
        post(DARK, (0.0, 0.0, 0.02), (0.36, 0.36, 0.04)),
        post(STEEL, (0.0, 0.0, 0.70), (0.035, 0.035, 1.35)),
        post(glowing(hue, 0.9), (0.0, 0.0, 1.38), (0.42, 0.42, 0.22)),
        post(glowing(hue, 0.9), (0.0, 0.0, 1.54), (0.32, 0.32, 0.12)),
    ]
    return ArticulatedModel(parts, scale=scale)


def build_candle(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a candle, 25 cm, whose flame flickers; `colour` is its wax."""
    wax = Material(colour if colour is not None else (0.78, 0.70, 0.55))
    rigid = [
        post(CHROME, (0.0, 0.0, 0.008), (0.12, 0.12, 0.016)),
        post(wax, (0.0, 0.0, 0.10), (0.06, 0.06, 0.18)),
        post(Material(BLACK), (0.0, 0.0, 0.195), (0.005, 0.005, 0.02)),
    ]
    start = 2.0 * math.pi * fraction(seed, "flame")

    def articulate(pose: Pose) -> list[ModelPart]:
        t = pose.time_s
        tall = 0.055 + 0.006 * math.sin(23.0 * t + start) + 0.004 * math.sin(41.0 * t)
        lean = 0.006 * math.sin(9.0 * t + start)
        base, tip = (0.0, 0.0, 0.203), (lean, 0.6 * lean, 0.203 + tall)
        inner = (0.6 * lean, 0.4 * lean, 0.203 + 0.55 * tall)
        return [
            limb(glowing((1.0, 0.50, 0.10), 3.0), base, tip, 0.014),
            limb(glowing((1.0, 0.85, 0.45), 5.0), base, inner, 0.009),
        ]

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


_FAN_HZ = 3.37
"""Turns per second: no multiple of a quarter turn in common steps of stills, .2 and .4 s."""


def build_fan(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a table fan, 0.6 m, its blades turning on +x; `colour` is its blades."""
    hue = colour if colour is not None else (0.05, 0.25, 0.45)
    blades, second = Material(hue), Material(shade(hue, 1.8))
    rigid = [
        post(DARK, (0.0, 0.0, 0.02), (0.26, 0.26, 0.04)),
        post(STEEL, (0.0, 0.0, 0.20), (0.04, 0.04, 0.36)),
        rod(DARK, (-0.12, 0.0, 0.40), (0.03, 0.0, 0.40), 0.055),
    ]
    start = fraction(seed, "turn")

    def articulate(pose: Pose) -> list[ModelPart]:
        turn = 2.0 * math.pi * (_FAN_HZ * pose.time_s + start)
        parts = [rod(CHROME, (0.02, 0.0, 0.40), (0.08, 0.0, 0.40), 0.03)]
        for index in range(4):
            wing = blade(
                second if index == 0 else blades, (0.0, 0.0, 0.02), (0.0, 0.0, 0.19),
                chord=(0.03, 0.12, 0.0), thickness=(0.012, 0.0, 0.0),
            )  # fmt: skip
            motion = compose(shift(0.055, 0.0, 0.40), turn_x(turn + 0.5 * math.pi * index))
            parts += moved([wing], motion)
        return parts

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


def build_pendulum(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a pendulum on a stand, 1.2 m, that swings across y; `colour` is its bob."""
    bob = Material(colour if colour is not None else (0.60, 0.30, 0.04))
    rigid = [
        box(WOOD, (0.0, 0.0, 0.03), (0.40, 0.90, 0.06)),
        *(rod(WOOD, (0.0, y, 0.05), (0.0, y, 1.18), 0.025) for y in (0.42, -0.42)),
        rod(WOOD, (0.0, -0.45, 1.17), (0.0, 0.45, 1.17), 0.025),
    ]
    length = 0.85
    hung = [
        rod(STEEL, (0.0, 0.0, 1.17), (0.0, 0.0, 1.17 - length), 0.010),
        ball(bob, (0.0, 0.0, 1.17 - length), (0.20, 0.20, 0.20)),
    ]
    start = 2.0 * math.pi * fraction(seed, "swing")
    rate = math.sqrt(9.81 / length)

    def articulate(pose: Pose) -> list[ModelPart]:
        # Small-angle pendulum: period 2π √(length / g).
        angle = 0.40 * math.sin(rate * pose.time_s + start)
        return moved(hung, turn_x(angle, (0.0, 0.0, 1.17)))

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


_RESTS_RAD = math.atan(0.87)
"""From the ground to the shaft of an open umbrella that lies on its rim and its handle."""


def build_umbrella(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make an open umbrella for the hand, 0.9 m; `colour` is its cloth.

    It lies on its rim and its handle; carried ("move") its shaft is upright.
    """
    hue = paint(colour, seed, "cloth", (RED, (0.05, 0.2, 0.5), YELLOW))
    cloth, other, rib = Material(hue), Material(shade(hue, 0.72)), Material(shade(hue, 0.4))
    dome = [(0.62, 0.52), (0.73, 0.45), (0.82, 0.29), (0.86, 0.08)]
    parts = [
        rod(STEEL, (0.0, 0.0, 0.08), (0.0, 0.0, 0.93), 0.010),
        *(limb(WOOD, start, end, 0.018) for start, end in (
            ((0.0, 0.0, 0.16), (0.0, 0.0, 0.05)), ((0.0, 0.0, 0.05), (0.0, 0.04, 0.015)),
            ((0.0, 0.04, 0.015), (0.0, 0.08, 0.05)))),
    ]  # fmt: skip
    for index in range(8):
        start, end = (math.tau * (index + k) / 8.0 for k in (0.0, 1.0))
        middle = 0.5 * (start + end)
        for (low, wide), (high, slim) in itertools.pairwise(dome):
            across = wide * 2.1 * math.sin(math.pi / 8.0)
            foot = (wide * math.cos(middle), wide * math.sin(middle), low)
            tip = (slim * math.cos(middle), slim * math.sin(middle), high)
            chord = (-across * math.sin(middle), across * math.cos(middle), 0.0)
            parts.append(
                plank(other if index % 2 else cloth, foot, tip, chord=chord,
                      thickness=(0.008 * math.cos(middle), 0.008 * math.sin(middle), 0.008))
            )  # fmt: skip
            ends = [(r * math.cos(start), r * math.sin(start), z) for z, r in
                    ((low, wide), (high, slim))]  # fmt: skip
            parts.append(rod(rib, ends[0], ends[1], 0.009))
    parts.append(ball(cloth, (0.0, 0.0, 0.86), (0.2, 0.2, 0.03)))
    laid = moved(parts, compose(turn_z(-0.9), turn_y(0.5 * math.pi - _RESTS_RAD)))

    def articulate(pose: Pose) -> list[ModelPart]:
        return parts if pose.activity == "move" else laid

    return ArticulatedModel([], scale=scale, articulate=articulate, poses=STANDING_POSES)


def build_parasol(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a garden umbrella, 2.4 m; `colour` is its cloth."""
    hue = paint(colour, seed, "cloth", (RED, YELLOW, (0.05, 0.2, 0.5)))
    parts = [
        post(DARK, (0.0, 0.0, 0.04), (0.50, 0.50, 0.08)),
        post(WOOD, (0.0, 0.0, 1.20), (0.06, 0.06, 2.40)),
        peak(Material(hue), (0.0, 0.0, 2.12), (2.60, 2.60, 0.56)),
        post(Material(shade(hue, 0.6)), (0.0, 0.0, 1.80), (2.56, 2.56, 0.08)),
        ball(Material(WHITE), (0.0, 0.0, 2.41), (0.10, 0.10, 0.10)),
    ]
    return ArticulatedModel(parts, scale=scale)


NOUNS = (
    fixed_noun("cup", build_cup, ("coffee cup", "teacup")),
    fixed_noun("bottle", build_bottle, ("wine bottle",)),
    working_noun("clock", build_clock, ("wall clock",)),
    fixed_noun("lamp", build_lamp, ("floor lamp", "standing lamp")),
    fixed_noun("candle", build_candle, ("candle flame", "burning candle", "lit candle")),
    working_noun("fan", build_fan, ("electric fan", "table fan")),
    working_noun("pendulum", build_pendulum, (), ("pendula",)),
    fixed_noun("umbrella", build_umbrella),
    fixed_noun(
        "parasol",
        build_parasol,
        ("beach umbrella", "patio umbrella", "garden umbrella", "sun umbrella", "table umbrella"),
    ),
)
